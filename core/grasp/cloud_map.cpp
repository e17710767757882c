#include "core/grasp/cloud_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/lanes.hpp"

namespace graspd {
namespace {

constexpr float unbounded = std::numeric_limits<float>::infinity();

int divided_up(int number, int divisor) { return (number + divisor - 1) / divisor; }

int whole_tiles(int pixels, int step) {
  return divided_up(divided_up(pixels, step), CloudMap::tile_size) * CloudMap::tile_size;
}

/// The smallest step at which the cells fit the memory.
int smallest_step(const Camera& camera, std::size_t cells) {
  int step = 1;
  while (static_cast<std::size_t>(whole_tiles(camera.width, step)) *
             static_cast<std::size_t>(whole_tiles(camera.height, step)) >
         cells) {
    ++step;
  }
  return step;
}

/// The depth of the first corner of a cell that was measured, between two columns of its first and its last row; 0:
/// none.
float corner_depth(const float* first, const float* last, int left, int right) {
  for (const float* const corner : {first + left, first + right, last + left, last + right}) {
    if (*corner > 0.0F) return *corner;
  }
  return 0.0F;
}

/// Depths of the cells of a tile's row; `left` and `top` are pixels.
void read_row(const DepthFrame& frame, int left, int top, int step, float* row) {
  const Camera& camera = frame.camera;
  std::fill_n(row, CloudMap::tile_size, 0.0F);
  if (top >= camera.height) return;
  const int rows = std::min(step, camera.height - top);
  const float* const first = frame.depth.data() + camera.index(0, top);
  const float* const last = first + (rows - 1) * camera.width;
  const float* const middle = first + std::min(step / 2, rows - 1) * camera.width;
  for (int i = 0; i < CloudMap::tile_size && left < camera.width; ++i, left += step) {
    const int right = std::min(left + step, camera.width) - 1;
    const float depth = middle[std::min(left + step / 2, right)];
    row[i] = depth > 0.0F ? depth : corner_depth(first, last, left, right);
  }
}

/// Makes room for the points of a tile's row, which begins at cell (first, v), in the bounds of the tile.
void add_row(const Camera& camera, const float* row, int first, int v, Box& bounds) {
  const Lanes unmeasured = Lanes{} - unbounded;
  Lanes furthest = unmeasured;
  Lanes nearest = unmeasured;  // Negative, so that the largest is the nearest.
  for (std::size_t i = 0; i < CloudMap::tile_size; i += lane_count) {
    const Lanes depths = load_lanes(row + i);
    furthest = larger(furthest, depths > 0.0F ? depths : unmeasured);
    nearest = larger(nearest, depths > 0.0F ? -depths : unmeasured);
  }
  const float near = -largest_lane(nearest);
  const float far = largest_lane(furthest);
  if (near > far) return;
  // Each coordinate is a ray times a depth: its extremes lie at the ends of both.
  const float y = (static_cast<float>(v) - camera.cy) / camera.fy;
  const float left = (static_cast<float>(first) - camera.cx) / camera.fx;
  const float right = (static_cast<float>(first + CloudMap::tile_size - 1) - camera.cx) / camera.fx;
  bounds.lower = bounds.lower.cwiseMin(Vector3(std::min(left * near, left * far), std::min(y * near, y * far), near));
  bounds.upper = bounds.upper.cwiseMax(Vector3(std::max(right * near, right * far), std::max(y * near, y * far), far));
}

}  // namespace

CloudMap carve_cloud_map(Arena& arena, std::uint32_t cells) {
  CloudMap map;
  map.depth_memory = arena.take<float>(cells, "grasp cloud");
  const std::size_t tiles = cells / (CloudMap::tile_size * CloudMap::tile_size);
  map.tile_memory = arena.take<Box>(tiles, "grasp cloud");
  map.known_memory = arena.take<std::uint8_t>(tiles, "grasp cloud");
  return map;
}

void begin_cloud_map(const DepthFrame& frame, float spacing, float reference_depth, CloudMap& map) {
  const Camera& full = frame.camera;
  const float pixels = spacing * std::min(full.fx, full.fy) / std::max(reference_depth, 0.01F);
  map.frame = frame;
  map.step =
      std::max(static_cast<int>(std::clamp(pixels, 1.0F, 1000.0F)), smallest_step(full, map.depth_memory.size()));
  const auto scale = 1.0F / static_cast<float>(map.step);
  const int middle_pixel = map.step / 2;
  const auto middle = static_cast<float>(middle_pixel);
  map.camera = {whole_tiles(full.width, map.step), whole_tiles(full.height, map.step), full.fx * scale, full.fy * scale,
                (full.cx - middle) * scale,        (full.cy - middle) * scale};
  map.tile_columns = map.camera.width / CloudMap::tile_size;
  map.depth = map.depth_memory.first(map.camera.pixel_count());
  const std::size_t tiles = map.depth.size() / (CloudMap::tile_size * CloudMap::tile_size);
  map.tiles = map.tile_memory.first(tiles);
  map.known = map.known_memory.first(tiles);
  std::fill(map.known.begin(), map.known.end(), std::uint8_t{0});
}

void read_tile(const CloudMap& map, int column, int row) {
  const std::size_t tile = tile_number(map, column, row);
  Box& bounds = map.tiles[tile];
  bounds = {Vector3::Constant(unbounded), Vector3::Constant(-unbounded)};
  const int first = column * CloudMap::tile_size;
  for (int v = row * CloudMap::tile_size; v < (row + 1) * CloudMap::tile_size; ++v) {
    float* const cells = map.depth.data() + map.camera.index(first, v);
    read_row(map.frame, first * map.step, v * map.step, map.step, cells);
    add_row(map.camera, cells, first, v, bounds);
  }
  map.known[tile] = 1;
}

void read_whole(const CloudMap& map) {
  for (int row = 0; row < map.camera.height / CloudMap::tile_size; ++row) {
    for (int column = 0; column < map.tile_columns; ++column) read_tile_once(map, column, row);
  }
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
