#pragma once

#include "tests/benchmarks/peer_ratio.hpp"

namespace graspd {

/// How PCL's PPFRegistration is set. The defaults are those of the benchmark page.
struct PclSettings {
  float sampling = 0.08F;  ///< Of model and scene, as a share of the diameter; also the distance step.
  /// Radians; 31 turns. At half a turn exactly, PCL counts one cell beyond the row: here the row's memory has room.
  float angle_step = 0.20268F;
  unsigned reference_step = 20;    ///< Every so many scene points one is a reference.
  float cluster_position = 0.1F;   ///< Share of the diameter.
  float cluster_rotation = 0.35F;  ///< Radians.
  int instances = 15;              ///< Alignments in one frame, one for each instance.
  int icp_iterations = 50;
  float icp_distance = 0.1F;    ///< Share of the diameter: correspondences further apart do not count.
  float taken_distance = 0.1F;  ///< Share of the diameter: scene points this close to an instance are taken by it.
};

/// pcl::PPFRegistration, and point-to-plane ICP for what it finds. It finds one instance; what an instance took is
/// removed from the scene, and it is asked again, until the number of instances is reached or little is left.
[[nodiscard]] Peer pcl_peer(const PclSettings& settings);

}  // namespace graspd
