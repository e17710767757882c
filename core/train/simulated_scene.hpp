#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/depth_frame.hpp"
#include "core/geometry/sensor_model.hpp"
#include "core/train/part_pile.hpp"

namespace graspd {

/// A part that lies in simulated bins.
struct SimulatedPart {
  Mesh mesh;        ///< Metres; every vertex once.
  PileShape shape;  ///< Of the same mesh.
};
[[nodiscard]] SimulatedPart simulated_part(const Mesh& mesh, bool closed);

/// What is to be simulated.
struct SceneRecipe {
  std::size_t instances = 10;
  SensorStrain strain = SensorStrain::medium;
  float sensor_distance = 0.75F;     ///< Metres, from the sensor to the bin's floor.
  float pixels_along_part = 150.0F;  ///< Along the smallest part, at that distance.
  float pixel_pitch = 0.0F;          ///< Metres between pixels there instead; 0: as the pixels along the part say.
  int maximum_width = 1280;          ///< Pixels; the pitch grows where the bin would not fit in.
  int maximum_height = 960;
  float layers = 1.5F;  ///< How deep the parts lie, on average.
  float rim = 0.0F;     ///< How thick the bin's walls are (metres): so broad is the ledge on top of them.
  std::uint64_t seed = 1;
  /// Where the sensor stands, and the frame of the empty bin: for several scenes that one sensor sees. Else by `seed`.
  std::optional<std::uint64_t> setting_seed;
};

/// An instance that is known to be there.
struct SimulatedInstance {
  std::size_t part = 0;  ///< Index into the parts.
  RigidTransform camera_from_part;
  float visibility = 0;  ///< Measured share of the pixels that it would cover alone.
};

/// A frame of parts in a bin, with what is true of it.
struct SimulatedScene {
  Camera camera;
  std::vector<float> depth;        ///< Metres, 0: not measured.
  std::vector<float> empty_depth;  ///< The same bin without parts.
  std::vector<SimulatedInstance> instances;

  [[nodiscard]] DepthFrame frame() { return {camera, depth, 0, 0}; }
  [[nodiscard]] DepthFrame empty_bin() { return {camera, empty_depth, 0, 0}; }
};

/// Piles the parts (at least one) in a bin that suits them and measures them with a structured-light sensor above it,
/// a little off the vertical. The same recipe gives the same scene.
[[nodiscard]] SimulatedScene simulate_scene(std::span<const SimulatedPart> parts, const SceneRecipe& recipe);

}  // namespace graspd
