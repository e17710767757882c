#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/bank/bank.hpp"
#include "core/detect/detections.hpp"
#include "core/detect/detector.hpp"
#include "core/detect/parameters.hpp"
#include "core/detect/score.hpp"
#include "core/detect/trace.hpp"
#include "core/evaluate/explanation.hpp"

namespace graspd {

/// The memory for the trace of a detection with up to `banks` banks.
class TraceBuffer {
 public:
  TraceBuffer(const DetectCapacity& capacity, std::size_t banks);
  [[nodiscard]] DetectTrace& trace() { return trace_; }

 private:
  std::vector<TracedPose> storage_;
  DetectTrace trace_;
};

/// A target that was not found, with what is needed to say why.
struct MissedTarget {
  TargetFate fate;
  Instance judged;  ///< With Fate::rejected: the right pose and the reason.
  std::array<TestOutcome, evidence_test_count> tests{};
  float minimum_score = 0;
};

/// A reported instance that is wrong.
struct FalseInstance {
  std::uint32_t scene = 0;
  std::uint32_t image = 0;
  std::uint32_t part = 0;
  float error = 0;  ///< See JudgedFate::error.
  Instance instance;
  std::array<TestOutcome, evidence_test_count> tests{};
};

/// Right and wrong hypotheses.
struct Verdicts {
  std::size_t right = 0;
  std::size_t wrong = 0;
};

/// What `graspd validate --explain` prints, gathered over the images.
struct Explanation {
  std::vector<TargetFate> targets;  ///< All of them, found or not.
  std::vector<MissedTarget> missed;
  std::vector<FalseInstance> false_instances;
  /// For each part, judged hypotheses by rejection; those with Rejection::none were reported.
  std::map<std::uint32_t, std::array<Verdicts, rejection_count>> verdicts;
  std::size_t dropped = 0;  ///< Poses for which the trace had no room.
};

/// Explains one image: `request`, which must have a trace, was answered by `detections`; `image` holds what was
/// reported and is true, `errors` belongs to it.
void explain_image(const EvaluationImage& image, const ImageErrors& errors, std::span<const EvaluationPart> parts,
                   const DetectRequest& request, const Detections& detections, const VerifyParameters& parameters,
                   Explanation& explanation);

/// Tables for a person; `part_names` by part number.
[[nodiscard]] std::string explanation_as_text(const Explanation& explanation,
                                              std::span<const std::pair<std::uint32_t, std::string>> part_names);

}  // namespace graspd
