#include <gtest/gtest.h>

#include <array>

#include "core/train/corner_normals.hpp"
#include "core/train/generalisation.hpp"
#include "core/train/part_mesh.hpp"
#include "core/train/self_visibility.hpp"
#include "core/train/surface_index.hpp"
#include "core/train/surface_sampling.hpp"
#include "core/train/view_refinement.hpp"
#include "core/train/view_sphere.hpp"
#include "tests/core/train/shapes.hpp"

namespace graspd {
namespace {

constexpr float cut_off = 1.31F;

/// A part with everything that the choice of views needs.
struct Studio {
  Mesh mesh;
  float diameter;
  CandidateViews candidates;

  Studio(const Mesh& shape, float size, std::vector<Vector3> from, const SymmetryGroup& symmetry = {})
      : mesh(shape),
        diameter(size),
        candidates(rendered_candidates(sample_surface(mesh, smooth_corner_normals(mesh, 0.52F), 6000), std::move(from),
                                       mesh.view(), conditions(), symmetry)) {}

  [[nodiscard]] ViewingConditions conditions() const { return {Vector3::Zero(), diameter, 0.75F, cut_off}; }
  [[nodiscard]] const std::vector<OrientedPoint>& samples() const { return candidates.samples; }
  [[nodiscard]] const Visibility& visibility() const { return candidates.visibility; }

