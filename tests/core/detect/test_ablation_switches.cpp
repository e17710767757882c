#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/core/detect/bracket_scene.hpp"
#include "tests/core/train/shapes.hpp"

namespace graspd {
namespace {

/// What is found with these parameters of six brackets, among them boxes that show edges like theirs.
struct AblatedDetection {
  BracketBank bracket;
  BracketScene scene;
  DetectMemory memory{1};
  Detections detections;

  AblatedDetection() {
    const auto put = [&](const Mesh& box, float x, float y, float yaw, float roll) {
      const Matrix3 turned =
          (Eigen::AngleAxisf(yaw, Vector3::UnitZ()) * Eigen::AngleAxisf(roll, Vector3::UnitX())).toRotationMatrix();
      draw_depth(box.view(), {turned, Vector3(x, y, BracketScene::floor - 0.02F)}, scene.camera, scene.depth);
    };
    put(shapes::box(0.06F, 0.03F, 0.03F), -0.02F, 0.11F, 1.2F, 0.785F);
    put(shapes::box(0.08F, 0.012F, 0.04F), 0.17F, -0.11F, -0.6F, 0.0F);
  }

  void run(const DetectParameters& parameters) { run(parameters, bracket.bank()); }

  void run(const DetectParameters& parameters, const Bank& bank) {
    DetectRequest request;
    request.banks = {&bank, 1};
    const Status status = detect(scene.frame(), request, parameters, memory.workspace, detections);
    ASSERT_TRUE(status.ok()) << status.message();
  }

  /// How many of all judged poses have an outline that says something against them.
  [[nodiscard]] std::ptrdiff_t contradicted() const {
    const auto says = [](const Instance& i) { return i.evidence.edge < 1.0F; };
    return std::count_if(detections.instances.begin(), detections.instances.end(), says) +
           std::count_if(detections.rejected.begin(), detections.rejected.end(), says);
  }
};

TEST(AblationSwitches, WithoutEdgesTheOutlineSaysNothing) {
  AblatedDetection ablated;
  ASSERT_NO_FATAL_FAILURE(ablated.run({}));
  EXPECT_GT(ablated.contradicted(), 0);
  const RigidTransform with = ablated.detections.instances.front().camera_from_part;
  DetectParameters parameters;
  parameters.refine.edges = false;
  parameters.verify.edges = false;
  ASSERT_NO_FATAL_FAILURE(ablated.run(parameters));
  EXPECT_GT(ablated.detections.instances.size(), 3U);
  EXPECT_EQ(ablated.contradicted(), 0);
  const auto same = [&](const Instance& i) {
    return i.camera_from_part.translation == with.translation && i.camera_from_part.rotation == with.rotation;
  };
  EXPECT_TRUE(std::none_of(ablated.detections.instances.begin(), ablated.detections.instances.end(), same));
}

TEST(AblationSwitches, ABankWithoutEdgesIsFoundAsWithTheSwitch) {
  AblatedDetection switched;
  DetectParameters parameters;
  parameters.refine.edges = false;
  parameters.verify.edges = false;
  ASSERT_NO_FATAL_FAILURE(switched.run(parameters));
  AblatedDetection told;
  BankPart part = *told.bracket.bank().part;
  Bank bank = told.bracket.bank();
  bank.part = &part;
  part.edges_judge = 0;
  ASSERT_NO_FATAL_FAILURE(told.run({}, bank));
  EXPECT_EQ(told.contradicted(), 0);
  part.edges_refine = 0;
  ASSERT_NO_FATAL_FAILURE(told.run({}, bank));
  ASSERT_EQ(told.detections.instances.size(), switched.detections.instances.size());
  for (std::size_t i = 0; i < told.detections.instances.size(); ++i) {
    const RigidTransform& a = told.detections.instances[i].camera_from_part;
    const RigidTransform& b = switched.detections.instances[i].camera_from_part;
    EXPECT_EQ(a.translation, b.translation);
    EXPECT_EQ(a.rotation, b.rotation);
  }
}

TEST(AblationSwitches, WithoutTestsOnlyTheScoreRejects) {
  AblatedDetection ablated;
  DetectParameters parameters;
  ASSERT_NO_FATAL_FAILURE(ablated.run(parameters));
  const auto count = [&](Rejection test) { return ablated.detections.rejections[static_cast<std::size_t>(test)]; };
  const std::array tests{Rejection::overlap, Rejection::boundary, Rejection::edge, Rejection::below_plane};
  std::uint32_t rejected = 0;
  for (const Rejection test : tests) rejected += count(test);
  EXPECT_GT(rejected, 0U);
  parameters.verify.tests = false;
  ASSERT_NO_FATAL_FAILURE(ablated.run(parameters));
  for (const Rejection test : tests) EXPECT_EQ(count(test), 0U);
}

}  // namespace
}  // namespace graspd
