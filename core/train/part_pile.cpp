#include "core/train/part_pile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/geometry/chance.hpp"
#include "core/train/resting_poses.hpp"
#include "core/train/surface_sampling.hpp"

namespace graspd {

namespace {

constexpr std::size_t shape_points = 3000;
constexpr float cells_per_diameter = 40.0F;
constexpr int settling_steps = 160;
constexpr float infinitely_high = 1e6F;

/// How high the pile stands over each cell of the bin's floor; beyond the walls nothing can lie.
class HeightMap {
 public:
  HeightMap(const PileBin& bin, float cell)
      : bin_(bin),
        cell_(cell),
        columns_(1 + static_cast<int>(2.0F * bin.half_width / cell)),
        rows_(1 + static_cast<int>(2.0F * bin.half_length / cell)),
        heights_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0.0F) {}

  [[nodiscard]] float at(float x, float y) const {
    if (std::abs(x) >= bin_.half_width || std::abs(y) >= bin_.half_length) return infinitely_high;
    return heights_[index(x, y)];
  }
  void raise(const Vector3& point) {
    if (std::abs(point.x()) >= bin_.half_width || std::abs(point.y()) >= bin_.half_length) return;
    float& height = heights_[index(point.x(), point.y())];
    height = std::max(height, point.z());
  }

 private:
  [[nodiscard]] std::size_t index(float x, float y) const {
    const int column = std::clamp(static_cast<int>((x + bin_.half_width) / cell_), 0, columns_ - 1);
    const int row = std::clamp(static_cast<int>((y + bin_.half_length) / cell_), 0, rows_ - 1);
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }

  PileBin bin_;
  float cell_;
  int columns_;
  int rows_;
  std::vector<float> heights_;
};

Matrix3 turn(const Vector3& axis, float angle) { return Eigen::AngleAxisf(angle, axis).toRotationMatrix(); }

Vector3 any_direction(Chance& chance) {
  const float z = chance.between(-1.0F, 1.0F);
  const float angle = chance.between(0.0F, 2.0F * std::numbers::pi_v<float>);
  const float radius = std::sqrt(1.0F - z * z);
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// The shortest turn that points `direction`, of unit length, upwards.
Matrix3 upright(const Vector3& direction) {
  constexpr float straight_down = -0.99999F;
  const float cosine = direction.z();
  if (cosine < straight_down) return turn(Vector3::UnitX(), std::numbers::pi_v<float>);
  // The quaternion of half the angle; Eigen's own way to it decomposes a matrix, which takes long to compile.
  const float twice = std::sqrt(2.0F * (1.0F + cosine));
  const Vector3 axis = direction.cross(Vector3::UnitZ()) / twice;
  return Eigen::Quaternionf(0.5F * twice, axis.x(), axis.y(), axis.z()).toRotationMatrix();
}

Matrix3 any_rotation(Chance& chance) {
  const Vector3 up = any_direction(chance);
  return turn(Vector3::UnitZ(), chance.between(0.0F, 2.0F * std::numbers::pi_v<float>)) * upright(up);
}

/// Lays the part, turned by `rotation` with its centre over (x, y), on the pile.
RigidTransform dropped(const PileShape& shape, const HeightMap& map, const Matrix3& rotation, float x, float y) {
  RigidTransform pose{rotation, Vector3(x, y, 0) - rotation * shape.centre};
  float lift = -infinitely_high;
  for (const Vector3& point : shape.points) {
    const Vector3 place = pose * point;
    lift = std::max(lift, map.at(place.x(), place.y()) - place.z());
  }
  pose.translation.z() += lift;
  return pose;
}

RigidTransform settled(const PileShape& shape, const HeightMap& map, const PileBin& bin, Chance& chance) {
  Matrix3 rotation = any_rotation(chance);
  float x = 0.7F * chance.between(-bin.half_width, bin.half_width);
  float y = 0.7F * chance.between(-bin.half_length, bin.half_length);
  RigidTransform pose = dropped(shape, map, rotation, x, y);
  for (int i = 0; i < settling_steps; ++i) {
    const float left = 1.0F - static_cast<float>(i) / settling_steps;
    // One draw a statement: compilers differ in which argument of a call comes first.
    const float angle = 0.6F * left * left * chance.unit();
    const Matrix3 tried_rotation = turn(any_direction(chance), angle) * rotation;
    const float tried_x = x + 0.2F * left * shape.diameter * chance.normal();
    const float tried_y = y + 0.2F * left * shape.diameter * chance.normal();
    const RigidTransform tried = dropped(shape, map, tried_rotation, tried_x, tried_y);
    if ((tried * shape.centre).z() >= (pose * shape.centre).z()) continue;
    pose = tried;
    rotation = tried_rotation;
    x = tried_x;
    y = tried_y;
  }
  pose.rotation = orthonormalised(pose.rotation);
  return pose;
}

}  // namespace

PileShape pile_shape(const Mesh& mesh, bool closed) {
  PileShape shape;
  for (const OrientedPoint& point : sample_surface(mesh, {}, shape_points)) shape.points.push_back(point.position);
  shape.centre = centre_of_mass(mesh, closed);
  Vector3 low = Vector3::Constant(std::numeric_limits<float>::infinity());
  Vector3 high = -low;
  for (const Vector3& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  shape.diameter = (high - low).norm();
  return shape;
}

std::vector<PiledPart> pile_parts(std::span<const PileShape> shapes, std::size_t count, const PileBin& bin,
                                  std::uint64_t seed) {
  Chance chance(seed);
  float finest = std::numeric_limits<float>::infinity();
  for (const PileShape& shape : shapes) finest = std::min(finest, shape.diameter);
  HeightMap map(bin, finest / cells_per_diameter);
  std::vector<PiledPart> pile;
  for (std::size_t i = 0; i < count; ++i) {
    const auto which =
        std::min(static_cast<std::size_t>(chance.unit() * static_cast<float>(shapes.size())), shapes.size() - 1);
    const PileShape& shape = shapes[which];
    const RigidTransform pose = settled(shape, map, bin, chance);
    for (const Vector3& point : shape.points) map.raise(pose * point);
    pile.push_back({which, pose});
  }
  return pile;
}

}  // namespace graspd
