#include "core/grasp/cloud_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graspd {
namespace {

constexpr float unbounded = std::numeric_limits<float>::infinity();

int divided_up(int number, int divisor) { return (number + divisor - 1) / divisor; }

/// The smallest step at which the cells fit the memory.
int smallest_step(const Camera& camera, std::size_t cells) {
  int step = 1;
  while (static_cast<std::size_t>(divided_up(camera.width, step)) *
             static_cast<std::size_t>(divided_up(camera.height, step)) >
         cells) {
    ++step;
  }
  return step;
}

/// The depth that stands for the pixels from (left, top) on.
float cell_depth(const DepthFrame& frame, int left, int top, int step) {
  const Camera& camera = frame.camera;
  const int right = std::min(left + step, camera.width);
  const int bottom = std::min(top + step, camera.height);
  const float middle =
      frame.depth[camera.index(std::min(left + step / 2, right - 1), std::min(top + step / 2, bottom - 1))];
  if (middle > 0.0F) return middle;
  for (int v = top; v < bottom; ++v) {
    for (int u = left; u < right; ++u) {
      if (const float depth = frame.depth[camera.index(u, v)]; depth > 0.0F) return depth;
    }
  }
  return 0.0F;
}

void bound_tiles(CloudMap& map) {
  const Camera& camera = map.camera;
  std::fill(map.tiles.begin(), map.tiles.end(), Box{Vector3::Constant(unbounded), Vector3::Constant(-unbounded)});
  for (int v = 0; v < camera.height; ++v) {
    const float y = (static_cast<float>(v) - camera.cy) / camera.fy;
    const float* const row = map.depth.data() + camera.index(0, v);
    Box* tile = map.tiles.data() +
                static_cast<std::size_t>(v / CloudMap::tile_size) * static_cast<std::size_t>(map.tile_columns);
    for (int first = 0; first < camera.width; first += CloudMap::tile_size, ++tile) {
      const int last = std::min(first + CloudMap::tile_size, camera.width) - 1;
      float near = unbounded;
      float far = -unbounded;
      for (int u = first; u <= last; ++u) {
        const bool measured = row[u] > 0.0F;
        near = std::min(near, measured ? row[u] : unbounded);
        far = std::max(far, measured ? row[u] : -unbounded);
      }
      if (near > far) continue;
      // Each coordinate is a ray times a depth: its extremes lie at the ends of both.
      const float left = (static_cast<float>(first) - camera.cx) / camera.fx;
      const float right = (static_cast<float>(last) - camera.cx) / camera.fx;
      const Vector3 low(std::min(left * near, left * far), std::min(y * near, y * far), near);
      const Vector3 high(std::max(right * near, right * far), std::max(y * near, y * far), far);
      tile->lower = tile->lower.cwiseMin(low);
      tile->upper = tile->upper.cwiseMax(high);
    }
  }
}

}  // namespace

CloudMap carve_cloud_map(Arena& arena, std::uint32_t cells) {
  CloudMap map;
  map.depth_memory = arena.take<float>(cells, "grasp cloud");
  // Enough for the worst shape, a single row of cells.
  map.tile_memory = arena.take<Box>(cells / CloudMap::tile_size + 2 * CloudMap::tile_size, "grasp cloud");
  return map;
}

void fill_cloud_map(const DepthFrame& frame, float spacing, float reference_depth, CloudMap& map) {
  const Camera& full = frame.camera;
  const float pixels = spacing * std::min(full.fx, full.fy) / std::max(reference_depth, 0.01F);
  const int step =
      std::max(static_cast<int>(std::clamp(pixels, 1.0F, 1000.0F)), smallest_step(full, map.depth_memory.size()));
  const auto scale = 1.0F / static_cast<float>(step);
  const auto middle = static_cast<float>(step / 2);
  map.camera = {divided_up(full.width, step), divided_up(full.height, step), full.fx * scale, full.fy * scale,
                (full.cx - middle) * scale,   (full.cy - middle) * scale};
  map.tile_columns = divided_up(map.camera.width, CloudMap::tile_size);
  const auto tiles = static_cast<std::size_t>(map.tile_columns) *
                     static_cast<std::size_t>(divided_up(map.camera.height, CloudMap::tile_size));
  map.depth = map.depth_memory.first(map.camera.pixel_count());
  map.tiles = map.tile_memory.first(tiles);
  for (int v = 0; v < map.camera.height; ++v) {
    float* const row = map.depth.data() + map.camera.index(0, v);
    for (int u = 0; u < map.camera.width; ++u) row[u] = cell_depth(frame, u * step, v * step, step);
  }
  bound_tiles(map);
}

CellRange cells_of(const Camera& camera, const RigidTransform& camera_from_box_frame, const Box& box) {
  constexpr float nearest_projected = 0.01F;
  Eigen::Vector2f low = Eigen::Vector2f::Constant(std::numeric_limits<float>::max());
  Eigen::Vector2f high = -low;
  CellRange range;
  range.nearest = std::numeric_limits<float>::max();
  range.furthest = -std::numeric_limits<float>::max();
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const Vector3 point = camera_from_box_frame * box.corner(corner);
    range.nearest = std::min(range.nearest, point.z());
    range.furthest = std::max(range.furthest, point.z());
    const Eigen::Vector2f cell = camera.project(point);
    low = low.cwiseMin(cell);
    high = high.cwiseMax(cell);
  }
  if (range.furthest < nearest_projected) return range;
  const auto right = static_cast<float>(camera.width - 1);
  const auto bottom = static_cast<float>(camera.height - 1);
  range.first_u = 0;
  range.last_u = camera.width - 1;
  range.first_v = 0;
  range.last_v = camera.height - 1;
  if (range.nearest >= nearest_projected && low.allFinite() && high.allFinite()) {
    range.first_u = static_cast<int>(std::clamp(std::floor(low.x()), 0.0F, right + 1.0F));
    range.last_u = static_cast<int>(std::clamp(std::ceil(high.x()), -1.0F, right));
    range.first_v = static_cast<int>(std::clamp(std::floor(low.y()), 0.0F, bottom + 1.0F));
    range.last_v = static_cast<int>(std::clamp(std::ceil(high.y()), -1.0F, bottom));
  }
  return range;
}

}  // namespace graspd
