// Times choose_pick on piles of many parts in a bin and prints microseconds and the work done. For instruction counts
// run it under valgrind --tool=callgrind --toggle-collect='graspd::choose_pick*' with one repetition.

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "core/grasp/planner.hpp"
#include "tests/collisions/pile_scene.hpp"
#include "tests/core/grasp/grasp_memory.hpp"

namespace graspd {
namespace {

/// The first `count` of the detected instances; parts that are hidden do not count.
void keep_instances(PileScene& scene, std::size_t count) {
  if (scene.detected.size() > count) scene.detected.resize(count);
}

double percentile(std::vector<double>& sorted, double share) {
  return sorted[std::min(sorted.size() - 1, static_cast<std::size_t>(share * static_cast<double>(sorted.size())))];
}

void time_choices(const char* name, const HeldShape& part, PileScene& scene, int repetitions,
                  GraspWorkspace& workspace) {
  const Bank bank = part.bank();
  Detections detections;
  detections.instances = scene.detected;
  std::vector<double> times;
  PickResult result;
  for (int i = 0; i < repetitions; ++i) {
    const auto start = std::chrono::steady_clock::now();
    result = choose_pick(scene.frame(), detections, {&bank, 1}, scene.parameters, workspace);
    times.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(times.begin(), times.end());
  std::printf("| %s | %zu | %u | %u | %.0f | %.0f | %.0f |\n", name, scene.detected.size(), result.pickable,
              result.checks, times.front(), percentile(times, 0.5), percentile(times, 0.999));
}

}  // namespace
}  // namespace graspd

int main(int argument_count, char** arguments) {
  using namespace graspd;
  const int repetitions = argument_count > 1 ? std::max(1, std::atoi(arguments[1])) : 1000;
  GraspMemory memory;

  const PileBin bin{0.25F, 0.19F};
  const Camera camera{1280, 960, 1100.0F, 1100.0F, 639.5F, 479.5F};
  std::printf(
      "| part | instances | pickable | grasps checked | us, least | median | 99.9%% "
      "|\n|---|---|---|---|---|---|---|\n");
  const std::vector<std::pair<const char*, HeldShape>> parts{
      {"block", held_block()}, {"round bar", held_bar()}, {"bracket", held_bracket()}};
  for (const auto& [name, part] : parts) {
    PileScene scene = pile_scene(part, 90, bin, camera, SensorStrain::medium, 3);
    keep_instances(scene, 60);
    time_choices(name, part, scene, repetitions, memory.workspace);
  }
  return 0;
}
