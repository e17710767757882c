#include "core/grasp/hidden_space.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/chance.hpp"

namespace graspd {
namespace {

/// Noise and pose errors, metres.
constexpr float same_surface = 0.003F;
constexpr float slack = 0.002F;
/// Of the outline, so many points may be in sight: a corner is easily lost.
constexpr int forgiven = 1;
/// How far behind the tip of a jaw, and in how many steps, places on it are tried.
constexpr float tip_length = 0.036F;
constexpr int steps_along = 4;
/// A share of poses that is hardly more than none.
constexpr float one_pose = 1e-4F;
constexpr std::size_t points_needed = TurnedPart::outline_points + TurnedPart::anchor_points;

/// Square metres of the bounding box, of which a part has more or less.
float bounding_area(const BankPart& part) {
  const Vector3 size = part.box_max - part.box_min;
  return 2.0F * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
}

/// The cell that shows `point`; the number of cells when none does.
std::size_t cell_of(const Camera& camera, const Vector3& point) {
  if (!(point.z() > 0.01F)) return camera.pixel_count();
  const float inverse_depth = 1.0F / point.z();
  const float u = camera.fx * point.x() * inverse_depth + camera.cx + 0.5F;
  const float v = camera.fy * point.y() * inverse_depth + camera.cy + 0.5F;
  if (!(u >= 0.0F && v >= 0.0F && u < static_cast<float>(camera.width) && v < static_cast<float>(camera.height))) {
    return camera.pixel_count();
  }
  return camera.index(static_cast<int>(u), static_cast<int>(v));
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

/// Makes a tile, as if there were no instances, if it was not made yet.
void make_tile(const HiddenSpace& space, int column, int row) {
  std::uint8_t& known = space.known[tile_number(*space.map, column, row)];
  if (known != 0) return;
  known = 1;
  static_cast<void>(tile_bounds(*space.map, column, row));
  constexpr int size = HiddenSpace::tile_size;
  for (int v = row * size; v < (row + 1) * size; ++v) {
    for (int u = column * size; u < (column + 1) * size; ++u) {
      const std::size_t cell = space.camera.index(u, v);
      space.begins[cell] = nearest_depth(*space.map, u * HiddenSpace::step, v * HiddenSpace::step) - slack;
      space.behind[cell] = 0.0F;
    }
  }
}

/// Makes all tiles of a range of cells, and of those next to them.
void make_tiles(const HiddenSpace& space, const CellRange& range) {
  if (range.last_u < range.first_u || range.last_v < range.first_v) return;
  constexpr int size = HiddenSpace::tile_size;
  const int last_column = std::min(range.last_u + 1, space.camera.width - 1) / size;
  const int last_row = std::min(range.last_v + 1, space.camera.height - 1) / size;
  for (int row = std::max(range.first_v - 1, 0) / size; row <= last_row; ++row) {
    for (int column = std::max(range.first_u - 1, 0) / size; column <= last_column; ++column) {
      make_tile(space, column, row);
    }
  }
}

/// How many cells beside the one that shows a surface point belong to it too, so that no gap is left to the next point.
int cells_beside(const BankPart& part, std::size_t points, float cell) {
  const float between = std::sqrt(bounding_area(part) / static_cast<float>(points));
  return static_cast<int>(std::ceil(std::max(0.5F * between / cell - 0.5F, 0.0F)));
}

/// Writes down where an instance ends in the cells that its surface covers. Only where the instance itself was
/// measured, its body is what hides the rest: the sign tells.
void add_instance(const HiddenSpace& space, const Instance& instance) {
  const Bank& bank = space.banks[instance.bank];
  const Camera& camera = space.camera;
  const float cell = std::max(instance.camera_from_part.translation.z() / camera.fx, 1e-4F);
  // Enough to leave no gap between them where there are as many, and no more.
  const float enough = std::ceil(bounding_area(*bank.part) / (cell * cell));
  const std::span<const SurfacePoint> surface =
      bank.surface.first(std::min(static_cast<std::size_t>(std::max(enough, 1.0F)), bank.surface.size()));
  const int beside = cells_beside(*bank.part, surface.size(), cell);
  make_tiles(space, cells_of(camera, instance.camera_from_part,
                             grown({bank.part->box_min, bank.part->box_max}, static_cast<float>(beside) * cell)));
  for (const SurfacePoint& point : surface) {
    const Vector3 place = instance.camera_from_part * point.position;
    const std::size_t middle = cell_of(camera, place);
    if (middle == camera.pixel_count()) continue;
    const auto u = static_cast<int>(middle % static_cast<std::size_t>(camera.width));
    const auto v = static_cast<int>(middle / static_cast<std::size_t>(camera.width));
    for (int y = std::max(v - beside, 0); y <= std::min(v + beside, camera.height - 1); ++y) {
      for (int x = std::max(u - beside, 0); x <= std::min(u + beside, camera.width - 1); ++x) {
        const std::size_t covered = camera.index(x, y);
        float& behind = space.behind[covered];
        const bool was_measured = behind < 0.0F || std::abs(place.z() - slack - space.begins[covered]) <= same_surface;
        const float end = std::max(std::abs(behind), place.z());
        behind = was_measured ? -end : end;
      }
    }
  }
}

/// Evenly drawn rotations (Shoemake 1992).
Matrix3 rotation_of(Chance& chance) {
  const float share = chance.unit();
  const float a = 6.2831853F * chance.unit();
  const float b = 6.2831853F * chance.unit();
  const float near = std::sqrt(1.0F - share);
  const float far = std::sqrt(share);
  return Eigen::Quaternionf(far * std::cos(b), near * std::sin(a), near * std::cos(a), far * std::sin(b))
      .toRotationMatrix();
}

TurnedPart turned_part(const Bank& bank, const Matrix3& rotation) {
  TurnedPart turned;
  for (std::size_t i = 0; i < TurnedPart::outline_points; ++i) turned.outline[i] = rotation * bank.surface[i].position;
  for (std::size_t i = 0; i < TurnedPart::anchor_points; ++i) {
    turned.anchors[i] = rotation * bank.surface[TurnedPart::outline_points + i].position;
  }
  std::sort(turned.outline.begin(), turned.outline.end(),
            [](const Vector3& a, const Vector3& b) { return a.z() < b.z(); });
  return turned;
}

/// Whether points (camera frame) of a part may be there without being seen.
class HiddenPlaces {
 public:
  HiddenPlaces(const HiddenSpace& space, const BinWalls& walls)
      : space_(space), walls_(walls), inside_(grown(walls.inside, slack)) {}
  [[nodiscard]] bool hold(const Vector3& point) const {
    const std::size_t cell = cell_of(space_.camera, point);
    if (cell < space_.begins.size() && point.z() < space_.begins[cell]) return false;
    return walls_.count == 0 || inside_.contains(walls_.bin_from_camera * point);
  }
  /// Whether a part in one orientation, moved to `place`, would be hidden whole.
  [[nodiscard]] bool hide(const TurnedPart& turned, const Vector3& place) const {
    int in_sight = 0;
    return std::all_of(turned.outline.begin(), turned.outline.end(),
                       [&](const Vector3& point) { return hold(point + place) || ++in_sight <= forgiven; });
  }

 private:
  const HiddenSpace& space_;
  const BinWalls& walls_;
  Box inside_;
};

/// Places on the pieces that touch the held part, those of a group together: of the poses, every group tries others.
struct TriedPlaces {
  struct Group {
    std::array<Vector3, 4 * steps_along*(maximum_tool_boxes + 3) / HiddenSpace::thinning> places;
    std::size_t count = 0;
  };
  std::array<Group, HiddenSpace::thinning> groups;
  std::size_t all = 0;  ///< Hidden or not.
  bool any = false;     ///< One of them is hidden.
};

/// Corners of a piece, from its tip backwards.
Vector3 place_on(const GripperPiece& piece, int number) {
  const float length = std::min(tip_length, piece.box.upper.z() - piece.box.lower.z());
  Vector3 place = piece.box.corner(static_cast<std::size_t>(number % 4) | 4U);
  const int steps_back = number / 4;
  place.z() -= length * static_cast<float>(steps_back) / static_cast<float>(steps_along - 1);
  return place;
}

TriedPlaces tried_places(const HiddenPlaces& hidden, const RigidTransform& camera_from_tool, const Gripper& gripper) {
  TriedPlaces tried;
  for (const GripperPiece& piece : gripper.all()) {
    if (!piece.touches_part) continue;
    for (int i = 0; i < 4 * steps_along; ++i, ++tried.all) {
      const Vector3 place = camera_from_tool * place_on(piece, i);
      if (!hidden.hold(place)) continue;
      TriedPlaces::Group& group = tried.groups[static_cast<std::size_t>(i + i / 4) % HiddenSpace::thinning];
      group.places[group.count++] = place;
      tried.any = true;
    }
  }
  return tried;
}

/// Bounds of the pieces that touch the held part, from their tips backwards.
Box bounds_of_tips(const Gripper& gripper) {
  Box bounds{Vector3::Constant(1e9F), Vector3::Constant(-1e9F)};
  for (const GripperPiece& piece : gripper.all()) {
    if (!piece.touches_part) continue;
    Box tip = piece.box;
    tip.lower.z() = std::max(tip.lower.z(), tip.upper.z() - tip_length);
    bounds.lower = bounds.lower.cwiseMin(tip.lower);
    bounds.upper = bounds.upper.cwiseMax(tip.upper);
  }
  return bounds;
}

}  // namespace

HiddenSpace carve_hidden_space(Arena& arena, std::uint32_t cells) {
  HiddenSpace space;
  const std::size_t own = cells / (HiddenSpace::step * HiddenSpace::step);
  space.begins_memory = arena.take<float>(own, "grasp cloud");
  space.behind_memory = arena.take<float>(own, "grasp cloud");
  space.known_memory = arena.take<std::uint8_t>(cells / (CloudMap::tile_size * CloudMap::tile_size), "grasp cloud");
  space.turned = arena.take<TurnedPart>(HiddenSpace::kept_banks * HiddenSpace::turns, "grasp cloud");
  space.rotations = arena.take<Matrix3>(HiddenSpace::turns, "grasp cloud");
  Chance chance(1);
  for (Matrix3& rotation : space.rotations) rotation = rotation_of(chance);
  return space;
}

void begin_hidden_space(const CloudMap& map, std::span<const Instance> instances, std::span<const Bank> banks,
                        HiddenSpace& space) {
  constexpr int step = HiddenSpace::step;
  constexpr float scale = 1.0F / step;
  constexpr float middle = 0.5F * (step - 1);
  space.map = &map;
  space.banks = banks;
  space.camera = {map.camera.width / step, map.camera.height / step,         map.camera.fx * scale,
                  map.camera.fy * scale,   (map.camera.cx - middle) * scale, (map.camera.cy - middle) * scale};
  space.begins = space.begins_memory.first(space.camera.pixel_count());
  space.behind = space.behind_memory.first(space.camera.pixel_count());
  space.known = space.known_memory.first(map.tiles.size());
  std::fill(space.known.begin(), space.known.end(), std::uint8_t{0});
  for (const Instance& instance : instances) add_instance(space, instance);
  constexpr int size = HiddenSpace::tile_size;
  for (int v = 0; v < space.camera.height; ++v) {
    for (int column = 0; column < map.tile_columns; ++column) {
      if (space.known[tile_number(map, column, v / size)] == 0) continue;
      const std::size_t first = space.camera.index(column * size, v);
      for (std::size_t i = first; i < first + size; ++i) {
        space.begins[i] = std::max(space.begins[i], -space.behind[i] - slack);
      }
    }
  }
  for (std::size_t bank = 0; bank < std::min(banks.size(), HiddenSpace::kept_banks); ++bank) {
    if (banks[bank].surface.size() < points_needed) continue;
    for (std::size_t turn = 0; turn < HiddenSpace::turns; ++turn) {
      space.turned[bank * HiddenSpace::turns + turn] = turned_part(banks[bank], space.rotations[turn]);
    }
  }
}

float hidden_part_clearance(float share, const CollisionParameters& parameters) {
  return parameters.hidden_clearance * std::log10(1.0F + share / one_pose);
}

float hidden_part_share_at(float clearance, const CollisionParameters& parameters) {
  const float tenfolds = parameters.hidden_clearance > 0.0F ? clearance / parameters.hidden_clearance : 10.0F;
  return one_pose * (std::pow(10.0F, std::min(tenfolds, 10.0F)) - 1.0F);
}

float hidden_part_share(const HiddenSpace& space, std::size_t bank, const BinWalls& walls,
                        const RigidTransform& camera_from_tool, const Gripper& gripper, float most) {
  if (space.banks[bank].surface.size() < points_needed) return 0.0F;
  const BankPart& part = *space.banks[bank].part;
  // No point of a part that is laid on a place is further from it.
  const float reach = (part.box_max - part.box_min).norm();
  make_tiles(space, cells_of(space.camera, camera_from_tool, grown(bounds_of_tips(gripper), reach)));
  const HiddenPlaces hidden(space, walls);
  const TriedPlaces tried = tried_places(hidden, camera_from_tool, gripper);
  if (!tried.any) return 0.0F;
  const std::size_t poses_tried = tried.all * HiddenSpace::turns * TurnedPart::anchor_points / HiddenSpace::thinning;
  const auto poses = static_cast<float>(poses_tried);
  std::size_t count = 0;
  for (std::size_t turn = 0; turn < HiddenSpace::turns; ++turn) {
    const TurnedPart turned = bank < HiddenSpace::kept_banks ? space.turned[bank * HiddenSpace::turns + turn]
                                                             : turned_part(space.banks[bank], space.rotations[turn]);
    for (std::size_t anchor = 0; anchor < TurnedPart::anchor_points; ++anchor) {
      const TriedPlaces::Group& group = tried.groups[(turn + anchor) % HiddenSpace::thinning];
      for (std::size_t i = 0; i < group.count; ++i) {
        if (hidden.hide(turned, group.places[i] - turned.anchors[anchor])) ++count;
      }
    }
    if (static_cast<float>(count) > most * poses) break;
  }
  return static_cast<float>(count) / poses;
}

}  // namespace graspd
