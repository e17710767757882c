#include "tests/benchmarks/detected_piles.hpp"

#include "core/grasp/planner.hpp"
#include "drivers/system/clock.hpp"
#include "tests/benchmarks/thread_seconds.hpp"

namespace graspd {

DetectedPiles::DetectedPiles(std::size_t parts, std::size_t picks) : picks_(picks) {
  const PileBin bin{0.25F, 0.19F};
  const Camera camera{1280, 960, 1100.0F, 1100.0F, 639.5F, 479.5F};
  for (std::size_t i = 0; i < shapes_.size(); ++i) {
    scenes_[i] = pile_scene(shapes_[i], parts + parts / 2, bin, camera, SensorStrain::medium, 3);
    scenes_[i].detected.resize(std::min(parts, scenes_[i].detected.size()));
  }
}

ResultBlock DetectedPiles::answer(const PlcRequest& request, double& detection_seconds) {
  const std::int64_t start = monotonic_ns();
  const double start_seconds = thread_seconds();
  for (std::size_t i = 0; i < other_memory_.size(); i += 64) ++other_memory_[i];
  detection_seconds = thread_seconds() - start_seconds;
  const std::int64_t detected = monotonic_ns();

  const std::size_t number = request.sequence % scenes_.size();
  PileScene& scene = scenes_[number];
  const Bank bank = shapes_[number].bank();
  Detections detections;
  detections.instances = scene.detected;
  begin_choice(scene.frame(), detections, {&bank, 1}, scene.parameters, memory_.workspace);
  const PickResult picks = find_picks(memory_.workspace, picks_);

  ResultBlock block;
  block.sequence = request.sequence;
  block.request_id = request.request_id;
  block.code = picks.found ? ResultCode::ok : ResultCode::not_pickable;
  block.verified = true;
  block.pick = picks.best.robot_from_tool;
  block.approach = picks.best.robot_from_approach;
  block.part_pose = picks.best.robot_from_part;
  block.stage_time[static_cast<std::size_t>(BlockStage::match)] = static_cast<float>(detected - start) * 1e-9F;
  return block;
}

}  // namespace graspd
