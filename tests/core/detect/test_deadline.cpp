#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/detect/select.hpp"
#include "tests/core/detect/bracket_scene.hpp"
#include "tests/core/detect/counting_clock.hpp"

namespace graspd {
namespace {

class Deadline : public testing::Test {
 protected:
  Deadline() {
    request_.banks = std::span(&maker_.bank(), 1);
    request_.now_ns = read_clock;
  }
  Detections detect_until(std::int64_t deadline) {
    readings = 0;
    request_.deadline_ns = deadline;
    Detections detections;
    EXPECT_TRUE(detect(bin_.frame(), request_, {}, memory_.workspace, detections).ok());
    return detections;
  }

  BracketBank maker_;
  BracketScene bin_;
  DetectMemory memory_{1};
  DetectRequest request_;
};

TEST_F(Deadline, ThatIsFarOffChangesNothing) {
  const std::size_t found = detect_until(0).instances.size();
  const Detections detections = detect_until(std::int64_t{1} << 60U);
  EXPECT_EQ(detections.instances.size(), found);
  EXPECT_EQ(detections.flags & flag_deadline, 0U);
}

TEST_F(Deadline, ThatHasPassedLeavesNothing) {
  const Detections detections = detect_until(1);
  EXPECT_NE(detections.flags & flag_deadline, 0U);
  EXPECT_TRUE(detections.instances.empty());
}

TEST_F(Deadline, EndsThePreparationOfTheSceneToo) {
  (void)detect_until(std::int64_t{1} << 60U);
  const std::int64_t whole = readings;
  // The clock is read once a row of the map and more.
  for (const std::int64_t deadline : {5, 50, 200, 400}) {
    const Detections detections = detect_until(deadline);
    EXPECT_NE(detections.flags & flag_deadline, 0U);
    EXPECT_TRUE(detections.instances.empty());
    EXPECT_EQ(detections.scene_points, 0U) << "voting began after " << deadline << " of " << whole << " readings";
  }
}

TEST_F(Deadline, EndsTheSamplingToo) {
  PreprocessWorkspace& workspace = memory_.workspace.preprocess;
  const BankPart& part = *maker_.bank().part;
  const Scene scene = preprocess(bin_.frame(), {}, part.detail, {}, {}, workspace);
  const auto sample_until = [&](std::int64_t deadline) {
    readings = 0;
    return sample_for(scene, part.sampling, part.diameter, {1, read_clock, deadline}, workspace).points.size();
  };
  EXPECT_GT(sample_until(std::int64_t{1} << 60U), 100U);
  const std::int64_t whole = readings;
  EXPECT_GT(whole, 10);
  for (const std::int64_t deadline : {std::int64_t{1}, whole / 2, whole}) EXPECT_EQ(sample_until(deadline), 0U);
}

TEST_F(Deadline, EndsTheSegmentationToo) {
  PreprocessWorkspace& workspace = memory_.workspace.preprocess;
  Scene scene = preprocess(bin_.frame(), {}, maker_.bank().part->detail, {}, {}, workspace);
  readings = 0;
  segment_foreground(1, {1, read_clock, std::int64_t{1} << 60U}, workspace.segments, scene.map);
  EXPECT_GE(readings, scene.map.camera.height);
  for (const std::int64_t deadline : {1, scene.map.camera.height}) {
    readings = 0;
    segment_foreground(1, {1, read_clock, deadline}, workspace.segments, scene.map);
    EXPECT_EQ(readings, deadline);
  }
}

TEST_F(Deadline, EndsTheSelectionToo) {
  const std::size_t found = detect_until(0).instances.size();
  DetectWorkspace& workspace = memory_.workspace;
  const Scene scene = preprocess(bin_.frame(), {}, maker_.bank().part->detail, {}, {}, workspace.preprocess);
  const std::vector<Instance> judged(workspace.judged.begin(), workspace.judged.end());
  const auto select_until = [&](std::int64_t deadline) {
    readings = 0;
    std::vector<Instance> candidates = judged;
    for (Instance& candidate : candidates) candidate.rejection = Rejection::none;
    workspace.accepted.clear();
    workspace.rejected.clear();
    (void)select_instances(scene.map, request_.banks, {}, -1.0F, {1, read_clock, deadline}, workspace.rendering,
                           candidates, workspace.select, workspace.accepted, workspace.rejected);
    return workspace.accepted.size();
  };
  EXPECT_EQ(select_until(0), found);
  EXPECT_EQ(select_until(1), 0U);
  // The clock is read before each candidate; the best ones come first.
  const std::size_t some = select_until(4);
  EXPECT_GT(some, 0U);
  EXPECT_LT(some, found);
}

TEST_F(Deadline, LeavesWhatWasVerifiedByThen) {
  const std::size_t found = detect_until(std::int64_t{1} << 60U).instances.size();
  const std::int64_t whole = readings;
  std::size_t most = 0;
  // The clock is read but once a pose that is verified, so that they all come shortly before the end.
  for (const std::int64_t left : {whole * 8 / 10, whole * 4 / 10, whole / 10, std::int64_t{40}, std::int64_t{20},
                                  std::int64_t{10}, std::int64_t{5}}) {
    const Detections detections = detect_until(whole - left);
    EXPECT_NE(detections.flags & flag_deadline, 0U);
    EXPECT_LE(detections.instances.size(), found);
    most = std::max(most, detections.instances.size());
    for (const Instance& instance : detections.instances) {
      EXPECT_TRUE(std::any_of(bin_.poses.begin(), bin_.poses.end(), [&](const RigidTransform& truth) {
        return (instance.camera_from_part.translation - truth.translation).norm() < 0.002F;
      }));
    }
  }
  EXPECT_GT(most, 0U);
}

}  // namespace
}  // namespace graspd
