#include "core/detect/workspace.hpp"

namespace graspd {

DetectWorkspace carve_detect_workspace(Arena& arena, const DetectCapacity& capacity) {
  DetectWorkspace workspace;
  workspace.capacity = capacity;
  workspace.preprocess = carve_preprocess_workspace(arena, capacity);
  workspace.match = carve_match_workspace(arena, capacity);
  workspace.hypotheses = FixedVector(arena.take<Hypothesis>(capacity.hypotheses, "hypotheses"));
  workspace.cluster = carve_cluster_workspace(arena, capacity);
  workspace.clusters = FixedVector(arena.take<PoseCluster>(capacity.clusters, "clusters"));
  workspace.rendering = arena.take<std::span<float>>(static_cast<std::size_t>(capacity.threads), "rendering");
  for (int t = 0; t < capacity.threads; ++t) {
    const std::span<float> image = arena.take<float>(std::size_t{2} * capacity.map_cells, "rendering");
    if (!workspace.rendering.empty()) workspace.rendering[static_cast<std::size_t>(t)] = image;
  }
  workspace.judged = FixedVector(arena.take<Instance>(capacity.judged, "instances"));
  workspace.select = carve_select_workspace(arena, capacity);
  workspace.accepted = FixedVector(arena.take<Instance>(capacity.instances, "instances"));
  workspace.rejected = FixedVector(arena.take<Instance>(capacity.judged, "instances"));
  return workspace;
}

}  // namespace graspd
