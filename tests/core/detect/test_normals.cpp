#include <gtest/gtest.h>

#include <vector>

#include "core/detect/normals.hpp"
#include "tests/core/detect/random_map.hpp"

namespace graspd {
namespace {

TEST(Normals, DoNotDependOnWhichCellsAreFittedAtOnce) {
  for (const int radius : {1, 2, 4}) {
    const RandomMap made(37, 12, 4, 0.8);
    std::vector<Vector3> expected;
    for (int shift = 0; shift < 4; ++shift) {
      // The same points, further to the right in a wider map.
      const int width = 37 + shift;
      std::vector<MapCell> cells(static_cast<std::size_t>(width) * 12U);
      SceneMap map = made.map;
      map.camera.width = width;
      map.cells = cells;
      for (int v = 0; v < 12; ++v) {
        for (int u = 0; u < 37; ++u) map.at(u + shift, v) = made.map.at(u, v);
      }
      fit_normals(radius, {2}, map);
      std::size_t fitted = 0;
      for (int v = 0; v < 12; ++v) {
        for (int u = 0; u < 37; ++u) {
          const Vector3& normal = map.at(u + shift, v).normal;
          fitted += normal.isZero() ? 0U : 1U;
          if (shift == 0) expected.push_back(normal);
          EXPECT_EQ(normal, expected[made.map.camera.index(u, v)]) << u << " " << v << " radius " << radius;
        }
      }
      EXPECT_GT(fitted, 200U);
    }
  }
}

TEST(Normals, AreThoseOfAPlaneUpToTheBorder) {
  RandomMap made(18, 9, 1, 1.0);
  const Vector3 normal = Vector3(0.4F, -0.2F, -1.0F).normalized();
  for (int v = 0; v < 9; ++v) {
    for (int u = 0; u < 18; ++u) {
      const Vector3 ray = made.map.camera.point(static_cast<float>(u), static_cast<float>(v), 1.0F);
      made.map.at(u, v).point = ray * (-0.5F / normal.dot(ray));
    }
  }
  made.map.at(4, 4).foreground = 0;
  fit_normals(2, {}, made.map);
  for (int v = 0; v < 9; ++v) {
    for (int u = 0; u < 18; ++u) {
      const Vector3& fitted = made.map.at(u, v).normal;
      if (u == 4 && v == 4) {
        EXPECT_TRUE(fitted.isZero());
      } else {
        EXPECT_LT((fitted - normal).norm(), 1e-3F) << u << " " << v;
      }
    }
  }
}

}  // namespace
}  // namespace graspd
