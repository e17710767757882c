#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "core/geometry/mesh.hpp"
#include "core/geometry/oriented_point.hpp"
#include "core/geometry/rigid_transform.hpp"

namespace graspd {

/// Poses of a part (camera_from_part) that another implementation came to, right or not, and the processor's seconds
/// that its matching and refining took.
struct PeerPoses {
  std::vector<RigidTransform> poses;
  double seconds = 0;
};

/// Another implementation, trained for one part: looks for it among points of a scene, which are sampled already.
using PeerPart = std::function<PeerPoses(const std::vector<OrientedPoint>& scene)>;

/// Another implementation.
struct Peer {
  std::string name;
  float sampling = 0;  ///< Of the scene, as a share of the part's diameter.
  std::function<PeerPart(const MeshView& mesh, float diameter)> train;
};

/// Which frames are compared, and how.
struct RatioOptions {
  std::string root;
  std::string split = "test";
  std::string bank_folder;
  std::vector<std::string> images;
  int every = 1;
  bool without_peer = false;
  float ranking_tolerance = 0.002F;  ///< Metres.
  float minimum_score = 0.1F;        ///< Below which poses of the peer are not reported.
};

/// Puts the options on the command line of `app`.
void add_ratio_options(CLI::App& app, RatioOptions& options);

/// Runs graspd and the peer on the same frames, one thread each, and prints the seconds a frame of both, their
/// ratio, and how well each did. Background, normals, sampling, ranking by depth and suppression of duplicates are
/// given to the peer and not counted. Returns the exit code of `program`, after a line that says what failed.
[[nodiscard]] int run_comparison(const char* program, const Peer& peer, const RatioOptions& options);

}  // namespace graspd
