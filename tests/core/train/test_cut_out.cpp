#include <gtest/gtest.h>

#include "core/bank/bank.hpp"
#include "core/train/bank_builder.hpp"
#include "core/train/simulated_scene.hpp"
#include "core/train/surface_sampling.hpp"
#include "tests/core/train/shapes.hpp"

namespace graspd {
namespace {

/// A clean frame with a few brackets in it.
struct Recording {
  std::vector<SimulatedPart> parts{simulated_part(shapes::bracket(), true)};
  SimulatedScene scene;

  Recording() {
    SceneRecipe recipe;
    recipe.instances = 4;
    recipe.strain = SensorStrain::clean;
    recipe.pixel_pitch = 0.0008F;
    scene = simulate_scene(parts, recipe);
  }
  [[nodiscard]] const Mesh& mesh() const { return parts[0].mesh; }
  [[nodiscard]] CutOut cut(const RigidTransform& camera_from_part) {
    return cut_out(scene.frame(), camera_from_part, mesh().view(), Vector3(0.04F, 0.025F, 0), {0.002F, 0.004F});
  }
};

float distance_to(const std::vector<OrientedPoint>& surface, const OrientedPoint& point) {
  float nearest = 1.0F;
  float distance = 1.0F;
  for (const OrientedPoint& s : surface) {
    const float apart = (s.position - point.position).norm();
    if (apart >= nearest) continue;
    nearest = apart;
    distance = std::abs(s.normal.dot(point.position - s.position));
  }
  return distance;
}

TEST(CutOut, HoldsPointsOfThePartAsSeenFromTheSensor) {
  Recording recording;
  const std::vector<OrientedPoint> surface = sample_surface(recording.mesh(), {}, 4000);
  for (const SimulatedInstance& instance : recording.scene.instances) {
    const CutOut view = recording.cut(instance.camera_from_part);
    if (instance.visibility > 0.6F) {
      EXPECT_GT(view.points.size(), 100U);
    }
    std::size_t facing = 0;
    std::size_t near = 0;
    for (const OrientedPoint& p : view.points) {
      facing += p.normal.dot(view.direction) > 0.0F ? 1 : 0;
      near += distance_to(surface, p) < 0.0005F ? 1 : 0;
    }
    EXPECT_GE(facing * 100, view.points.size() * 95);
    EXPECT_GE(near * 100, view.points.size() * 90);
  }
}

TEST(CutOut, NothingIsCutWhereNothingOfThePartWasMeasured) {
  Recording recording;
  RigidTransform beside;
  beside.translation = Vector3(0.3F, 0.3F, 0.5F);
  EXPECT_TRUE(recording.cut(beside).points.empty());
}

TEST(CutOut, AlignmentTakesOutTheErrorOfAPose) {
  Recording recording;
  const std::vector<OrientedPoint> surface = sample_surface(recording.mesh(), {}, 8000);
  std::size_t best = 0;
  for (std::size_t i = 1; i < recording.scene.instances.size(); ++i) {
    if (recording.scene.instances[i].visibility > recording.scene.instances[best].visibility) best = i;
  }
  RigidTransform off;
  off.rotation = Eigen::AngleAxisf(0.02F, Vector3(1, 2, -1).normalized()).toRotationMatrix();
  off.translation = Vector3(0.001F, -0.0008F, 0.0012F);
  CutOut view = recording.cut(recording.scene.instances[best].camera_from_part);
  for (OrientedPoint& p : view.points) p = off * p;
  const auto error = [&] {
    float sum = 0.0F;
    for (const OrientedPoint& p : view.points) sum += distance_to(surface, p);
    return sum / static_cast<float>(view.points.size());
  };
  const float before = error();
  lay_on(SurfaceIndex(surface, 0.004F), 0.004F, view);
  EXPECT_LT(error(), 0.4F * before);
}

TEST(LearnBank, ViewsFromFramesComeBeforeRenderedOnesAndAloneWhenAskedFor) {
  Recording recording;
  PartDescription part;
  part.name = "bracket";
  part.part_id = 1;
  part.mesh = recording.mesh();
  part.symmetry_given = true;
  std::vector<CutOut> cuts;
  for (const SimulatedInstance& instance : recording.scene.instances) {
    cuts.push_back(recording.cut(instance.camera_from_part));
    cuts.back().source = "frame 1";
  }
  BankBuildParameters parameters;
  parameters.sampling = 0.08F;
  parameters.surface_points = 500;
  BankReport report;
  const auto mixed = learn_bank(part, cuts, true, parameters, report, [](float) {});
  ASSERT_TRUE(mixed.ok()) << mixed.status().message();
  EXPECT_TRUE(read_bank(mixed.value(), "mixed").ok());
  EXPECT_EQ(report.views_rendered, parameters.candidate_views);
  EXPECT_GT(report.views_cut_out, 0);
  std::size_t last_cut_out = 0;
  std::size_t first_rendered = 1000;
  for (const CandidateReport& candidate : report.candidates) {
    if (candidate.fate != CandidateFate::kept) continue;
    if (candidate.source.empty()) {
      first_rendered = std::min(first_rendered, candidate.view);
    } else {
      EXPECT_EQ(candidate.source, "frame 1");
      last_cut_out = std::max(last_cut_out, candidate.view);
    }
  }
  EXPECT_LT(last_cut_out, first_rendered);
  EXPECT_LT(first_rendered, 1000U);  // Four parts do not show every side.

  const auto alone = learn_bank(part, cuts, false, parameters, report, [](float) {});
  ASSERT_TRUE(alone.ok()) << alone.status().message();
  EXPECT_EQ(report.views_rendered, 0);
  const auto none = learn_bank(part, {}, false, parameters, report, [](float) {});
  EXPECT_EQ(none.status().code(), StatusCode::bad_frame);
}

TEST(LearnBank, TwinsOfASymmetricPartAreOneView) {
  PartDescription part;
  part.name = "block";
  part.part_id = 1;
  part.mesh = shapes::box(0.06F, 0.04F, 0.02F);
  part.symmetry_given = true;
  const RigidTransform half = turn_about({Vector3::UnitZ(), Vector3::Zero()}, std::numbers::pi_v<float>);
  part.symmetry_discrete = {half};
  CutOut cut{"frame", Vector3(1.0F, 0.4F, 0.8F).normalized(), {}};
  for (const OrientedPoint& p : sample_surface(part.mesh, {}, 3000)) {
    if (p.normal.dot(cut.direction) > 0.2F) cut.points.push_back(p);
  }
  CutOut twin{"frame", half.rotation * cut.direction, {}};
  for (const OrientedPoint& p : cut.points) twin.points.push_back(half * p);
  BankBuildParameters parameters;
  parameters.surface_points = 500;
  BankReport report;
  ASSERT_TRUE(learn_bank(part, {cut, twin}, false, parameters, report, [](float) {}).ok());
  EXPECT_EQ(report.views_cut_out, 2);
  EXPECT_EQ(report.views_kept, 1);
  EXPECT_EQ(report.views_merged, 1);
}

}  // namespace
}  // namespace graspd
