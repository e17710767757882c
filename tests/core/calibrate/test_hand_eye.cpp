#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "core/calibrate/hand_eye.hpp"

namespace graspd {
namespace {

Eigen::Isometry3d pose(const Eigen::Vector3d& turn, const Eigen::Vector3d& place) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  const double angle = turn.norm();
  if (angle > 0.0) result.linear() = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  result.translation() = place;
  return result;
}

/// A cell with a known camera, whose robot stops at random places.
struct HandEye : testing::TestWithParam<HandEyeSetup> {
  Eigen::Vector3d random_vector(double size) {
    std::uniform_real_distribution<double> unit(-size, size);
    return {unit(random), unit(random), unit(random)};
  }
  /// Stops with turns up to `turn` radians about each axis that `axes` lets through, and noise on what is detected.
  void stop_at(std::size_t count, double turn, const Eigen::Vector3d& axes, double noise_metres, double noise_radians) {
    std::normal_distribution<double> normal;
    pairs.clear();
    for (std::size_t i = 0; i < count; ++i) {
      HandEyePair pair;
      pair.robot_from_flange =
          pose(random_vector(turn).cwiseProduct(axes), Eigen::Vector3d(0.4, 0.1, 0.6) + random_vector(0.15));
      const bool in_hand = GetParam() == HandEyeSetup::eye_in_hand;
      const Eigen::Isometry3d carrier = in_hand ? pair.robot_from_flange : pair.robot_from_flange.inverse();
      pair.camera_from_target = mount.inverse() * carrier.inverse() * target;
      const Eigen::Vector3d wobble(normal(random), normal(random), normal(random));
      const Eigen::Vector3d shift(normal(random), normal(random), normal(random));
      pair.camera_from_target = pair.camera_from_target * pose(noise_radians * wobble, noise_metres * shift);
      pairs.push_back(pair);
    }
  }
  double turn_error(const HandEyeSolution& solution) const {
    return Eigen::AngleAxisd(solution.mount.linear().transpose() * mount.linear()).angle();
  }
  double place_error(const HandEyeSolution& solution) const {
    return (solution.mount.translation() - mount.translation()).norm();
  }
  std::mt19937 random{11};
  Eigen::Isometry3d mount = pose({0.3, -2.1, 0.4}, {0.05, -0.03, 0.12});
  Eigen::Isometry3d target = pose({-0.2, 0.1, 1.3}, {0.5, 0.05, 0.02});
  std::vector<HandEyePair> pairs;
};

TEST_P(HandEye, ExactPairsGiveTheExactAnswer) {
  stop_at(8, 0.6, Eigen::Vector3d::Ones(), 0.0, 0.0);
  const HandEyeSolution solution = solve_hand_eye(pairs, GetParam());
  EXPECT_LT(turn_error(solution), 1e-7);
  EXPECT_LT(place_error(solution), 1e-7);
  EXPECT_TRUE(solution.target.isApprox(target, 1e-6));
  EXPECT_LT(solution.rms.translation, 1e-8);
  EXPECT_EQ(solution.warnings, 0U);
  EXPECT_EQ(solution.residuals.size(), pairs.size());
}

TEST_P(HandEye, ThreePairsAreEnoughButLeaveNoDoubt) {
  stop_at(3, 0.8, Eigen::Vector3d::Ones(), 0.0, 0.0);
  const HandEyeSolution solution = solve_hand_eye(pairs, GetParam());
  EXPECT_LT(place_error(solution), 1e-6);
  EXPECT_EQ(solution.warnings, hand_eye_few_pairs);
}

TEST_P(HandEye, NoiseIsAveragedAndItsEffectForetold) {
  double worst = 0.0;
  for (int trial = 0; trial < 10; ++trial) {
    stop_at(20, 0.6, Eigen::Vector3d::Ones(), 0.0005, 0.002);
    const HandEyeSolution solution = solve_hand_eye(pairs, GetParam());
    EXPECT_LT(turn_error(solution), 0.004);
    EXPECT_LT(place_error(solution), 0.004);
    EXPECT_NEAR(solution.rms.rotation, 0.002 * std::sqrt(3.0), 0.0012);
    EXPECT_EQ(solution.warnings & (hand_eye_no_turn | hand_eye_one_axis), 0U);
    worst = std::max(worst, place_error(solution) / solution.translation_deviation);
  }
  EXPECT_LT(worst, 4.0) << "errors lie within a few of the standard deviations that were foretold";
  EXPECT_GT(worst, 0.2) << "which are no mere caution";
}

TEST_P(HandEye, TurnsAboutOneAxisAreWarnedOf) {
  stop_at(10, 0.6, Eigen::Vector3d::UnitY(), 0.0, 0.0);
  const HandEyeSolution solution = solve_hand_eye(pairs, GetParam());
  EXPECT_EQ(solution.warnings, hand_eye_one_axis);
  EXPECT_NEAR(std::abs(solution.turn_axis.y()), 1.0, 1e-6);
  EXPECT_TRUE(solution.mount.matrix().allFinite());
}

TEST_P(HandEye, StopsWithoutTurnsAreWarnedOf) {
  stop_at(10, 0.01, Eigen::Vector3d::Ones(), 0.0, 0.0);
  EXPECT_NE(solve_hand_eye(pairs, GetParam()).warnings & hand_eye_no_turn, 0U);
  stop_at(10, 0.0, Eigen::Vector3d::Ones(), 0.0, 0.0);
  const HandEyeSolution still = solve_hand_eye(pairs, GetParam());
  EXPECT_NE(still.warnings & hand_eye_no_turn, 0U);
  EXPECT_TRUE(still.mount.matrix().allFinite());
}

TEST_P(HandEye, PairThatDisagreesIsWarnedOf) {
  stop_at(12, 0.6, Eigen::Vector3d::Ones(), 0.0003, 0.001);
  EXPECT_EQ(solve_hand_eye(pairs, GetParam()).warnings, 0U);
  pairs[4].camera_from_target.translation().x() += 0.03;
  const HandEyeSolution solution = solve_hand_eye(pairs, GetParam());
  EXPECT_EQ(solution.warnings, hand_eye_outlier);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_LE(solution.residuals[i].translation, solution.residuals[4].translation);
  }
}

