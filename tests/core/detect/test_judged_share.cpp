#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/core/detect/bracket_scene.hpp"
#include "tests/core/train/shapes.hpp"

namespace graspd {
namespace {

TEST(JudgedShare, IsLeftToEachPartWhateverTheTwinsOfThoseBeforeItTake) {
  // A box that nearly looks the same after three half turns.
  PartDescription part;
  part.name = "box";
  part.part_id = 1;
  part.mesh = shapes::box(0.06F, 0.036F, 0.02F);
  part.symmetry_given = true;
  part.twins.emplace();
  for (const Vector3& axis : {Vector3(Vector3::UnitX()), Vector3(Vector3::UnitY()), Vector3(Vector3::UnitZ())})
    part.twins->push_back(turn_about({axis, Vector3::Zero()}, std::numbers::pi_v<float>));
  BankBuildParameters quick;
  quick.sampling = 0.08F;
  quick.candidate_views = 42;
  quick.surface_points = 400;
  quick.visibility_directions = 162;
  BankReport report;
  const std::vector<std::byte> file = build_bank(part, quick, report, [](float) {}).value();
  const Bank bank = read_bank(file, "box").value();
  ASSERT_EQ(bank.twins.size(), 3U);

  const Camera camera{400, 300, 500.0F, 500.0F, 199.5F, 149.5F};
  std::vector<float> depth(camera.pixel_count(), 0.55F);
  for (const float x : {-0.1F, 0.0F, 0.1F}) {
    const Matrix3 turn = Eigen::AngleAxisf(3.0F * x, Vector3::UnitZ()).toRotationMatrix();
    draw_depth(part.mesh.view(), {turn, Vector3(x, 0.01F, 0.54F)}, camera, depth);
  }
  DetectCapacity capacity;
  capacity.maximum_width = camera.width;
  capacity.maximum_height = camera.height;
  capacity.judged = 24;
  std::unique_ptr<std::byte[]> bytes;
  DetectWorkspace workspace = carved_into(bytes, [&](Arena& arena) { return carve_detect_workspace(arena, capacity); });
  const std::array<Bank, 3> banks{bank, bank, bank};
  DetectRequest request;
  request.banks = banks;
  Detections detections;
  DetectParameters parameters;
  parameters.cluster.plausible = 100;
  ASSERT_TRUE(detect({camera, depth, 0, 0}, request, parameters, workspace, detections).ok());
  EXPECT_NE(detections.flags & flag_hypotheses_cut, 0U);
  for (std::uint32_t b = 0; b < banks.size(); ++b) {
    const auto of_bank = [&](const Instance& instance) { return instance.bank == b; };
    const std::ptrdiff_t judged = std::count_if(detections.instances.begin(), detections.instances.end(), of_bank) +
                                  std::count_if(detections.rejected.begin(), detections.rejected.end(), of_bank);
    EXPECT_GE(judged, 1) << b;
    EXPECT_LE(judged, 8) << b;
  }
}

}  // namespace
}  // namespace graspd
