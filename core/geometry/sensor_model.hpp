#pragma once

#include <cstdint>
#include <span>

#include "core/geometry/camera.hpp"
#include "core/geometry/mesh.hpp"
#include "core/geometry/rigid_transform.hpp"

namespace graspd {

/// What a camera with a projector beside it makes of surfaces: noise and the many reasons why a pixel
/// is not measured. All zero: perfect depth.
struct SensorModel {
  Vector3 projector = Vector3::Zero();  ///< Metres, camera frame; what it does not light is not measured.
  float noise = 0;  ///< Deviation along z (metres) on a surface met squarely at one metre; grows with z^2
                    ///< and with incidence.
  float maximum_incidence = 1.57F;  ///< Radians, to the camera or the projector: beyond it nothing is measured.
  float drop_out = 0;               ///< Share of the pixels lost in patches, more of them at grazing incidence.
  float gloss = 0;          ///< Radians around the mirror direction of projector and camera where pixels are lost.
  float flying_pixels = 0;  ///< Share of the pixels at depth steps that come out between the two surfaces.
  float stray_patches = 0;  ///< Share of the pixels that hold a wrong depth, in small patches.
};

/// How much a bin tries its sensor: `clean` about a tenth of the surface missing, `medium` a third, `hard` a half.
enum class SensorStrain : std::uint8_t { clean, medium, hard };

/// A structured-light sensor whose projector stands `baseline` metres to the left of the camera.
[[nodiscard]] SensorModel structured_light(SensorStrain strain, float baseline);

/// A mesh somewhere in front of the camera.
struct PosedMesh {
  MeshView mesh;
  RigidTransform camera_from_mesh;
};

/// Draws what the sensor measures of `scene` into `depth` (camera.pixel_count() values, metres along z, 0: not
/// measured). The same seed gives the same frame. Allocates.
void measure_scene(std::span<const PosedMesh> scene, const Camera& camera, const SensorModel& sensor,
                   std::uint64_t seed, std::span<float> depth);

/// As above, of depth that was rendered before: `ideal` as the camera would see it (0: nothing there). The projector's
/// shadows then come from the surfaces that the camera sees.
void measure_depth(std::span<const float> ideal, const Camera& camera, const SensorModel& sensor, std::uint64_t seed,
                   std::span<float> depth);

}  // namespace graspd
