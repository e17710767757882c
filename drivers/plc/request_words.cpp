#include "drivers/plc/request_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "drivers/plc/register_map.hpp"
#include "drivers/plc/request_check.hpp"

namespace graspd {
namespace {

constexpr double longest_norm_error = 0.01;

[[nodiscard]] RequestBox read_box(std::span<const std::uint16_t> words, NumberKind kind, const BlockFormat& format) {
  RequestBox box;
  for (int i = 0; i < 3; ++i) {
    const std::size_t at = 2 * static_cast<std::size_t>(i);
    box.reference_from_box.translation[i] = static_cast<float>(get_length(words.subspan(at), kind, format));
    box.half_size[i] = static_cast<float>(get_length(words.subspan(6 + at), kind, format) / 2);
  }
  const auto turn = static_cast<float>(get_angle(words.subspan(12), kind, format));
  box.reference_from_box.rotation = Eigen::AngleAxisf(turn, Vector3::UnitZ()).toRotationMatrix();
  return box;
}

/// Four numbers that were never written are zeros, which as a quaternion are no rotation.
[[nodiscard]] bool is_unit_quaternion(const std::array<double, 4>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::abs(std::sqrt(sum) - 1.0) < longest_norm_error;
}

[[nodiscard]] RigidTransform read_flange_pose(std::span<const std::uint16_t> words, NumberKind kind,
                                              const BlockFormat& format) {
  RigidTransform pose = get_pose(words, kind, format);
  if (format.convention == PoseConvention::quaternion &&
      !is_unit_quaternion(get_orientation(words.subspan(6), kind, format))) {
    pose.rotation.setConstant(std::numeric_limits<float>::quiet_NaN());
  }
  return pose;
}

}  // namespace

PoseConvention request_convention(std::span<const std::uint16_t> registers, const BlockFormat& format) {
  const std::uint16_t named = registers[request_register::pose_convention];
  return named == 0 || named > pose_convention_count ? format.convention : static_cast<PoseConvention>(named);
}

PlcRequest read_request(std::span<const std::uint16_t> registers, const BlockFormat& format) {
  BlockFormat own = format;
  own.convention = request_convention(registers, format);
  const unsigned options = registers[request_register::options];
  const NumberKind kind = (options & request_option::scaled_numbers) != 0 ? NumberKind::scaled : NumberKind::floating;
  const std::uint16_t score = registers[request_register::minimum_score];

  PlcRequest request;
  for (std::size_t i = 0; i < request_register::region_box; ++i) {
    request.well_formed = request.well_formed && is_request_value(i, registers[i]);
  }
  request.request_id = registers[request_register::request_id];
  request.part = registers[request_register::part];
  request.tool = registers[request_register::tool];
  request.minimum_score = score == 0 ? -1.0F : static_cast<float>(score) / 1e4F;
  request.results_wanted = std::max<std::uint16_t>(registers[request_register::results_wanted], 1);
  request.dry_run = (options & request_option::dry_run) != 0;
  request.save_snapshot = (options & request_option::save_snapshot) != 0;
  request.avoid_last_place = (options & request_option::avoid_last_place) != 0;
  request.region = registers[request_register::region];
  if (request.region == request_region::box) {
    request.box = read_box(registers.subspan(request_register::region_box), kind, own);
  }
  request.has_flange_pose = (options & request_option::flange_pose_given) != 0;
  if (request.has_flange_pose) {
    request.robot_from_flange = read_flange_pose(registers.subspan(request_register::flange_pose), kind, own);
  }
  return request;
}

}  // namespace graspd