  [[nodiscard]] std::vector<RefinedView> refined(const SymmetryGroup& symmetry, const BankBuildParameters& parameters,
                                                 BankReport& report) const {
    return refine_views(candidates, symmetry, {}, diameter, parameters, report);
  }
};

TEST(ViewSphere, DirectionsAreUnitAndEven) {
  const auto directions = view_sphere(162);
  ASSERT_EQ(directions.size(), 162U);
  Vector3 sum = Vector3::Zero();
  for (const Vector3& a : directions) {
    EXPECT_NEAR(a.norm(), 1.0F, 1e-6F);
    sum += a;
    float nearest = -1.0F;
    for (const Vector3& b : directions) {
      if (&a != &b) nearest = std::max(nearest, a.dot(b));
    }
    // Even discs would stand about 0.3 radians apart.
    EXPECT_GT(std::acos(nearest), 0.2F);
    EXPECT_LT(std::acos(nearest), 0.4F);
  }
  EXPECT_LT(sum.norm(), 0.5F);
}

TEST(SelfVisibility, PlatesHideEachOtherHoweverFarFromTheMiddle) {
  // Pairs of plates at the corners of a triangle: further from the middle of the box than half the diameter.
  Mesh mesh;
  std::vector<OrientedPoint> under;
  for (const Vector3& place : {Vector3(0.06F, 0, 0), Vector3(-0.03F, 0.052F, 0), Vector3(-0.03F, -0.052F, 0)}) {
    for (const float z : {0.0F, 0.004F}) {
      const RigidTransform there{Matrix3::Identity(), place + Vector3(0, 0, z)};
      mesh = shapes::joined(mesh, shapes::moved(shapes::box(0.010F, 0.010F, 0.001F), there));
    }
    under.push_back({place + Vector3(0, 0, 0.0005F), Vector3::UnitZ()});
  }
  const PartMesh part = prepare_mesh(mesh).value();
  const Vector3 middle = 0.5F * (part.box_min + part.box_max);
  // From nearly above, with the image turned in every way.
  std::vector<Vector3> above;
  for (int i = 0; i < 36; ++i) {
    const float turn = 0.1745F * static_cast<float>(i);
    above.push_back(Vector3(0.14F * std::cos(turn), 0.14F * std::sin(turn), 1.0F).normalized());
  }
  const Visibility visibility =
      find_visibility(part.mesh.view(), under, above, {middle, part.diameter, 0.75F, cut_off});
  for (std::size_t d = 0; d < above.size(); ++d) {
    for (std::size_t i = 0; i < under.size(); ++i) {
      EXPECT_TRUE(visibility.facing.at(d, i));
      EXPECT_FALSE(visibility.seen.at(d, i)) << under[i].position.transpose() << " from " << above[d].transpose();
    }
  }
}

TEST(SelfVisibility, ABoxShowsTheThreeFacesOfACorner) {
  const Studio studio(shapes::box(0.06F, 0.05F, 0.04F), 0.088F, {Vector3(1, 1, 1).normalized(), Vector3::UnitZ()});
  for (std::size_t i = 0; i < studio.samples().size(); ++i) {
    const Vector3& normal = studio.samples()[i].normal;
    EXPECT_EQ(studio.visibility().seen.at(0, i), normal.sum() > 0.0F) << normal.transpose();
    EXPECT_EQ(studio.visibility().seen.at(1, i), normal.z() > 0.5F) << normal.transpose();
    EXPECT_EQ(studio.visibility().facing.at(1, i), normal.z() > 0.5F);
  }
}

TEST(SelfVisibility, OneLegOfABracketHidesTheOther) {
  // Seen along +x the short leg stands in front of the inside of nothing, but along (1, 0.3) from the
  // outer corner the long leg's inner face lies behind the short leg.
  const Studio studio(shapes::moved(shapes::bracket(), {Matrix3::Identity(), Vector3(-0.04F, -0.025F, 0)}), 0.1F,
                      {Vector3(-1.0F, 0.35F, 0).normalized(), Vector3(1.0F, 1.0F, 0).normalized()});
  std::size_t hidden = 0;
  std::size_t open = 0;
  for (std::size_t i = 0; i < studio.samples().size(); ++i) {
    const OrientedPoint& p = studio.samples()[i];
    const bool inner_face = p.normal.y() > 0.9F && p.position.y() < 0.0F && p.position.x() > -0.027F;
    if (!inner_face) continue;
    if (p.position.x() < 0.02F && p.position.x() > -0.02F) {
      hidden += studio.visibility().facing.at(0, i) && !studio.visibility().seen.at(0, i) ? 1 : 0;
      open += studio.visibility().seen.at(1, i) ? 1 : 0;
    }
  }
  EXPECT_GT(hidden, 300U);
  EXPECT_EQ(hidden, open);
}

TEST(SelfVisibility, GrazingSurfacesAreNotSeen) {
  const float tilt = 1.4F;  // More than the cut-off of 1.31 radians, less than a right angle.
  const Studio studio(shapes::box(0.05F, 0.05F, 0.05F), 0.088F, {Vector3(std::sin(tilt), 0, std::cos(tilt))});
  for (std::size_t i = 0; i < studio.samples().size(); ++i) {
    EXPECT_FALSE(studio.samples()[i].normal.z() > 0.5F && studio.visibility().seen.at(0, i));
  }
}

TEST(ViewRefinement, ACylinderSeenEndOnCannotFixThePose) {
  const SymmetryGroup symmetry = close_group({}, true, {Vector3::UnitZ(), Vector3::Zero()}, 0.05F);
  const Studio studio(shapes::cylinder(0.01F, 0.05F), 0.054F,
                      {Vector3::UnitZ(), Vector3::UnitX(), Vector3(1, 0, 1).normalized()});
  const auto conditioning = [&](std::size_t direction) {
    return pose_conditioning(studio.samples(), studio.visibility().seen.row(direction), symmetry, 0.027F);
  };
  EXPECT_LT(conditioning(0), 1e-4F);
  EXPECT_LT(conditioning(1), 1e-4F);  // Side on, it may slide along its axis.
  EXPECT_GT(conditioning(2), 0.01F);
  // Without the symmetry the turn about the axis is free from everywhere.
  EXPECT_LT(pose_conditioning(studio.samples(), studio.visibility().seen.row(2), {}, 0.027F), 1e-3F);
}

TEST(ViewRefinement, DegenerateViewsOfACylinderAreDroppedAndOneViewServesAllTurns) {
  const RigidTransform flip = turn_about({Vector3::UnitX(), Vector3::Zero()}, std::numbers::pi_v<float>);
  const SymmetryGroup symmetry = close_group(std::span(&flip, 1), true, {Vector3::UnitZ(), Vector3::Zero()}, 0.05F);
  const Studio studio(shapes::cylinder(0.012F, 0.03F), 0.0384F, view_sphere(162), symmetry);
  BankReport report;
  BankBuildParameters parameters;
  parameters.minimum_completeness = 0.1F;
  const auto kept = studio.refined(symmetry, parameters, report);
  EXPECT_EQ(report.views_rendered, 162);
  EXPECT_GT(report.views_degenerate, 8);
  EXPECT_EQ(report.views_kept, static_cast<int>(kept.size()));
  EXPECT_EQ(kept.size(), 1U);
  EXPECT_LT(std::abs(studio.candidates.directions[kept[0].candidate].z()), 0.95F);
  EXPECT_EQ(report.views_incomplete + report.views_degenerate + report.views_merged + report.views_kept, 162);
}

TEST(ViewRefinement, EverySideOfABracketIsCoveredByAKeptView) {
  const Studio studio(shapes::moved(shapes::bracket(), {Matrix3::Identity(), Vector3(-0.04F, -0.025F, 0)}), 0.1F,
                      view_sphere(162));
  BankReport report;
  const auto kept = studio.refined({}, {}, report);
  EXPECT_GE(kept.size(), 4U);
  for (std::size_t i = 0; i < studio.samples().size(); i += 7) {
    const bool covered = std::any_of(kept.begin(), kept.end(), [&](const RefinedView& view) {
      return std::any_of(view.fused.begin(), view.fused.end(),
                         [&](std::size_t fused) { return studio.visibility().seen.at(fused, i); });
    });
    EXPECT_TRUE(covered) << studio.samples()[i].position.transpose() << " / " << studio.samples()[i].normal.transpose();
  }
}

TEST(ViewRefinement, ADegenerateViewIsKeptForASideThatNoOtherShows) {
  const Studio studio(shapes::box(0.05F, 0.05F, 0.05F), 0.0866F,
                      {Vector3(1, 1, 1).normalized(), Vector3(-Vector3::UnitZ()), Vector3::UnitZ()});
  BankReport report;
  BankBuildParameters parameters;
  parameters.minimum_completeness = 0.1F;
  const auto kept = studio.refined({}, parameters, report);
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_EQ(kept[0].candidate, 0U);
  EXPECT_EQ(kept[1].candidate, 1U);
  EXPECT_EQ(report.candidates[1].fate, CandidateFate::kept);
  EXPECT_EQ(report.candidates[2].fate, CandidateFate::degenerate);
  EXPECT_EQ(report.views_degenerate, 1);
}

TEST(ViewRefinement, TheHeaviestOfAlikeViewsIsKeptFirst) {
  const std::vector<Vector3> corners{Vector3(1, 1, 1).normalized(), Vector3(-1, -1, -1).normalized(),
                                     Vector3(1, -1, 1).normalized()};
  const Studio studio(shapes::box(0.05F, 0.05F, 0.05F), 0.0866F, corners);
  for (std::size_t heaviest = 0; heaviest < corners.size(); ++heaviest) {
    std::vector<float> weights(corners.size(), 0.4F);
    weights[heaviest] = 1.0F;
    BankReport report;
    const auto kept = refine_views(studio.candidates, {}, weights, studio.diameter, {}, report);
    ASSERT_FALSE(kept.empty());
    EXPECT_EQ(kept[0].candidate, heaviest);
  }
}

TEST(ViewRefinement, EveryCandidateHasAFate) {
  const Studio studio(shapes::bracket(), 0.1F, view_sphere(60));
  BankReport report;
  const auto kept = studio.refined({}, {}, report);
  ASSERT_EQ(report.candidates.size(), 60U);
  std::array<int, 6> fates{};
  for (const CandidateReport& candidate : report.candidates) ++fates[static_cast<std::size_t>(candidate.fate)];
  EXPECT_EQ(fates[static_cast<std::size_t>(CandidateFate::kept)], static_cast<int>(kept.size()));
  const int fused = fates[static_cast<std::size_t>(CandidateFate::fused)];
  EXPECT_EQ(fused, report.views_fused);
  EXPECT_GT(fused, 0);
  EXPECT_EQ(fates[static_cast<std::size_t>(CandidateFate::merged)] + fused, report.views_merged);
  for (const CandidateReport& candidate : report.candidates) {
    if (candidate.fate == CandidateFate::fused) {
      EXPECT_LT(candidate.view, kept.size());
    }
  }
  EXPECT_EQ(fates[static_cast<std::size_t>(CandidateFate::incomplete)], report.views_incomplete);
  EXPECT_EQ(fates[static_cast<std::size_t>(CandidateFate::degenerate)], report.views_degenerate);
}

TEST(ViewRefinement, SwitchedOffKeepsSpreadCandidatesAsTheyAre) {
  const Studio studio(shapes::bracket(), 0.1F, view_sphere(162));
  BankReport report;
  BankBuildParameters parameters;
  parameters.refinement = false;
  parameters.maximum_views = 6;
  const auto kept = studio.refined({}, parameters, report);
  ASSERT_EQ(kept.size(), 6U);
  for (const RefinedView& a : kept) {
    for (const RefinedView& b : kept) {
      if (&a == &b) continue;
      // Six even directions stand a right angle apart.
      EXPECT_LT(studio.candidates.directions[a.candidate].dot(studio.candidates.directions[b.candidate]), 0.6F);
    }
  }
}

TEST(Generalisation, FusionUnitesAndSmoothingKeepsToOneView) {
  // From either side a sensor sees a little more of the round.
  const Studio studio(shapes::cylinder(0.012F, 0.03F), 0.0384F, view_sphere(162));
  BankReport report;
  const auto kept = studio.refined({}, {}, report);
  const SurfaceIndex samples(studio.samples(), 0.002F);
  const auto points = [&](const RefinedView& view, Generalisation method) {
    return generalise_view(view, studio.candidates, samples, {}, {method, 0.002F, Vector3::Zero()}).references.size();
  };
  ASSERT_GT(kept[0].fused.size(), 1U);
  const RefinedView alone{kept[0].candidate, {kept[0].candidate}, kept[0].completeness};
  const std::size_t single = points(alone, Generalisation::none);
  EXPECT_GT(points(kept[0], Generalisation::fuse), single + 10);
  EXPECT_NEAR(static_cast<double>(points(alone, Generalisation::smooth)), static_cast<double>(single), 10.0);
}

TEST(Generalisation, ReferencesOfASymmetricPartLieInOneSlice) {
  const SymmetryGroup symmetry = close_group({}, true, {Vector3::UnitZ(), Vector3::Zero()}, 0.05F);
  const Studio studio(shapes::cylinder(0.012F, 0.03F), 0.0384F, view_sphere(162), symmetry);
  BankReport report;
  BankBuildParameters parameters;
  parameters.minimum_completeness = 0.1F;
  const auto kept = studio.refined(symmetry, parameters, report);
  const SurfaceIndex samples(studio.samples(), 0.002F);
  const GeneralisedView view =
      generalise_view(kept[0], studio.candidates, samples, symmetry, {Generalisation::fuse, 0.002F, Vector3::Zero()});
  EXPECT_LT(view.references.size() * 5, view.partners.size());
  const Vector3 first = view.references[0].point.position;
  for (const ViewPoint& r : view.references) {
    const Vector3 arm(r.point.position.x(), r.point.position.y(), 0);
    if (arm.norm() < 0.002F) continue;
    EXPECT_GT(arm.normalized().dot(Vector3(first.x(), first.y(), 0).normalized()), 0.95F);
  }
}

TEST(DirectionOrbits, HoldWhereTheSymmetryCarriesADirection) {
  const RigidTransform half = turn_about({Vector3::UnitZ(), Vector3::Zero()}, std::numbers::pi_v<float>);
  const SymmetryGroup symmetry = close_group(std::span(&half, 1), false, {}, 1.0F);
  const std::vector<Vector3> directions{Vector3::UnitX(), -Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()};
  const auto orbits = direction_orbits(directions, symmetry);
  EXPECT_EQ(orbits[0], (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(orbits[1], (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(orbits[3], (std::vector<std::size_t>{3}));
}

}  // namespace
}  // namespace graspd
