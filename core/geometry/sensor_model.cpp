#include "core/geometry/sensor_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/geometry/chance.hpp"
#include "core/geometry/depth_render.hpp"

namespace graspd {

namespace {

/// Neighbouring pixels further apart than this share of their depth belong to two surfaces.
constexpr float depth_step = 0.01F;

enum Stream : std::uint64_t {
  white_noise = 1,
  slow_noise,
  coarse_patches,
  fine_patches,
  edges,
  stray_places,
  stray_depths
};

/// What the projector lights: its depth image, and how far it stands from the camera.
struct ProjectorView {
  Camera camera;
  std::vector<float> depth;
};

/// A camera at the projector with the same pixels, shifted and widened so that it sees what the camera sees.
ProjectorView projector_view(const Camera& camera, const SensorModel& sensor, float middle_depth) {
  ProjectorView view;
  view.camera = camera;
  const float shift_u = camera.fx * sensor.projector.x() / middle_depth;
  const float shift_v = camera.fy * sensor.projector.y() / middle_depth;
  const int margin = 32 + camera.width / 4;
  view.camera.width += 2 * margin;
  view.camera.height += 2 * margin;
  view.camera.cx += shift_u + static_cast<float>(margin);
  view.camera.cy += shift_v + static_cast<float>(margin);
  view.depth.assign(view.camera.pixel_count(), 0.0F);
  return view;
}

float median_depth(std::span<const float> ideal) {
  std::vector<float> seen;
  for (std::size_t i = 0; i < ideal.size(); i += 7) {
    if (ideal[i] > 0.0F) seen.push_back(ideal[i]);
  }
  if (seen.empty()) return 1.0F;
  const auto middle = seen.begin() + static_cast<std::ptrdiff_t>(seen.size() / 2);
  std::nth_element(seen.begin(), middle, seen.end());
  return *middle;
}

/// Evenly spread values at the knots of a square lattice, smoothly joined: in [0, 1], mean 1/2.
float lattice(std::uint64_t seed, Stream stream, float u, float v) {
  const auto column = static_cast<std::int64_t>(std::floor(u));
  const auto row = static_cast<std::int64_t>(std::floor(v));
  const auto knot = [&](std::int64_t i, std::int64_t j) {
    return unit_from(word_at(seed + stream, static_cast<std::uint64_t>(j * 65536 + i)));
  };
  const auto smooth = [](float t) { return t * t * (3.0F - 2.0F * t); };
  const float a = smooth(u - static_cast<float>(column));
  const float b = smooth(v - static_cast<float>(row));
  const float above = knot(column, row) * (1.0F - a) + knot(column + 1, row) * a;
  const float below = knot(column, row + 1) * (1.0F - a) + knot(column + 1, row + 1) * a;
  return above * (1.0F - b) + below * b;
}

/// One frame being measured.
class Measurement {
 public:
  Measurement(std::span<const float> ideal, const Camera& camera, const SensorModel& sensor, const ProjectorView& lit,
              std::uint64_t seed)
      : ideal_(ideal), camera_(camera), sensor_(sensor), lit_(lit), seed_(seed) {}

