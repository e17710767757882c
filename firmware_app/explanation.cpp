#include "firmware_app/explanation.hpp"

#include <algorithm>

#include "core/evaluate/summary.hpp"

namespace graspd {
namespace {

static_assert(chain_stage_count == traced_stage_count);

/// What the detector held for the bank `index`; `judged` gets the instances behind PartChain::judged.
PartChain chain_of(std::uint32_t index, const Bank& bank, const DetectTrace& trace, const Detections& detections,
                   std::vector<Instance>& judged) {
  PartChain chain;
  chain.part = bank.part->part_id;
  for (const TracedPose& pose : trace.poses) {
    if (pose.bank == index) chain.poses[static_cast<std::size_t>(pose.stage)].push_back(pose.camera_from_part);
  }
  for (const std::span<const Instance> instances : {detections.instances, detections.rejected}) {
    for (const Instance& instance : instances) {
      if (instance.bank == index) judged.push_back(instance);
    }
  }
  for (const Instance& instance : judged) {
    chain.judged.push_back({instance.camera_from_part, instance.score, static_cast<std::size_t>(instance.rejection)});
  }
  return chain;
}

void explain_bank(const EvaluationImage& image, const PartErrors& errors, const EvaluationPart& part,
                  std::uint32_t index, const DetectRequest& request, const Detections& detections,
                  const VerifyParameters& parameters, Explanation& explanation) {
  const Bank& bank = request.banks[index];
  std::vector<Instance> judged;
  const PartChain chain = chain_of(index, bank, *request.trace, detections, judged);
  const PartExplanation explained = explain(image, errors, part, chain);
  const VerifyThresholds& thresholds = bank.part->thresholds;
  const float minimum_score = request.minimum_score >= 0.0F ? request.minimum_score : thresholds.minimum_score;
  for (const TargetFate& fate : explained.targets) {
    explanation.targets.push_back(fate);
    if (fate.fate == Fate::found) continue;
    MissedTarget missed{fate, {}, {}, minimum_score};
    if (fate.fate == Fate::rejected) {
      missed.judged = judged[fate.judged];
      missed.tests = test_outcomes(missed.judged.evidence, parameters, thresholds);
    }
    explanation.missed.push_back(missed);
  }
  std::array<Verdicts, rejection_count>& verdicts = explanation.verdicts[part.id];
  for (const JudgedFate& fate : explained.judged) {
    const Instance& instance = judged[fate.judged];
    Verdicts& count = verdicts[static_cast<std::size_t>(instance.rejection)];
    ++(fate.right() ? count.right : count.wrong);
    if (instance.rejection != Rejection::none || fate.right()) continue;
    explanation.false_instances.push_back({image.scene, image.image, part.id, fate.error, instance,
                                           test_outcomes(instance.evidence, parameters, thresholds)});
  }
}

}  // namespace

TraceBuffer::TraceBuffer(const DetectCapacity& capacity, std::size_t banks)
    : storage_(banks * (capacity.hypotheses + std::size_t{4} * capacity.clusters)),
      trace_{FixedVector(std::span(storage_))} {}

void explain_image(const EvaluationImage& image, const ImageErrors& errors, std::span<const EvaluationPart> parts,
                   const DetectRequest& request, const Detections& detections, const VerifyParameters& parameters,
                   Explanation& explanation) {
  explanation.dropped += request.trace->poses.dropped();
  for (std::uint32_t index = 0; index < request.banks.size(); ++index) {
    const std::uint32_t id = request.banks[index].part->part_id;
    const auto part = std::find_if(parts.begin(), parts.end(), [&](const EvaluationPart& p) { return p.id == id; });
    const auto part_errors =
        std::find_if(errors.parts.begin(), errors.parts.end(), [&](const PartErrors& e) { return e.part == id; });
    if (part == parts.end() || part_errors == errors.parts.end()) continue;
    explain_bank(image, *part_errors, *part, index, request, detections, parameters, explanation);
  }
}

}  // namespace graspd
