#include "core/grasp/hidden_space.hpp"

#include <algorithm>
#include <cmath>

#include "core/grasp/bounding_sphere.hpp"

namespace graspd {
namespace {

/// Noise and pose errors, metres.
constexpr float same_surface = 0.003F;

/// Square metres of the bounding box, of which a part has more or less.
float bounding_area(const BankPart& part) {
  const Vector3 size = part.box_max - part.box_min;
  return 2.0F * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
}

/// The nearest depth that was measured in the cells of the map that make one of the space; 0: none.
float nearest_depth(const CloudMap& map, int left, int top) {
  float nearest = 0.0F;
  for (int v = top; v < top + HiddenSpace::step; ++v) {
    for (int u = left; u < left + HiddenSpace::step; ++u) {
      const float depth = map.depth[map.camera.index(u, v)];
      if (depth > 0.0F && (nearest <= 0.0F || depth < nearest)) nearest = depth;
    }
  }
  return nearest;
}

/// The tiles of a range of cells, and of those next to them.
TileRange tiles_of(const HiddenSpace& space, const CellRange& range) {
  if (range.last_u < range.first_u || range.last_v < range.first_v) return {};
  constexpr int size = HiddenSpace::tile_size;
  return {std::max(range.first_u - 1, 0) / size, std::min(range.last_u + 1, space.camera.width - 1) / size,
          std::max(range.first_v - 1, 0) / size, std::min(range.last_v + 1, space.camera.height - 1) / size};
}

/// Makes a tile as if there were no instances.
void begin_tile(const HiddenSpace& space, int column, int row) {
  read_tile_once(*space.map, column, row);
  constexpr int size = HiddenSpace::tile_size;
  for (int v = row * size; v < (row + 1) * size; ++v) {
    for (int u = column * size; u < (column + 1) * size; ++u) {
      const std::size_t cell = space.camera.index(u, v);
      space.begins[cell] = nearest_depth(*space.map, u * HiddenSpace::step, v * HiddenSpace::step) - HiddenSpace::slack;
      space.behind[cell] = 0.0F;
    }
  }
}

/// Takes the instances that cover a tile, all of which were added, out of what it hides.
void finish_tile(const HiddenSpace& space, int column, int row) {
  constexpr int size = HiddenSpace::tile_size;
  for (int v = row * size; v < (row + 1) * size; ++v) {
    const std::size_t first = space.camera.index(column * size, v);
    for (std::size_t i = first; i < first + size; ++i) {
      space.begins[i] = std::max(space.begins[i], -space.behind[i] - HiddenSpace::slack);
    }
  }
}

/// How many cells beside the one that shows a surface point belong to it too, so that no gap is left to the next point.
int cells_beside(const BankPart& part, std::size_t points, float cell) {
  const float between = std::sqrt(bounding_area(part) / static_cast<float>(points));
  return static_cast<int>(std::ceil(std::max(0.5F * between / cell - 0.5F, 0.0F)));
}

/// How an instance covers the cells.
struct Cover {
  std::span<const SurfacePoint> surface;
  int beside = 0;  ///< So many cells about the one that shows a point belong to it too.
  TileRange tiles;
};

Cover cover_of(const HiddenSpace& space, const Instance& instance) {
  const Bank& bank = space.banks[instance.bank];
  const float depth = bounding_sphere(instance, space.banks).centre.z();
  const float cell = std::max(depth / space.camera.fx, 1e-4F);
  // Enough to leave no gap between them where there are as many, and no more.
  const float enough = std::ceil(bounding_area(*bank.part) / (cell * cell));
  Cover cover;
  cover.surface = bank.surface.first(std::min(static_cast<std::size_t>(std::max(enough, 1.0F)), bank.surface.size()));
  cover.beside = cells_beside(*bank.part, cover.surface.size(), cell);
  const Box reached = grown({bank.part->box_min, bank.part->box_max}, static_cast<float>(cover.beside) * cell);
  cover.tiles = tiles_of(space, cells_of(space.camera, instance.camera_from_part, reached));
  return cover;
}

/// Writes down where an instance ends in the cells that its surface covers. Only where the instance itself was
/// measured, its body is what hides the rest: the sign tells.
void add_instance(const HiddenSpace& space, const Instance& instance) {
  const Camera& camera = space.camera;
  const Cover cover = cover_of(space, instance);
  for (int row = cover.tiles.first_row; row <= cover.tiles.last_row; ++row) {
    for (int column = cover.tiles.first_column; column <= cover.tiles.last_column; ++column) {
      make_tile(space, column, row, TileState::measured);
    }
  }
  for (const SurfacePoint& point : cover.surface) {
    const Vector3 place = instance.camera_from_part * point.position;
    const HiddenCell middle = cell_of(camera, place);
    if (middle.u < 0) continue;
    const int last_u = std::min(middle.u + cover.beside, camera.width - 1);
    const int last_v = std::min(middle.v + cover.beside, camera.height - 1);
    for (int v = std::max(middle.v - cover.beside, 0); v <= last_v; ++v) {
      for (int u = std::max(middle.u - cover.beside, 0); u <= last_u; ++u) {
        const std::size_t cell = camera.index(u, v);
        float& behind = space.behind[cell];
        const bool was_measured =
            behind < 0.0F || std::abs(place.z() - HiddenSpace::slack - space.begins[cell]) <= same_surface;
        const float end = std::max(std::abs(behind), place.z());
        behind = was_measured ? -end : end;
      }
    }
  }
}

}  // namespace

HiddenSpace carve_hidden_space(Arena& arena, std::uint32_t cells, std::uint32_t instances) {
  HiddenSpace space;
  const std::size_t own = cells / (HiddenSpace::step * HiddenSpace::step);
  space.begins_memory = arena.take<float>(own, "grasp cloud");
  space.behind_memory = arena.take<float>(own, "grasp cloud");
  space.tile_memory = arena.take<TileState>(cells / (CloudMap::tile_size * CloudMap::tile_size), "grasp cloud");
  space.covered = arena.take<TileRange>(instances, "grasp cloud");
  space.added = arena.take<std::uint8_t>(instances, "grasp cloud");
  space.turned = arena.take<TurnedPart>(HiddenSpace::kept_banks * HiddenSpace::turns, "grasp cloud");
  space.is_turned = arena.take<std::uint8_t>(HiddenSpace::kept_banks, "grasp cloud");
  return space;
}

void begin_hidden_space(const CloudMap& map, std::span<const Instance> instances, std::span<const Bank> banks,
                        HiddenSpace& space) {
  constexpr int step = HiddenSpace::step;
  constexpr float scale = 1.0F / step;
  constexpr float middle = 0.5F * (step - 1);
  space.map = &map;
  space.instances = instances;
  space.banks = banks;
  space.camera = {map.camera.width / step, map.camera.height / step,         map.camera.fx * scale,
                  map.camera.fy * scale,   (map.camera.cx - middle) * scale, (map.camera.cy - middle) * scale};
  space.begins = space.begins_memory.first(space.camera.pixel_count());
  space.behind = space.behind_memory.first(space.camera.pixel_count());
  space.tiles = space.tile_memory.first(map.tiles.size());
  std::fill(space.tiles.begin(), space.tiles.end(), TileState::unknown);
  std::fill(space.is_turned.begin(), space.is_turned.end(), std::uint8_t{0});
  std::fill(space.added.begin(), space.added.end(), std::uint8_t{0});
  const std::size_t listed = std::min(instances.size(), space.covered.size());
  for (std::size_t i = 0; i < listed; ++i) space.covered[i] = cover_of(space, instances[i]).tiles;
  for (const Instance& instance : instances.subspan(listed)) add_instance(space, instance);
}

void make_tile(const HiddenSpace& space, int column, int row, TileState needed) {
  TileState& state = space.tiles[tile_number(*space.map, column, row)];
  if (state == TileState::unknown) {
    begin_tile(space, column, row);
    state = TileState::measured;
  }
  if (state >= needed) return;
  const std::size_t listed = std::min(space.instances.size(), space.covered.size());
  for (std::size_t i = 0; i < listed; ++i) {
    const TileRange& covered = space.covered[i];
    if (space.added[i] != 0 || column < covered.first_column || column > covered.last_column ||
        row < covered.first_row || row > covered.last_row) {
      continue;
    }
    space.added[i] = 1;
    add_instance(space, space.instances[i]);
  }
  finish_tile(space, column, row);
  state = TileState::whole;
}

}  // namespace graspd
