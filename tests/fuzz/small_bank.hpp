#pragma once

#include <vector>

#include "core/bank/bank.hpp"
#include "core/bank/bank_check.hpp"
#include "core/bank/bank_writer.hpp"

namespace graspd {

/// The file of a bank that is whole in every respect and as small as one can be: a block of 40 x 30 x 20 mm with one
/// view of eight points. Small, so that damage hits every kind of field often.
inline std::vector<std::byte> small_bank_file() {
  BankPart part;
  part.name = {'b', 'l', 'o', 'c', 'k'};
  part.part_id = 7;
  part.diameter = 0.054F;
  part.box_min = Vector3(-0.020F, -0.015F, -0.010F);
  part.box_max = -part.box_min;
  part.sampling = 0.005F;
  part.detail = 0.003F;

  const std::vector<Vector3> corners{{-0.02F, -0.015F, -0.01F}, {0.02F, -0.015F, -0.01F}, {0.02F, 0.015F, -0.01F},
                                     {-0.02F, 0.015F, -0.01F},  {-0.02F, -0.015F, 0.01F}, {0.02F, -0.015F, 0.01F},
                                     {0.02F, 0.015F, 0.01F},    {-0.02F, 0.015F, 0.01F}};
  const std::vector<Triangle> faces{{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                    {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  std::vector<OrientedPoint> points;
  std::vector<EdgePoint> edges;
  for (const Vector3& corner : corners) {
    points.push_back({corner, corner.normalized()});
    edges.push_back({corner, Vector3::UnitX()});
  }
  std::vector<SurfacePoint> surface;
  for (int i = 0; i < 70; ++i) {
    const float x = 0.0005F * static_cast<float>(i % 35) - 0.0085F;
    const float side = i < 35 ? 1.0F : -1.0F;
    surface.push_back({Vector3(x, 0.0F, 0.01F * side), Vector3(0.0F, 0.0F, side)});
  }
  const std::vector<Vector3> directions{Vector3::UnitZ(), Vector3::UnitX(), -Vector3::UnitZ()};
  std::vector<std::uint64_t> bits(directions.size() * visibility_words(surface.size()), 0x1FU);

  BankView view;
  view.point_count = 8;
  view.reference_count = 4;
  view.completeness = 0.9F;
  const std::vector<BankView> views{view};
  const std::vector<std::uint32_t> reference_points{0, 1, 2, 3};
  const std::vector<std::uint32_t> reference_views(4, 0);
  const PpfGrid grid{0.010F, 6, 3};
  std::vector<std::uint32_t> offsets(grid.cell_count() + 1);
  std::vector<PpfEntry> entries;
  for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell) {
    offsets[cell] = static_cast<std::uint32_t>(entries.size());
    if (cell % 3 == 0) entries.push_back(PpfEntry::pack(cell % 4, cell % 256));
  }
  offsets.back() = static_cast<std::uint32_t>(entries.size());

  RigidTransform half_turn;
  half_turn.rotation = Vector3(-1.0F, -1.0F, 1.0F).asDiagonal();
  const std::vector<RigidTransform> symmetry{RigidTransform{}, half_turn};
  RigidTransform from_above;
  from_above.rotation = Vector3(1.0F, -1.0F, -1.0F).asDiagonal();
  const std::vector<PartGrasp> grasps{{from_above, 0.036F, 1, 1, GraspKind::parallel, 0.032F, 0.030F, 0},
                                      {from_above, 0.0F, 0, 2, GraspKind::suction, 0.0F, 0.0F, 2}};

  Bank bank;
  bank.part = &part;
  bank.grid = grid;
  bank.views = views;
  bank.view_points = points;
  bank.cell_offsets = offsets;
  bank.entries = entries;
  bank.reference_points = reference_points;
  bank.reference_views = reference_views;
  bank.surface = surface;
  bank.edges = edges;
  bank.visibility = {directions, bits, static_cast<std::uint32_t>(visibility_words(surface.size()))};
  bank.mesh = {corners, faces};
  bank.symmetry_discrete = symmetry;
  bank.grasps = grasps;
  return write_bank(bank);
}

}  // namespace graspd
