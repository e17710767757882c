#include "core/grasp/workspace.hpp"

namespace graspd {

GraspWorkspace carve_grasp_workspace(Arena& arena, const GraspCapacity& capacity) {
  GraspWorkspace workspace;
  workspace.capacity = capacity;
  workspace.candidates = FixedVector(arena.take<GraspCandidate>(capacity.candidates, "grasp candidates"));
  workspace.picks = FixedVector(arena.take<Pick>(capacity.instances, "picks"));
  workspace.reasons = FixedVector(arena.take<GraspRejection>(capacity.instances, "picks"));
  return workspace;
}

}  // namespace graspd
