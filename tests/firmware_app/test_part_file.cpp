#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "firmware_app/part_file.hpp"
#include "tests/firmware_app/temporary_folder.hpp"

namespace graspd {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

constexpr std::string_view smallest = "name = \"nut\"\nid = 7\nmesh = \"nut.stl\"\n";

class PartFileText : public testing::Test {
 protected:
  Result<PartFile> read(std::string_view more) {
    return read_part_file(folder_.write("part.toml", std::string(smallest) + std::string(more)));
  }
  std::string complaint(std::string_view more) {
    const Result<PartFile> result = read(more);
    if (result.ok()) return "(accepted)";
    EXPECT_EQ(result.status().code(), StatusCode::bad_configuration);
    const std::string message(result.status().message());
    return message.substr(std::min(message.size(), folder_.path("").size()));
  }
  TemporaryFolder folder_;
};

TEST_F(PartFileText, SmallestOneLeavesSymmetriesToTheBuilder) {
  const Result<PartFile> result = read("");
  ASSERT_TRUE(result.ok()) << result.status().message();
  EXPECT_EQ(result.value().part.name, "nut");
  EXPECT_EQ(result.value().part.part_id, 7U);
  EXPECT_EQ(result.value().mesh_path, folder_.path("nut.stl"));
  EXPECT_EQ(result.value().mesh_unit, LengthUnit::millimetres);
  EXPECT_EQ(read("units = \"in\"\n").value().mesh_unit, LengthUnit::inches);
  EXPECT_FALSE(result.value().part.symmetry_given);
}

TEST_F(PartFileText, ASamplingOfTheFileIsToldFromTheDefault) {
  EXPECT_FALSE(read("[build]\nmaximum_views = 8\n").value().sampling_given);
  const PartFile given = read("[build]\nsampling = 0.04\n").value();
  EXPECT_TRUE(given.sampling_given);
  EXPECT_FLOAT_EQ(given.build.sampling, 0.04F);
}

TEST_F(PartFileText, TheDetailCanBeSet) {
  EXPECT_FLOAT_EQ(read("").value().build.detail, BankBuildParameters{}.detail);
  EXPECT_FLOAT_EQ(read("[build]\ndetail = 0.4\n").value().build.detail, 0.4F);
  EXPECT_THAT(complaint("[build]\ndetail = 1.5\n"), StartsWith("part.toml:5: build.detail"));
}

TEST_F(PartFileText, EmptySymmetrySectionMeansNone) {
  const Result<PartFile> result = read("[symmetry]\n");
  ASSERT_TRUE(result.ok()) << result.status().message();
  EXPECT_TRUE(result.value().part.symmetry_given);
  EXPECT_TRUE(result.value().part.symmetry_discrete.empty());
  EXPECT_FALSE(result.value().part.symmetry_continuous);
}

TEST_F(PartFileText, DiscreteAxesAreClosedToAGroup) {
  const Result<PartFile> result =
      read("[[symmetry.discrete]]\naxis = [0, 0, 2]\nfold = 6\n[[symmetry.discrete]]\naxis = [1, 0, 0]\nfold = 2\n");
  ASSERT_TRUE(result.ok()) << result.status().message();
  EXPECT_EQ(result.value().part.symmetry_discrete.size(), 11U) << "a hexagonal prism has 12 with the identity";
  for (const RigidTransform& transform : result.value().part.symmetry_discrete) {
    EXPECT_GT(rotation_angle(transform.rotation), 0.5F) << "the identity is not listed";
  }
}

TEST_F(PartFileText, OffsetOfAnAxisTurnsAboutThatPoint) {
  const Result<PartFile> result = read("[[symmetry.discrete]]\naxis = [0, 0, 1]\nfold = 2\noffset = [10, 0, 0]\n");
  ASSERT_TRUE(result.ok()) << result.status().message();
  ASSERT_EQ(result.value().part.symmetry_discrete.size(), 1U);
  EXPECT_TRUE((result.value().part.symmetry_discrete[0] * Vector3::Zero()).isApprox(Vector3(0.02F, 0, 0), 1e-5F));
}

TEST_F(PartFileText, AxesThatMakeNoGroupAreRefused) {
  EXPECT_EQ(complaint("[[symmetry.discrete]]\naxis = [0, 0, 1]\nfold = 5\n[[symmetry.discrete]]\naxis = [1, 0, 3]\n"
                      "fold = 7\n"),
            "part.toml:4: symmetry.discrete makes more than 256 poses that look alike: the axes must meet in one point "
            "at right angles");
}

TEST_F(PartFileText, NothingIsTakenThatTheBankDoesNotHold) {
  const auto turns = [](const std::string& fold) {
    return "[[symmetry.discrete]]\naxis = [0, 0, 1]\nfold = " + fold + "\n";
  };
  EXPECT_EQ(read(turns("256")).value().part.symmetry_discrete.size(), 255U);
  EXPECT_THAT(complaint(turns("257")), StartsWith("part.toml:6: symmetry.discrete.fold must"));
  EXPECT_THAT(complaint(turns("200") + "[[symmetry.discrete]]\naxis = [1, 0, 0]\nfold = 2\n"),
              HasSubstr("makes more than 256 poses"));

  PartFile most = read("[build]\ncandidate_views = " + std::to_string(most_candidate_views) + "\n").value();
  most.part.mesh.vertices = {Vector3::Zero()};
  BankReport report;
  const auto refused = build_bank(most.part, most.build, report, [](float) {});
  EXPECT_THAT(std::string(refused.status().message()), HasSubstr("no faces")) << "the parameters are not what is wrong";
  EXPECT_THAT(complaint("[build]\ncandidate_views = " + std::to_string(most_candidate_views + 1) + "\n"),
              HasSubstr("candidate_views"));
}

TEST_F(PartFileText, GraspMakesARightHandedToolFrame) {
  const Result<PartFile> result = read(
      "[[grasp]]\nposition = [0, 5, 10]\napproach = [0, 0, -3]\nclosing = [0, 2, 0]\nwidth = 40\npriority = 2\n"
      "[[grasp]]\nkind = \"suction\"\nposition = [0, 0, 0]\napproach = [1, 0, 0]\ntool = 3\n");
  ASSERT_TRUE(result.ok()) << result.status().message();
  ASSERT_EQ(result.value().part.grasps.size(), 2U);
  const PartGrasp& grasp = result.value().part.grasps[0];
  EXPECT_TRUE(grasp.part_from_tool.translation.isApprox(Vector3(0, 0.005F, 0.01F)));
  EXPECT_TRUE(grasp.part_from_tool.rotation.col(2).isApprox(Vector3(0, 0, -1)));
  EXPECT_TRUE(grasp.part_from_tool.rotation.col(0).isApprox(Vector3(0, 1, 0)));
  EXPECT_NEAR(grasp.part_from_tool.rotation.determinant(), 1.0F, 1e-5F);
  EXPECT_FLOAT_EQ(grasp.opening, 0.04F);
  EXPECT_EQ(grasp.priority, 2);
  EXPECT_EQ(grasp.number, 1U);
  EXPECT_EQ(grasp.kind, GraspKind::parallel);
  EXPECT_FLOAT_EQ(grasp.least_opening, 0.04F);
  EXPECT_EQ(result.value().part.grasps[1].number, 2U);
  EXPECT_EQ(result.value().part.grasps[1].kind, GraspKind::suction);
  EXPECT_EQ(result.value().part.grasps[1].tool, 3U);
  EXPECT_FLOAT_EQ(result.value().part.grasps[1].opening, 0.0F);
}

TEST_F(PartFileText, SkewGraspIsRefused) {
  EXPECT_EQ(complaint("[[grasp]]\nposition = [0, 0, 0]\napproach = [0, 0, 1]\nclosing = [1, 0, 1]\nwidth = 9\n"),
            "part.toml:7: grasp.closing must be at a right angle to the approach");
  EXPECT_EQ(complaint("[[grasp]]\nposition = [0, 0, 0]\napproach = [0, 0, 0]\nclosing = [1, 0, 1]\nwidth = 9\n"),
            "part.toml:6: grasp.approach must be a direction, but has no length");
}

constexpr const char* jaws = "[[grasp]]\nposition = [0, 0, 10]\napproach = [0, 0, -1]\nclosing = [1, 0, 0]\n";

TEST_F(PartFileText, WidthMayBeARange) {
  const Result<PartFile> result = read(std::string(jaws) + "width = [30, 45]\nheld_width = 28\n");
  ASSERT_TRUE(result.ok()) << result.status().message();
  const PartGrasp& grasp = result.value().part.grasps[0];
  EXPECT_FLOAT_EQ(grasp.least_opening, 0.030F);
  EXPECT_FLOAT_EQ(grasp.opening, 0.045F);
  EXPECT_FLOAT_EQ(grasp.held_width, 0.028F);
}

TEST_F(PartFileText, WidthsThatMakeNoSenseAreRefused) {
  EXPECT_EQ(complaint(std::string(jaws) + "width = [45, 30]\n"),
            "part.toml:8: grasp.width must be two numbers between 0 and 1000, the lesser one first");
  EXPECT_EQ(complaint(std::string(jaws) + "width = 0\n"), "part.toml:8: grasp.width must be greater than 0");
  EXPECT_EQ(complaint(std::string(jaws) + "width = 30\nheld_width = 31\n"),
            "part.toml:9: grasp.held_width must not be greater than width");
  EXPECT_THAT(complaint(jaws), StartsWith("part.toml:4: grasp.width is missing: "));
  EXPECT_THAT(complaint("[[grasp]]\nkind = \"magnetic\"\nposition = [0, 0, 0]\napproach = [0, 0, 1]\nwidth = 3\n"),
              StartsWith("part.toml:8: unknown key grasp.width"));
}

TEST_F(PartFileText, GraspIsExpandedAboutAnAxis) {
  const Result<PartFile> circle =
      read(std::string(jaws) + "width = 30\n[grasp.around]\naxis = [0, 1, 0]\noffset = [5, 0, 0]\nsteps = 4\n");
  ASSERT_TRUE(circle.ok()) << circle.status().message();
  const std::vector<PartGrasp>& grasps = circle.value().part.grasps;
  ASSERT_EQ(grasps.size(), 4U);
  for (const PartGrasp& grasp : grasps) EXPECT_EQ(grasp.number, 1U);
  // A quarter turn about y carries z to x.
  EXPECT_TRUE(grasps[1].part_from_tool.translation.isApprox(Vector3(0.015F, 0, 0.005F), 1e-4F));
  EXPECT_TRUE(grasps[1].part_from_tool.rotation.col(2).isApprox(Vector3(-1, 0, 0), 1e-4F));
  EXPECT_TRUE(grasps[2].part_from_tool.rotation.col(2).isApprox(Vector3(0, 0, 1), 1e-4F));

  const Result<PartFile> arc =
      read(std::string(jaws) + "width = 30\n[grasp.around]\naxis = [0, 0, 1]\nsteps = 3\nfrom = -45\nto = 45\n");
  ASSERT_TRUE(arc.ok()) << arc.status().message();
  ASSERT_EQ(arc.value().part.grasps.size(), 3U);
  const Vector3 last = arc.value().part.grasps[2].part_from_tool.rotation.col(0);
  EXPECT_NEAR(std::atan2(last.y(), last.x()), 0.7854F, 1e-3F) << "an arc includes both ends";
  EXPECT_EQ(complaint(std::string(jaws) + "width = 30\n[grasp.around]\naxis = [0, 0, 1]\nfrom = 10\nto = 5\n"),
            "part.toml:12: grasp.around.to must be greater than from, by at most 360");
}

TEST_F(PartFileText, GraspWithoutPositionSaysSo) {
  EXPECT_THAT(complaint("[[grasp]]\napproach = [0, 0, 1]\nclosing = [1, 0, 0]\n"),
              StartsWith("part.toml:4: grasp.position is missing: "));
}

TEST_F(PartFileText, MisspeltKeysNameTheNearest) {
  EXPECT_THAT(complaint("unit = \"mm\"\n"), EndsWith("unknown key unit; did you mean units?"));
  EXPECT_THAT(complaint("[thresholds]\nminimum_scor = 0.5\n"),
              EndsWith("unknown key thresholds.minimum_scor; did you mean thresholds.minimum_score?"));
}

TEST_F(PartFileText, ThresholdsAndBuildParametersAreTaken) {
  const Result<PartFile> result = read("[thresholds]\nminimum_edge = 0.4\n[build]\nmaximum_incidence = 60\n");
  ASSERT_TRUE(result.ok()) << result.status().message();
  EXPECT_FLOAT_EQ(result.value().part.thresholds.minimum_edge, 0.4F);
  EXPECT_NEAR(result.value().build.maximum_incidence, 1.0472F, 1e-4F);
}

TEST_F(PartFileText, NameThatDoesNotFitTheBankIsRefused) {
  const std::string path =
      folder_.write("part.toml", "name = \"" + std::string(64, 'x') + "\"\nid = 1\nmesh = \"a\"\n");
  const Result<PartFile> result = read_part_file(path);
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(std::string(result.status().message()), EndsWith(":1: name must have between 1 and 63 letters"));
}

}  // namespace
}  // namespace graspd
