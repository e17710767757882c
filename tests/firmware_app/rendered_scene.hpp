#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "core/bank/bank.hpp"
#include "core/geometry/depth_render.hpp"
#include "core/train/bank_builder.hpp"
#include "drivers/files/depth_image.hpp"

namespace graspd {

/// An angle bar, 60 x 40 x 25 mm with legs 8 mm thick: no pose looks like another.
inline Mesh angle_bar() {
  constexpr std::array<std::array<float, 2>, 6> profile{
      {{0, 0}, {0.040F, 0}, {0.040F, 0.008F}, {0.008F, 0.008F}, {0.008F, 0.025F}, {0, 0.025F}}};
  constexpr float length = 0.060F;
  Mesh mesh;
  for (const float x : {0.0F, length}) {
    for (const auto& [y, z] : profile) mesh.vertices.emplace_back(x, y, z);
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t j = (i + 1) % 6;
    mesh.triangles.push_back({i, i + 6, j});
    mesh.triangles.push_back({j, i + 6, j + 6});
  }
  constexpr std::array<Triangle, 4> cap{{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}};
  for (const Triangle& t : cap) {
    mesh.triangles.push_back({t[0], t[2], t[1]});
    mesh.triangles.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
  }
  return mesh;
}

/// A grasp on the standing leg, from above.
inline PartGrasp angle_bar_grasp() {
  PartGrasp grasp;
  grasp.part_from_tool.rotation.col(0) = Vector3::UnitY();
  grasp.part_from_tool.rotation.col(1) = Vector3::UnitX();
  grasp.part_from_tool.rotation.col(2) = -Vector3::UnitZ();
  grasp.part_from_tool.translation = Vector3(0.030F, 0.004F, 0.020F);
  grasp.opening = 0.020F;
  grasp.number = 1;
  return grasp;
}

/// A small bank of the angle bar, made in a second or so. Fails the program's test when it cannot be made.
inline std::vector<std::byte> angle_bar_bank(std::uint32_t part_id = 7, float sampling = 0.05F) {
  PartDescription part;
  part.name = "angle bar";
  part.part_id = part_id;
  part.mesh = angle_bar();
  part.symmetry_given = true;
  part.twins.emplace();
  part.grasps.push_back(angle_bar_grasp());
  BankBuildParameters build;
  build.candidate_views = 42;
  build.surface_points = 1024;
  build.sampling = sampling;
  BankReport report;
  Result<std::vector<std::byte>> bytes = build_bank(part, build, report, [](float) {});
  return bytes.ok() ? std::move(bytes).value() : std::vector<std::byte>{};
}

/// A table half a metre below the camera with angle bars on it.
struct RenderedScene {
  Camera camera{320, 240, 400.0F, 400.0F, 159.5F, 119.5F};
  std::vector<float> depth;
  std::vector<float> empty;
  std::vector<RigidTransform> poses;  ///< camera_from_part.
};

inline RenderedScene angle_bar_scene(std::size_t count = 2) {
  constexpr float table = 0.5F;
  RenderedScene scene;
  scene.empty.assign(scene.camera.pixel_count(), table);
  scene.depth = scene.empty;
  constexpr std::array<std::array<float, 3>, 3> places{
      {{-0.08F, -0.03F, 20}, {0.06F, 0.04F, 140}, {0.07F, -0.09F, 250}}};
  for (std::size_t i = 0; i < count; ++i) {
    const float angle = places[i][2] * std::numbers::pi_v<float> / 180;
    RigidTransform pose;
    // Part z towards the camera, turned about it.
    pose.rotation =
        (Eigen::AngleAxisf(angle, Vector3::UnitZ()) * Eigen::AngleAxisf(std::numbers::pi_v<float>, Vector3::UnitX()))
            .toRotationMatrix();
    pose.translation = Vector3(places[i][0], places[i][1], table);
    scene.poses.push_back(pose);
    draw_depth(angle_bar().view(), pose, scene.camera, scene.depth);
  }
  return scene;
}

/// Depth in tenths of a millimetre.
inline std::vector<std::uint16_t> as_file_values(const std::vector<float>& depth) {
  std::vector<std::uint16_t> values;
  for (const float z : depth) values.push_back(static_cast<std::uint16_t>(std::lround(z * 1e4F)));
  return values;
}

/// Writes `scene` as the BOP scene `root`/test/000001 with one image and an empty frame; returns its folder.
inline std::filesystem::path write_bop_scene(const std::filesystem::path& root, const RenderedScene& scene) {
  const std::filesystem::path folder = root / "test" / "000001";
  std::filesystem::create_directories(folder / "depth");
  std::filesystem::create_directories(folder / "empty");
  const auto write = [&](const std::filesystem::path& path, const std::vector<float>& depth) {
    return write_depth_png(path, scene.camera.width, scene.camera.height, as_file_values(depth)).ok();
  };
  if (!write(folder / "depth" / "000000.png", scene.depth)) return {};
  if (!write(folder / "empty" / "000000.png", scene.empty)) return {};
  std::ofstream(folder / "scene_camera.json")
      << R"({"0": {"cam_K": [400, 0, 159.5, 0, 400, 119.5, 0, 0, 1], "depth_scale": 0.1}})";
  return folder;
}

/// Writes the angle bar as an ASCII STL file in millimetres.
inline void write_angle_bar_stl(const std::filesystem::path& path) {
  std::ofstream file(path);
  const Mesh mesh = angle_bar();
  file << "solid bar\n";
  for (const Triangle& triangle : mesh.triangles) {
    file << "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t i : triangle) {
      const Vector3 v = mesh.vertices[i] * 1e3F;
      file << "vertex " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
    }
    file << "endloop\nendfacet\n";
  }
  file << "endsolid bar\n";
}

}  // namespace graspd
