#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/detect/cell_verdict.hpp"
#include "core/detect/normals.hpp"
#include "tests/core/detect/random_map.hpp"

namespace graspd {
namespace {

constexpr float tolerance = 0.0015F;

struct Expected {
  bool confirmed = false, behind = false, occluded = false, contradicted = false;
  float distance = 0;
};

/// In the order of LaneVectors; which order Eigen takes depends on the processor.
float dot_of(const Vector3& a, const Vector3& b) { return a.x() * b.x() + (a.y() * b.y() + a.z() * b.z()); }
float length_of(const Vector3& a) { return std::sqrt(dot_of(a, a)); }

/// What the scene says at one cell, by the description and one number at a time.
Expected expected_at(const SceneMap& map, const RenderedModel& model, int u, int v) {
  Expected expected;
  const auto depth = [&](int x, int y) {
    return model.camera.contains(x, y) ? model.front[model.camera.index(x, y)] : 0.0F;
  };
  const auto point = [&](int x, int y) {
    return model.camera.point(static_cast<float>(x), static_cast<float>(y), depth(x, y));
  };
  const float here = depth(u, v);
  const MapCell& cell = map.at(model.rectangle.left + u, model.rectangle.top + v);
  if (here == 0.0F || !cell.measured()) return expected;
  const auto fits = [&](int x, int y) {
    return depth(x, y) > 0.0F && std::abs(depth(x, y) - here) < 8.0F * here / model.camera.fx;
  };
  const auto point_or_middle = [&](int x, int y) { return fits(x, y) ? point(x, y) : point(u, v); };
  const Vector3 across = point_or_middle(u + 1, v) - point_or_middle(u - 1, v);
  const Vector3 down = point_or_middle(u, v + 1) - point_or_middle(u, v - 1);
  const Vector3 scaled = down.cross(across);
  const bool known =
      (fits(u + 1, v) || fits(u - 1, v)) && (fits(u, v + 1) || fits(u, v - 1)) && length_of(scaled) > 0.0F;
  const Vector3 normal = known ? Vector3(scaled / length_of(scaled)) : Vector3(Vector3::Zero());
  const Vector3 ray = model.camera.point(static_cast<float>(u), static_cast<float>(v), 1.0F);
  const float gap = cell.point.z() - here;
  const float slope = known ? std::max(0.25F, std::abs(dot_of(normal, ray)) / length_of(ray)) : 1.0F;
  expected.distance = std::abs(gap) * slope;
  if (std::abs(gap) * 0.25F > tolerance || expected.distance > tolerance) {
    (gap > 0.0F ? expected.behind : expected.occluded) = true;
    return expected;
  }
  const bool agrees = !known || !cell.has_normal() || dot_of(normal, cell.normal) > 0.6F;
  (agrees && cell.foreground != 0 ? expected.confirmed : expected.contradicted) = true;
  return expected;
}

TEST(CellVerdict, IsThatOfEachCellByItselfToTheLastBit) {
  RandomMap scene(48, 33, 3, 0.9);
  fit_normals(2, {}, scene.map);
  std::mt19937 random(8);
  std::normal_distribution<float> offset(0.0F, 0.002F);
  std::bernoulli_distribution here(0.85);
  std::bernoulli_distribution background(0.2);
  for (const int width : {1, 2, 3, 4, 5, 18, 41}) {
    RenderedModel model;
    model.rectangle = {48 - width, 2, width, 31};
    model.camera = cropped(scene.map.camera, model.rectangle);
    std::vector<float> front(model.camera.pixel_count(), 0.0F);
    model.front = front;
    for (int v = 0; v < 31; ++v) {
      for (int u = 0; u < width; ++u) {
        MapCell& cell = scene.map.at(48 - width + u, 2 + v);
        if (background(random)) cell.foreground = 0;
        const float z = cell.measured() ? cell.point.z() : 0.5F;
        if (here(random)) front[model.camera.index(u, v)] = z + offset(random);
      }
    }
    int confirmed = 0;
    for (int v = 0; v < 31; ++v) {
      for (int u = 0; u < width; ++u) {
        // Wherever the four begin.
        const Verdicts verdicts =
            judge_cells(measured_cells(scene.map, model, u, v), ModelCells(model, u, v), model.camera, u, v, tolerance);
        for (int i = 0; i < 4; ++i) {
          const auto lane = static_cast<std::size_t>(i);
          const Expected expected = u + i < width ? expected_at(scene.map, model, u + i, v) : Expected{};
          ASSERT_EQ(verdicts.confirmed[lane] != 0, expected.confirmed) << u << " " << v << " " << i;
          ASSERT_EQ(verdicts.behind[lane] != 0, expected.behind) << u << " " << v << " " << i;
          ASSERT_EQ(verdicts.occluded[lane] != 0, expected.occluded) << u << " " << v << " " << i;
          ASSERT_EQ(verdicts.contradicted[lane] != 0, expected.contradicted) << u << " " << v << " " << i;
          if (!expected.confirmed) continue;
          ASSERT_EQ(verdicts.distance[lane], expected.distance);
          ++confirmed;
        }
      }
    }
    EXPECT_GT(confirmed, 4 * width);
  }
}

}  // namespace
}  // namespace graspd
