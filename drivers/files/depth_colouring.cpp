#include "drivers/files/depth_colouring.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace graspd {

namespace {

constexpr Colour not_measured{16, 17, 22};

/// The depths between which most of the frame lies.
struct DepthRange {
  float nearest = 0;
  float farthest = 1;
};

DepthRange range_of(std::span<const float> depth) {
  std::vector<float> values;
  for (std::size_t i = 0; i < depth.size(); i += 7) {
    if (depth[i] > 0.0F) values.push_back(depth[i]);
  }
  if (values.empty()) return {};
  // Stray pixels must not take the colours away from the rest.
  const auto at = [&](double share) {
    const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + place, values.end());
    return values[static_cast<std::size_t>(place)];
  };
  const float nearest = at(0.005);
  const float farthest = at(0.995);
  return {nearest, std::max(farthest, nearest + 1e-3F)};
}

/// A calm scale of even steps in lightness: far is a dark blue, near a pale sand.
Colour scale_colour(float nearness) {
  constexpr std::array<Colour, 6> stops{
      {{38, 52, 92}, {44, 84, 116}, {62, 118, 128}, {104, 150, 134}, {158, 180, 142}, {222, 210, 170}}};
  const float place = std::clamp(nearness, 0.0F, 1.0F) * static_cast<float>(stops.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  return blend(stops[below], stops[below + 1], place - static_cast<float>(below));
}

/// The slope of depth along one direction (metres a pixel) from the neighbours that lie on the same
/// surface; 0 where there are none.
float slope(const DepthFrame& frame, int u, int v, int du, int dv, float largest_step) {
  const float z = frame.at(u, v);
  float sum = 0;
  int count = 0;
  for (const int sign : {-1, 1}) {
    const int nu = u + sign * du;
    const int nv = v + sign * dv;
    if (!frame.camera.contains(nu, nv)) continue;
    const float step = frame.at(nu, nv) - z;
    if (frame.at(nu, nv) == 0.0F || std::abs(step) > largest_step) continue;
    sum += static_cast<float>(sign) * step;
    ++count;
  }
  return count == 0 ? 0.0F : sum / static_cast<float>(count);
}

/// Brightness of the surface at a pixel under a light from the upper left behind the camera.
float shading(const DepthFrame& frame, int u, int v) {
  const float z = frame.at(u, v);
  const float pixel = z / frame.camera.fx;
  // Over a few pixels the noise of the sensor hides the shape less than over one.
  constexpr int reach = 2;
  const float largest_step = 6.0F * reach * pixel;
  const Vector3 normal(slope(frame, u, v, reach, 0, largest_step) / (reach * pixel),
                       slope(frame, u, v, 0, reach, largest_step) / (reach * pixel), -1.0F);
  const Vector3 light = Vector3(-0.45F, -0.55F, -0.7F).normalized();
  return 0.35F + 0.85F * std::max(normal.normalized().dot(light), 0.0F);
}

Colour brightened(Colour colour, float factor) {
  return factor <= 1.0F ? blend({0, 0, 0}, colour, factor) : blend(colour, {255, 255, 255}, factor - 1.0F);
}

}  // namespace

Picture colour_depth(const DepthFrame& frame) {
  const DepthRange range = range_of(frame.depth);
  Picture picture(frame.camera.width, frame.camera.height, not_measured);
  for (int v = 0; v < frame.camera.height; ++v) {
    for (int u = 0; u < frame.camera.width; ++u) {
      const float z = frame.at(u, v);
      if (!(z > 0.0F)) continue;
      const float nearness = (range.farthest - z) / (range.farthest - range.nearest);
      picture.at(u, v) = brightened(scale_colour(nearness), shading(frame, u, v));
    }
  }
  return picture;
}

}  // namespace graspd
