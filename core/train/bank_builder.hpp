#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/bank/bank.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/mesh.hpp"
#include "core/status.hpp"
#include "core/train/cut_out.hpp"
#include "core/train/resting_poses.hpp"

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
  std::optional<std::vector<RigidTransform>> twins;  ///< Of find_twins(); none: the builder looks for them.
  std::vector<PartGrasp> grasps;
  VerifyThresholds thresholds;
};

/// How a view is kept from being about one instance alone (paper 2.3).
enum class Generalisation : std::uint8_t {
  none,
  fuse,    ///< United with all that it stands for, then averaged over voxels.
  smooth,  ///< Its own points and normals, averaged with their neighbours'.
};

/// Directions from which a part may be rendered at most.
inline constexpr int most_candidate_views = 2562;

/// How a bank is made.
struct BankBuildParameters {
  float sampling = 0.05F;     ///< Voxel edge of the view points, as a share of the diameter.
  float detail = 0.6F;        ///< Length at which poses are refined and judged, as a share of that edge.
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
  int visibility_directions = 642;  ///< From which the bank knows what of the surface the part itself hides.
  bool refinement = true;           ///< False: evenly spread candidates as they are (ablation).
  Generalisation generalisation = Generalisation::fuse;
  bool full_model = false;   ///< One view of all sides and all pairs, in place of many views (ablation).
  bool edges_refine = true;  ///< The bank lets outlines draw poses in refinement
  bool edges_judge = true;   ///< and be evidence in verification.
  int model_points = 0;      ///< Not 0: in place of `sampling`, one by which the whole surface makes so many points.
};

/// What became of a candidate view.
enum class CandidateFate : std::uint8_t {
  unused,  ///< No room left, or not asked for.
  kept,
  fused,       ///< A kept view holds its points.
  merged,      ///< A kept view stands for it.
  incomplete,  ///< Shows too little of the part.
  degenerate,  ///< Does not fix the pose.
};

/// A candidate view in the report.
struct CandidateReport {
  Vector3 direction = Vector3::UnitZ();  ///< From the part towards the sensor, part frame.
  std::string source;                    ///< The frame that it was cut out of; empty: rendered.
  float completeness = 0;
  CandidateFate fate = CandidateFate::unused;
  std::size_t view = 0;               ///< Kept as, or merged or fused into.
  std::vector<OrientedPoint> points;  ///< Some of what it shows, part frame.
};

/// What became of a build, for the report on the terminal and the contact sheet.
struct BankReport {
  int views_rendered = 0;
  int views_cut_out = 0;  ///< Candidates from frames.
  int views_incomplete = 0;
  int views_degenerate = 0;
  int views_merged = 0;  ///< Those that were fused among them.
  int views_fused = 0;
  int views_kept = 0;
  bool symmetry_proposed = false;    ///< The symmetries were found on the mesh, not given.
  std::vector<std::string> remarks;  ///< Lines worth showing: symmetries found, open meshes, faces dropped.
  std::vector<CandidateReport> candidates;
  std::vector<RestingPose> resting;  ///< How the part lies on a floor, most frequent first.
};

/// Makes a bank (paper 2.2 and 2.3): views from the mesh, refined and generalised, the PPF table, the
/// dense surface. Returns the bytes of the file. `progress` is called with a share in [0, 1].
/// Fails with bad_file when the mesh cannot make a bank (no faces, NaN vertices, no extent) and with
/// bad_configuration when a parameter is out of its range or the symmetries given turn the part far away from itself.
[[nodiscard]] Result<std::vector<std::byte>> build_bank(const PartDescription& part,
                                                        const BankBuildParameters& parameters, BankReport& report,
                                                        const std::function<void(float)>& progress);

/// As build_bank, with views that were cut out of frames among the candidates: they are kept before rendered ones
/// (paper 2.2). Without `rendered`, they are the only ones; then fails with bad_frame when there are none.
[[nodiscard]] Result<std::vector<std::byte>> learn_bank(const PartDescription& part, std::vector<CutOut> cut_outs,
                                                        bool rendered, const BankBuildParameters& parameters,
                                                        BankReport& report, const std::function<void(float)>& progress);

}  // namespace graspd
