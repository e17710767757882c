#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/bank/bank.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/mesh.hpp"
#include "core/status.hpp"

namespace graspd {

/// A part as its file describes it, in metres and radians.
struct PartDescription {
  std::string name;
  std::uint32_t part_id = 0;
  Mesh mesh;                                      ///< As read; may hold doubled vertices and open edges.
  bool symmetry_given = false;                    ///< False: the builder looks for symmetries itself.
  std::vector<RigidTransform> symmetry_discrete;  ///< part_from_part, without the identity.
  bool symmetry_continuous = false;
  SymmetryAxis symmetry_axis;
  std::vector<PartGrasp> grasps;
  VerifyThresholds thresholds;
};

/// How a bank is made from CAD.
struct BankBuildParameters {
  float sampling = 0.05F;     ///< Voxel edge of the view points, as a share of the diameter.
  int angle_bins = 12;        ///< 15 degrees, as in the paper.
  int candidate_views = 162;  ///< Directions of the view sphere that are rendered.
  int maximum_views = 16;     ///< Kept after refinement.
  int maximum_view_points = 1000;
  float maximum_overlap = 0.6F;  ///< Views that share more than this are merged (paper 2.2).
  float minimum_completeness = 0.3F;
  float maximum_incidence =
      1.31F;                      ///< The sensor sees surfaces up to this angle from the normal (radians, 75 degrees).
  float sensor_distance = 0.75F;  ///< Metres from the sensor to the part.
  int surface_points = 2048;
};

/// What became of a build, for the report on the terminal and the contact sheet.
struct BankReport {
  int views_rendered = 0;
  int views_incomplete = 0;
  int views_degenerate = 0;
  int views_merged = 0;
  int views_kept = 0;
  bool symmetry_proposed = false;    ///< The symmetries were found on the mesh, not given.
  std::vector<std::string> remarks;  ///< Lines worth showing: symmetries found, open meshes, faces dropped.
};

/// Makes a bank (paper 2.2 and 2.3): views from the mesh, refined and generalised, the PPF table, the
/// dense surface. Returns the bytes of the file. `progress` is called with a share in [0, 1].
/// Fails with bad_file when the mesh cannot make a bank (no faces, NaN vertices, no extent) and with
/// bad_configuration when a parameter is out of its range.
[[nodiscard]] Result<std::vector<std::byte>> build_bank(const PartDescription& part,
                                                        const BankBuildParameters& parameters, BankReport& report,
                                                        const std::function<void(float)>& progress);

}  // namespace graspd
