#pragma once

#include "tests/benchmarks/peer_ratio.hpp"

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

/// cv::ppf_match_3d::PPF3DDetector, and its ICP for the best poses; on one thread. Poses come as they were refined, and
/// as they were matched.
[[nodiscard]] Peer opencv_peer(const OpenCvSettings& settings);

}  // namespace graspd
