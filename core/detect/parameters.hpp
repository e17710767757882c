#pragma once

#include <cstdint>

#include "core/bank/bank.hpp"

namespace graspd {

/// How the background is found when there is no empty-bin frame.
enum class BackgroundMode : std::uint8_t {
  automatic,  ///< By the empty-bin frame when the request has one, else by the dominant plane.
  none,       ///< Everything measured is foreground.
  plane,      ///< The dominant plane and all beyond it.
  box,        ///< All outside a box.
};

/// Background removal, normals and sampling (paper 2.4.1).
struct PreprocessParameters {
  BackgroundMode background = BackgroundMode::automatic;
  float background_margin = 0.0015F;  ///< What stands out less than this (metres) from the background belongs to it.
  float plane_slack = 1.6F;        ///< Details that a part may stand below a plane that was found in the frame itself.
  RigidTransform box_from_camera;  ///< For BackgroundMode::box.
  Vector3 box_half_size = Vector3::Zero();     ///< Metres; for BackgroundMode::box.
  bool has_region = false;                     ///< Outside a box everything is background, however else that is found.
  RigidTransform region_from_camera;           ///< The box of the region about its middle.
  Vector3 region_half_size = Vector3::Zero();  ///< Metres.
  bool segmentation = true;                    ///< Drop connected surfaces too small to be a part.
  float cells_per_detail = 4.0F;  ///< Resolution of the organised map, in cells along the finest bank's detail.
};

/// Voting (paper 1.3 and 2.4).
struct MatchParameters {
  int reference_step = 3;           ///< Every so many scene points one is a reference point,
  int minimum_references = 400;     ///< but more of them where so many would not be.
  int peaks_per_reference = 6;      ///< Poses kept for a reference, over all views.
  float minimum_peak_share = 0.5F;  ///< A peak counts when it has this share of the votes of the best one.
  int budget = 1000;                ///< VotingWork::effort of one part, in millions.
};

/// Clustering (paper 3.2: 15 degrees, 3 voxels) and the choice of what is refined.
struct ClusterParameters {
  float rotation = 0.26F;        ///< Radians.
  float translation = 1.5F;      ///< Voxels; wider clusters blur parts that nearly repeat, such as gears.
  int plausible = 2000;          ///< Clusters that go on to refinement, for one part
  int plausible_per_place = 20;  ///< and for one place of the scene.
};

/// Iterative closest point against the organised map: coarse for all plausible clusters, closer and then fine for
/// ever fewer that agree best with the scene.
struct RefineParameters {
  int coarse_iterations = 6;
  int coarse_points = 120;   ///< Surface points that take part.
  float first_gate = 2.0F;   ///< Voxels: correspondences further apart are ignored in the first iteration.
  float coarse_gate = 1.0F;  ///< The same in the last coarse iteration, in details,
  float last_gate = 0.4F;    ///< and in the last of all.
  int fine_iterations = 6;
  int fine_rounds = 2;     ///< The contour is rendered anew each round.
  bool edges = true;       ///< False: surfaces alone draw the pose (ablation).
  float edge_gate = 1.5F;  ///< Details: contours further from the scene's edges are ignored in the fine iterations.
  int fine_points = 400;
  float same_rotation = 0.1F;     ///< Radians: coarse poses this close and
  float same_translation = 1.0F;  ///< this close (details) are one.
  int closer = 600;               ///< Poses that are refined closely, for one part
  int closer_per_place = 6;       ///< and for one place of the scene.
  int close_iterations = 6;       ///< With fine_points, surfaces alone.
  int twins = 3;                  ///< Twins of a pose that are tried as well.
  int judged = 200;               ///< Poses that are refined to the end and verified, for one part
  int judged_per_place = 2;       ///< and for one place of the scene; their twins come in addition.
};

/// Verification (paper 2.4.2); the thresholds come from the bank.
struct VerifyParameters {
  bool tests = true;                ///< False: only the score decides (ablation).
  bool edges = true;                ///< False: the outline says nothing (ablation).
  float tolerance = 0.4F;           ///< Details: a model surface this close to the measured one is confirmed
  float blurred_tolerance = 1.67F;  ///< and this close when the sensor smears depth steps over nearly one.
  float noise_tolerance = 2.0F;     ///< But always so many standard deviations of a depth.
  float minimum_measured = 0.2F;    ///< Share of the model that must have been measured at all to be judged.
  float minimum_inside = 0.4F;      ///< Share of the model's surface that must fall inside the image.
  float minimum_purity = 0.6F;      ///< Share of what the scene says of the model that must be in its favour.
};

/// Bounds on what one detection may hold; they fix the memory of a workspace.
struct DetectCapacity {
  int maximum_width = 1280;
  int maximum_height = 960;
  std::uint32_t map_cells = 640 * 480;  ///< Cells of the organised map; larger frames are binned until they fit.
  std::uint32_t scene_points = 20000;
  std::uint32_t hypotheses = 40000;  ///< Peaks of the voting, over all references and views of one part.
  std::uint32_t clusters = 6000;
  std::uint32_t judged = 4000;              ///< Hypotheses that are refined and verified, over all parts.
  std::uint32_t instances = 100;            ///< Accepted, over all parts.
  std::uint32_t maximum_references = 8192;  ///< References of all views of one bank.
  std::uint32_t maximum_cells = 65536;      ///< Cells of one bank's PPF grid.
  int threads = 1;
};

/// Everything that can be set about a detection; a bank brings its own thresholds.
struct DetectParameters {
  PreprocessParameters preprocess;
  MatchParameters match;
  ClusterParameters cluster;
  RefineParameters refine;
  VerifyParameters verify;
  int threads = 1;
};

}  // namespace graspd
