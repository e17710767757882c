#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/geometry/depth_render.hpp"

namespace graspd {
namespace {

const Camera camera{160, 120, 200.0F, 210.0F, 78.3F, 61.7F};

Mesh box_mesh(const Vector3& half) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back((i & 1) != 0 ? half.x() : -half.x(), (i & 2) != 0 ? half.y() : -half.y(),
                               (i & 4) != 0 ? half.z() : -half.z());
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// A ball of latitude and longitude bands, radius 1, fine enough to stand for the sphere.
Mesh sphere_mesh(std::uint32_t bands) {
  Mesh mesh;
  for (std::uint32_t i = 0; i <= bands; ++i) {
    for (std::uint32_t j = 0; j < 2 * bands; ++j) {
      const double theta = M_PI * i / bands;
      const double phi = M_PI * j / bands;
      mesh.vertices.emplace_back(static_cast<float>(std::sin(theta) * std::cos(phi)),
                                 static_cast<float>(std::sin(theta) * std::sin(phi)),
                                 static_cast<float>(std::cos(theta)));
    }
  }
  for (std::uint32_t i = 0; i < bands; ++i) {
    for (std::uint32_t j = 0; j < 2 * bands; ++j) {
      const std::uint32_t next = (j + 1) % (2 * bands);
      const std::uint32_t row = i * 2 * bands;
      const std::uint32_t below = row + 2 * bands;
      mesh.triangles.push_back({row + j, below + j, row + next});
      mesh.triangles.push_back({row + next, below + j, below + next});
    }
  }
  return mesh;
}

/// The nearest depth at which the ray of a pixel meets the posed box; 0 when it misses. `slack`
/// grows the box.
double cast_at_box(const RigidTransform& pose, const Vector3& half, float slack, int u, int v) {
  const RigidTransform part_from_camera = inverse(pose);
  const Vector3 origin = part_from_camera.translation;
  const Vector3 ray = part_from_camera.rotation * camera.point(static_cast<float>(u), static_cast<float>(v), 1.0F);
  double enter = 0.0;
  double leave = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double a = static_cast<double>(-half[axis] - slack - origin[axis]) / static_cast<double>(ray[axis]);
    const double b = static_cast<double>(half[axis] + slack - origin[axis]) / static_cast<double>(ray[axis]);
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave ? enter : 0.0;
}

RigidTransform random_pose(std::mt19937& random) {
  std::normal_distribution<float> gauss;
  const Eigen::Quaternionf q(gauss(random), gauss(random), gauss(random), gauss(random));
  return {q.normalized().toRotationMatrix(),
          Vector3(0.03F * gauss(random), 0.03F * gauss(random), 0.5F + 0.02F * gauss(random))};
}

TEST(DepthRender, BoxAgreesWithRayCasting) {
  const Vector3 half(0.05F, 0.03F, 0.02F);
  const Mesh mesh = box_mesh(half);
  std::mt19937 random(3);
  std::vector<float> depth(camera.pixel_count());
  for (int trial = 0; trial < 20; ++trial) {
    const RigidTransform pose = random_pose(random);
    render_depth(mesh.view(), pose, camera, depth);
    int hits = 0;
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const float rendered = depth[camera.index(u, v)];
        const double inside = cast_at_box(pose, half, -1e-5F, u, v);
        if (inside > 0.0) {
          ++hits;
          ASSERT_NEAR(rendered, cast_at_box(pose, half, 0.0F, u, v), 2e-6) << u << " " << v << " trial " << trial;
        } else if (cast_at_box(pose, half, 1e-5F, u, v) == 0.0) {
          ASSERT_EQ(rendered, 0.0F) << u << " " << v << " trial " << trial;
        }
      }
    }
    EXPECT_GT(hits, 500);
  }
}

TEST(DepthRender, SphereAgreesWithRayCasting) {
  Mesh mesh = sphere_mesh(200);
  const float radius = 0.06F;
  for (Vector3& vertex : mesh.vertices) vertex *= radius;
  const RigidTransform pose{Matrix3::Identity(), Vector3(0.02F, -0.01F, 0.4F)};
  std::vector<float> depth(camera.pixel_count());
  render_depth(mesh.view(), pose, camera, depth);
  int hits = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Vector3 ray = camera.point(static_cast<float>(u), static_cast<float>(v), 1.0F);
      const double a = ray.squaredNorm();
      const double b = ray.dot(pose.translation);
      const double c = pose.translation.squaredNorm() - radius * radius;
      const double discriminant = b * b - a * c;
      const float rendered = depth[camera.index(u, v)];
      if (discriminant > 1e-4) {
        ++hits;
        ASSERT_NEAR(rendered, (b - std::sqrt(discriminant)) / a, 3e-5) << u << " " << v;
      } else if (discriminant < -1e-4) {
        ASSERT_EQ(rendered, 0.0F);
      }
    }
  }
  EXPECT_GT(hits, 2000);
}

