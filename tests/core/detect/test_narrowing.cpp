#include <gtest/gtest.h>

#include <vector>

#include "core/detect/narrowing.hpp"
#include "core/detect/verify.hpp"
#include "tests/core/detect/bracket_scene.hpp"

namespace graspd {
namespace {

TEST(Narrowing, DropsWhatStandsInFreeSpaceAndNothingElse) {
  BracketBank bracket;
  BracketScene bin;
  DetectMemory memory(1);
  const Bank& bank = bracket.bank();
  const Scene scene =
      preprocess(bin.frame(), {}, bank.part->detail, DetectParameters{}.preprocess, {}, memory.workspace.preprocess);
  const auto shifted = [&](std::size_t pose, float towards_sensor) {
    PoseCluster cluster;
    cluster.camera_from_part = bin.poses[pose];
    cluster.camera_from_part.translation.z() -= towards_sensor;
    return cluster;
  };
  // Right, in the air, right, below the floor, in the air, beyond the image.
  std::vector<PoseCluster> storage{shifted(0, 0.0F),  shifted(0, 0.05F), shifted(3, 0.0F),
                                   shifted(3, -0.1F), shifted(3, 0.02F), shifted(1, 0.0F)};
  storage[5].camera_from_part.translation.x() += 2.0F;
  for (std::size_t i = 0; i < storage.size(); ++i) storage[i].rank = static_cast<std::uint32_t>(i);
  FixedVector<PoseCluster> clusters{std::span(storage)};
  clusters.assume_size(storage.size());
  const DetectParameters parameters;
  drop_contradicted(scene, bank, parameters.refine, surface_tolerance(scene.map, bank, parameters.verify), {},
                    clusters);
  std::vector<std::uint32_t> kept;
  for (const PoseCluster& cluster : clusters.span()) kept.push_back(cluster.rank);
  EXPECT_EQ(kept, (std::vector<std::uint32_t>{0, 2, 3, 5}));
}

}  // namespace
}  // namespace graspd
