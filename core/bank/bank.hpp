#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/bank/part_grasp.hpp"
#include "core/bank/ppf.hpp"
#include "core/geometry/mesh.hpp"
#include "core/geometry/oriented_point.hpp"
#include "core/geometry/symmetry.hpp"
#include "core/status.hpp"

namespace graspd {

/// The thresholds of the four tests (paper 2.4.2 and 3.2), as the bank carries them for its part.
struct VerifyThresholds {
  float minimum_edge = 0.5F;     ///< Edge consistency on a flat surface must be greater; on a shaped one less will do.
  float minimum_overlap = 0.1F;  ///< Share of the model's visible surface that the scene confirms.
  float maximum_boundary = 0.15F;  ///< Share of the model's points that stand where the scene shows free space.
  float maximum_below = 0.05F;     ///< Share of the model's points below the plane or inside other instances.
  float minimum_score = 0.4F;      ///< Default acceptance threshold on the final score.
};

/// What the bank found of its part in simulated bins, where the truth is known.
struct BankExpectation {
  float recall_above_half = 0;  ///< Share found of the instances of which more than half could be seen,
  float recall_below_half = 0;  ///< and of those from 0.3 to 0.5.
  float precision = 0;          ///< Share of all reported instances that were right.
  std::uint32_t instances = 0;  ///< On which the recalls were measured; 0: nothing was measured.
};

/// What a part may measure across (metres): beyond that its unit was mistaken.
inline constexpr float least_diameter = 1e-4F;
inline constexpr float greatest_diameter = 1e3F;
/// How far the middle of a part may lie from its origin along an axis of coordinates (metres).
inline constexpr float furthest_centre = 1e4F;

/// What a bank says of its part. Lengths in metres, part frame.
struct BankPart {
  std::array<char, 64> name{};       ///< Zero-terminated.
  std::uint32_t part_id = 0;         ///< The number the PLC knows, or the BOP object id.
  float diameter = 0;                ///< Largest distance between two surface points.
  Vector3 centre = Vector3::Zero();  ///< Stands for its place: the middle of the box, but where symmetries leave it.
  Vector3 box_min = Vector3::Zero();
  Vector3 box_max = Vector3::Zero();
  float sampling = 0;  ///< Voxel edge of the view points: scene sampling follows it.
  float detail = 0;    ///< Length (metres) that counts when poses are refined and judged; at most `sampling`.
  std::uint32_t symmetry_continuous = 0;
  SymmetryAxis symmetry_axis;
  VerifyThresholds thresholds;
  std::uint32_t edges_refine = 1;  ///< 1: the outline draws the pose in refinement, 0: surfaces alone do.
  std::uint32_t edges_judge = 1;   ///< 1: the outline is evidence in verification, 0: it says nothing.
  BankExpectation expected;

  [[nodiscard]] std::string_view name_view() const { return {name.data()}; }
};

/// A view: what the sensor sees of the part from one side (paper 2.1).
struct BankView {
  Vector3 direction = Vector3::UnitZ();  ///< From the part towards the sensor, unit length, part frame.
  std::uint32_t first_point = 0;         ///< Into Bank::view_points.
  std::uint32_t point_count = 0;
  std::uint32_t reference_count = 0;  ///< The first points of a view are its voting references.
  std::uint32_t first_reference = 0;  ///< Index of the first of them among the references of all views.
  float completeness = 0;             ///< Share of the surface on that side which the view holds.
};

/// A point of the dense surface, for refinement and verification.
struct SurfacePoint {
  Vector3 position = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();
};

/// A point on a crease or rim of the part where depth or normal step, with the direction along it.
struct EdgePoint {
  Vector3 position = Vector3::Zero();
  Vector3 tangent = Vector3::UnitX();
};

/// Which surface points can be seen from each of many directions, as one row of bits a direction:
/// self-occlusion at the price of a look-up.
struct VisibilityTable {
  std::span<const Vector3> directions;  ///< From the part towards the sensor, unit length; z never rises.
  std::span<const std::uint64_t> bits;  ///< directions.size() rows of words_per_row words.
  std::uint32_t words_per_row = 0;

  /// The row of the direction nearest to `towards_sensor` (part frame, any length).
  [[nodiscard]] std::span<const std::uint64_t> row(const Vector3& towards_sensor) const;
};

/// A bank as the pipeline reads it: spans into the bytes of its file.
struct Bank {
  const BankPart* part = nullptr;
  PpfGrid grid;
  std::span<const BankView> views;
  std::span<const OrientedPoint> view_points;       ///< The points of all views, view after view.
  std::span<const std::uint32_t> cell_offsets;      ///< grid.cell_count() + 1 offsets into entries.
  std::span<const PpfEntry> entries;                ///< Sorted by cell, then by reference, then by alpha.
  std::span<const std::uint32_t> reference_points;  ///< For each reference, its index in view_points.
  std::span<const std::uint32_t> reference_views;   ///< For each reference, its view.
  std::span<const SurfacePoint> surface;            ///< In an order such that every prefix covers the part evenly.
  std::span<const EdgePoint> edges;
  VisibilityTable visibility;  ///< Over `surface`.
  MeshView mesh;               ///< Simplified: for rendering, not for looks.
  std::span<const RigidTransform> symmetry_discrete;
  std::span<const RigidTransform> twins;  ///< Poses (part_from_part) in which the part nearly looks the same.
  std::span<const PartGrasp> grasps;

  [[nodiscard]] Symmetry symmetry() const {
    return {symmetry_discrete, part->symmetry_continuous != 0, part->symmetry_axis};
  }
};

/// Reads a bank in place: checks the header, sizes, offsets, indices and checksum of `bytes` (8-byte
/// aligned, which must outlive the Bank) and points into them. Fails with bad_bank and the first
/// thing that is wrong; `name` stands in the message.
[[nodiscard]] Result<Bank> read_bank(std::span<const std::byte> bytes, std::string_view name);

}  // namespace graspd
