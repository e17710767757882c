#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/geometry/rigid_transform.hpp"
#include "core/status.hpp"
#include "drivers/plc/pose_words.hpp"
#include "drivers/plc/register_map.hpp"
#include "drivers/plc/result_codes.hpp"

namespace graspd {

/// The frame in which the poses of a block are given; the number is that of the register.
enum class PoseFrame : std::uint16_t { camera = 0, robot = 1 };

/// The stages whose times a block carries, in the order of their registers.
enum class BlockStage : std::uint8_t { total, capture, preprocess, match, cluster, refine, verify, grasp };
inline constexpr std::size_t block_stage_count = 8;

/// One pick of a list. Metres.
struct ListedPick {
  std::uint16_t part = 0;
  std::uint16_t grasp = 0;
  std::uint16_t tool = 0;  ///< Tool::number.
  float score = 0;         ///< In [0, 1].
  float opening = 0;
  RigidTransform pick;  ///< The tool when it holds the part.
};

/// The answer to one request. Lengths are metres, times seconds. The poses map the tool or the part to
/// the frame `frame`, and go out only when has_poses(); otherwise zeros do.
struct ResultBlock {
  std::uint16_t sequence = 0;  ///< PlcRequest::sequence of the request that is answered.
  std::uint16_t request_id = 0;
  ResultCode code = ResultCode::internal;
  ResultReason reason = ResultReason::none;
  std::uint16_t flags = 0;  ///< As result_flags() makes them.
  std::uint16_t part = 0;
  std::uint16_t view = 0;
  std::uint16_t grasp = 0;
  std::uint16_t tool = 0;  ///< Tool::number.
  float score = 0;         ///< In [0, 1].
  std::uint16_t instances_found = 0;
  std::uint16_t pickable = 0;
  std::uint16_t remaining = 0;     ///< Pickable instances left after those in this answer.
  std::uint16_t result_index = 0;  ///< 1 for the first pick of a capture, then one more with each `next`.
  PoseFrame frame = PoseFrame::camera;
  float frame_age = 0;  ///< From the exposure to this answer.
  std::array<float, block_stage_count> stage_time{};
  float opening = 0;
  RigidTransform pick;      ///< The tool when it holds the part.
  RigidTransform approach;  ///< The tool before it moves in.
  RigidTransform part_pose;
  bool verified = false;  ///< Every instance passed verification and every pick all checks of the planner.
  /// The picks of this answer, the one above first.
  std::array<ListedPick, pick_list::entries> listed{};
  std::uint16_t listed_count = 0;
  float approach_distance = 0;  ///< From each listed pick back along its z to where the straight way in starts.
};

/// True when the block carries a pick that a robot may go to.
[[nodiscard]] bool has_pick(const ResultBlock& result);
/// True when the block carries poses: a pick, or that of a dry run, which is for eyes only.
[[nodiscard]] bool has_poses(const ResultBlock& result);

/// How much of the time that an answer took went to capture and detection, nanoseconds.
[[nodiscard]] std::int64_t detection_ns(const ResultBlock& result);

/// Writes `result` to the first block::count of `words`. Values beyond what a register holds are cut to
/// its range.
void encode(const ResultBlock& result, const BlockFormat& format, std::span<std::uint16_t> words);

/// Reads a block (block::count words) back, poses from the floats. The convention is taken from the block, the rest
/// from `format`; `verified` says that the block carries a pick. Fails with bad_file when the words are too few, torn,
/// of another map version or damaged, or when the test pattern contradicts the word order.
[[nodiscard]] Result<ResultBlock> decode(std::span<const std::uint16_t> words, const BlockFormat& format);

}  // namespace graspd
