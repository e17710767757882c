#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/geometry/rigid_transform.hpp"

namespace graspd {

/// Why a hypothesis was rejected (paper 2.4.2), in the order in which the tests run.
enum class Rejection : std::uint8_t {
  none,
  weak,          ///< Too little of the model was measured, or lies inside the image, to judge it.
  overlap,       ///< Overlap testing: too little of the visible model surface confirmed.
  boundary,      ///< Boundary testing: model where the scene shows free space.
  edge,          ///< Edge consistency testing.
  below_plane,   ///< Spatial pose testing: below the plane or behind the background.
  intersecting,  ///< Spatial pose testing: inside an instance that was accepted before.
  duplicate,     ///< The surface that confirms it was claimed by a better instance.
  score,         ///< The final score is below the threshold.
  ambiguous,     ///< Another pose explains the same surface as well, or nearly.
};
inline constexpr std::size_t rejection_count = 10;

/// A name for logs and tables, in lower case.
[[nodiscard]] const char* rejection_name(Rejection rejection);

/// Lengths and areas in evidence are counted in this share of the diameter and its square, so that they mean the same
/// however finely a part is sampled.
inline constexpr float evidence_unit = 0.03F;

/// The figures on which a hypothesis is judged; shares in [0, 1].
struct Evidence {
  float overlap = 0;    ///< Confirmed share of the surface that should be seen and was measured.
  float visible = 0;    ///< Confirmed share of all the surface that faces the sensor from this pose.
  float purity = 0;     ///< Confirmed share of the surface for or against which the scene speaks.
  float measured = 0;   ///< Share of that surface for which the sensor saw anything.
  float inside = 1;     ///< Share of the surface that falls inside the image.
  float boundary = 0;   ///< Share of the model that stands where the scene shows free space.
  float edge = 0;       ///< Share of the decided outline that agrees with the scene.
  float decided = 0;    ///< Length of the outline on which the scene says anything, in units.
  float outline = 0;    ///< Length of the outline, in units.
  float lock = 0;       ///< How firmly the confirmed normals hold the pose: 0 for a plane or a cylinder, at most 1.
  float blur = 0;       ///< How far the sensor smears depth steps: 0 sharp, 1 nearly a detail and more.
  float gap = 0;        ///< Area with free space where the model stands, without its seam, in units.
  float below = 0;      ///< Share of the model below the plane or inside accepted instances.
  float residual = 0;   ///< Root mean square distance of confirmed points, in voxels of the bank
  float misfit = 0;     ///< and as a share of what is tolerated of this sensor.
  float leniency = 0;   ///< Natural logarithm of how many times as much is tolerated for the noise of the depth.
  float confirmed = 0;  ///< Area that confirms the model as seen from the sensor, in units.
};

/// A part found, or a hypothesis that was rejected.
struct Instance {
  RigidTransform camera_from_part;
  std::uint32_t bank = 0;  ///< Index into the banks of the request.
  std::uint32_t view = 0;  ///< The view that voted for it.
  float votes = 0;
  float score = 0;  ///< In [0, 1]; higher is surer.
  Evidence evidence;
  Rejection rejection = Rejection::none;
};

/// What was cut or left out; a result with a flag is right, but not all there may have been.
enum DetectionFlag : std::uint32_t {
  flag_scene_points_cut = 1U << 0U,
  flag_hypotheses_cut = 1U << 1U,
  flag_instances_cut = 1U << 2U,
  flag_deadline = 1U << 3U,    ///< The deadline passed: verified instances so far.
  flag_voting_cut = 1U << 4U,  ///< The voting would have taken more than its budget or memory: fewer points voted.
};

enum class Stage : std::uint8_t { preprocess, match, cluster, refine, verify };
inline constexpr std::size_t stage_count = 5;
[[nodiscard]] const char* stage_name(Stage stage);

/// What the voting did (paper 1.3).
struct VotingWork {
  std::uint64_t pairs = 0;  ///< Pairs of scene points whose feature was looked up.
  std::uint64_t cells = 0;  ///< Cells of the table that were read; pairs that repeat a vote are passed over.
  std::uint64_t votes = 0;
  std::uint64_t effort = 0;    ///< What all that takes, in votes that are cast one by one.
  std::uint32_t left_out = 0;  ///< Reference points that did not vote: the budget was spent, or the memory full.

  void operator+=(const VotingWork& other) {
    pairs += other.pairs;
    cells += other.cells;
    votes += other.votes;
    effort += other.effort;
    left_out += other.left_out;
  }
};

/// How much there was to do, over all banks. The same for any number of threads.
struct DetectionWork {
  VotingWork voting;
  std::uint32_t hypotheses = 0;  ///< Peaks of the voting.
  std::uint32_t clusters = 0;
  std::uint32_t judged = 0;  ///< Poses that were refined to the end and verified.
};

/// The outcome of one detection, in memory of the workspace: valid until the next one.
struct Detections {
  std::span<const Instance> instances;                      ///< Accepted, best score first.
  std::span<const Instance> rejected;                       ///< Judged and rejected, with the reason.
  std::array<std::uint32_t, rejection_count> rejections{};  ///< Hypotheses by reason.
  std::array<std::int64_t, stage_count> stage_ns{};
  DetectionWork work;
  std::uint32_t flags = 0;
  std::uint32_t scene_points = 0;       ///< Points that took part in the matching.
  std::uint32_t foreground_pixels = 0;  ///< Pixels left after the background was removed; 0: the bin is empty.
  std::uint32_t measured_pixels = 0;    ///< Pixels of the frame that hold a depth at all.
};

}  // namespace graspd