  [[nodiscard]] float pixel(int u, int v) const {
    const float z = ideal_[camera_.index(u, v)];
    if (z == 0.0F) return 0.0F;
    const std::uint64_t place = camera_.index(u, v);
    if (const float other = across_step(u, v, z); other > 0.0F) {
      const float chance = unit_from(word_at(seed_ + edges, place));
      if (chance < sensor_.flying_pixels) return z + (other - z) * (0.15F + 0.7F * chance / sensor_.flying_pixels);
    }
    const Vector3 point = camera_.point(static_cast<float>(u), static_cast<float>(v), z);
    const Vector3 to_camera = -point.normalized();
    const Vector3 to_projector = (sensor_.projector - point).normalized();
    const Vector3 normal = normal_at(u, v, z);
    const float facing = normal.dot(to_camera);
    const float facing_light = normal.dot(to_projector);
    const float least = std::cos(sensor_.maximum_incidence);
    if (facing < least || facing_light < least) return 0.0F;
    if (shadowed(point, facing_light)) return 0.0F;
    const Vector3 mirror = (to_camera + to_projector).normalized();
    const float fu = static_cast<float>(u);
    const float fv = static_cast<float>(v);
    // Two sizes of patches; their sum is about normal, and the logistic curve makes it even again.
    const float rough = 0.6F * lattice(seed_, coarse_patches, fu / 23.0F, fv / 23.0F) +
                        0.4F * lattice(seed_, fine_patches, fu / 7.0F, fv / 7.0F);
    const float rank = 1.0F / (1.0F + std::exp((0.5F - rough) / 0.092F));
    if (sensor_.gloss > 0.0F && std::acos(std::min(normal.dot(mirror), 1.0F)) < sensor_.gloss * (0.5F + rank))
      return 0.0F;
    const float grazing = 1.0F - std::min(facing, facing_light);
    if (rank < sensor_.drop_out * (0.5F + 1.6F * grazing)) return 0.0F;
    if (stray(fu, fv)) return z * (0.9F + 0.2F * unit_from(word_at(seed_ + stray_depths, cell(fu, fv))));
    const float deviation = sensor_.noise * z * z / std::max(facing, 0.25F);
    const float slow = 2.0F * lattice(seed_, slow_noise, fu / 3.0F, fv / 3.0F) - 1.0F;
    return z + deviation * (0.85F * normal_from(word_at(seed_ + white_noise, place)) + slow);
  }

 private:
  static std::uint64_t cell(float u, float v) {
    return static_cast<std::uint64_t>(v / 6.0F) * 65536U + static_cast<std::uint64_t>(u / 6.0F);
  }
  [[nodiscard]] bool stray(float u, float v) const {
    return unit_from(word_at(seed_ + stray_places, cell(u, v))) < sensor_.stray_patches;
  }

  /// The depth beyond a step to one of the four neighbours, 0 when there is none.
  [[nodiscard]] float across_step(int u, int v, float z) const {
    constexpr std::array<std::array<int, 2>, 4> sides{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    for (const auto& side : sides) {
      if (!camera_.contains(u + side[0], v + side[1])) continue;
      const float other = ideal_[camera_.index(u + side[0], v + side[1])];
      if (other > 0.0F && std::abs(other - z) > depth_step * z) return other;
    }
    return 0.0F;
  }

  /// The slope dz/du or dz/dv on the smoother side.
  [[nodiscard]] float slope(int u, int v, int du, int dv, float z) const {
    const auto step = [&](int sign) {
      const int nu = u + sign * du;
      const int nv = v + sign * dv;
      const float other = camera_.contains(nu, nv) ? ideal_[camera_.index(nu, nv)] : 0.0F;
      return other > 0.0F ? static_cast<float>(sign) * (other - z) : 1e9F;
    };
    const float forward = step(1);
    const float backward = step(-1);
    const float gentler = std::abs(forward) < std::abs(backward) ? forward : backward;
    return std::abs(gentler) > 1e8F ? 0.0F : gentler;
  }

  [[nodiscard]] Vector3 normal_at(int u, int v, float z) const {
    const float x = (static_cast<float>(u) - camera_.cx) / camera_.fx;
    const float y = (static_cast<float>(v) - camera_.cy) / camera_.fy;
    const float zu = slope(u, v, 1, 0, z);
    const float zv = slope(u, v, 0, 1, z);
    const Vector3 along_u(z / camera_.fx + x * zu, y * zu, zu);
    const Vector3 along_v(x * zv, z / camera_.fy + y * zv, zv);
    return along_v.cross(along_u).normalized();
  }

  [[nodiscard]] bool shadowed(const Vector3& point, float facing_light) const {
    const Vector3 from_projector = point - sensor_.projector;
    const Eigen::Vector2f pixel = lit_.camera.project(from_projector);
    const int u = static_cast<int>(std::lround(pixel.x()));
    const int v = static_cast<int>(std::lround(pixel.y()));
    if (!lit_.camera.contains(u, v)) return false;
    const float nearest = lit_.depth[lit_.camera.index(u, v)];
    // The pixel's centre lies up to 0.7 pixels off on the same slanted surface.
    const float slant = std::sqrt(std::max(0.0F, 1.0F - facing_light * facing_light)) / std::max(facing_light, 0.1F);
    const float tolerance = 5e-4F + from_projector.z() / lit_.camera.fx * (1.0F + slant);
    return nearest > 0.0F && from_projector.z() > nearest + tolerance;
  }

  std::span<const float> ideal_;
  const Camera& camera_;
  const SensorModel& sensor_;
  const ProjectorView& lit_;
  std::uint64_t seed_;
};

void measure(std::span<const float> ideal, const Camera& camera, const SensorModel& sensor, const ProjectorView& lit,
             std::uint64_t seed, std::span<float> depth) {
  const Measurement measurement(ideal, camera, sensor, lit, mixed(seed));
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) depth[camera.index(u, v)] = measurement.pixel(u, v);
  }
}

}  // namespace

