#include "tests/benchmarks/graspd_runner.hpp"

#include <algorithm>
#include <cstdio>
#include <set>
#include <utility>
#include <vector>

#include "core/detect/detector.hpp"
#include "firmware_app/detection_session.hpp"
#include "firmware_app/loaded_banks.hpp"
#include "tests/benchmarks/thread_seconds.hpp"

namespace graspd {

struct GraspdRunner::Opened {
  LoadedBanks loaded;
  DetectionSession session;
};

GraspdRunner::GraspdRunner(std::unique_ptr<Opened> opened) : opened_(std::move(opened)) {}
GraspdRunner::GraspdRunner(GraspdRunner&&) noexcept = default;
GraspdRunner::~GraspdRunner() = default;

Result<GraspdRunner> GraspdRunner::open(const std::string& bank_folder, std::span<const EvaluationImage> images) {
  std::set<std::uint32_t> wanted;
  for (const EvaluationImage& image : images) {
    for (const EvaluationTarget& target : image.targets) wanted.insert(target.part);
  }
  std::vector<std::string> paths;
  for (const std::uint32_t part : wanted) {
    char name[32];
    std::snprintf(name, sizeof name, "/obj_%06u.bank", part);
    paths.push_back(bank_folder + name);
  }
  Result<LoadedBanks> loaded = load_banks(paths);
  if (!loaded.ok()) return loaded.status();
  return GraspdRunner(std::make_unique<Opened>(Opened{std::move(loaded).value(), {}}));
}

Status GraspdRunner::run(LoadedFrame& frame, EvaluationImage& image) {
  Opened& opened = *opened_;
  const DepthFrame depth = frame.frame();
  opened.session.fit({depth.camera.width, depth.camera.height}, opened.loaded.banks, 1);
  std::vector<Bank> banks;
  for (const Bank& bank : opened.loaded.banks) {
    const bool wanted = std::any_of(image.targets.begin(), image.targets.end(),
                                    [&](const EvaluationTarget& t) { return t.part == bank.part->part_id; });
    if (wanted) banks.push_back(bank);
  }
  DetectRequest request;
  request.banks = banks;
  request.empty_bin = frame.empty_bin();
  DetectParameters parameters;
  Detections detections;
  const double start = thread_seconds();
  if (Status status = opened.session.run(depth, request, parameters, detections); !status.ok()) return status;
  image.seconds = thread_seconds() - start;
  image.estimates.clear();
  for (const Instance& instance : detections.instances) {
    image.estimates.push_back({banks[instance.bank].part->part_id, instance.score, instance.camera_from_part});
  }
  return {};
}

}  // namespace graspd
