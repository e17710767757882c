#include "tests/benchmarks/stranger_shapes.hpp"

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace graspd {

namespace {

using ProfilePoint = Eigen::Vector2f;  ///< Radius and height.

/// What the closed line `profile` leaves when it turns about z.
Mesh lathed(std::span<const ProfilePoint> profile, std::uint32_t sides) {
  Mesh mesh;
  const auto count = static_cast<std::uint32_t>(profile.size());
  for (std::uint32_t side = 0; side < sides; ++side) {
    const float angle = 2.0F * std::numbers::pi_v<float> * static_cast<float>(side) / static_cast<float>(sides);
    for (const ProfilePoint& point : profile)
      mesh.vertices.emplace_back(point.x() * std::cos(angle), point.x() * std::sin(angle), point.y());
  }
  for (std::uint32_t side = 0; side < sides; ++side) {
    const std::uint32_t next = (side + 1) % sides;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t k = (i + 1) % count;
      mesh.triangles.push_back({side * count + i, next * count + i, next * count + k});
      mesh.triangles.push_back({side * count + i, next * count + k, side * count + k});
    }
  }
  return mesh;
}

void add_box(const Vector3& low, const Vector3& high, Mesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::uint32_t i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back((i & 1U) != 0 ? high.x() : low.x(), (i & 2U) != 0 ? high.y() : low.y(),
                               (i & 4U) != 0 ? high.z() : low.z());
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> sides{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : sides) {
    mesh.triangles.push_back({first + a, first + b, first + c});
    mesh.triangles.push_back({first + a, first + c, first + d});
  }
}

/// A long profile of flat bars: an angle, a T or a channel.
Mesh profile_of_bars(Chance& chance) {
  Mesh mesh;
  const float length = chance.between(0.4F, 1.0F);
  const float width = chance.between(0.2F, 0.6F);
  const float height = chance.between(0.2F, 0.6F);
  const float wall = chance.between(0.03F, 0.1F);
  add_box({0, 0, 0}, {width, wall, length}, mesh);
  const float kind = chance.unit();
  const float stem = kind < 0.4F ? 0.0F : kind < 0.7F ? 0.5F * (width - wall) : width - wall;
  add_box({stem, 0, 0}, {stem + wall, height, length}, mesh);
  if (kind >= 0.85F) add_box({0, 0, 0}, {wall, height, length}, mesh);
  return mesh;
}

Mesh ball(Chance& chance) {
  constexpr int steps = 16;
  std::vector<ProfilePoint> profile;
  const float squash = chance.between(0.5F, 1.0F);
  for (int i = 0; i <= steps; ++i) {
    const float angle = std::numbers::pi_v<float> * (static_cast<float>(i) / steps - 0.5F);
    profile.emplace_back(std::cos(angle), squash * std::sin(angle));
  }
  return lathed(profile, 32);
}

Mesh bottle(Chance& chance) {
  const float body = chance.between(0.15F, 0.35F);
  const float neck = body * chance.between(0.2F, 0.7F);
  const float shoulder = chance.between(0.5F, 0.75F);
  const float throat = shoulder + chance.between(0.05F, 0.2F);
  const std::array<ProfilePoint, 6> profile{ProfilePoint(0, 0),       {body, 0}, {body, shoulder}, {neck, throat},
                                            ProfilePoint(neck, 1.0F), {0, 1.0F}};
  return lathed(profile, 40);
}

Mesh tube(Chance& chance) {
  const float height = chance.between(0.05F, 1.2F);
  const float inner = chance.between(0.3F, 0.9F);
  const std::array<ProfilePoint, 4> profile{
      ProfilePoint(0.5F * inner, 0), {0.5F, 0}, {0.5F, height}, ProfilePoint(0.5F * inner, height)};
  return lathed(profile, 40);
}

/// A round or cornered rod, disc or cone.
Mesh rod(Chance& chance) {
  const float height = std::pow(10.0F, chance.between(-1.2F, 0.7F));
  const float top = chance.unit() < 0.7F ? 1.0F : chance.between(0.1F, 0.9F);
  const std::array<ProfilePoint, 4> profile{ProfilePoint(0, 0), {0.5F, 0}, {0.5F * top, height}, {0, height}};
  return lathed(profile, chance.unit() < 0.7F ? 40U : 6U);
}

}  // namespace

Mesh stranger_shape(Chance& chance, float diameter) {
  Mesh mesh;
  switch (chance.word() % 6U) {
    case 0:
      add_box(Vector3::Zero(), {1.0F, chance.between(0.2F, 1.0F), chance.between(0.05F, 0.8F)}, mesh);
      break;
    case 1:
      mesh = profile_of_bars(chance);
      break;
    case 2:
      mesh = ball(chance);
      break;
    case 3:
      mesh = bottle(chance);
      break;
    case 4:
      mesh = tube(chance);
      break;
    default:
      mesh = rod(chance);
      break;
  }
  Vector3 low = mesh.vertices.front();
  Vector3 high = low;
  for (const Vector3& vertex : mesh.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  const float scale = diameter / (high - low).norm();
  for (Vector3& vertex : mesh.vertices) vertex *= scale;
  return mesh;
}

}  // namespace graspd
