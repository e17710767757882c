#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "tests/core/detect/bracket_scene.hpp"

namespace graspd {
namespace {

template <class T>
void append(std::string& bytes, const T& value) {
  static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

/// The result as bytes, field by field: padding has no say. Times are no part of it.
std::string bytes_of(const Detections& detections) {
  std::string bytes;
  for (const std::span<const Instance> instances : {detections.instances, detections.rejected}) {
    append(bytes, instances.size());
    for (const Instance& i : instances) {
      for (const float number : i.camera_from_part.rotation.reshaped()) append(bytes, number);
      for (const float number : i.camera_from_part.translation) append(bytes, number);
      for (const float number : {i.votes, i.score, i.evidence.overlap, i.evidence.visible, i.evidence.boundary,
                                 i.evidence.edge, i.evidence.below, i.evidence.residual}) {
        append(bytes, number);
      }
      append(bytes, i.bank);
      append(bytes, i.view);
      append(bytes, i.rejection);
    }
  }
  for (const std::uint32_t count : detections.rejections) append(bytes, count);
  for (const std::uint32_t number :
       {detections.flags, detections.scene_points, detections.foreground_pixels, detections.measured_pixels}) {
    append(bytes, number);
  }
  const DetectionWork& work = detections.work;
  for (const std::uint64_t count : {work.voting.pairs, work.voting.cells, work.voting.votes}) append(bytes, count);
  for (const std::uint32_t count : {work.hypotheses, work.clusters, work.judged}) append(bytes, count);
  return bytes;
}

struct Determinism : testing::Test {
  Determinism() { scene.crop(); }
  /// Coarser than banks are made, as sanitizers take their time.
  static void SetUpTestSuite() {
    BankBuildParameters parameters;
    parameters.sampling = 0.06F;
    parameters.candidate_views = 60;
    parameters.surface_points = 600;
    parameters.visibility_directions = 162;
    bracket = std::make_unique<BracketBank>(parameters);
  }
  static void TearDownTestSuite() { bracket.reset(); }
  std::string detect_with(int threads, DetectMemory& memory) {
    DetectRequest request;
    request.banks = {&bracket->bank(), 1};
    DetectParameters parameters;
    parameters.threads = threads;
    const Status status = detect(scene.frame(), request, parameters, memory.workspace, detections);
    EXPECT_TRUE(status.ok()) << status.message();
    return bytes_of(detections);
  }
  static std::unique_ptr<BracketBank> bracket;
  BracketScene scene;
  Detections detections;
};
std::unique_ptr<BracketBank> Determinism::bracket;

TEST_F(Determinism, SceneHoldsWhatItIsMeantToTest) {
  DetectMemory memory(1);
  detect_with(1, memory);
  int right = 0;
  for (const RigidTransform& pose : scene.poses) {
    right += std::any_of(detections.instances.begin(), detections.instances.end(), [&](const Instance& instance) {
      return (instance.camera_from_part.translation - pose.translation).norm() < 0.005F &&
             rotation_angle(instance.camera_from_part.rotation.transpose() * pose.rotation) < 0.1F;
    });
  }
  EXPECT_GE(2 * right, static_cast<int>(scene.poses.size()))
      << right << " of " << scene.poses.size() << " brackets; " << detections.instances.size() << " reported";
  EXPECT_FALSE(detections.rejected.empty());
}

TEST_F(Determinism, SameBytesRunAfterRun) {
  DetectMemory memory(1);
  const std::string first = detect_with(1, memory);
  EXPECT_EQ(detect_with(1, memory), first);
}

TEST_F(Determinism, SameBytesForAnyNumberOfThreads) {
  DetectMemory one(1);
  const std::string expected = detect_with(1, one);
  DetectMemory several(3);
  for (const int threads : {2, 3, 1}) EXPECT_EQ(detect_with(threads, several), expected) << threads << " threads";
}

TEST_F(Determinism, MemoryOfAnotherFrameLeavesNoTrace) {
  DetectMemory fresh(2);
  const std::string expected = detect_with(2, fresh);
  DetectMemory used(2);
  const std::vector<float> kept = scene.depth;
  for (std::size_t i = 0; i < scene.depth.size(); i += 3) scene.depth[i] = 0.0F;
  std::rotate(scene.depth.begin(), scene.depth.begin() + 4000, scene.depth.end());
  EXPECT_NE(detect_with(2, used), expected);
  scene.depth = kept;
  EXPECT_EQ(detect_with(2, used), expected);
}

}  // namespace
}  // namespace graspd
