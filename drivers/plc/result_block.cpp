#include "drivers/plc/result_block.hpp"

#include <cmath>

#include "drivers/plc/coherent_words.hpp"

namespace graspd {
namespace {

[[nodiscard]] bool is_finite(const RigidTransform& pose) {
  return pose.rotation.allFinite() && pose.translation.allFinite();
}

void put_pick(std::span<std::uint16_t> words, const ResultBlock& result, const BlockFormat& format) {
  const auto put = [&](NumberKind kind, std::size_t opening, std::size_t pick, std::size_t approach, std::size_t part) {
    put_length(words.subspan(opening), static_cast<double>(result.opening), kind, format);
    put_pose(words.subspan(pick), result.pick, kind, format);
    put_pose(words.subspan(approach), result.approach, kind, format);
    put_pose(words.subspan(part), result.part_pose, kind, format);
  };
  put(NumberKind::floating, block::opening, block::pick_pose, block::approach_pose, block::part_pose);
  put(NumberKind::scaled, block::opening_scaled, block::pick_pose_scaled, block::approach_pose_scaled,
      block::part_pose_scaled);
}

[[nodiscard]] Status check(std::span<const std::uint16_t> words, WordOrder order) {
  if (Status whole = check_coherent(words, block::count, "result block"); !whole.ok()) return whole;
  if (get_float(words.subspan(block::test_float), order) != block::test_float_value ||
      get_int32(words.subspan(block::test_int), order) != block::test_int_value) {
    return Status::format(StatusCode::bad_file, "result block: the test pattern does not read as 123.456 in order %s",
                          word_order_name(order).data());
  }
  const std::uint16_t convention = words[block::pose_convention];
  if (convention < 1 || convention > pose_convention_count) {
    return Status::format(StatusCode::bad_file, "result block: unknown pose convention %u", unsigned{convention});
  }
  return {};
}

}  // namespace

bool has_poses(const ResultBlock& result) {
  return result.verified && (result.code == ResultCode::ok || result.code == ResultCode::dry_run) &&
         is_finite(result.pick) && is_finite(result.approach) && is_finite(result.part_pose) &&
         std::isfinite(result.opening);
}

bool has_pick(const ResultBlock& result) { return has_poses(result) && result.code == ResultCode::ok; }

std::int64_t detection_ns(const ResultBlock& result) {
  double seconds = 0.0;
  for (const BlockStage stage : {BlockStage::capture, BlockStage::preprocess, BlockStage::match, BlockStage::cluster,
                                 BlockStage::refine, BlockStage::verify}) {
    seconds += static_cast<double>(result.stage_time[static_cast<std::size_t>(stage)]);
  }
  return std::llround(seconds * 1e9);
}

void encode(const ResultBlock& result, const BlockFormat& format, std::span<std::uint16_t> words) {
  begin_coherent(words.first(block::count), result.sequence);
  words[block::request_id] = result.request_id;
  words[block::result_code] = static_cast<std::uint16_t>(result.code);
  words[block::reason] = static_cast<std::uint16_t>(result.reason);
  words[block::flags] = result.flags;
  words[block::part] = result.part;
  words[block::view] = result.view;
  words[block::grasp] = result.grasp;
  words[block::tool] = result.tool;
  words[block::score] = rounded_word(1e4 * static_cast<double>(result.score));
  words[block::instances_found] = result.instances_found;
  words[block::pickable] = result.pickable;
  words[block::remaining] = result.remaining;
  words[block::result_index] = result.result_index;
  words[block::pose_convention] = static_cast<std::uint16_t>(format.convention);
  words[block::pose_frame] = static_cast<std::uint16_t>(result.frame);
  words[block::frame_age] = rounded_word(1e3 * static_cast<double>(result.frame_age));
  for (std::size_t i = 0; i < block_stage_count; ++i) {
    words[block::time_total + i] = rounded_word(1e3 * static_cast<double>(result.stage_time[i]));
  }
  words[block::test_word] = block::test_word_value;
  put_float(words.subspan(block::test_float), block::test_float_value, format.word_order);
  put_int32(words.subspan(block::test_int), block::test_int_value, format.word_order);
  if (has_poses(result)) put_pick(words, result, format);
  end_coherent(words.first(block::count));
}

Result<ResultBlock> decode(std::span<const std::uint16_t> words, const BlockFormat& format) {
  if (Status status = check(words, format.word_order); !status.ok()) return status;
  BlockFormat own = format;
  own.convention = static_cast<PoseConvention>(words[block::pose_convention]);
  ResultBlock result;
  result.sequence = words[block::sequence_first];
  result.request_id = words[block::request_id];
  result.code = static_cast<ResultCode>(words[block::result_code]);
  result.reason = static_cast<ResultReason>(words[block::reason]);
  result.flags = words[block::flags];
  result.part = words[block::part];
  result.view = words[block::view];
  result.grasp = words[block::grasp];
  result.tool = words[block::tool];
  result.score = static_cast<float>(words[block::score]) / 1e4F;
  result.instances_found = words[block::instances_found];
  result.pickable = words[block::pickable];
  result.remaining = words[block::remaining];
  result.result_index = words[block::result_index];
  result.frame = static_cast<PoseFrame>(words[block::pose_frame]);
  result.frame_age = static_cast<float>(words[block::frame_age]) / 1e3F;
  for (std::size_t i = 0; i < block_stage_count; ++i) {
    result.stage_time[i] = static_cast<float>(words[block::time_total + i]) / 1e3F;
  }
  result.verified = result.code == ResultCode::ok || result.code == ResultCode::dry_run;
  if (result.verified) {
    constexpr NumberKind kind = NumberKind::floating;
    result.opening = static_cast<float>(get_length(words.subspan(block::opening), kind, own));
    result.pick = get_pose(words.subspan(block::pick_pose), kind, own);
    result.approach = get_pose(words.subspan(block::approach_pose), kind, own);
    result.part_pose = get_pose(words.subspan(block::part_pose), kind, own);
  }
  return result;
}

}  // namespace graspd
