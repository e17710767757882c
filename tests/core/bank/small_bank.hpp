#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <vector>

#include "core/bank/bank_format.hpp"
#include "core/bank/bank_writer.hpp"

namespace graspd {

/// A bank small enough to damage in every place: two views of a tetrahedron, made by hand.
struct SmallBank {
  BankPart part;
  PpfGrid grid{0.01F, 2, 2};
  std::array<BankView, 2> views;
  std::array<OrientedPoint, 5> view_points;
  std::array<std::uint32_t, 17> cell_offsets{};
  std::array<PpfEntry, 4> entries{PpfEntry::pack(0, 10), PpfEntry::pack(1, 3), PpfEntry::pack(2, 255),
                                  PpfEntry::pack(0, 0)};
  std::array<std::uint32_t, 3> reference_points{0, 1, 3};
  std::array<std::uint32_t, 3> reference_views{0, 0, 1};
  std::array<SurfacePoint, 70> surface;
  std::array<EdgePoint, 2> edges;
  std::array<Vector3, 2> directions{Vector3::UnitZ(), Vector3::UnitX()};
  std::array<std::uint64_t, 4> bits{3, 4, 1, 2};
  std::array<Vector3, 4> vertices{Vector3::Zero(), Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()};
  std::array<Triangle, 4> triangles{Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{0, 3, 2}, Triangle{1, 2, 3}};
  std::array<RigidTransform, 2> symmetries;
  std::array<RigidTransform, 1> twins;
  std::array<PartGrasp, 1> grasps;

  SmallBank() {
    std::memcpy(part.name.data(), "tetrahedron", 11);
    part.part_id = 7;
    part.diameter = 1.5F;
    part.sampling = 0.05F;
    part.detail = 0.03F;
    part.box_max = Vector3::Ones();
    views[0].point_count = 3;
    views[0].reference_count = 2;
    views[1].first_point = 3;
    views[1].point_count = 2;
    views[1].first_reference = 2;
    views[1].reference_count = 1;
    for (std::size_t i = 6; i < cell_offsets.size(); ++i) cell_offsets[i] = i < 9 ? 3 : 4;
    symmetries[1].rotation = Eigen::AngleAxisf(3.1415926F, Vector3::UnitZ()).toRotationMatrix();
  }

  [[nodiscard]] Bank view() const {
    Bank bank;
    bank.part = &part;
    bank.grid = grid;
    bank.views = views;
    bank.view_points = view_points;
    bank.cell_offsets = cell_offsets;
    bank.entries = entries;
    bank.reference_points = reference_points;
    bank.reference_views = reference_views;
    bank.surface = surface;
    bank.edges = edges;
    bank.visibility = {directions, bits, 2};
    bank.mesh = {vertices, triangles};
    bank.symmetry_discrete = symmetries;
    bank.twins = twins;
    bank.grasps = grasps;
    return bank;
  }
  [[nodiscard]] std::vector<std::byte> file() const { return write_bank(view()); }
};

/// Puts the right checksum into a file that a test has changed on purpose.
inline void seal(std::vector<std::byte>& file) {
  const std::uint64_t checksum = bank_checksum(file);
  std::memcpy(file.data() + offsetof(BankHeader, checksum), &checksum, sizeof(checksum));
}

}  // namespace graspd
