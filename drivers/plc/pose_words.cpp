#include "drivers/plc/pose_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace graspd {
namespace {

constexpr double degrees_per_radian = 180.0 / std::numbers::pi;

/// What metres are multiplied by on their way to a register.
[[nodiscard]] double length_scale(NumberKind kind, const BlockFormat& format) {
  if (kind == NumberKind::scaled) return 1e6;
  return format.length == PositionUnit::millimetre ? 1e3 : 1.0;
}

/// What radians are multiplied by.
[[nodiscard]] double angle_scale(NumberKind kind, const BlockFormat& format) {
  const bool degrees = format.angle == AngleUnit::degree;
  if (kind == NumberKind::scaled) return degrees ? 1e3 * degrees_per_radian : 1e6;
  return degrees ? degrees_per_radian : 1.0;
}

/// What the numbers of an orientation are multiplied by.
[[nodiscard]] double orientation_scale(NumberKind kind, const BlockFormat& format) {
  if (format.convention != PoseConvention::quaternion) return angle_scale(kind, format);
  return kind == NumberKind::scaled ? 1e6 : 1.0;
}

[[nodiscard]] std::int32_t rounded_int(double value) {
  if (std::isnan(value)) return 0;
  constexpr double limit = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::llround(std::clamp(value, -limit, limit)));
}

void put_number(std::span<std::uint16_t> words, double value, NumberKind kind, WordOrder order) {
  if (kind == NumberKind::scaled) {
    put_int32(words, rounded_int(value), order);
  } else {
    put_float(words, static_cast<float>(value), order);
  }
}

[[nodiscard]] double get_number(std::span<const std::uint16_t> words, NumberKind kind, WordOrder order) {
  return kind == NumberKind::scaled ? static_cast<double>(get_int32(words, order))
                                    : static_cast<double>(get_float(words, order));
}

}  // namespace

void put_length(std::span<std::uint16_t> words, double metres, NumberKind kind, const BlockFormat& format) {
  put_number(words, metres * length_scale(kind, format), kind, format.word_order);
}

double get_length(std::span<const std::uint16_t> words, NumberKind kind, const BlockFormat& format) {
  return get_number(words, kind, format.word_order) / length_scale(kind, format);
}

double get_angle(std::span<const std::uint16_t> words, NumberKind kind, const BlockFormat& format) {
  return get_number(words, kind, format.word_order) / angle_scale(kind, format);
}

void put_pose(std::span<std::uint16_t> words, const RigidTransform& pose, NumberKind kind, const BlockFormat& format) {
  for (std::size_t i = 0; i < 3; ++i) {
    put_length(words.subspan(2 * i), static_cast<double>(pose.translation[static_cast<int>(i)]), kind, format);
  }
  const std::array<double, 4> orientation = orientation_values(pose.rotation, format.convention);
  const double scale = orientation_scale(kind, format);
  for (std::size_t i = 0; i < orientation.size(); ++i) {
    put_number(words.subspan(6 + 2 * i), orientation[i] * scale, kind, format.word_order);
  }
}

std::array<double, 4> get_orientation(std::span<const std::uint16_t> words, NumberKind kind,
                                      const BlockFormat& format) {
  const double scale = orientation_scale(kind, format);
  std::array<double, 4> orientation{};
  for (std::size_t i = 0; i < orientation.size(); ++i) {
    orientation[i] = get_number(words.subspan(2 * i), kind, format.word_order) / scale;
  }
  return orientation;
}

RigidTransform get_pose(std::span<const std::uint16_t> words, NumberKind kind, const BlockFormat& format) {
  RigidTransform pose;
  for (std::size_t i = 0; i < 3; ++i) {
    pose.translation[static_cast<int>(i)] = static_cast<float>(get_length(words.subspan(2 * i), kind, format));
  }
  pose.rotation = rotation_from_values(get_orientation(words.subspan(6), kind, format), format.convention);
  return pose;
}

}  // namespace graspd
