#include "core/grasp/collision.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace graspd {
namespace {

/// The smallest of the distances seen, kept sorted.
class NearestDistances {
 public:
  NearestDistances(std::uint32_t count, float cap) : count_(std::clamp<std::size_t>(count, 1, distances_.size())) {
    distances_.fill(cap);
  }
  void add(float distance) {
    std::size_t place = count_ - 1;
    if (distance >= distances_[place]) return;
    for (; place > 0 && distances_[place - 1] > distance; --place) distances_[place] = distances_[place - 1];
    distances_[place] = distance;
  }
  [[nodiscard]] float last() const { return distances_[count_ - 1]; }

 private:
  std::array<float, 8> distances_{};
  std::size_t count_;
};

/// Whether the bounds of a tile (camera frame) may reach into a box (tool frame).
bool tile_reaches(const Box& tile, const RigidTransform& tool_from_camera, const Matrix3& size_in_tool,
                  const Box& box) {
  if (tile.lower.z() > tile.upper.z()) return false;
  const Vector3 centre = tool_from_camera * tile.centre();
  const Vector3 half = size_in_tool * tile.half_size();
  return ((centre + half).array() >= box.lower.array()).all() && ((centre - half).array() <= box.upper.array()).all();
}

/// Calls `visit` with each tile's first and last cell, for tiles in `range` that `wanted` asks for, until it returns
/// true.
template <class Wanted, class Visit>
void visit_tiles(const CloudMap& map, const CellRange& range, const Wanted& wanted, const Visit& visit) {
  if (range.last_u < range.first_u || range.last_v < range.first_v) return;
  constexpr int size = CloudMap::tile_size;
  for (int row = range.first_v / size; row <= range.last_v / size; ++row) {
    for (int column = range.first_u / size; column <= range.last_u / size; ++column) {
      if (!wanted(map.tiles[static_cast<std::size_t>(row) * static_cast<std::size_t>(map.tile_columns) +
                            static_cast<std::size_t>(column)])) {
        continue;
      }
      const CellRange cells{std::max(range.first_u, column * size),
                            std::min(range.last_u, column * size + size - 1),
                            std::max(range.first_v, row * size),
                            std::min(range.last_v, row * size + size - 1),
                            range.nearest,
                            range.furthest};
      if (visit(cells)) return;
    }
  }
}

/// Calls `visit` with the depth, out of `depths`, and the ray (tool frame, a metre deep) of every cell of `range` whose
/// depth lies between its nearest and its furthest one, in tiles that `wanted` asks for, until it returns true.
template <class Wanted, class Visit>
void visit_cells(const CloudMap& map, std::span<const float> depths, const CellRange& range,
                 const RigidTransform& tool_from_camera, const Wanted& wanted, const Visit& visit) {
  const Vector3 ray_step = tool_from_camera.rotation.col(0) / map.camera.fx;
  visit_tiles(map, range, wanted, [&](const CellRange& cells) {
    for (int v = cells.first_v; v <= cells.last_v; ++v) {
      const Vector3 row_ray = tool_from_camera.rotation * map.camera.point(0.0F, static_cast<float>(v), 1.0F);
      const float* const row = depths.data() + map.camera.index(0, v);
      for (int u = cells.first_u; u <= cells.last_u; ++u) {
        const float depth = row[u];
        if (!(depth > 0.0F && depth >= cells.nearest && depth <= cells.furthest)) continue;
        if (visit(depth, Vector3(row_ray + static_cast<float>(u) * ray_step))) return true;
      }
    }
    return false;
  });
}

/// Calls `visit` with every measured point (tool frame) that may lie in `box`, until it returns true.
template <class Visit>
void visit_points(const CloudMap& map, const RigidTransform& camera_from_tool, const RigidTransform& tool_from_camera,
                  const Box& box, const Visit& visit) {
  const CellRange range = cells_of(map.camera, camera_from_tool, box);
  const Matrix3 size_in_tool = tool_from_camera.rotation.cwiseAbs();
  const auto wanted = [&](const Box& tile) { return tile_reaches(tile, tool_from_camera, size_in_tool, box); };
  visit_cells(map, map.depth, range, tool_from_camera, wanted, [&](float depth, const Vector3& ray) {
    return visit(Vector3(depth * ray + tool_from_camera.translation));
  });
}

bool is_part(const Vector3& point, const GripperPiece& piece, const Gripper& gripper, const HeldPart& part) {
  return piece.touches_part && gripper.held.contains(point) && part.bounds.contains(part.part_from_tool * point);
}

/// The volume behind what was measured, or may stand where nothing was, that a box covers, cubic metres.
float hidden_volume(const CloudMap& map, const RigidTransform& camera_from_tool, const RigidTransform& tool_from_camera,
                    const Box& box) {
  CellRange range = cells_of(map.camera, camera_from_tool, box);
  // Whatever stands in front of the box hides it, however far in front.
  range.nearest = 0.0F;
  const float cell = 1.0F / (map.camera.fx * map.camera.fy);
  const Vector3 to_lower = box.lower - tool_from_camera.translation;
  const Vector3 to_upper = box.upper - tool_from_camera.translation;
  float volume = 0.0F;
  const auto every_tile = [](const Box&) { return true; };
  visit_cells(map, map.front, range, tool_from_camera, every_tile, [&](float depth, const Vector3& ray) {
    const Vector3 inverse_ray = ray.cwiseInverse();
    const Vector3 a = to_lower.cwiseProduct(inverse_ray);
    const Vector3 b = to_upper.cwiseProduct(inverse_ray);
    const float enter = std::max(a.cwiseMin(b).maxCoeff(), depth);
    const float leave = a.cwiseMax(b).minCoeff();
    if (leave > enter) {
      const float middle = 0.5F * (enter + leave);
      volume += (leave - enter) * middle * middle * cell;
    }
    return false;
  });
  return volume;
}

}  // namespace