TEST(DepthRender, NoCracksBetweenNeighbouringTriangles) {
  // A fine flat grid that covers the whole image, its vertices on pixel centres: every pixel lies on an edge.
  Mesh mesh;
  const Camera exact{64, 48, 64.0F, 64.0F, 32.0F, 24.0F};
  for (int y = 0; y <= 48; ++y) {
    for (int x = 0; x <= 64; ++x) {
      mesh.vertices.emplace_back(static_cast<float>(x - 32) / 64.0F, static_cast<float>(y - 24) / 64.0F, 1.0F);
    }
  }
  for (std::uint32_t y = 0; y < 48; ++y) {
    for (std::uint32_t x = 0; x < 64; ++x) {
      const std::uint32_t i = y * 65 + x;
      mesh.triangles.push_back({i, i + 1, i + 65});
      mesh.triangles.push_back({i + 66, i + 65, i + 1});
    }
  }
  std::vector<float> depth(exact.pixel_count());
  render_depth(mesh.view(), {}, exact, depth);
  for (const float z : depth) ASSERT_FLOAT_EQ(z, 1.0F);
}

TEST(DepthRender, NearestWinsAndBothSidesAreDrawn) {
  Mesh mesh;
  mesh.vertices = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  std::vector<float> depth(camera.pixel_count());
  const std::size_t middle = camera.index(78, 62);
  render_depth(mesh.view(), {Matrix3::Identity(), Vector3(0, 0, 2)}, camera, depth);
  EXPECT_FLOAT_EQ(depth[middle], 2.0F);
  mesh.triangles = {{0, 2, 1}};
  draw_depth(mesh.view(), {Matrix3::Identity(), Vector3(0, 0, 3)}, camera, depth);
  EXPECT_FLOAT_EQ(depth[middle], 2.0F);
  draw_depth(mesh.view(), {Matrix3::Identity(), Vector3(0, 0, 1)}, camera, depth);
  EXPECT_FLOAT_EQ(depth[middle], 1.0F);
}

TEST(DepthRender, WhatReachesBehindTheCameraIsCutAtTheNearPlane) {
  // A floor half a metre below the camera, from far behind it to far before it.
  Mesh mesh;
  mesh.vertices = {{-50, 0.5F, -50}, {50, 0.5F, -50}, {50, 0.5F, 50}, {-50, 0.5F, 50}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  std::vector<float> depth(camera.pixel_count());
  render_depth(mesh.view(), {}, camera, depth);
  for (int v = 65; v < camera.height; ++v) {
    const float expected = 0.5F * camera.fy / (static_cast<float>(v) - camera.cy);
    for (int u = 0; u < camera.width; ++u)
      ASSERT_NEAR(depth[camera.index(u, v)], expected, 2e-5F * expected * expected);
  }
  EXPECT_EQ(depth[camera.index(80, 30)], 0.0F);
  render_depth(mesh.view(), {Matrix3::Identity(), Vector3(0, 0, -200)}, camera, depth);
  for (const float z : depth) ASSERT_EQ(z, 0.0F);
}

TEST(DepthRender, BothSurfacesAtOnceAreThoseOfTwoRenderings) {
  std::mt19937 random(11);
  std::normal_distribution<float> gauss;
  Mesh mesh = sphere_mesh(30);
  // Crumpled, so that rays meet many surfaces; some of it reaches behind the camera.
  for (Vector3& vertex : mesh.vertices) vertex = 0.05F * (vertex + 0.3F * Vector3(gauss(random), gauss(random), 0.0F));
  mesh.vertices[100].z() = -2.0F;
  std::vector<float> nearest(camera.pixel_count());
  std::vector<float> farthest(camera.pixel_count());
  for (int trial = 0; trial < 5; ++trial) {
    const RigidTransform pose = random_pose(random);
    std::vector<float> both_nearest(camera.pixel_count(), 3.0F);
    std::vector<float> both_farthest(camera.pixel_count(), 3.0F);
    render_both_surfaces(mesh.view(), pose, camera, both_nearest, both_farthest);
    render_depth(mesh.view(), pose, camera, nearest);
    render_depth(mesh.view(), pose, camera, farthest, RenderedSurface::farthest);
    EXPECT_EQ(both_nearest, nearest);
    EXPECT_EQ(both_farthest, farthest);
    EXPECT_NE(nearest, farthest);
  }
}

TEST(DepthRender, ClosedMeshesLookAsIfBothSidesWereDrawn) {
  // A dented ball: rays meet up to six surfaces of it.
  Mesh mesh = sphere_mesh(40);
  for (Vector3& vertex : mesh.vertices)
    vertex *= 0.05F * (1.0F + 0.4F * std::sin(7.0F * vertex.x() + 5.0F * vertex.z()));
  MeshView closed = mesh.view();
  closed.closed = true;
  std::mt19937 random(17);
  for (int trial = 0; trial < 10; ++trial) {
    const RigidTransform pose = random_pose(random);
    std::vector<std::vector<float>> open_images(2, std::vector<float>(camera.pixel_count()));
    std::vector<std::vector<float>> closed_images = open_images;
    render_both_surfaces(mesh.view(), pose, camera, open_images[0], open_images[1]);
    render_both_surfaces(closed, pose, camera, closed_images[0], closed_images[1]);
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t pixel = 0; pixel < camera.pixel_count(); ++pixel)
        ASSERT_NEAR(closed_images[i][pixel], open_images[i][pixel], 1e-6F) << i << " trial " << trial;
    }
    std::vector<float> alone(camera.pixel_count());
    render_depth(closed, pose, camera, alone);
    EXPECT_EQ(alone, closed_images[0]);
    render_depth(closed, pose, camera, alone, RenderedSurface::farthest);
    EXPECT_EQ(alone, closed_images[1]);
  }
}

