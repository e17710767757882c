#include "tests/benchmarks/depth_ranking.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/geometry/depth_render.hpp"

namespace graspd {
namespace {

struct Judged {
  RankedPose pose;
  std::vector<std::size_t> agreeing;  // Pixels of the frame.
};

Judged judge(const RigidTransform& pose, const MeshView& mesh, const DepthFrame& frame, float tolerance) {
  Judged judged{{pose, -1.0F}, {}};
  const ImageRectangle rectangle = projected_bounds(mesh, pose, frame.camera);
  if (rectangle.empty()) return judged;
  const Camera window = cropped(frame.camera, rectangle);
  std::vector<float> depth(window.pixel_count());
  render_depth(mesh, pose, window, depth);
  int drawn = 0;
  int free_space = 0;
  for (int v = 0; v < window.height; ++v) {
    for (int u = 0; u < window.width; ++u) {
      const float model = depth[window.index(u, v)];
      if (model == 0.0F) continue;
      ++drawn;
      const std::size_t pixel = frame.camera.index(u + rectangle.left, v + rectangle.top);
      const float scene = frame.depth[pixel];
      if (scene == 0.0F) continue;
      if (std::abs(scene - model) <= tolerance) {
        judged.agreeing.push_back(pixel);
      } else if (scene > model) {
        ++free_space;
      }
    }
  }
  if (drawn > 0) {
    judged.pose.score =
        static_cast<float>(static_cast<int>(judged.agreeing.size()) - free_space) / static_cast<float>(drawn);
  }
  return judged;
}

}  // namespace

std::vector<RankedPose> rank_by_depth(std::span<const RigidTransform> poses, const MeshView& mesh,
                                      const DepthFrame& frame, float tolerance, float minimum_score) {
  std::vector<Judged> candidates;
  for (const RigidTransform& pose : poses) {
    Judged judged = judge(pose, mesh, frame, tolerance);
    if (judged.pose.score > minimum_score) candidates.push_back(std::move(judged));
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Judged& a, const Judged& b) { return a.pose.score > b.pose.score; });
  std::vector<std::uint8_t> claimed(frame.camera.pixel_count(), 0);
  std::vector<RankedPose> kept;
  for (const Judged& candidate : candidates) {
    const auto taken = std::count_if(candidate.agreeing.begin(), candidate.agreeing.end(),
                                     [&](std::size_t pixel) { return claimed[pixel] != 0; });
    if (2 * static_cast<std::size_t>(taken) > candidate.agreeing.size()) continue;
    for (const std::size_t pixel : candidate.agreeing) claimed[pixel] = 1;
    kept.push_back(candidate.pose);
  }
  return kept;
}

}  // namespace graspd