bool sweep_collides(const CloudMap& map, const Sweep& sweep, const HeldPart& part,
                    const CollisionParameters& parameters) {
  const RigidTransform tool_from_camera = inverse(sweep.camera_from_tool);
  for (const GripperPiece& piece : sweep.gripper->all()) {
    const Box box = grown(piece.box, parameters.minimum_clearance);
    const Box bounds = swept_bounds(box, sweep.motion);
    std::uint32_t hits = 0;
    visit_points(map, sweep.camera_from_tool, tool_from_camera, bounds, [&](const Vector3& point) {
      if (!bounds.contains(point) || !sweeps_over(box, sweep.motion, point)) return false;
      if (is_part(point, piece, *sweep.gripper, part)) return false;
      return ++hits >= parameters.minimum_points;
    });
    if (hits >= parameters.minimum_points) return true;
  }
  return false;
}

float sweep_clearance(const CloudMap& map, const Sweep& sweep, const HeldPart& part,
                      const CollisionParameters& parameters) {
  const RigidTransform tool_from_camera = inverse(sweep.camera_from_tool);
  float clearance = parameters.clearance_range;
  for (const GripperPiece& piece : sweep.gripper->all()) {
    const Box swept = swept_bounds(piece.box, sweep.motion);
    NearestDistances nearest(parameters.minimum_points, clearance);
    visit_points(map, sweep.camera_from_tool, tool_from_camera, grown(swept, clearance), [&](const Vector3& point) {
      const float distance = distance_to_box(point, swept);
      if (distance >= nearest.last() || is_part(point, piece, *sweep.gripper, part)) return false;
      nearest.add(distance);
      return nearest.last() <= parameters.minimum_clearance;
    });
    clearance = std::min(clearance, nearest.last());
    if (clearance <= parameters.minimum_clearance) break;
  }
  return clearance;
}

float unseen_share(const CloudMap& map, const Sweep& sweep) {
  const RigidTransform tool_from_camera = inverse(sweep.camera_from_tool);
  float share = 0.0F;
  for (const GripperPiece& piece : sweep.gripper->all()) {
    const float own = (piece.box.upper - piece.box.lower).prod();
    if (!(own > 0.0F)) continue;
    share = std::max(
        share,
        hidden_volume(map, sweep.camera_from_tool, tool_from_camera, swept_bounds(piece.box, sweep.motion)) / own);
  }
  return share;
}

}  // namespace graspd