TEST(DepthRender, OfAClosedMeshOnlyTheSidesThatFaceTheSensorAreNearest) {
  Mesh mesh = box_mesh(Vector3(0.1F, 0.1F, 0.1F));
  for (Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  MeshView inside_out = mesh.view();
  inside_out.closed = true;
  std::vector<float> depth(camera.pixel_count());
  render_depth(inside_out, {Matrix3::Identity(), Vector3(0, 0, 1)}, camera, depth);
  EXPECT_FLOAT_EQ(depth[camera.index(78, 62)], 1.1F);
}

TEST(DepthRender, BadMeshesAreHarmless) {
  Mesh mesh = box_mesh(Vector3(0.1F, 0.1F, 0.1F));
  mesh.vertices.emplace_back(std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F);
  mesh.vertices.emplace_back(1e30F, 1e30F, 1e30F);
  mesh.triangles = {{0, 1, 8}, {0, 1, 99}, {0, 0, 0}};
  std::vector<float> depth(camera.pixel_count(), 7.0F);
  render_depth(mesh.view(), {Matrix3::Identity(), Vector3(0, 0, 1)}, camera, depth);
  for (const float z : depth) ASSERT_EQ(z, 0.0F);
  mesh.triangles = {{0, 1, 9}};
  render_depth(mesh.view(), {Matrix3::Identity(), Vector3(0, 0, 1)}, camera, depth);
}

TEST(DepthRender, CroppedCameraSeesTheSamePixels) {
  const Mesh mesh = box_mesh(Vector3(0.05F, 0.03F, 0.02F));
  std::mt19937 random(5);
  const RigidTransform pose = random_pose(random);
  std::vector<float> whole(camera.pixel_count());
  render_depth(mesh.view(), pose, camera, whole);
  const ImageRectangle bounds = projected_bounds(mesh.view(), pose, camera);
  ASSERT_FALSE(bounds.empty());
  const Camera window = cropped(camera, bounds);
  std::vector<float> part(window.pixel_count());
  render_depth(mesh.view(), pose, window, part);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const int inner_u = u - bounds.left;
      const int inner_v = v - bounds.top;
      const float expected = whole[camera.index(u, v)];
      if (window.contains(inner_u, inner_v)) {
        ASSERT_NEAR(part[window.index(inner_u, inner_v)], expected, 1e-5F);
      } else {
        ASSERT_EQ(expected, 0.0F);
      }
    }
  }
  EXPECT_TRUE(projected_bounds(mesh.view(), {Matrix3::Identity(), Vector3(5, 0, 1)}, camera).empty());
  EXPECT_TRUE(projected_bounds(mesh.view(), {Matrix3::Identity(), Vector3(0, 0, -1)}, camera).empty());
}

}  // namespace
}  // namespace graspd
