#pragma once

#include <memory>
#include <vector>

#include "core/geometry/mesh.hpp"
#include "core/geometry/oriented_point.hpp"

namespace graspd {

/// How OpenCV's surface_matching is set. The defaults are those of the benchmark page.
struct OpenCvSettings {
  double sampling = 0.06;          ///< Of model and scene, as a share of the diameter; also the distance step.
  double reference_share = 0.2;    ///< Of the scene points, used as references (OpenCV's default).
  double cluster_position = 0.05;  ///< Share of the diameter.
  double cluster_rotation = 0.2;   ///< Radians.
  int refined = 100;               ///< Poses, best first, that go through ICP.
  int icp_iterations = 100;
  float icp_tolerance = 0.005F;
  float icp_rejection = 2.5F;
  int icp_levels = 4;
};

/// A part trained with cv::ppf_match_3d::PPF3DDetector.
class OpenCvPart {
 public:
  OpenCvPart(const MeshView& mesh, float diameter, const OpenCvSettings& settings);
  ~OpenCvPart();
  OpenCvPart(OpenCvPart&&) noexcept;

  /// Poses (camera_from_part), before and after refinement by cv::ppf_match_3d::ICP, and the seconds
  /// that matching and refining took. `scene` is sampled already.
  struct Found {
    std::vector<RigidTransform> matched;
    std::vector<RigidTransform> refined;
    double match_seconds = 0;
    double refine_seconds = 0;
  };
  [[nodiscard]] Found find(const std::vector<OrientedPoint>& scene) const;

 private:
  struct Trained;
  std::unique_ptr<Trained> trained_;
};

}  // namespace graspd
