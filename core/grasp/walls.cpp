#include "core/grasp/walls.hpp"

#include <algorithm>
#include <limits>

namespace graspd {
namespace {

/// What is left of a wall when its faces give way by `forgiven`. A thin wall reaches further to the outside than it
/// does: nothing else passes there either.
Box less_forgiven(const Box& wall, const Box& inside, float forgiven) {
  constexpr float least_depth = 0.010F;
  Box less = grown(wall, -forgiven);
  for (int axis = 0; axis < 3; ++axis) {
    if (wall.lower[axis] >= inside.upper[axis]) {
      less.upper[axis] = std::max(less.upper[axis], less.lower[axis] + least_depth);
    } else if (wall.upper[axis] <= inside.lower[axis]) {
      less.lower[axis] = std::min(less.lower[axis], less.upper[axis] - least_depth);
    }
  }
  return less;
}

}  // namespace

BinWalls bin_walls(const BinParameters& bin, const Vector3& up, const RigidTransform& camera_from_robot) {
  BinWalls result;
  if (!bin.present) return result;
  result.camera_from_bin = camera_from_robot * bin.robot_from_bin;
  result.bin_from_camera = inverse(result.camera_from_bin);
  const Vector3 half = 0.5F * bin.inner_size;
  const Vector3 outer = half + Vector3::Constant(bin.wall);
  const bool z_is_up = bin.opens_along_z(up);
  constexpr float open = std::numeric_limits<float>::infinity();
  result.inside = {Vector3(-half.x(), -half.y(), z_is_up ? -half.z() : -open),
                   Vector3(half.x(), half.y(), z_is_up ? open : half.z())};
  const float rim_low = z_is_up ? -outer.z() : -half.z();
  const float rim_high = z_is_up ? half.z() : outer.z();
  for (const float side : {-1.0F, 1.0F}) {
    const float near_x = side * half.x();
    const float far_x = side * outer.x();
    const float near_y = side * half.y();
    const float far_y = side * outer.y();
    result.walls[result.count++] = {{std::min(near_x, far_x), -outer.y(), rim_low},
                                    {std::max(near_x, far_x), outer.y(), rim_high}};
    result.walls[result.count++] = {{-outer.x(), std::min(near_y, far_y), rim_low},
                                    {outer.x(), std::max(near_y, far_y), rim_high}};
  }
  result.walls[result.count++] = {{-outer.x(), -outer.y(), z_is_up ? -outer.z() : half.z()},
                                  {outer.x(), outer.y(), z_is_up ? -half.z() : outer.z()}};
  return result;
}

bool sweep_meets_walls(const BinWalls& walls, const Sweep& sweep, float clearance) {
  if (walls.count == 0) return false;
  const RigidTransform bin_from_tool = walls.bin_from_camera * sweep.camera_from_tool;
  const RigidTransform tool_from_bin = inverse(bin_from_tool);
  return std::any_of(sweep.gripper->all().begin(), sweep.gripper->all().end(), [&](const GripperPiece& piece) {
    const Box box = grown(piece.box, clearance);
    if (holds(walls.inside, bounds_in(bin_from_tool, swept_bounds(box, sweep.motion)))) return false;
    return std::any_of(walls.all().begin(), walls.all().end(),
                       [&](const Box& wall) { return sweep_meets_box(box, sweep.motion, tool_from_bin, wall); });
  });
}

bool carried_meets_walls(const BinWalls& walls, const RigidTransform& camera_from_part, const Bank& bank,
                         const Vector3& motion, float tolerance) {
  if (walls.count == 0) return false;
  const Box bounds{bank.part->box_min, bank.part->box_max};
  const RigidTransform bin_from_part = walls.bin_from_camera * camera_from_part;
  const Vector3 way = walls.bin_from_camera.rotation * motion;
  if (holds(walls.inside, swept_bounds(bounds_in(bin_from_part, bounds), way))) return false;
  const RigidTransform part_from_bin = inverse(bin_from_part);
  const Vector3 way_of_part = part_from_bin.rotation * way;
  const bool far_off = std::none_of(walls.all().begin(), walls.all().end(), [&](const Box& wall) {
    return sweep_meets_box(bounds, way_of_part, part_from_bin, wall);
  });
  if (far_off) return false;
  const Box free = grown(walls.inside, tolerance);
  const auto stays_free = [&](const Vector3& point) {
    const Vector3 start = bin_from_part * point;
    return free.contains(start) && free.contains(start + way);
  };
  // What is free is convex: when all corners begin and end there, so does all between them, and stays there.
  const std::span<const Vector3> corners = bank.mesh.vertices;
  if (!corners.empty() && std::all_of(corners.begin(), corners.end(), stays_free)) return false;
  const auto meets = [&](const Vector3& point) {
    if (stays_free(point)) return false;
    const Vector3 start = bin_from_part * point;
    return std::any_of(walls.all().begin(), walls.all().end(), [&](const Box& wall) {
      // The point moves, the wall stands still: as if the wall came towards the point.
      return sweeps_over(less_forgiven(wall, walls.inside, tolerance), -way, start);
    });
  };
  return std::any_of(corners.begin(), corners.end(), meets) ||
         std::any_of(bank.surface.begin(), bank.surface.end(),
                     [&](const SurfacePoint& point) { return meets(point.position); });
}

}  // namespace graspd
