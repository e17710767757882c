#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/core/detect/bracket_scene.hpp"

namespace graspd {
namespace {

class OddFrames : public testing::Test {
 protected:
  static void SetUpTestSuite() { bracket = std::make_unique<BracketBank>(); }
  static void TearDownTestSuite() { bracket.reset(); }

  [[nodiscard]] Status detect_in(const DepthFrame& frame, Detections& detections) {
    DetectRequest request;
    request.banks = {&bracket->bank(), 1};
    return detect(frame, request, {}, memory.workspace, detections);
  }

  static std::unique_ptr<BracketBank> bracket;
  DetectMemory memory{1};
};
std::unique_ptr<BracketBank> OddFrames::bracket;

TEST_F(OddFrames, WhatIsNoDepthIsAsIfNothingWereMeasured) {
  const auto thinned = [](float instead) {
    BracketScene bin;
    // More than half of the frame, so that it would be what is typical of it.
    for (std::size_t i = 0; i < bin.depth.size(); ++i) {
      if (i % 400 < 220) bin.depth[i] = instead;
    }
    return bin;
  };
  BracketScene gaps = thinned(0.0F);
  Detections expected;
  ASSERT_TRUE(detect_in(gaps.frame(), expected).ok());
  ASSERT_FALSE(expected.instances.empty());
  const std::vector<Instance> instances(expected.instances.begin(), expected.instances.end());
  for (const float instead : {1e-9F, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    BracketScene bin = thinned(instead);
    Detections detections;
    ASSERT_TRUE(detect_in(bin.frame(), detections).ok()) << instead;
    EXPECT_EQ(detections.measured_pixels, expected.measured_pixels) << instead;
    EXPECT_EQ(detections.scene_points, expected.scene_points) << instead;
    ASSERT_EQ(detections.instances.size(), instances.size()) << instead;
    for (std::size_t i = 0; i < instances.size(); ++i) {
      EXPECT_EQ(detections.instances[i].camera_from_part.translation, instances[i].camera_from_part.translation);
      EXPECT_EQ(detections.instances[i].score, instances[i].score);
    }
  }
}

TEST_F(OddFrames, HoldNothingWhenTheyAreNarrow) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 300}, {400, 1}, {2, 2}, {3, 300}, {5, 7}}) {
    std::vector<float> depth(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.5F);
    Detections detections;
    EXPECT_TRUE(detect_in({{width, height, 500.0F, 500.0F, 0.0F, 0.0F}, depth, 0, 0}, detections).ok());
    EXPECT_TRUE(detections.instances.empty()) << width << " x " << height;
    EXPECT_EQ(detections.measured_pixels, depth.size());
  }
}

TEST_F(OddFrames, ShowTheSamePartsFromBesideTheOpticalAxis) {
  BracketScene bin;
  Detections detections;
  ASSERT_TRUE(detect_in(bin.frame(), detections).ok());
  ASSERT_EQ(detections.instances.size(), bin.poses.size());
  // A window whose principal point lies outside of it.
  BracketScene window;
  window.crop();
  ASSERT_LT(window.camera.cx, 25.0F);
  const int left = 40;
  const Camera whole = window.camera;
  window.camera.width -= left;
  window.camera.cx -= static_cast<float>(left);
  std::vector<float> depth;
  for (int v = 0; v < whole.height; ++v) {
    for (int u = left; u < whole.width; ++u) depth.push_back(window.depth[whole.index(u, v)]);
  }
  ASSERT_TRUE(detect_in({window.camera, depth, 0, 0}, detections).ok());
  // Of the brackets in it, one stands partly beyond its left edge.
  EXPECT_GE(detections.instances.size(), 2U);
  for (const Instance& instance : detections.instances) {
    const bool there = std::any_of(window.poses.begin(), window.poses.end(), [&](const RigidTransform& truth) {
      return (instance.camera_from_part.translation - truth.translation).norm() < 0.002F;
    });
    EXPECT_TRUE(there) << instance.camera_from_part.translation.transpose();
  }
}

}  // namespace
}  // namespace graspd
