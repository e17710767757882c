#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/evaluate/image_evaluation.hpp"

namespace graspd {

/// Poses on their way through a detector, before they are judged: stages in the order of the chain.
enum class ChainStage : std::uint8_t { voted, clustered, plausible, aligned, distinct };
inline constexpr std::size_t chain_stage_count = 5;

/// Before it is refined to the end, a pose counts as the right one below this MSSD, as a share of the
/// diameter: refinement can still make it right. After that, `right_pose_error` decides.
inline constexpr float near_pose_error = 0.2F;

/// A pose that was refined to the end and judged.
struct JudgedPose {
  RigidTransform camera_from_part;
  float score = 0;
  std::size_t reason = 0;  ///< 0: reported; else why it was rejected, by the detector's own numbers.
};

/// All that a detector held for one part in one image.
struct PartChain {
  std::uint32_t part = 0;
  std::array<std::vector<RigidTransform>, chain_stage_count> poses;  ///< Best first.
  std::vector<JudgedPose> judged;
};

/// What became of the right pose of a target.
enum class Fate : std::uint8_t {
  found,
  never_voted,      ///< No vote for a pose near it.
  lost_clustering,  ///< Voted for, but no cluster lies near it.
  implausible,      ///< A cluster, but not among the most plausible.
  lost_coarse,      ///< Led away by coarse refinement.
  outranked,        ///< Not among the best after coarse refinement, or merged into one further off.
  lost_fine,        ///< Refined to the end, but not right.
  rejected,         ///< Right, and rejected by a test or in the selection.
  taken,            ///< Reported, but another estimate or target claims it: two targets that look alike.
};
inline constexpr std::size_t fate_count = 9;

/// In words, for tables.
[[nodiscard]] const char* fate_name(Fate fate);

/// A target and what became of it.
struct TargetFate {
  std::uint32_t scene = 0;
  std::uint32_t image = 0;
  std::string level;
  std::uint32_t part = 0;
  std::size_t truth = 0;  ///< Among the true poses of the part in the image.
  float visibility = 0;
  Fate fate = Fate::found;
  float error = 0;         ///< MSSD (share of the diameter) of the nearest pose at the last stage that held one.
  std::size_t rank = 0;    ///< Of the best ranked near pose at that stage, from 1; 0 when there is none.
  std::size_t judged = 0;  ///< With `rejected`: the right pose with the best score, in PartChain::judged.
  float reported = 0;      ///< MSSD of the nearest reported pose; infinite when none is nearer than 1 (diameter).
};

/// A judged pose and whether it is right: near a true pose, however many others are.
struct JudgedFate {
  std::size_t judged = 0;  ///< Index into PartChain::judged.
  float error = 0;         ///< MSSD to the nearest true pose, as a share of the diameter; infinite beyond 1.

  [[nodiscard]] bool right() const;
};

/// One part in one image, explained.
struct PartExplanation {
  std::vector<TargetFate> targets;
  std::vector<JudgedFate> judged;  ///< In the order of PartChain::judged.
};

/// Looks for each target of `part` in what `chain` held; `errors` are those of the same part in `image`.
/// A missed target's pose was lost behind the last stage that still held a pose near it.
[[nodiscard]] PartExplanation explain(const EvaluationImage& image, const PartErrors& errors,
                                      const EvaluationPart& part, const PartChain& chain);

}  // namespace graspd
