#include "core/evaluate/explanation.hpp"

#include <algorithm>
#include <limits>

#include "core/evaluate/match.hpp"
#include "core/evaluate/summary.hpp"
#include "core/evaluate/surface_error.hpp"

namespace graspd {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

/// MSSD as a share of the diameter, infinite from `limit` on.
float error_of(const RigidTransform& pose, const RigidTransform& truth, const EvaluationPart& part, float limit) {
  // The largest distance between vertices is at least that between their means, which symmetries hardly move.
  const float mean_limit = (limit + 0.1F) * part.diameter;
  if ((pose * part.middle - truth * part.middle).squaredNorm() > mean_limit * mean_limit) return infinite;
  return maximum_surface_distance(pose, truth, part.vertices, part.symmetries, limit * part.diameter) / part.diameter;
}

struct NearPose {
  std::size_t rank = 0;
  float error = infinite;
};

/// The best ranked pose near the true one.
NearPose first_near(std::span<const RigidTransform> poses, const RigidTransform& truth, const EvaluationPart& part) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const float error = error_of(poses[i], truth, part, near_pose_error);
    if (error < near_pose_error) return {i + 1, error};
  }
  return {};
}

/// Where the way of a pose ended that was last near the true one at `stage`.
Fate fate_after(ChainStage stage) {
  switch (stage) {
    case ChainStage::voted:
      return Fate::lost_clustering;
    case ChainStage::clustered:
      return Fate::implausible;
    case ChainStage::plausible:
      return Fate::lost_coarse;
    case ChainStage::aligned:
      return Fate::outranked;
    case ChainStage::distinct:
      return Fate::lost_fine;
  }
  return Fate::never_voted;
}

/// The right judged pose that was reported or, failing that, has the best score.
std::size_t best_right(const PartChain& chain, const RigidTransform& truth, const EvaluationPart& part) {
  std::size_t best = unmatched;
  const auto better = [&](std::size_t a, std::size_t b) {
    const JudgedPose& first = chain.judged[a];
    const JudgedPose& second = chain.judged[b];
    if ((first.reason == 0) != (second.reason == 0)) return first.reason == 0;
    return first.score > second.score;
  };
  for (std::size_t i = 0; i < chain.judged.size(); ++i) {
    const float error = error_of(chain.judged[i].camera_from_part, truth, part, static_cast<float>(right_pose_error));
    if (error < static_cast<float>(right_pose_error) && (best == unmatched || better(i, best))) best = i;
  }
  return best;
}

float nearest_reported(const PartChain& chain, const RigidTransform& truth, const EvaluationPart& part) {
  float nearest = infinite;
  for (const JudgedPose& judged : chain.judged) {
    if (judged.reason == 0) nearest = std::min(nearest, error_of(judged.camera_from_part, truth, part, 1.0F));
  }
  return nearest;
}

void find_loss(const PartChain& chain, const RigidTransform& truth, const EvaluationPart& part, TargetFate& target) {
  target.reported = nearest_reported(chain, truth, part);
  target.judged = best_right(chain, truth, part);
  if (target.judged != unmatched) {
    const JudgedPose& judged = chain.judged[target.judged];
    target.fate = judged.reason == 0 ? Fate::taken : Fate::rejected;
    target.error = error_of(judged.camera_from_part, truth, part, near_pose_error);
    return;
  }
  target.judged = 0;
  target.fate = Fate::never_voted;
  target.error = infinite;
  for (std::size_t s = chain_stage_count; s-- > 0;) {
    const NearPose near = first_near(chain.poses[s], truth, part);
    if (near.rank == 0) continue;
    target.fate = fate_after(static_cast<ChainStage>(s));
    target.rank = near.rank;
    target.error = near.error;
    return;
  }
}

}  // namespace

const char* fate_name(Fate fate) {
  switch (fate) {
    case Fate::found:
      return "found";
    case Fate::never_voted:
      return "never voted";
    case Fate::lost_clustering:
      return "lost in clustering";
    case Fate::implausible:
      return "cluster not kept";
    case Fate::lost_coarse:
      return "lost in coarse ICP";
    case Fate::outranked:
      return "outranked after coarse ICP";
    case Fate::lost_fine:
      return "lost in fine ICP";
    case Fate::rejected:
      return "rejected";
    case Fate::taken:
      return "taken by a neighbour";
  }
  return "unknown";
}

bool JudgedFate::right() const { return error < static_cast<float>(right_pose_error); }

PartExplanation explain(const EvaluationImage& image, const PartErrors& errors, const EvaluationPart& part,
                        const PartChain& chain) {
  std::vector<RigidTransform> truths;
  for (const TruePose& truth : image.truths) {
    if (truth.part == part.id) truths.push_back(truth.camera_from_part);
  }
  PartExplanation explanation;
  const Claims claimed = claims(errors);
  for (std::size_t t = 0; t < truths.size(); ++t) {
    if (!errors.targeted[t]) continue;
    TargetFate target;
    target.scene = image.scene;
    target.image = image.image;
    target.level = image.level;
    target.part = part.id;
    target.truth = t;
    target.visibility = errors.visibilities[t];
    if (claimed.estimate_of_truth[t] == unmatched) find_loss(chain, truths[t], part, target);
    explanation.targets.push_back(target);
  }
  for (std::size_t i = 0; i < chain.judged.size(); ++i) {
    JudgedFate judged{i, infinite};
    for (const RigidTransform& truth : truths) {
      judged.error =
          std::min(judged.error, error_of(chain.judged[i].camera_from_part, truth, part, std::min(judged.error, 1.0F)));
    }
    explanation.judged.push_back(judged);
  }
  return explanation;
}

}  // namespace graspd
