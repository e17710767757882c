#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/bank/bank_check.hpp"
#include "core/train/bank_builder.hpp"
#include "tests/core/train/shapes.hpp"

namespace graspd {
namespace {

/// Enough to be a bank, little enough to make in a moment.
BankBuildParameters quick() {
  BankBuildParameters parameters;
  parameters.sampling = 0.08F;
  parameters.candidate_views = 60;
  parameters.surface_points = 150;
  parameters.visibility_directions = 100;
  return parameters;
}

PartDescription described(const Mesh& mesh) {
  PartDescription part;
  part.name = "part";
  part.part_id = 3;
  part.mesh = mesh;
  part.symmetry_given = true;
  part.twins.emplace();
  return part;
}

std::vector<std::byte> built(const PartDescription& part, BankReport& report) {
  auto file = build_bank(part, quick(), report, [](float) {});
  EXPECT_TRUE(file.ok()) << file.status().message();
  return std::move(file).value();
}

TEST(BankBuilder, ABracketMakesABankThatReadsBack) {
  PartDescription part = described(shapes::exploded(shapes::bracket()));
  part.grasps.resize(2);
  part.grasps[1].number = 2;
  part.thresholds.minimum_score = 0.6F;
  BankReport report;
  const auto file = built(part, report);
  const auto result = read_bank(file, "bracket");
  ASSERT_TRUE(result.ok()) << result.status().message();
  const Bank& bank = result.value();
  EXPECT_EQ(bank.part->name_view(), "part");
  EXPECT_EQ(bank.part->part_id, 3U);
  EXPECT_NEAR(bank.part->diameter, std::sqrt(0.0064F + 0.0025F + 0.0009F), 1e-4F);
  EXPECT_NEAR(bank.part->sampling, 0.08F * bank.part->diameter, 1e-6F);
  EXPECT_NEAR(bank.part->thresholds.minimum_score, 0.6F, 1e-6F);
  EXPECT_EQ(bank.grasps.size(), 2U);
  EXPECT_EQ(bank.surface.size(), 150U);
  EXPECT_EQ(static_cast<int>(bank.views.size()), report.views_kept);
  EXPECT_GE(bank.views.size(), 4U);
  EXPECT_EQ(bank.symmetry_discrete.size(), 1U);
  EXPECT_GT(bank.entries.size(), 1000U);
  EXPECT_GT(bank.edges.size(), 100U);
  EXPECT_FALSE(report.symmetry_proposed);
  EXPECT_EQ(report.views_rendered, 60);
}

TEST(BankBuilder, TheBankSaysWhatEdgesAreUsedFor) {
  BankBuildParameters parameters = quick();
  parameters.edges_judge = false;
  BankReport report;
  const auto file = build_bank(described(shapes::bracket()), parameters, report, [](float) {}).value();
  const Bank bank = read_bank(file, "bracket").value();
  EXPECT_EQ(bank.part->edges_refine, 1U);
  EXPECT_EQ(bank.part->edges_judge, 0U);
}

TEST(BankBuilder, TheSamePartGivesTheSameBytes) {
  const PartDescription part = described(shapes::bracket());
  BankReport report;
  EXPECT_EQ(built(part, report), built(part, report));
}

TEST(BankBuilder, EntriesHoldPairsOfTheirView) {
  BankReport report;
  const auto file = built(described(shapes::bracket()), report);
  const Bank bank = read_bank(file, "bracket").value();
  std::size_t matched = 0;
  std::size_t looked_at = 0;
  for (std::uint32_t cell = 0; cell < bank.grid.cell_count(); cell += 5) {
    for (std::uint32_t e = bank.cell_offsets[cell]; e < bank.cell_offsets[cell + 1]; ++e, ++looked_at) {
      const std::uint32_t reference = bank.entries[e].reference();
      const BankView& view = bank.views[bank.reference_views[reference]];
      const OrientedPoint& first = bank.view_points[bank.reference_points[reference]];
      const RigidTransform local = local_from_point(first);
      const auto partners = bank.view_points.subspan(view.first_point, view.point_count);
      matched += std::any_of(partners.begin(), partners.end(), [&](const OrientedPoint& second) {
        return ppf_cell(ppf_feature(first, second), bank.grid) == cell &&
               entry_alpha(alpha_of(local, second.position)) == bank.entries[e].alpha();
      });
    }
  }
  EXPECT_GT(looked_at, 500U);
  EXPECT_EQ(matched, looked_at);
}

TEST(BankBuilder, VisibilityAgreesWithTheNormalsOfABox) {
  BankReport report;
  const auto file = built(described(shapes::box(0.06F, 0.05F, 0.04F)), report);
  const Bank bank = read_bank(file, "box").value();
  const auto row = bank.visibility.row(Vector3(1, 1, 1));
  for (std::size_t i = 0; i < bank.surface.size(); ++i) {
    EXPECT_EQ((row[i / 64] >> (i % 64) & 1U) != 0, bank.surface[i].normal.sum() > 0.0F);
  }
}

TEST(BankBuilder, SymmetriesAreFoundAndSaidWhenNotGiven) {
  PartDescription part = described(shapes::cylinder(0.012F, 0.03F));
  part.symmetry_given = false;
  BankReport report;
  const auto file = built(part, report);
  const Bank bank = read_bank(file, "cylinder").value();
  EXPECT_TRUE(report.symmetry_proposed);
  EXPECT_THAT(report.remarks, testing::Contains(testing::HasSubstr("symmetries found on the mesh: any turn about")));
  EXPECT_EQ(bank.part->symmetry_continuous, 1U);
  EXPECT_EQ(bank.symmetry_discrete.size(), 2U);
  EXPECT_LE(bank.views.size(), 2U);
  EXPECT_GT(report.views_degenerate, 0);
}

TEST(BankBuilder, TwinsAreLookedForWhenNotKnown) {
  PartDescription part = described(shapes::box(0.06F, 0.04F, 0.02F));
  part.twins.reset();
  BankReport report;
  const auto file = built(part, report);
  EXPECT_EQ(read_bank(file, "box").value().twins.size(), 3U) << "half turns, of which it was told nothing";
  EXPECT_THAT(report.remarks, testing::Contains(testing::HasSubstr("most of all turned by 180 degrees about")));
}

TEST(BankBuilder, SymmetriesLeaveTheCentreWhereItIs) {
  // The middle of the box about three alike sides is not their middle.
  PartDescription prism = described(shapes::prism(3, 0.03F, 0.012F));
  prism.symmetry_discrete = {turn_about({Vector3::UnitZ(), Vector3::Zero()}, 2.0F * std::numbers::pi_v<float> / 3.0F)};
  BankReport prism_report;
  const auto prism_file = built(prism, prism_report);
  const Bank three = read_bank(prism_file, "prism").value();
  ASSERT_EQ(three.symmetry_discrete.size(), 3U);
  EXPECT_LT(three.part->centre.norm(), 1e-6F);
  EXPECT_GT(three.part->box_max.x(), 0.01F - three.part->box_min.x());
  // Likewise a cone whose axis runs between the axes of coordinates.
  const SymmetryAxis axis{Vector3(1, 2, 2) / 3.0F, Vector3(0.1F, 0.0F, -0.05F)};
  Mesh cone = shapes::cylinder(0.02F, 0.05F);
  for (Vector3& vertex : cone.vertices) {
    if (vertex.z() > 0.0F) vertex.head<2>() *= 0.2F;
    vertex = axis.point + Eigen::Quaternionf::FromTwoVectors(Vector3::UnitZ(), axis.direction) * vertex;
  }
  PartDescription part = described(cone);
  part.symmetry_continuous = true;
  part.symmetry_axis = axis;
  BankReport report;
  const auto file = built(part, report);
  const Bank bank = read_bank(file, "cone").value();
  const Vector3 arm = bank.part->centre - axis.point;
  EXPECT_LT(axis.direction.cross(arm).norm(), 1e-6F);
  EXPECT_LT(arm.norm(), 0.02F);
  const Vector3 middle = 0.5F * (bank.part->box_min + bank.part->box_max);
  EXPECT_GT(axis.direction.cross(middle - axis.point).norm(), 0.001F);
}

TEST(BankBuilder, ADoubtfulSymmetryIsRemarkedOn) {
  PartDescription part = described(shapes::box(0.06F, 0.04F, 0.02F));
  part.symmetry_discrete = {turn_about({Vector3::UnitZ(), Vector3::Zero()}, std::numbers::pi_v<float> / 2)};
  BankReport report;
  built(part, report);
  EXPECT_THAT(report.remarks, testing::Contains(testing::StartsWith("the symmetries given do not fit the mesh")));

  part.symmetry_discrete = {turn_about({Vector3::UnitZ(), Vector3::Zero()}, std::numbers::pi_v<float>)};
  built(part, report);
  EXPECT_THAT(report.remarks, testing::IsEmpty());
}

TEST(BankBuilder, ASymmetryBesideThePartIsRefused) {
  // A CAD file that has the part away from its origin, and an axis without an offset.
  const RigidTransform aside{Matrix3::Identity(), Vector3(0.32F, 0.0F, 0.01F)};
  PartDescription half = described(shapes::moved(shapes::box(0.04F, 0.03F, 0.02F), aside));
  half.symmetry_discrete = {turn_about({Vector3::UnitZ(), Vector3::Zero()}, std::numbers::pi_v<float>)};
  PartDescription any = described(shapes::moved(shapes::cylinder(0.01F, 0.03F), aside));
  any.symmetry_continuous = true;
  BankReport report;
  for (const PartDescription& part : {half, any}) {
    const Status refused = build_bank(part, quick(), report, [](float) {}).status();
    EXPECT_EQ(refused.code(), StatusCode::bad_configuration);
    EXPECT_THAT(std::string(refused.message()),
                testing::AllOf(testing::StartsWith("[symmetry] turns the part 640 mm away from itself"),
                               testing::HasSubstr("(320.0, 0.0, 10.0)")));
  }
  half.symmetry_discrete = {turn_about({Vector3::UnitZ(), aside.translation}, std::numbers::pi_v<float>)};
  EXPECT_TRUE(build_bank(half, quick(), report, [](float) {}).ok());
}

TEST(BankBuilder, ProgressRunsForwardToItsEnd) {
  std::vector<float> shares;
  BankReport report;
  ASSERT_TRUE(build_bank(described(shapes::bracket()), quick(), report, [&](float s) { shares.push_back(s); }).ok());
  EXPECT_GT(shares.size(), 4U);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1.0F);
}

TEST(BankBuilder, RefusesMeshesAndParametersThatMakeNoBank) {
  BankReport report;
  const auto code = [&](const PartDescription& part, const BankBuildParameters& parameters) {
    return build_bank(part, parameters, report, [](float) {}).status().code();
  };
  EXPECT_EQ(code(described({}), quick()), StatusCode::bad_file);
  PartDescription spoiled = described(shapes::bracket());
  spoiled.mesh.vertices[0].x() = std::numeric_limits<float>::infinity();
  EXPECT_EQ(code(spoiled, quick()), StatusCode::bad_file);

  const PartDescription part = described(shapes::bracket());
  for (const auto spoil :
       {+[](BankBuildParameters& p) { p.sampling = 0.0F; },
        +[](BankBuildParameters& p) { p.sampling = std::numeric_limits<float>::quiet_NaN(); },
        +[](BankBuildParameters& p) { p.angle_bins = 0; }, +[](BankBuildParameters& p) { p.candidate_views = 0; },
        +[](BankBuildParameters& p) { p.maximum_views = 0; }, +[](BankBuildParameters& p) { p.surface_points = 0; },
        +[](BankBuildParameters& p) { p.maximum_incidence = 2.0F; },
        +[](BankBuildParameters& p) { p.sensor_distance = -1.0F; }}) {
    BankBuildParameters parameters = quick();
    spoil(parameters);
    EXPECT_EQ(code(part, parameters), StatusCode::bad_configuration);
  }
}

}  // namespace
}  // namespace graspd
