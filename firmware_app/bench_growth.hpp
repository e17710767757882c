#pragma once

#include <string>
#include <vector>

#include "firmware_app/bench_bed.hpp"

namespace graspd {

/// How the time grows with one size.
struct GrowthPoint {
  double size = 0;
  BenchRun run;
};
struct Growth {
  std::string with;                 ///< What grows.
  std::vector<GrowthPoint> points;  ///< By rising size.
};

/// Looks at windows of the frames about the middle of their scene points, for several shares of the points: more
/// of them at one density. Fails as detect() does, like all functions here.
[[nodiscard]] Result<Growth> growth_with_scene(BenchBed& bed);

/// Lets shares of every bank's references vote: more points of the model.
[[nodiscard]] Result<Growth> growth_with_references(BenchBed& bed);

/// Lets the first views of every bank vote.
[[nodiscard]] Result<Growth> growth_with_views(BenchBed& bed);

/// Takes more and more threads, up to one for each processor. `bed` must have memory for most_threads().
[[nodiscard]] Result<Growth> growth_with_threads(BenchBed& bed);

/// The threads asked for, or one for each processor when that is more.
[[nodiscard]] int most_threads(const BenchInput& input);

}  // namespace graspd
