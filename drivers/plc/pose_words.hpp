#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/geometry/rigid_transform.hpp"
#include "drivers/plc/orientation.hpp"
#include "drivers/plc/word_order.hpp"

namespace graspd {

enum class PositionUnit : std::uint8_t { millimetre, metre };
enum class AngleUnit : std::uint8_t { degree, radian };

/// How values are written to registers. Scaled integers are in micrometres, and in thousandths of a
/// degree or millionths of a radian; components of a quaternion in millionths.
struct BlockFormat {
  WordOrder word_order = WordOrder::abcd;
  PoseConvention convention = PoseConvention::rotation_vector;
  PositionUnit length = PositionUnit::millimetre;
  AngleUnit angle = AngleUnit::degree;
};

/// Whether a number is a float32 in the units of the format, or a scaled int32.
enum class NumberKind : std::uint8_t { floating, scaled };

/// Registers that a pose takes: seven numbers of two words, position and then orientation.
inline constexpr std::size_t pose_words = 14;

/// Writes a length (metres) to the first two of `words`. What an int32 cannot hold is cut to its range.
void put_length(std::span<std::uint16_t> words, double metres, NumberKind kind, const BlockFormat& format);
/// Reads a length (metres) from the first two of `words`.
[[nodiscard]] double get_length(std::span<const std::uint16_t> words, NumberKind kind, const BlockFormat& format);
/// Reads an angle (radians) from the first two of `words`.
[[nodiscard]] double get_angle(std::span<const std::uint16_t> words, NumberKind kind, const BlockFormat& format);

/// Writes a pose to the first pose_words of `words`.
void put_pose(std::span<std::uint16_t> words, const RigidTransform& pose, NumberKind kind, const BlockFormat& format);
/// Reads the four numbers of an orientation (radians, or components of a quaternion) from the first eight of `words`.
[[nodiscard]] std::array<double, 4> get_orientation(std::span<const std::uint16_t> words, NumberKind kind,
                                                    const BlockFormat& format);
/// Reads a pose from the first pose_words of `words`. Its numbers are as finite as those in the registers.
[[nodiscard]] RigidTransform get_pose(std::span<const std::uint16_t> words, NumberKind kind, const BlockFormat& format);

}  // namespace graspd
