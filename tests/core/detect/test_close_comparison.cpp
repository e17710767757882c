#include <gtest/gtest.h>

#include <cmath>

#include "core/detect/close_comparison.hpp"
#include "core/geometry/chance.hpp"
#include "tests/core/detect/bracket_map.hpp"

namespace graspd {
namespace {

constexpr float noise = 0.0002F;

/// The brackets with noise in their depths, laid out as a map.
class CloseComparison : public BracketMap {
 protected:
  std::span<float> image_;

  void SetUp() override {
    for (std::size_t i = 0; i < bin_.depth.size(); ++i) bin_.depth[i] += noise * normal_from(word_at(7, i));
    BracketMap::SetUp();
    image_ = memory_.workspace.rendering[0];
  }
  [[nodiscard]] float tolerance() const { return surface_tolerance(scene_.map, maker_.bank(), {}); }
  /// How far the surface that faces the sensor is moved along its normals, at most: what depths can tell.
  [[nodiscard]] float distance(const RigidTransform& pose, const RigidTransform& truth) const {
    float farthest = 0;
    for (const SurfacePoint& surface : maker_.bank().surface) {
      const Vector3 normal = truth.rotation * surface.normal;
      const Vector3 point = truth * surface.position;
      if (normal.dot(point) < -0.3F * point.norm())
        farthest = std::max(farthest, std::abs(normal.dot(pose * surface.position - point)));
    }
    return farthest;
  }
  /// The pose, turned by `angle` about the part's centre and shifted by `shift` metres.
  [[nodiscard]] RigidTransform moved(const RigidTransform& pose, float angle, float shift) const {
    const Vector3 axis = Vector3(1.0F, -2.0F, 1.5F).normalized();
    const RigidTransform turned = pose * turn_about({axis, maker_.bank().part->centre}, angle);
    return {turned.rotation, turned.translation + shift * Vector3(0.6F, 0.0F, 0.8F)};
  }
};

TEST_F(CloseComparison, RefinementLeavesLessThanTheNoiseOfACell) {
  for (const RigidTransform& truth : bin_.poses) {
    const RigidTransform start = moved(truth, 0.008F, 0.0004F);
    const DenseFit fit = refine_densely(scene_.map, maker_.bank(), start, tolerance(), image_);
    EXPECT_TRUE(fit.supported);
    EXPECT_GT(distance(start, truth), 2.0F * noise);
    EXPECT_LT(distance(fit.camera_from_part, truth), 0.5F * noise);
    EXPECT_NEAR(fit.residual, noise, 0.5F * noise);
  }
}

TEST_F(CloseComparison, APoseInTheAirStaysAsItIs) {
  RigidTransform pose = bin_.poses.front();
  pose.translation.z() -= 0.1F;
  const DenseFit fit = refine_densely(scene_.map, maker_.bank(), pose, tolerance(), image_);
  EXPECT_FALSE(fit.supported);
  EXPECT_EQ(fit.camera_from_part.translation, pose.translation);
  EXPECT_EQ(fit.camera_from_part.rotation, pose.rotation);
}

TEST_F(CloseComparison, TheTruthIsLikelierThanWhatIsBesideIt) {
  const DepthNoise model{noise, maker_.bank().part->diameter};
  const auto likelihood = [&](const RigidTransform& pose) {
    return log_likelihood(scene_.map, maker_.bank(), pose, model, image_);
  };
  for (const RigidTransform& truth : bin_.poses) {
    const float best = likelihood(truth);
    EXPECT_GT(best, 0.0F);
    float last = best;
    for (const float angle : {0.01F, 0.03F, 0.09F}) {
      const float less = likelihood(moved(truth, angle, 0.0F));
      EXPECT_LT(less, last);
      last = less;
    }
  }
}

TEST_F(CloseComparison, WhereNothingWasMeasuredNothingIsLikelier) {
  std::fill(bin_.depth.begin(), bin_.depth.end(), 0.0F);
  bin_.depth.front() = 0.5F;
  lay_out();
  EXPECT_EQ(log_likelihood(scene_.map, maker_.bank(), bin_.poses.front(), {noise, 0.07F}, image_), 0.0F);
}

TEST_F(CloseComparison, WhatHidesThePartCostsLessThanWhatIsSeenBehindIt) {
  const DepthNoise model{noise, maker_.bank().part->diameter};
  const RigidTransform truth = bin_.poses.front();
  RigidTransform nearer = truth;
  nearer.translation.z() -= 0.02F;
  RigidTransform farther = truth;
  farther.translation.z() += 0.02F;
  const float in_the_air = log_likelihood(scene_.map, maker_.bank(), nearer, model, image_);
  const float hidden = log_likelihood(scene_.map, maker_.bank(), farther, model, image_);
  EXPECT_LT(in_the_air, hidden);
  EXPECT_LT(hidden, 0.0F);
}

}  // namespace
}  // namespace graspd
