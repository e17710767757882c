// Gathers the evidence of poses, right and wrong, in simulated bins of many kinds: what the score is fitted to
// (fit_score) and, in other bins, held against.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "core/detect/detector.hpp"
#include "core/detect/score.hpp"
#include "core/evaluate/surface_error.hpp"
#include "firmware_app/detection_session.hpp"
#include "firmware_app/loaded_banks.hpp"
#include "tests/benchmarks/evidence_bins.hpp"

namespace graspd {
namespace {

struct Options {
  std::vector<std::string> banks;
  std::vector<std::string> kinds;
  std::uint64_t first = 1;
  std::uint64_t count = 3;
};

struct LookedFor {
  LoadedBanks loaded;
  [[nodiscard]] const Bank& bank() const { return loaded.banks.front(); }
};

/// The instance of the part that a pose hits (MSSD below a tenth of the diameter), or -1.
int hit_instance(const Instance& instance, const SimulatedScene& scene, const EvaluationPart& part) {
  const RigidTransform& found = instance.camera_from_part;
  const float limit = 0.1F * part.diameter;
  for (std::size_t k = 0; k < scene.instances.size(); ++k) {
    const RigidTransform& real = scene.instances[k].camera_from_part;
    if (scene.instances[k].part != 0 || (found * part.middle - real * part.middle).norm() > 0.5F * part.diameter)
      continue;
    if (maximum_surface_distance(found, real, part.vertices, part.symmetries, limit) < limit)
      return static_cast<int>(k);
  }
  return -1;
}

bool is_judged_by_score(const Instance& instance) {
  return instance.rejection != Rejection::weak && instance.rejection != Rejection::duplicate &&
         instance.rejection != Rejection::intersecting;
}

void print_row(BinKind kind, std::uint64_t seed, const Bank& bank, const Instance& instance, int hit, float company) {
  const Evidence& e = instance.evidence;
  std::printf("%s,%llu,%s,%d,%s,%.4f,%.4f", bin_kind_name(kind), static_cast<unsigned long long>(seed),
              bank.part->name.data(), hit, rejection_name(instance.rejection), static_cast<double>(instance.score),
              static_cast<double>(company));
  for (const float figure : {e.overlap, e.visible, e.purity, e.measured, e.inside, e.boundary, e.edge, e.decided,
                             e.outline, e.lock, e.blur, e.gap, e.below, e.residual, e.misfit, e.leniency, e.confirmed})
    std::printf(",%.5g", static_cast<double>(figure));
  std::printf("\n");
}

/// One row for each reported pose, and for the best of those that were not in places where nothing was reported.
void print_evidence(BinKind kind, std::uint64_t seed, const Bank& bank, const EvaluationPart& part,
                    const SimulatedScene& scene, const Detections& detections) {
  std::vector<Instance> ordered(detections.instances.begin(), detections.instances.end());
  const auto reported = static_cast<std::ptrdiff_t>(ordered.size());
  std::copy_if(detections.rejected.begin(), detections.rejected.end(), std::back_inserter(ordered), is_judged_by_score);
  std::sort(ordered.begin() + reported, ordered.end(),
            [](const Instance& a, const Instance& b) { return a.score > b.score; });
  std::vector<Vector3> taken;
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    const Instance& instance = ordered[i];
    const Vector3 place = instance.camera_from_part * bank.part->centre;
    const bool is_taken = std::any_of(taken.begin(), taken.end(), [&](const Vector3& other) {
      return (place - other).norm() < 0.3F * bank.part->diameter;
    });
    if (is_taken) continue;
    taken.push_back(place);
    print_row(kind, seed, bank, instance, hit_instance(instance, scene, part),
              company_of(instance, detections.instances));
  }
}

Status run(const Options& options) {
  std::vector<LookedFor> looked_for;
  std::vector<TrialPart> parts;
  for (const std::string& path : options.banks) {
    Result<LoadedBanks> loaded = load_banks(std::vector<std::string>{path});
    if (!loaded.ok()) return loaded.status();
    Result<TrialPart> part = trial_part(loaded.value().banks.front());
    if (!part.ok()) return part.status();
    looked_for.push_back({std::move(loaded).value()});
    parts.push_back(std::move(part).value());
  }
  std::printf(
      "kind,bin,part,hit,rejection,score,company,overlap,visible,purity,measured,inside,boundary,edge,decided,"
      "outline,lock,blur,gap,below,residual,misfit,leniency,confirmed\n");
  DetectionSession session;
  for (std::uint64_t seed = options.first; seed < options.first + options.count; ++seed) {
    for (std::size_t wanted = 0; wanted < parts.size(); ++wanted) {
      const Bank& bank = looked_for[wanted].bank();
      for (const BinKind kind : every_bin_kind) {
        const bool asked =
            options.kinds.empty() || std::any_of(options.kinds.begin(), options.kinds.end(),
                                                 [&](const std::string& name) { return name == bin_kind_name(kind); });
        if (!asked) continue;
        EvidenceBin bin = evidence_bin(kind, parts, wanted, bank, seed);
        const DepthFrame frame = bin.scene.frame();
        session.fit({frame.camera.width, frame.camera.height}, looked_for[wanted].loaded.banks, 1);
        DetectRequest request;
        request.banks = looked_for[wanted].loaded.banks;
        if (bin.empty_known) request.empty_bin = bin.scene.empty_bin();
        Detections detections;
        if (Status status = session.run(frame, request, {}, detections); !status.ok()) return status;
        print_evidence(kind, seed, bank, parts[wanted].evaluation, bin.scene, detections);
        std::fprintf(stderr, "bin %llu, %s, %s: %zu reported\n", static_cast<unsigned long long>(seed),
                     bank.part->name.data(), bin_kind_name(kind), detections.instances.size());
      }
    }
  }
  return {};
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  graspd::Options options;
  CLI::App app("Gathers the evidence of right and wrong poses in simulated bins; rows of comma-separated values");
  app.add_option("--bank", options.banks, "Banks of the parts")->required();
  app.add_option("--kind", options.kinds, "Kinds of bins; all unless given");
  app.add_option("--first", options.first, "Number of the first bin of each kind")->capture_default_str();
  app.add_option("--count", options.count, "Bins of each kind for each part")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const graspd::Status status = graspd::run(options);
  if (!status.ok()) {
    std::fprintf(stderr, "score_evidence: %.*s\n", static_cast<int>(status.message().size()), status.message().data());
  }
  return static_cast<int>(status.code());
}
