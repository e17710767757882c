#include "core/evaluate/visible_surface.hpp"

#include <algorithm>
#include <cmath>

namespace graspd {
namespace {

void depth_to_distance(const Camera& camera, std::span<float> values) {
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      float& value = values[camera.index(u, v)];
      if (value > 0.0F) value = camera.point(static_cast<float>(u), static_cast<float>(v), value).norm();
    }
  }
}

/// The smallest rectangle that holds both.
ImageRectangle bounding(const ImageRectangle& a, const ImageRectangle& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  const int left = std::min(a.left, b.left);
  const int top = std::min(a.top, b.top);
  return {left, top, std::max(a.left + a.width, b.left + b.width) - left,
          std::max(a.top + a.height, b.top + b.height) - top};
}

}  // namespace

DistanceImage measured_distance(const DepthFrame& frame) {
  DistanceImage image{{0, 0, frame.camera.width, frame.camera.height}, {frame.depth.begin(), frame.depth.end()}};
  depth_to_distance(frame.camera, image.distance);
  return image;
}

DistanceImage rendered_distance(const MeshView& mesh, const RigidTransform& camera_from_part, const Camera& camera) {
  DistanceImage image;
  image.rectangle = projected_bounds(mesh, camera_from_part, camera);
  if (image.rectangle.empty()) return {};
  const Camera window = cropped(camera, image.rectangle);
  image.distance.resize(window.pixel_count());
  render_depth(mesh, camera_from_part, window, image.distance);
  depth_to_distance(window, image.distance);
  return image;
}

std::array<float, bop19_tolerance_count> visible_surface_discrepancy(const DistanceImage& estimate,
                                                                     const DistanceImage& truth,
                                                                     const DistanceImage& measured, float delta,
                                                                     float diameter) {
  // Pixels where both are visible, counted by the first tolerance that their difference stays below.
  std::array<int, bop19_tolerance_count + 1> agree_from{};
  int visible_in_either = 0;
  const auto compare = [&](int u, int v) {
    const float estimated = estimate.at(u, v);
    const float true_distance = truth.at(u, v);
    const float scene = measured.at(u, v);
    const auto not_hidden = [&](float d) { return d > 0.0F && (scene == 0.0F || d - scene <= delta); };
    const bool truth_visible = not_hidden(true_distance);
    // What the scene shows of the true object, an estimate that lies behind it shows too.
    const bool estimate_visible = not_hidden(estimated) || (truth_visible && estimated > 0.0F);
    if (!truth_visible && !estimate_visible) return;
    ++visible_in_either;
    if (!truth_visible || !estimate_visible) return;
    const double difference = std::abs(static_cast<double>(true_distance) - static_cast<double>(estimated)) / diameter;
    const double step = std::floor(difference / bop19_tolerance_step);
    ++agree_from[static_cast<std::size_t>(std::min(step, static_cast<double>(bop19_tolerance_count)))];
  };

  const ImageRectangle both = bounding(estimate.rectangle, truth.rectangle);
  for (int v = both.top; v < both.top + both.height; ++v) {
    for (int u = both.left; u < both.left + both.width; ++u) compare(u, v);
  }

  std::array<float, bop19_tolerance_count> errors;
  errors.fill(1.0F);
  if (visible_in_either == 0) return errors;
  int agreeing = 0;
  for (std::size_t i = 0; i < bop19_tolerance_count; ++i) {
    agreeing += agree_from[i];
    errors[i] = 1.0F - static_cast<float>(agreeing) / static_cast<float>(visible_in_either);
  }
  return errors;
}

}  // namespace graspd
