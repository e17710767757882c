#include "core/grasp/hidden_space.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/chance.hpp"

namespace graspd {
namespace {

/// Noise and pose errors, metres.
constexpr float same_surface = 0.003F;
constexpr float slack = 0.002F;
/// Surface points of an instance that are looked at.
constexpr std::size_t surface_points = 512;
/// Of the outline, so many points may be in sight: a corner is easily lost.
constexpr int forgiven = 1;
/// How far behind the tip of a jaw, and in how many steps, places on it are tried.
constexpr float tip_length = 0.036F;
constexpr int steps_along = 4;

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
  for (int v = top; v < std::min(top + HiddenSpace::step, map.camera.height); ++v) {
    for (int u = left; u < std::min(left + HiddenSpace::step, map.camera.width); ++u) {
      const float depth = map.depth[map.camera.index(u, v)];
      if (depth > 0.0F && (nearest <= 0.0F || depth < nearest)) nearest = depth;
    }
  }
  return nearest;
}

/// How many cells beside the one that shows a surface point belong to it too, so that no gap is left to the next point.
int cells_beside(const BankPart& part, std::size_t points, float cell) {
  const float between = std::sqrt(bounding_area(part) / static_cast<float>(points));
  return static_cast<int>(std::ceil(std::max(0.5F * between / cell - 0.5F, 0.0F)));
}

/// Calls `visit` with cells and depths that cover the surface of every instance.
template <class Visit>
void visit_surfaces(std::span<const Instance> instances, std::span<const Bank> banks, const Camera& camera,
                    const Visit& visit) {
  for (const Instance& instance : instances) {
    const Bank& bank = banks[instance.bank];
    const std::span<const SurfacePoint> surface = bank.surface.first(std::min(surface_points, bank.surface.size()));
    const float cell = instance.camera_from_part.translation.z() / camera.fx;
    const int beside = cells_beside(*bank.part, surface.size(), std::max(cell, 1e-4F));
    for (const SurfacePoint& point : surface) {
      const Vector3 place = instance.camera_from_part * point.position;
      const std::size_t middle = cell_of(camera, place);
      if (middle == camera.pixel_count()) continue;
      const auto u = static_cast<int>(middle % static_cast<std::size_t>(camera.width));
      const auto v = static_cast<int>(middle / static_cast<std::size_t>(camera.width));
      for (int y = std::max(v - beside, 0); y <= std::min(v + beside, camera.height - 1); ++y) {
        for (int x = std::max(u - beside, 0); x <= std::min(u + beside, camera.width - 1); ++x) {
          visit(camera.index(x, y), place.z());
        }
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

/// Whether a point (camera frame) of a part may be there without being seen.
class HiddenPlaces {
 public:
  HiddenPlaces(const HiddenSpace& space, const BinWalls& walls)
      : space_(space), has_bin_(walls.count > 0), bin_from_camera_(inverse(walls.camera_from_bin)) {
    inside_ = grown(walls.inside, slack);
  }
  [[nodiscard]] bool hold(const Vector3& point) const {
    const std::size_t cell = cell_of(space_.camera, point);
    if (cell < space_.begins.size() && point.z() < space_.begins[cell]) return false;
    return !has_bin_ || inside_.contains(bin_from_camera_ * point);
  }

 private:
  const HiddenSpace& space_;
  bool has_bin_;
  RigidTransform bin_from_camera_;
  Box inside_;
};

/// Whether a part whose outline, turned already, is moved to `place` would be hidden whole.
bool hides(const HiddenPlaces& places, std::span<const Vector3> outline, const Vector3& place) {
  int in_sight = 0;
  return std::all_of(outline.begin(), outline.end(),
                     [&](const Vector3& point) { return places.hold(point + place) || ++in_sight <= forgiven; });
}

}  // namespace

HiddenSpace carve_hidden_space(Arena& arena, std::uint32_t cells) {
  HiddenSpace space;
  // Half as many along each side, rounded up: most for a single row.
  const std::size_t most = cells / 2 + 1;
  space.begins_memory = arena.take<float>(most, "grasp cloud");
  space.behind_memory = arena.take<float>(most, "grasp cloud");
  space.rotations = arena.take<Matrix3>(HiddenSpace::turns, "grasp cloud");
  Chance chance(1);
  for (Matrix3& rotation : space.rotations) rotation = rotation_of(chance);
  return space;
}

void fill_hidden_space(const CloudMap& map, std::span<const Instance> instances, std::span<const Bank> banks,
                       HiddenSpace& space) {
  constexpr int step = HiddenSpace::step;
  constexpr float scale = 1.0F / step;
  constexpr float middle = 0.5F * (step - 1);
  space.camera = {(map.camera.width + step - 1) / step,
                  (map.camera.height + step - 1) / step,
                  map.camera.fx * scale,
                  map.camera.fy * scale,
                  (map.camera.cx - middle) * scale,
                  (map.camera.cy - middle) * scale};
  space.begins = space.begins_memory.first(space.camera.pixel_count());
  space.behind = space.behind_memory.first(space.camera.pixel_count());
  for (int v = 0; v < space.camera.height; ++v) {
    for (int u = 0; u < space.camera.width; ++u) {
      space.begins[space.camera.index(u, v)] = nearest_depth(map, u * step, v * step);
    }
  }
  std::fill(space.behind.begin(), space.behind.end(), 0.0F);
  visit_surfaces(instances, banks, space.camera,
                 [&](std::size_t cell, float depth) { space.behind[cell] = std::max(space.behind[cell], depth); });
  // Only where the instance itself was measured, its body is what hides the rest: the sign tells.
  visit_surfaces(instances, banks, space.camera, [&](std::size_t cell, float depth) {
    if (std::abs(depth - space.begins[cell]) <= same_surface) space.behind[cell] = -std::abs(space.behind[cell]);
  });
  for (std::size_t i = 0; i < space.begins.size(); ++i) {
    space.begins[i] = std::max(space.begins[i], -space.behind[i]) - slack;
  }
}

float hidden_part_clearance(float share, const CollisionParameters& parameters) {
  constexpr float one_pose = 1e-4F;
  return parameters.hidden_clearance * std::log10(1.0F + share / one_pose);
}

float hidden_part_share(const HiddenSpace& space, const Bank& bank, const BinWalls& walls,
                        const RigidTransform& camera_from_tool, const Gripper& gripper) {
  constexpr std::size_t needed = HiddenSpace::outline + HiddenSpace::anchors;
  if (bank.surface.size() < needed) return 0.0F;
  const HiddenPlaces places(space, walls);
  std::array<Vector3, 4 * steps_along*(maximum_tool_boxes + 3)> tried;
  std::size_t tried_count = 0;
  std::size_t all = 0;
  for (const GripperPiece& piece : gripper.all()) {
    if (!piece.touches_part) continue;
    const float length = std::min(tip_length, piece.box.upper.z() - piece.box.lower.z());
    for (int i = 0; i < 4 * steps_along; ++i) {
      Vector3 corner = piece.box.corner(static_cast<std::size_t>(i % 4) | 4U);
      corner.z() -= length * static_cast<float>(i / 4) / static_cast<float>(steps_along - 1);
      const Vector3 place = camera_from_tool * corner;
      ++all;
      if (places.hold(place)) tried[tried_count++] = place;
    }
  }
  if (tried_count == 0) return 0.0F;
  std::size_t hidden = 0;
  std::array<Vector3, HiddenSpace::outline> outline;
  for (const Matrix3& rotation : space.rotations) {
    for (std::size_t i = 0; i < outline.size(); ++i) outline[i] = rotation * bank.surface[i].position;
    for (std::size_t anchor = HiddenSpace::outline; anchor < needed; ++anchor) {
      const Vector3 laid = rotation * bank.surface[anchor].position;
      for (std::size_t i = 0; i < tried_count; ++i) {
        if (hides(places, outline, tried[i] - laid)) ++hidden;
      }
    }
  }
  const std::size_t poses = all * space.rotations.size() * HiddenSpace::anchors;
  return static_cast<float>(hidden) / static_cast<float>(poses);
}

}  // namespace graspd
