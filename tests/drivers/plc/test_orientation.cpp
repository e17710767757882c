#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "drivers/plc/orientation.hpp"

namespace graspd {
namespace {

using Values = std::array<double, 4>;
constexpr double pi = std::numbers::pi;

[[nodiscard]] Eigen::Matrix3d elementary(char axis, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  Eigen::Matrix3d m;
  if (axis == 'x') m << 1, 0, 0, 0, c, -s, 0, s, c;
  if (axis == 'y') m << c, 0, s, 0, 1, 0, -s, 0, c;
  if (axis == 'z') m << c, -s, 0, s, c, 0, 0, 0, 1;
  return m;
}

/// The rotation by its textbook definition: matrices multiplied out, Rodrigues' series for the rotation
/// vector, and the quaternion's product for the quaternion.
[[nodiscard]] Eigen::Matrix3d by_definition(const Values& v, PoseConvention convention) {
  switch (convention) {
    case PoseConvention::rotation_vector: {
      Eigen::Matrix3d k;
      k << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
      Eigen::Matrix3d sum = Eigen::Matrix3d::Identity();
      Eigen::Matrix3d term = Eigen::Matrix3d::Identity();
      for (int i = 1; i < 40; ++i) {
        term = term * k / i;
        sum += term;
      }
      return sum;
    }
    case PoseConvention::quaternion: {
      const auto [w, x, y, z] = v;
      Eigen::Matrix3d m;
      m << 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), 2 * (x * y + w * z),
          1 - 2 * (x * x + z * z), 2 * (y * z - w * x), 2 * (x * z - w * y), 2 * (y * z + w * x),
          1 - 2 * (x * x + y * y);
      return m;
    }
    case PoseConvention::zyx_euler:
      return elementary('z', v[0]) * elementary('y', v[1]) * elementary('x', v[2]);
    case PoseConvention::fixed_xyz:
      return elementary('z', v[2]) * elementary('y', v[1]) * elementary('x', v[0]);
    case PoseConvention::zyz_euler:
      return elementary('z', v[0]) * elementary('y', v[1]) * elementary('z', v[2]);
    case PoseConvention::xyz_euler:
      return elementary('x', v[0]) * elementary('y', v[1]) * elementary('z', v[2]);
  }
  return Eigen::Matrix3d::Zero();
}

/// Random rotations, and every product of quarter turns, each exactly and a little off: gimbal lock of
/// every convention, half turns and the identity are among them.
[[nodiscard]] std::vector<Matrix3> rotations() {
  std::vector<Matrix3> all;
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 500; ++i) {
    all.push_back(Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                      .normalized()
                      .toRotationMatrix()
                      .cast<float>());
  }
  for (const double off : {0.0, 1e-9, 1e-7, 1e-6, 3e-6, 1e-5, 1e-4, 1e-3}) {
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        for (int c = 0; c < 4; ++c) {
          all.push_back((elementary('z', a * pi / 2 + off) * elementary('y', b * pi / 2 + off) *
                         elementary('x', c * pi / 2 - off))
                            .cast<float>());
        }
      }
    }
  }
  return all;
}

class Orientation : public testing::TestWithParam<PoseConvention> {};

TEST_P(Orientation, DescribesEveryRotationInFull) {
  for (const Matrix3& rotation : rotations()) {
    const Values values = orientation_values(rotation, GetParam());
    const Eigen::Matrix3d described = by_definition(values, GetParam());
    EXPECT_LT((described - rotation.cast<double>()).norm(), 4e-6) << rotation;
  }
}

TEST_P(Orientation, ReadsItsOwnNumbersBack) {
  for (const Matrix3& rotation : rotations()) {
    const Matrix3 back = rotation_from_values(orientation_values(rotation, GetParam()), GetParam());
    EXPECT_LT((back - rotation).norm(), 5e-6F);
  }
}

TEST_P(Orientation, StaysInItsRange) {
  for (const Matrix3& rotation : rotations()) {
    const auto [a, b, c, d] = orientation_values(rotation, GetParam());
    switch (GetParam()) {
      case PoseConvention::rotation_vector:
        EXPECT_LE(std::hypot(a, b, c), pi + 1e-6);
        EXPECT_EQ(d, 0.0);
        break;
      case PoseConvention::quaternion:
        EXPECT_GE(a, 0.0);
        EXPECT_NEAR(a * a + b * b + c * c + d * d, 1.0, 1e-9);
        break;
      default:
        EXPECT_LE(std::abs(a), pi + 1e-9);
        EXPECT_LE(std::abs(c), pi + 1e-9);
        EXPECT_GE(b, GetParam() == PoseConvention::zyz_euler ? -1e-9 : -pi / 2 - 1e-6);
        EXPECT_LE(b, GetParam() == PoseConvention::zyz_euler ? pi + 1e-9 : pi / 2 + 1e-6);
        EXPECT_EQ(d, 0.0);
    }
  }
}

TEST_P(Orientation, IsNoneWhenAValueIsNoNumber) {
  const std::size_t used = GetParam() == PoseConvention::quaternion ? 4 : 3;
  for (const double wrong : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (std::size_t i = 0; i < used; ++i) {
      Values values{};
      values[i] = wrong;
      EXPECT_FALSE(rotation_from_values(values, GetParam()).allFinite()) << i;
    }
  }
  EXPECT_TRUE(rotation_from_values({}, GetParam()).isIdentity()) << "zeros are no turn";
}

INSTANTIATE_TEST_SUITE_P(All, Orientation,
                         testing::Values(PoseConvention::rotation_vector, PoseConvention::quaternion,
                                         PoseConvention::zyx_euler, PoseConvention::fixed_xyz,
                                         PoseConvention::zyz_euler, PoseConvention::xyz_euler),
                         [](const auto& test) { return std::string(pose_convention_name(test.param)); });

TEST(OrientationGimbalLock, PutsTheWholeTurnIntoOneAngle) {
  const Matrix3 zyx = by_definition({0.3, pi / 2, 0.5, 0}, PoseConvention::zyx_euler).cast<float>();
  EXPECT_EQ(orientation_values(zyx, PoseConvention::zyx_euler)[0], 0.0);
  EXPECT_NEAR(orientation_values(zyx, PoseConvention::zyx_euler)[1], pi / 2, 1e-6);
  EXPECT_NEAR(orientation_values(zyx, PoseConvention::zyx_euler)[2], 0.2, 1e-6);
  const Matrix3 zyz = by_definition({0.3, 0.0, 0.5, 0}, PoseConvention::zyz_euler).cast<float>();
  EXPECT_EQ(orientation_values(zyz, PoseConvention::zyz_euler)[0], 0.0);
  EXPECT_NEAR(orientation_values(zyz, PoseConvention::zyz_euler)[2], 0.8, 1e-6);
}

}  // namespace
}  // namespace graspd
