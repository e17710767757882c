#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/evaluate/visible_surface.hpp"
#include "core/geometry/depth_frame.hpp"
#include "core/geometry/mesh.hpp"
#include "core/geometry/rigid_transform.hpp"
#include "core/geometry/symmetry.hpp"

namespace graspd {

/// A part as the evaluation needs it; made by `evaluation_part`.
struct EvaluationPart {
  std::uint32_t id = 0;
  float diameter = 0;  ///< Metres.
  Mesh mesh;
  std::vector<Vector3> vertices;           ///< The mesh's, the outermost first.
  std::vector<RigidTransform> symmetries;  ///< See symmetry_set.
  Vector3 middle = Vector3::Zero();        ///< Mean of the vertices.
};

/// `mesh` is the one errors are defined on: BOP's models_eval where a data set has it.
[[nodiscard]] EvaluationPart evaluation_part(std::uint32_t id, Mesh mesh, float diameter, const Symmetry& symmetry);

/// A pose that was reported.
struct PoseEstimate {
  std::uint32_t part = 0;
  float score = 0;
  RigidTransform camera_from_part;
};

/// A pose that is known.
struct TruePose {
  std::uint32_t part = 0;
  RigidTransform camera_from_part;
  float visibility = 0;  ///< Share of the part that can be seen: `visib_fract` of BOP's scene_gt_info.json; negative
                         ///< when it is not known.
};

/// How many instances of a part are to be found in an image (`inst_count` of BOP's targets).
struct EvaluationTarget {
  std::uint32_t part = 0;
  std::uint32_t instances = 0;
};

/// What was asked, reported and true in one image.
struct EvaluationImage {
  std::uint32_t scene = 0;
  std::uint32_t image = 0;
  std::string level;       ///< Difficulty as the data set names it; empty when it does not.
  double seconds = 0;      ///< Of the detection.
  bool annotated = false;  ///< The true poses are known; false: `truths` is empty and says nothing.
  std::vector<EvaluationTarget> targets;
  std::vector<PoseEstimate> estimates;
  std::vector<TruePose> truths;
};

/// How far an estimate lies from a true pose (BOP'19). What lies too far to be right at any threshold
/// is 1 for VSD and infinite for the others.
struct PoseError {
  std::array<float, bop19_tolerance_count> visible_surface;  ///< VSD for each tolerance, in [0, 1].
  float surface = 0;                                         ///< MSSD as a share of the diameter.
  float projection = 0;                                      ///< MSPD in pixels of an image that is 640 pixels wide.
};

/// One part in one image: every estimate against every true pose.
struct PartErrors {
  std::uint32_t part = 0;
  std::uint32_t instances = 0;       ///< To be found; 0 for a part that was reported but not asked for.
  std::vector<float> scores;         ///< Of the estimates, best first.
  std::vector<std::size_t> sources;  ///< For each estimate, its index in EvaluationImage::estimates.
  std::vector<float> visibilities;   ///< Of the true poses, in the order of EvaluationImage::truths.
  std::vector<bool> targeted;        ///< The `instances` most visible true poses: those that recall counts.
  std::vector<PoseError> errors;     ///< Estimates times true poses, estimate by estimate.

  [[nodiscard]] const PoseError& error(std::size_t estimate, std::size_t truth) const {
    return errors[estimate * visibilities.size() + truth];
  }
};

/// One image, ready to be counted.
struct ImageErrors {
  std::uint32_t scene = 0;
  std::uint32_t image = 0;
  std::string level;
  double seconds = 0;
  std::vector<PartErrors> parts;
};

/// The errors of every estimate of `image`. `frame` is the measured depth; `parts` holds every part
/// that is a target or was reported (what is missing there is left out). As BOP'19 does it: poses
/// whose bounding spheres do not meet (in the image for VSD, in space for MSSD) are not compared.
[[nodiscard]] ImageErrors image_errors(const EvaluationImage& image, const DepthFrame& frame,
                                       std::span<const EvaluationPart> parts);

}  // namespace graspd
