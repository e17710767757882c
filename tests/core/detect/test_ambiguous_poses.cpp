#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "core/geometry/symmetry.hpp"
#include "tests/core/detect/bracket_scene.hpp"
#include "tests/core/train/shapes.hpp"

namespace graspd {
namespace {

constexpr float height = 0.02F;

/// A box of 60 x 36 x 20 mm, with the half turns that its part file gives.
PartDescription box_part(const std::vector<RigidTransform>& symmetry) {
  PartDescription part;
  part.name = "box";
  part.part_id = 1;
  part.mesh = shapes::box(0.06F, 0.036F, height);
  part.symmetry_given = true;
  part.symmetry_discrete = symmetry;
  return part;
}

/// The box with a step of 12 x 10 mm near a corner of its upper side, which is lower than what surfaces may be off by.
PartDescription marked_box_part() {
  constexpr float step = 0.0007F;
  PartDescription part = box_part({});
  Mesh mark = shapes::box(0.012F, 0.010F, 2.0F * step);
  const auto first = static_cast<std::uint32_t>(part.mesh.vertices.size());
  for (const Vector3& vertex : mark.vertices)
    part.mesh.vertices.push_back(vertex + Vector3(0.02F, 0.01F, -0.5F * height));
  for (const Triangle& triangle : mark.triangles)
    part.mesh.triangles.push_back({triangle[0] + first, triangle[1] + first, triangle[2] + first});
  return part;
}

std::vector<RigidTransform> half_turns() {
  std::vector<RigidTransform> turns;
  for (const Vector3& axis : {Vector3(Vector3::UnitX()), Vector3(Vector3::UnitY()), Vector3(Vector3::UnitZ())})
    turns.push_back(turn_about({axis, Vector3::Zero()}, std::numbers::pi_v<float>));
  return turns;
}

/// Detects boxes on a floor with a bank made from `part`.
class Boxes {
 public:
  explicit Boxes(const PartDescription& part, int threads = 1) : memory_(threads) {
    BankReport report;
    Result<std::vector<std::byte>> built = build_bank(part, {}, report, [](float) {});
    EXPECT_TRUE(built.ok());
    file_ = std::move(built).value();
    bank_ = read_bank(file_, "box").value();
    for (const float yaw : {0.3F, 1.4F}) {
      const Matrix3 turn = Eigen::AngleAxisf(yaw, Vector3::UnitZ()).toRotationMatrix();
      poses.push_back({turn, Vector3(0.1F * (yaw - 0.8F), 0.01F, floor - 0.5F * height)});
      draw_depth(part.mesh.view(), poses.back(), camera_, depth_);
    }
    DetectRequest request;
    request.banks = std::span(&bank_, 1);
    request.minimum_score = 0.6F;
    DetectParameters parameters;
    parameters.threads = threads;
    EXPECT_TRUE(detect({camera_, depth_, 0, 0}, request, parameters, memory_.workspace, detections).ok());
  }
  [[nodiscard]] const Bank& bank() const { return bank_; }
  [[nodiscard]] std::uint32_t rejected(Rejection reason) const {
    return detections.rejections[static_cast<std::size_t>(reason)];
  }

  std::vector<RigidTransform> poses;
  Detections detections;

 private:
  static constexpr float floor = 0.55F;
  Camera camera_{400, 300, 500.0F, 500.0F, 199.5F, 149.5F};
  std::vector<float> depth_ = std::vector<float>(camera_.pixel_count(), floor);
  std::vector<std::byte> file_;
  Bank bank_;
  DetectMemory memory_;
};

TEST(AmbiguousPoses, ABoxWhoseHalfTurnsCountAsOtherPosesIsNotReported) {
  const Boxes boxes(box_part({}));
  EXPECT_TRUE(boxes.detections.instances.empty());
  EXPECT_EQ(boxes.rejected(Rejection::ambiguous), 2U);
}

TEST(AmbiguousPoses, ABoxWithItsSymmetryIs) {
  const Boxes boxes(box_part(half_turns()));
  EXPECT_EQ(boxes.detections.instances.size(), 2U);
  EXPECT_EQ(boxes.rejected(Rejection::ambiguous), 0U);
}

TEST(AmbiguousPoses, ABoxWithAMarkTooLowForTheToleranceIsTurnedRightly) {
  const Boxes boxes(marked_box_part());
  ASSERT_GT(VerifyParameters{}.tolerance * boxes.bank().part->detail, 0.0008F);
  ASSERT_EQ(boxes.detections.instances.size(), 2U);
  for (const Instance& instance : boxes.detections.instances) {
    EXPECT_TRUE(std::any_of(boxes.poses.begin(), boxes.poses.end(), [&](const RigidTransform& truth) {
      return (instance.camera_from_part.translation - truth.translation).norm() < 0.001F &&
             rotation_angle(truth.rotation.transpose() * instance.camera_from_part.rotation) < 0.05F;
    }));
  }
}

TEST(AmbiguousPoses, AreComparedAlikeByOneThreadAndTwo) {
  const Boxes one(marked_box_part(), 1);
  const Boxes two(marked_box_part(), 2);
  ASSERT_EQ(two.detections.instances.size(), one.detections.instances.size());
  for (std::size_t i = 0; i < one.detections.instances.size(); ++i) {
    EXPECT_EQ(two.detections.instances[i].score, one.detections.instances[i].score);
    EXPECT_EQ(two.detections.instances[i].camera_from_part.rotation,
              one.detections.instances[i].camera_from_part.rotation);
    EXPECT_EQ(two.detections.instances[i].camera_from_part.translation,
              one.detections.instances[i].camera_from_part.translation);
  }
}

}  // namespace
}  // namespace graspd
