#pragma once

#include "core/detect/cluster.hpp"
#include "core/detect/detections.hpp"
#include "core/detect/match.hpp"
#include "core/detect/parameters.hpp"
#include "core/detect/preprocess.hpp"
#include "core/detect/select.hpp"
#include "core/memory/arena.hpp"
#include "core/memory/fixed_vector.hpp"

namespace graspd {

/// All the memory that a detection writes to, stage by stage.
struct DetectWorkspace {
  DetectCapacity capacity;
  PreprocessWorkspace preprocess;
  MatchWorkspace match;
  FixedVector<Hypothesis> hypotheses;
  ClusterWorkspace cluster;
  FixedVector<PoseCluster> clusters;
  std::span<std::span<float>> rendering;  ///< For each thread, an image as large as the map.
  FixedVector<Instance> judged;
  SelectWorkspace select;
  FixedVector<Instance> accepted;
  FixedVector<Instance> rejected;
};

/// Carves the memory of a detection for frames and banks up to `capacity`.
[[nodiscard]] DetectWorkspace carve_detect_workspace(Arena& arena, const DetectCapacity& capacity);

}  // namespace graspd
