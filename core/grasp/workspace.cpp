#include "core/grasp/workspace.hpp"

namespace graspd {

GraspWorkspace carve_grasp_workspace(Arena& arena, const GraspCapacity& capacity) {
  GraspWorkspace workspace;
  workspace.capacity = capacity;
  workspace.candidates = FixedVector(arena.take<GraspCandidate>(capacity.candidates, "grasp candidates"));
  workspace.picks = FixedVector(arena.take<Pick>(capacity.instances, "picks"));
  workspace.reasons = FixedVector(arena.take<GraspRejection>(capacity.instances, "picks"));
  workspace.searches = FixedVector(arena.take<GraspSearch>(capacity.instances, "picks"));
  workspace.avoided = FixedVector(arena.take<AvoidedPlace>(AvoidList::capacity, "avoided places"));
  workspace.rejected = FixedVector(arena.take<RejectedGrasp>(2 * std::size_t{capacity.instances}, "picks"));
  workspace.cloud = carve_cloud_map(arena, capacity.cloud_cells);
  workspace.hidden = carve_hidden_space(arena, capacity.cloud_cells, capacity.instances);
  workspace.explained = arena.take<Explained>(capacity.cloud_cells, "grasp cloud");
  workspace.spheres = FixedVector(arena.take<BoundingSphere>(capacity.instances, "picks"));
  workspace.wall_points = FixedVector(arena.take<WallPoint>(bin_fit_points, "grasp cloud"));
  return workspace;
}

}  // namespace graspd
