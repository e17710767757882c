#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/sensor_model.hpp"
#include "core/status.hpp"
#include "drivers/files/loaded_frame.hpp"

namespace graspd {

/// Which scenes a simulated camera is to see.
struct PileOptions {
  std::vector<std::string> parts;  ///< Meshes in millimetres, part files or banks.
  int scenes = 10;
  int instances = 12;  ///< In each scene.
  SensorStrain strain = SensorStrain::medium;
  double distance = 750.0;  ///< Millimetres, from the sensor to the bin's floor.
  double pixels = 150.0;    ///< Along the smallest part; fewer where the bin would not fit into 1280x960.
  std::uint64_t seed = 1;
  double step = 0.1;  ///< Millimetres; the sensor measures whole steps.
  std::string save;   ///< Scene folder in BOP's form for frames, empty bin and true poses; empty: nowhere.
};

/// Piles of the parts in one bin before one sensor, each scene another pile; all with the same empty bin. The same
/// options give the same frames. Fails as the readers of parts do, and with cannot_write.
[[nodiscard]] Result<std::vector<LoadedFrame>> simulate_piles(const PileOptions& options);

}  // namespace graspd
