#include "core/detect/edge_blur.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace graspd {

namespace {

constexpr std::uint32_t fewest_steps = 100;
/// Steps, in details: less may be a slope of the part, more is no neighbour of the part.
constexpr float lowest_step = 5.0F;
constexpr float highest_step = 25.0F;
/// Half the width that a smeared step may have, in details.
constexpr float reach_details = 2.5F;

struct BlurSum {
  double width = 0;  ///< Metres.
  std::uint32_t steps = 0;
};

/// Takes the step around pixel `centre` of a line of pixels `pitch` apart, when there is one between two surfaces that
/// face the sensor.
void take_step(const float* centre, std::ptrdiff_t pitch, int reach, float detail, float focal_length, BlurSum& sum) {
  const auto at = [&](int k) { return centre[k * pitch]; };
  const float before = at(-reach);
  const float after = at(reach);
  if (before <= 0.0F || after <= 0.0F) return;
  const float step = after - before;
  if (std::abs(step) < lowest_step * detail || std::abs(step) > highest_step * detail) return;
  const float flat = 0.15F * std::abs(step);
  const auto goes_on = [&](int k, float depth) { return at(k) > 0.0F && std::abs(at(k) - depth) < flat; };
  if (!goes_on(-2 * reach, before) || !goes_on(2 * reach, after)) return;
  int between = 0;
  for (int k = -reach; k <= reach; ++k) {
    const float share = (at(k) - before) / step;
    between += at(k) > 0.0F && share > 0.2F && share < 0.8F ? 1 : 0;
  }
  sum.width += static_cast<float>(between) * std::min(before, after) / focal_length;
  ++sum.steps;
}

}  // namespace

float measure_edge_blur(const DepthFrame& frame, float detail, const Execution& execution) {
  constexpr int line_step = 4;
  const Camera& camera = frame.camera;
  BlurSum sum;
  // Beyond the image there is nothing to look at, and what stands right before the lens must not reach further.
  const auto furthest = static_cast<float>(std::max(camera.width, camera.height));
  const auto reach_at = [&](float depth) {
    return std::max(3, static_cast<int>(std::lround(std::min(reach_details * detail * camera.fx / depth, furthest))));
  };
  // `k` is the pixel's place on its line.
  const auto take_pixel = [&](int u, int v, std::ptrdiff_t pitch, int k, int length, float focal_length) {
    const float* const pixel = &frame.depth[camera.index(u, v)];
    if (!is_measured(*pixel)) return;
    const int reach = reach_at(*pixel);
    if (k >= 2 * reach && k + 2 * reach < length) take_step(pixel, pitch, reach, detail, focal_length, sum);
  };
  for (int v = 0; v < camera.height && !execution.late(); ++v) {
    if (v % line_step == 0) {
      for (int u = 0; u < camera.width; ++u) take_pixel(u, v, 1, u, camera.width, camera.fx);
    }
    for (int u = 0; u < camera.width; u += line_step) take_pixel(u, v, camera.width, v, camera.height, camera.fy);
  }
  return sum.steps < fewest_steps ? 0.0F : static_cast<float>(sum.width / sum.steps);
}

void know_edge_blur(const DepthFrame& frame, float detail, const Execution& execution, EdgeBlurs& blurs) {
  if (blurs.count == blurs.known.size() || blurs.knows(detail)) return;
  blurs.known[blurs.count++] = {detail, measure_edge_blur(frame, detail, execution)};
}

}  // namespace graspd