SensorModel structured_light(SensorStrain strain, float baseline) {
  SensorModel sensor;
  sensor.projector = Vector3(-baseline, 0, 0);
  switch (strain) {
    case SensorStrain::clean:
      sensor.noise = 1.0e-4F;
      sensor.maximum_incidence = 1.36F;
      sensor.drop_out = 0.03F;
      sensor.flying_pixels = 0.02F;
      break;
    case SensorStrain::medium:
      sensor.noise = 2.0e-4F;
      sensor.maximum_incidence = 1.27F;
      sensor.drop_out = 0.22F;
      sensor.gloss = 0.1F;
      sensor.flying_pixels = 0.08F;
      sensor.stray_patches = 0.003F;
      break;
    case SensorStrain::hard:
      sensor.noise = 3.5e-4F;
      sensor.maximum_incidence = 1.17F;
      sensor.drop_out = 0.42F;
      sensor.gloss = 0.16F;
      sensor.flying_pixels = 0.15F;
      sensor.stray_patches = 0.006F;
      break;
  }
  return sensor;
}

void measure_scene(std::span<const PosedMesh> scene, const Camera& camera, const SensorModel& sensor,
                   std::uint64_t seed, std::span<float> depth) {
  std::vector<float> ideal(camera.pixel_count(), 0.0F);
  for (const PosedMesh& item : scene) draw_depth(item.mesh, item.camera_from_mesh, camera, ideal);
  ProjectorView lit = projector_view(camera, sensor, median_depth(ideal));
  for (const PosedMesh& item : scene) {
    RigidTransform projector_from_mesh = item.camera_from_mesh;
    projector_from_mesh.translation -= sensor.projector;
    draw_depth(item.mesh, projector_from_mesh, lit.camera, lit.depth);
  }
  measure(ideal, camera, sensor, lit, seed, depth);
}

void measure_depth(std::span<const float> ideal, const Camera& camera, const SensorModel& sensor, std::uint64_t seed,
                   std::span<float> depth) {
  ProjectorView lit = projector_view(camera, sensor, median_depth(ideal));
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const float z = ideal[camera.index(u, v)];
      if (z == 0.0F) continue;
      const Vector3 point = camera.point(static_cast<float>(u), static_cast<float>(v), z) - sensor.projector;
      if (point.z() < near_plane) continue;
      const Eigen::Vector2f pixel = lit.camera.project(point);
      const int lit_u = static_cast<int>(std::lround(pixel.x()));
      const int lit_v = static_cast<int>(std::lround(pixel.y()));
      if (!lit.camera.contains(lit_u, lit_v)) continue;
      float& nearest = lit.depth[lit.camera.index(lit_u, lit_v)];
      nearest = nearest == 0.0F ? point.z() : std::min(nearest, point.z());
    }
  }
  measure(ideal, camera, sensor, lit, seed, depth);
}

}  // namespace graspd
