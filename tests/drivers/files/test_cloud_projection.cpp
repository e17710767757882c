#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "drivers/files/cloud_projection.hpp"

namespace graspd {
namespace {

using ::testing::HasSubstr;

const Camera sensor{220, 160, 410.3F, 412.7F, 104.4F, 83.8F};

/// A slanted ground with a ball on it: the depth behind a pixel or a direction.
float depth_at(float x, float y) {
  const float ground = 0.6F / (1.0F + 0.3F * x + 0.1F * y);
  const Vector3 ray(x, y, 1.0F);
  const Vector3 centre(0.02F, -0.01F, 0.55F);
  const float a = ray.squaredNorm();
  const float b = ray.dot(centre);
  const float discriminant = b * b - a * (centre.squaredNorm() - 0.05F * 0.05F);
  return discriminant > 0.0F ? (b - std::sqrt(discriminant)) / a : ground;
}

Cloud organised_cloud() {
  Cloud cloud;
  cloud.width = sensor.width;
  cloud.height = sensor.height;
  for (int v = 0; v < sensor.height; ++v) {
    for (int u = 0; u < sensor.width; ++u) {
      const Vector3 ray = sensor.point(static_cast<float>(u), static_cast<float>(v), 1.0F);
      cloud.points.push_back(depth_at(ray.x(), ray.y()) * ray);
    }
  }
  return cloud;
}

TEST(CloudProjection, OrganisedCloudKeepsItsPixels) {
  Cloud cloud = organised_cloud();
  cloud.points[77] = Vector3::Constant(std::nanf(""));
  const Result<LoadedFrame> frame = frame_from_cloud(cloud, {});
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  const Camera& camera = frame.value().camera;
  EXPECT_EQ(camera.width, sensor.width);
  EXPECT_NEAR(camera.fx, sensor.fx, 0.02F);
  EXPECT_NEAR(camera.fy, sensor.fy, 0.02F);
  EXPECT_NEAR(camera.cx, sensor.cx, 0.02F);
  EXPECT_NEAR(camera.cy, sensor.cy, 0.02F);
  EXPECT_EQ(frame.value().depth[77], 0.0F);
  EXPECT_EQ(frame.value().depth[78], cloud.points[78].z());
}

TEST(CloudProjection, OrganisedCloudThatIsNoPinholeIsProjected) {
  Cloud cloud = organised_cloud();
  // Rows that belong together no longer lie together.
  std::rotate(cloud.points.begin(), cloud.points.begin() + 60 * sensor.width + 70, cloud.points.end());
  EXPECT_FALSE(fit_camera(cloud).has_value());
  EXPECT_TRUE(frame_from_cloud(cloud, {}).ok());
}

TEST(CloudProjection, PixelsOfTheSensorAreFoundInACloudWithoutOrder) {
  Cloud cloud;
  std::mt19937 random(3);
  std::vector<float> expected(sensor.pixel_count(), 0.0F);
  const Cloud organised = organised_cloud();
  for (std::size_t i = 0; i < organised.points.size(); ++i) {
    // Big holes, single holes, and the rounding of a text file.
    const int u = static_cast<int>(i) % sensor.width;
    const int v = static_cast<int>(i) / sensor.width;
    if (random() % 40 == 0 || (std::abs(u - 60) < 20 && std::abs(v - 40) < 15)) continue;
    expected[i] = organised.points[i].z();
    cloud.points.push_back((organised.points[i] * 1e5F).array().round().matrix() / 1e5F);
  }
  std::shuffle(cloud.points.begin(), cloud.points.end(), random);
  const Result<LoadedFrame> frame = frame_from_cloud(cloud, {});
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  const Camera& camera = frame.value().camera;
  ASSERT_EQ(camera.width, sensor.width);
  ASSERT_EQ(camera.height, sensor.height);
  EXPECT_NEAR(camera.fx, sensor.fx, 0.1F);
  EXPECT_NEAR(camera.cx, sensor.cx, 0.05F);
  EXPECT_NEAR(camera.cy, sensor.cy, 0.05F);

  int lost = 0;
  int open_single_holes = 0;
  for (int v = 0; v < sensor.height; ++v) {
    for (int u = 0; u < sensor.width; ++u) {
      const std::size_t i = sensor.index(u, v);
      const float z = frame.value().depth[i];
      if (expected[i] != 0.0F) {
        lost += std::abs(z - expected[i]) > 2e-5F ? 1 : 0;
      } else if (std::abs(u - 60) < 20 && std::abs(v - 40) < 15) {
        ASSERT_EQ(z, 0.0F) << "a large hole was filled at " << u << " " << v;
      } else if (z == 0.0F) {
        ++open_single_holes;
      } else {
        EXPECT_NEAR(z, organised.points[i].z(), 1e-3F);
      }
    }
  }
  EXPECT_EQ(lost, 0);
  EXPECT_LT(open_single_holes, 120);
}

TEST(CloudProjection, IrregularCloudFillsMostOfItsPixels) {
  Cloud cloud;
  std::mt19937 random(5);
  std::uniform_real_distribution<float> direction(-0.2F, 0.2F);
  for (int i = 0; i < 40000; ++i) {
    const float x = direction(random);
    const float y = direction(random);
    cloud.points.push_back(depth_at(x, y) * Vector3(x, y, 1.0F));
  }
  const Result<LoadedFrame> frame = frame_from_cloud(cloud, {});
  ASSERT_TRUE(frame.ok());
  const Camera& camera = frame.value().camera;
  // Pixels of about one point: neither a blurred picture nor a sieve.
  EXPECT_GT(camera.pixel_count(), 20000U);
  EXPECT_LT(camera.pixel_count(), 45000U);
  std::size_t filled = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const float z = frame.value().depth[camera.index(u, v)];
      if (z == 0.0F) continue;
      ++filled;
      const Vector3 ray = camera.point(static_cast<float>(u), static_cast<float>(v), 1.0F);
      const float radius = std::hypot(ray.x() - 0.02F / 0.55F, ray.y() + 0.01F / 0.55F);
      if (std::abs(radius - 0.09F) < 0.02F) continue;
      EXPECT_NEAR(z, depth_at(ray.x(), ray.y()), 3e-3F);
    }
  }
  // Points thrown at random leave a quarter of such pixels empty: a third of those are closed.
  EXPECT_GT(static_cast<double>(filled) / static_cast<double>(camera.pixel_count()), 0.8);
}

