#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/geometry/rigid_transform.hpp"

namespace graspd {

/// Why an instance was found but not picked. A grasp is put to the tests in the order of `tool`, `opening`, `tilt`,
/// `reach`, `avoided`, `wall`, `collision`, `neighbour`, `closing`, `retreat`, `unseen`; an instance has the reason of
/// its grasp that came furthest.
enum class GraspRejection : std::uint8_t {
  none,
  no_grasp,   ///< The part file lists no grasp: graspd invents none, since it cannot know where a part may be held.
  tilt,       ///< The tool would lean further from the vertical than allowed.
  reach,      ///< The pick or the approach pose lies outside the robot's reach.
  collision,  ///< On its way in the gripper would come too near to something that the sensor measured; nearer counts as
              ///< too near beside what is neither a detected instance nor the bin.
  opening,    ///< The gripper cannot open that wide.
  tool,       ///< The cell has no tool of the kind, or of the number, that the grasp needs.
  avoided,    ///< A pick at this place failed not long ago.
  wall,       ///< On its way in the gripper would touch the bin.
  unseen,     ///< A part that the sensor could not see may well be in the way, or the frame ends there.
  neighbour,  ///< On its way in the gripper would touch another instance, where the sensor did not see it.
  closing,    ///< Closing, the jaws would catch something that is not the part.
  retreat,    ///< On the way out the gripper would touch something, or the held part the bin.
  no_bin,     ///< The bin was to be found in the frame and was not: nobody knows where its walls are.
};
inline constexpr std::size_t grasp_rejection_count = 14;

/// A name for logs and tables, in lower case.
[[nodiscard]] const char* grasp_rejection_name(GraspRejection rejection);

/// The grasp that was chosen. Frame `robot` is the camera's frame unless a calibration is configured.
struct Pick {
  RigidTransform robot_from_tool;      ///< The tool when it holds the part.
  RigidTransform robot_from_approach;  ///< The tool before it moves in, back along its z.
  RigidTransform robot_from_part;      ///< Of the symmetric poses the one in which the part file's grasp is meant.
  float opening = 0;                   ///< Metres between the jaws before closing.
  float score = 0;                     ///< The instance's score.
  float tilt = 0;                      ///< Radians between the tool's way in and straight down.
  float clearance = 0;                 ///< Metres from the gripper's way in to the nearest measured obstacle; capped.
  float value = 0;                     ///< What picks are ordered by: core/grasp/ranking.hpp.
  std::uint32_t instance = 0;          ///< Index into Detections::instances.
  std::uint32_t grasp = 0;             ///< PartGrasp::number.
  std::uint32_t tool = 0;              ///< Tool::number.
};

/// A grasp that was tried and rejected, for pictures and reports.
struct RejectedGrasp {
  RigidTransform robot_from_tool;
  float opening = 0;
  std::uint32_t instance = 0;
  std::uint32_t grasp = 0;  ///< PartGrasp::number.
  std::uint32_t tool = 0;   ///< Tool::number.
  GraspRejection reason = GraspRejection::none;
};

/// What was cut: the result is right, but a better pick may have been left out. And what is still open.
enum PickFlag : std::uint32_t {
  flag_grasps_cut = 1U << 0U,     ///< An instance had more grasps than the workspace holds, or than its share of the
                                  ///< checks: those ranked last went.
  flag_picks_cut = 1U << 1U,      ///< More instances than the workspace holds: those with the lowest scores went.
  flag_not_all_asked = 1U << 2U,  ///< Of some instances it is not known whether they can be picked: nobody asked yet.
};

/// Where the bin stands in one frame.
struct BinFit {
  bool found = false;
  RigidTransform robot_from_bin;  ///< Meaningful only when found.
  /// Share of the length of each wall (at lower x, upper x, lower y, upper y) along which it was measured.
  std::array<float, 4> measured{};
  float residual = 0;  ///< Metres: root mean square of what the measured points of the inner faces disagree by.
};

/// The outcome of one choice as far as it has come, in memory of the workspace: valid until it goes on or the next one
/// begins.
struct PickResult {
  bool found = false;
  Pick best;                    ///< The first of `picks`; meaningful only when `found`.
  std::span<const Pick> picks;  ///< The best pick of each pickable instance, in the order to pick them; the first ones
                                ///< when not all were asked for.
  std::span<const GraspRejection> reasons;  ///< One for each instance; `none` for the pickable ones, and for those of
                                            ///< which nothing is known yet.
  std::span<const RejectedGrasp> rejected;  ///< Grasps that failed when they were looked up in the frame; as many as
                                            ///< the workspace holds.
  BinFit bin;                               ///< Meaningful only with BinParameters::fitted.
  std::uint32_t pickable = 0;               ///< Instances that can be picked; at least, with flag_not_all_asked.
  std::uint32_t unlisted = 0;               ///< Those of them whose picks are not in `picks` yet.
  std::uint32_t checks = 0;                 ///< Grasps that were looked up in the frame.
  std::array<std::uint32_t, grasp_rejection_count> rejections{};  ///< Instances by reason.
  GraspRejection main_reason =
      GraspRejection::none;  ///< Of most instances that are not pickable; `none`: there are none.
  std::uint32_t flags = 0;   ///< PickFlag bits.
};

}  // namespace graspd