TEST_P(HandEye, HalfTurnsBetweenStopsAreNoTrouble) {
  stop_at(8, 0.4, Eigen::Vector3d::Ones(), 0.0, 0.0);
  const Eigen::Isometry3d half_turn = pose({0.0, 0.0, std::numbers::pi - 1e-3}, Eigen::Vector3d::Zero());
  const bool in_hand = GetParam() == HandEyeSetup::eye_in_hand;
  for (std::size_t i = 0; i < pairs.size(); i += 2) {
    pairs[i].robot_from_flange = pairs[i].robot_from_flange * half_turn;
    const Eigen::Isometry3d carrier = in_hand ? pairs[i].robot_from_flange : pairs[i].robot_from_flange.inverse();
    pairs[i].camera_from_target = mount.inverse() * carrier.inverse() * target;
  }
  EXPECT_LT(place_error(solve_hand_eye(pairs, GetParam())), 1e-6);
}

TEST_P(HandEye, QuarterTurnsBetweenNoisyStopsAreNoTrouble) {
  const bool in_hand = GetParam() == HandEyeSetup::eye_in_hand;
  for (int cell = 0; cell < 40; ++cell) {
    mount = pose(random_vector(3.0), random_vector(0.2));
    stop_at(8, 0.0, Eigen::Vector3d::Ones(), 0.0005, 0.003);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const Eigen::Isometry3d noise = target.inverse() *
                                      (in_hand ? pairs[i].robot_from_flange : pairs[i].robot_from_flange.inverse()) *
                                      mount * pairs[i].camera_from_target;
      // The flange looks down at four turns, and at the same once more while it leans.
      const double quarters = 0.5 * std::numbers::pi * static_cast<double>(i % 4);
      const Eigen::Vector3d lean = i < 4 ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(i % 2 == 0 ? -0.4 : 0.4, 0.3, 0);
      pairs[i].robot_from_flange =
          pairs[i].robot_from_flange * pose({0, 0, quarters}, {0, 0, 0}) * pose(lean, {0, 0, 0});
      const Eigen::Isometry3d carrier = in_hand ? pairs[i].robot_from_flange : pairs[i].robot_from_flange.inverse();
      pairs[i].camera_from_target = mount.inverse() * carrier.inverse() * target * noise;
    }
    const HandEyeSolution solution = solve_hand_eye(pairs, GetParam());
    EXPECT_LT(place_error(solution), 0.01);
    EXPECT_LT(turn_error(solution), 0.02);
    EXPECT_EQ(solution.warnings, 0U);
  }
}

TEST_P(HandEye, TheOneAxisIsThatOfTheFrameThatCarriesTheCamera) {
  stop_at(10, 0.6, Eigen::Vector3d::UnitY(), 0.0, 0.0);
  const Eigen::Isometry3d leaning = pose({0.9, 0.0, 0.0}, Eigen::Vector3d::Zero());
  for (HandEyePair& pair : pairs) {
    // Not the flange's y any more, but still the robot's.
    pair.robot_from_flange = pair.robot_from_flange * leaning;
    const bool in_hand = GetParam() == HandEyeSetup::eye_in_hand;
    const Eigen::Isometry3d carrier = in_hand ? pair.robot_from_flange : pair.robot_from_flange.inverse();
    pair.camera_from_target = mount.inverse() * carrier.inverse() * target;
  }
  const HandEyeSolution solution = solve_hand_eye(pairs, GetParam());
  const Eigen::Vector3d of_flange = leaning.linear().transpose() * Eigen::Vector3d::UnitY();
  const Eigen::Vector3d expected =
      GetParam() == HandEyeSetup::eye_in_hand ? of_flange : Eigen::Vector3d(Eigen::Vector3d::UnitY());
  EXPECT_NEAR(std::abs(solution.turn_axis.dot(expected)), 1.0, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(BothSetups, HandEye, testing::Values(HandEyeSetup::eye_in_hand, HandEyeSetup::eye_to_hand));

}  // namespace
}  // namespace graspd
