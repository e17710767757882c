// Times the choice of grasps in piles of many parts in a bin, for one pick, for five and for all, and prints
// microseconds and the work done. For instruction counts run it under valgrind --tool=callgrind
// --toggle-collect='graspd::*time_choices*' with one repetition and the number of picks wanted.
//   grasp_choice [REPETITIONS [PICKS [PARTS]]]

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "core/grasp/planner.hpp"
#include "tests/collisions/pile_scene.hpp"
#include "tests/core/grasp/grasp_memory.hpp"

namespace graspd {
namespace {

constexpr std::size_t all_picks = 1000;

/// The first `count` of the detected instances; parts that are hidden do not count.
void keep_instances(PileScene& scene, std::size_t count) {
  if (scene.detected.size() > count) scene.detected.resize(count);
}

double percentile(std::vector<double>& sorted, double share) {
  return sorted[std::min(sorted.size() - 1, static_cast<std::size_t>(share * static_cast<double>(sorted.size())))];
}

[[gnu::noinline]] void time_choices(const char* name, const HeldShape& part, PileScene& scene, int repetitions,
                                    std::size_t wanted, GraspWorkspace& workspace) {
  const Bank bank = part.bank();
  Detections detections;
  detections.instances = scene.detected;
  std::vector<double> times;
  PickResult result;
  for (int i = 0; i < repetitions; ++i) {
    const auto start = std::chrono::steady_clock::now();
    begin_choice(scene.frame(), detections, {&bank, 1}, scene.parameters, workspace);
    result = find_picks(workspace, wanted);
    times.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(times.begin(), times.end());
  std::printf("| %s | %zu | %zu | %u | %u | %.0f | %.0f | %.0f |\n", name, scene.detected.size(), result.picks.size(),
              result.pickable, result.checks, times.front(), percentile(times, 0.5), percentile(times, 0.999));
}

}  // namespace
}  // namespace graspd

int main(int argument_count, char** arguments) {
  using namespace graspd;
  const int repetitions = argument_count > 1 ? std::max(1, std::atoi(arguments[1])) : 1000;
  std::vector<std::size_t> wanted{1, 5, all_picks};
  if (argument_count > 2) wanted = {static_cast<std::size_t>(std::max(1, std::atoi(arguments[2])))};
  const std::size_t count = argument_count > 3 ? static_cast<std::size_t>(std::max(1, std::atoi(arguments[3]))) : 60;
  GraspMemory memory;

  const PileBin bin{0.25F, 0.19F};
  const Camera camera{1280, 960, 1100.0F, 1100.0F, 639.5F, 479.5F};
  std::printf(
      "| part | instances | picks | pickable | grasps checked | us, least | median | 99.9%% "
      "|\n|---|---|---|---|---|---|---|---|\n");
  const std::vector<std::pair<const char*, HeldShape>> parts{
      {"block", held_block()}, {"round bar", held_bar()}, {"bracket", held_bracket()}};
  for (const auto& [name, part] : parts) {
    PileScene scene = pile_scene(part, count + count / 2, bin, camera, SensorStrain::medium, 3);
    keep_instances(scene, count);
    for (const std::size_t picks : wanted) time_choices(name, part, scene, repetitions, picks, memory.workspace);
  }
  return 0;
}
