#include "core/bank/bank_check.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace graspd {

namespace {

bool is_unit(const Vector3& v) { return std::abs(v.squaredNorm() - 1.0F) < 1e-3F; }

bool is_rigid(const RigidTransform& t) {
  const float drift = (t.rotation * t.rotation.transpose() - Matrix3::Identity()).cwiseAbs().maxCoeff();
  return t.translation.allFinite() && drift < 1e-3F && t.rotation.determinant() > 0.0F;
}

bool is_identity(const RigidTransform& t) { return t.translation.isZero(1e-6F) && t.rotation.isIdentity(1e-5F); }

bool is_within(float value, float low, float high) { return value >= low && value <= high; }

/// Whether a point may belong to the part at all; numbers beyond would overflow on their way to a cell or pixel.
bool is_near(const BankPart& part, const Vector3& point) {
  return (point - part.centre).squaredNorm() <= 4.0F * part.diameter * part.diameter;
}

/// Whether a transform leaves the part where it is.
bool keeps_place(const BankPart& part, const RigidTransform& part_from_part) {
  return is_rigid(part_from_part) && is_near(part, part_from_part * part.centre);
}

const char* part_fault(const BankPart& part) {
  if (std::find(part.name.begin(), part.name.end(), '\0') == part.name.end()) return "the part's name has no end";
  const bool lengths = std::isfinite(part.diameter) && part.diameter > 0.0F && std::isfinite(part.sampling) &&
                       part.sampling > 0.0F && part.centre.allFinite() && part.box_min.allFinite() &&
                       part.box_max.allFinite() && (part.box_min.array() <= part.box_max.array()).all();
  if (!lengths) return "the part's measures are not numbers or not positive";
  if (!is_within(part.diameter, least_diameter, greatest_diameter)) return "the part is impossibly small or large";
  if (!is_within(part.sampling / part.diameter, 1e-4F, 1.0F)) {
    return "the part's diameter and sampling contradict each other";
  }
  if (!is_within(part.detail, 0.1F * part.sampling, part.sampling)) {
    return "the part's sampling and detail contradict each other";
  }
  if (!is_within(part.centre.cwiseAbs().maxCoeff(), 0.0F, furthest_centre))
    return "the part lies too far from its origin";
  if (part.symmetry_continuous > 1 || !part.symmetry_axis.point.allFinite() || !is_unit(part.symmetry_axis.direction)) {
    return "the part's symmetry axis is not a line";
  }
  const VerifyThresholds& t = part.thresholds;
  for (const float threshold :
       {t.minimum_edge, t.minimum_overlap, t.maximum_boundary, t.maximum_below, t.minimum_score}) {
    if (!is_within(threshold, 0.0F, 1.0F)) return "a threshold lies outside 0 to 1";
  }
  if (part.edges_refine > 1 || part.edges_judge > 1) return "it does not say whether its edges are used";
  const BankExpectation& e = part.expected;
  for (const float share : {e.recall_above_half, e.recall_below_half, e.precision}) {
    if (!is_within(share, 0.0F, 1.0F)) return "an expected recall or precision lies outside 0 to 1";
  }
  return nullptr;
}

const char* grid_fault(const Bank& bank) {
  constexpr std::uint64_t maximum_cells = 1U << 26U;
  const PpfGrid& grid = bank.grid;
  if (!(std::isfinite(grid.distance_step) && grid.distance_step > 0.0F)) return "the grid has no distance step";
  const std::uint64_t angles = grid.angle_bins;
  if (grid.distance_bins == 0 || angles == 0 || angles > 180 ||
      grid.distance_bins > maximum_cells / (angles * angles * angles)) {
    return "the grid has an impossible number of cells";
  }
  const float reach = grid.distance_step * static_cast<float>(grid.distance_bins);
  if (!is_within(reach / bank.part->diameter, 1e-3F, 1e3F)) return "the grid's reach does not suit the part's diameter";
  if (bank.cell_offsets.size() != std::size_t{grid.cell_count()} + 1) return "the table does not fit its grid";
  if (bank.cell_offsets.front() != 0 || bank.cell_offsets.back() != bank.entries.size() ||
      !std::is_sorted(bank.cell_offsets.begin(), bank.cell_offsets.end())) {
    return "the table's offsets are out of order";
  }
  return nullptr;
}

const char* view_fault(const Bank& bank) {
  if (bank.views.empty()) return "it holds no views";
  const std::size_t references = bank.reference_points.size();
  if (references != bank.reference_views.size() || references > PpfEntry::maximum_references) {
    return "the references do not fit the views";
  }
  std::uint64_t next_point = 0;
  std::uint64_t next_reference = 0;
  for (std::size_t v = 0; v < bank.views.size(); ++v) {
    const BankView& view = bank.views[v];
    if (view.first_point != next_point || view.first_reference != next_reference ||
        view.reference_count > view.point_count || !is_unit(view.direction) || !std::isfinite(view.completeness)) {
      return "a view does not follow the one before";
    }
    next_point += view.point_count;
    next_reference += view.reference_count;
    if (next_point > bank.view_points.size() || next_reference > references) return "a view reaches beyond its points";
    for (std::uint32_t r = 0; r < view.reference_count; ++r) {
      const std::size_t reference = std::size_t{view.first_reference} + r;
      if (bank.reference_points[reference] != view.first_point + r || bank.reference_views[reference] != v) {
        return "a reference names another point or view";
      }
    }
  }
  if (next_point != bank.view_points.size() || next_reference != references) return "points belong to no view";
  return nullptr;
}

const char* entry_fault(const Bank& bank) {
  const std::size_t references = bank.reference_points.size();
  for (std::size_t cell = 0; cell + 1 < bank.cell_offsets.size(); ++cell) {
    std::uint32_t previous = 0;
    for (std::uint32_t i = bank.cell_offsets[cell]; i < bank.cell_offsets[cell + 1]; ++i) {
      const PpfEntry entry = bank.entries[i];
      if (entry.reference() >= references) return "an entry names a reference that is not there";
      if (entry.packed < previous) return "the entries of a cell are out of order";
      previous = entry.packed;
    }
  }
  return nullptr;
}

template <class Points>
bool all_oriented(const BankPart& part, const Points& points) {
  return std::all_of(points.begin(), points.end(),
                     [&](const auto& p) { return is_near(part, p.position) && is_unit(p.normal); });
}

const char* surface_fault(const Bank& bank) {
  if (!all_oriented(*bank.part, bank.view_points)) return "a view point is not a point with a unit normal";
  if (bank.surface.empty() || !all_oriented(*bank.part, bank.surface))
    return "the surface is not one of points with unit normals";
  for (const EdgePoint& edge : bank.edges) {
    if (!is_near(*bank.part, edge.position) || !is_unit(edge.tangent))
      return "an edge point is not a point with a direction";
  }
  const VisibilityTable& table = bank.visibility;
  if (table.directions.empty() || table.bits.size() / table.words_per_row != table.directions.size() ||
      table.bits.size() % table.words_per_row != 0) {
    return "the visibility table does not fit the surface";
  }
  if (!std::all_of(table.directions.begin(), table.directions.end(), is_unit)) {
    return "a direction of the visibility table is not of unit length";
  }
  if (!std::is_sorted(table.directions.begin(), table.directions.end(),
                      [](const Vector3& a, const Vector3& b) { return a.z() > b.z(); })) {
    return "the directions of the visibility table are out of order";
  }
  const std::size_t used = bank.surface.size() % 64;
  if (used != 0) {
    for (std::size_t last = table.words_per_row - 1U; last < table.bits.size(); last += table.words_per_row) {
      if (table.bits[last] >> used != 0) return "the visibility table names points that are not there";
    }
  }
  return nullptr;
}

const char* shape_fault(const Bank& bank) {
  const auto& mesh = bank.mesh;
  if (mesh.triangles.empty()) return "its mesh has no faces";
  for (const Vector3& vertex : mesh.vertices) {
    if (!is_near(*bank.part, vertex)) return "a vertex of its mesh is not near the part";
  }
  for (const Triangle& triangle : mesh.triangles) {
    if (*std::max_element(triangle.begin(), triangle.end()) >= mesh.vertices.size()) {
      return "a face of its mesh names a vertex that is not there";
    }
  }
  if (bank.symmetry_discrete.empty() || !is_identity(bank.symmetry_discrete.front())) {
    return "its symmetries do not begin with the identity";
  }
  if (bank.symmetry_discrete.size() > most_symmetries) return "it has more symmetries than any part";
  const auto all_keep_place = [&](std::span<const RigidTransform> poses) {
    return std::all_of(poses.begin(), poses.end(), [&](const RigidTransform& t) { return keeps_place(*bank.part, t); });
  };
  if (!all_keep_place(bank.symmetry_discrete)) return "a symmetry is not a rigid transform";
  if (!all_keep_place(bank.twins)) return "a twin is not a rigid transform";
  for (const PartGrasp& grasp : bank.grasps) {
    if (!is_rigid(grasp.part_from_tool)) return "a grasp is not a rigid transform";
    const auto kind = static_cast<std::uint32_t>(grasp.kind);
    if (kind < static_cast<std::uint32_t>(GraspKind::parallel) ||
        kind > static_cast<std::uint32_t>(GraspKind::magnetic) || !std::isfinite(grasp.opening) ||
        !std::isfinite(grasp.least_opening) || !std::isfinite(grasp.held_width)) {
      return "a grasp is of no known kind or has an impossible width";
    }
  }
  return nullptr;
}

}  // namespace

const char* find_bank_fault(const Bank& bank) {
  if (const char* fault = part_fault(*bank.part); fault != nullptr) return fault;
  if (const char* fault = grid_fault(bank); fault != nullptr) return fault;
  if (const char* fault = view_fault(bank); fault != nullptr) return fault;
  if (const char* fault = entry_fault(bank); fault != nullptr) return fault;
  if (const char* fault = surface_fault(bank); fault != nullptr) return fault;
  return shape_fault(bank);
}

}  // namespace graspd
