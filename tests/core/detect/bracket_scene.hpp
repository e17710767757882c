#pragma once

#include <array>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "core/bank/bank.hpp"
#include "core/detect/detector.hpp"
#include "core/geometry/depth_frame.hpp"
#include "core/geometry/depth_render.hpp"
#include "core/train/bank_builder.hpp"
#include "tests/core/memory/carved.hpp"

namespace graspd {

/// An L-shaped bracket: legs of 60 and 40 mm, 6 mm thick, 30 mm deep. No turn carries it onto itself.
inline Mesh bracket_mesh() {
  constexpr std::array<std::array<float, 2>, 6> outline{
      {{0.0F, 0.0F}, {0.060F, 0.0F}, {0.060F, 0.006F}, {0.006F, 0.006F}, {0.006F, 0.040F}, {0.0F, 0.040F}}};
  Mesh mesh;
  for (const float z : {0.0F, 0.030F}) {
    for (const auto& corner : outline) mesh.vertices.emplace_back(corner[0], corner[1], z);
  }
  for (const Triangle& face : {Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{0, 3, 4}, Triangle{0, 4, 5}}) {
    mesh.triangles.push_back({face[0], face[2], face[1]});
    mesh.triangles.push_back({face[0] + 6, face[1] + 6, face[2] + 6});
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t j = (i + 1) % 6;
    mesh.triangles.push_back({i, j, j + 6});
    mesh.triangles.push_back({i, j + 6, i + 6});
  }
  return mesh;
}

/// A bank of the bracket, made from its mesh, to be held by the upright leg.
class BracketBank {
 public:
  explicit BracketBank(const BankBuildParameters& parameters = {}) {
    PartDescription part;
    part.name = "bracket";
    part.part_id = 1;
    part.mesh = bracket_mesh();
    part.symmetry_given = true;
    part.twins.emplace();
    RigidTransform tool;
    tool.rotation << 1.0F, 0.0F, 0.0F, 0.0F, -1.0F, 0.0F, 0.0F, 0.0F, -1.0F;
    tool.translation = Vector3(0.003F, 0.020F, 0.025F);
    part.grasps.push_back({tool, 0.014F, 0, 1});
    BankReport report;
    Result<std::vector<std::byte>> built = build_bank(part, parameters, report, [](float) {});
    if (!built.ok()) std::abort();
    file_ = std::move(built.value());
    Result<Bank> read = read_bank(file_, "bracket");
    if (!read.ok()) std::abort();
    bank_ = read.value();
  }
  [[nodiscard]] const Bank& bank() const { return bank_; }

 private:
  std::vector<std::byte> file_;
  Bank bank_;
};

/// Six brackets on a floor across the optical axis: some on their side, some on a leg, two of them touching.
struct BracketScene {
  Camera camera;
  std::vector<RigidTransform> poses;
  std::vector<float> depth;

  explicit BracketScene(const Camera& seen_by = {400, 300, 500.0F, 500.0F, 199.5F, 149.5F})
      : camera(seen_by), depth(camera.pixel_count(), floor) {
    const auto turn = [](float angle, const Vector3& axis) {
      return Eigen::AngleAxisf(angle, axis).toRotationMatrix();
    };
    const Matrix3 on_its_side = turn(3.14159265F, Vector3::UnitX());
    const Matrix3 on_its_leg = turn(-1.57079633F, Vector3::UnitX());
    const auto lay = [&](float x, float y, float yaw, const Matrix3& rest) {
      poses.push_back({turn(yaw, Vector3::UnitZ()) * rest, Vector3(x, y, floor)});
    };
    lay(-0.12F, -0.06F, 0.3F, on_its_side);
    lay(0.00F, -0.08F, 1.9F, on_its_side);
    lay(0.10F, -0.03F, -2.4F, on_its_side);
    lay(-0.10F, 0.07F, 0.8F, on_its_leg);
    lay(0.03F, 0.03F, -0.4F, on_its_leg);
    lay(0.12F, 0.08F, 2.6F, on_its_leg);
    const Mesh mesh = bracket_mesh();
    for (const RigidTransform& pose : poses) draw_depth(mesh.view(), pose, camera, depth);
  }
  /// Leaves the three brackets to the right, in a quarter of the frame.
  void crop() {
    constexpr int left = 180;
    constexpr int top = 95;
    const Camera whole = camera;
    camera = {200, 150, whole.fx, whole.fy, whole.cx - left, whole.cy - top};
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) depth[camera.index(u, v)] = depth[whole.index(u + left, v + top)];
    }
    depth.resize(camera.pixel_count());
    poses = {poses[2], poses[4], poses[5]};
  }
  [[nodiscard]] DepthFrame frame() { return {camera, depth, 0, 0}; }

  static constexpr float floor = 0.55F;
};

/// The memory of one detection.
struct DetectMemory {
  explicit DetectMemory(int threads) {
    DetectCapacity capacity;
    capacity.maximum_width = 400;
    capacity.maximum_height = 300;
    capacity.threads = threads;
    workspace = carved_into(bytes, [&](Arena& arena) { return carve_detect_workspace(arena, capacity); });
  }
  std::unique_ptr<std::byte[]> bytes;
  DetectWorkspace workspace;
};

}  // namespace graspd