TEST(CloudProjection, ImageStaysWithinItsLimits) {
  Cloud cloud = organised_cloud();
  cloud.height = 0;
  const Result<LoadedFrame> frame = frame_from_cloud(cloud, {100, 100});
  ASSERT_TRUE(frame.ok());
  EXPECT_LE(frame.value().camera.width, 100);
  EXPECT_LE(frame.value().camera.height, 100);
  EXPECT_GT(frame.value().camera.width, 90);
}

TEST(CloudProjection, NearestPointWins) {
  std::vector<float> depth(sensor.pixel_count());
  const Vector3 near = sensor.point(50, 60, 0.4F);
  const Vector3 far = sensor.point(50, 60, 0.7F);
  project_cloud(std::vector<Vector3>{far, near, far, {0, 0, -1}, {9, 9, 1}}, sensor, depth);
  EXPECT_FLOAT_EQ(depth[sensor.index(50, 60)], 0.4F);
  EXPECT_EQ(std::count(depth.begin(), depth.end(), 0.0F), static_cast<long>(depth.size()) - 1);
}

TEST(CloudProjection, HolesAtASilhouetteStayOpen) {
  // Half of the picture at 0.5 m, half at 0.6 m, single pixels missing on both sides of the step.
  std::vector<float> depth(sensor.pixel_count());
  for (int v = 0; v < sensor.height; ++v) {
    for (int u = 0; u < sensor.width; ++u) depth[sensor.index(u, v)] = u < 100 ? 0.5F : 0.6F;
  }
  depth[sensor.index(99, 50)] = 0.0F;
  depth[sensor.index(40, 50)] = 0.0F;
  close_small_holes(sensor, depth);
  EXPECT_EQ(depth[sensor.index(99, 50)], 0.0F);
  EXPECT_FLOAT_EQ(depth[sensor.index(40, 50)], 0.5F);
}

TEST(CloudProjection, CloudsThatCannotBeSeenAreRefused) {
  const auto refusal = [](const Cloud& cloud) {
    const Result<LoadedFrame> frame = frame_from_cloud(cloud, {});
    EXPECT_EQ(frame.status().code(), StatusCode::bad_frame);
    return std::string(frame.status().message());
  };
  Cloud behind = organised_cloud();
  for (Vector3& p : behind.points) p = -p;
  EXPECT_THAT(refusal(behind), HasSubstr("behind the camera"));
  Cloud huge = organised_cloud();
  for (Vector3& p : huge.points) p *= 1000.0F;
  EXPECT_THAT(refusal(huge), HasSubstr("is its unit mm, not m?"));
  Cloud tiny = organised_cloud();
  for (Vector3& p : tiny.points) p *= 0.001F;
  EXPECT_THAT(refusal(tiny), HasSubstr("is its unit m, not mm?"));
  EXPECT_THAT(refusal({{Vector3::Constant(std::nanf(""))}, 1, 1}), HasSubstr("no point of the cloud is measured"));
}

TEST(CloudProjection, ASinglePointMakesAFrame) {
  const Result<LoadedFrame> frame = frame_from_cloud({{Vector3(0.1F, 0.2F, 0.5F)}, 1, 1}, {});
  ASSERT_TRUE(frame.ok());
  EXPECT_EQ(frame.value().depth, std::vector<float>{0.5F});
}

}  // namespace
}  // namespace graspd
