#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "drivers/plc/plc_link.hpp"
#include "drivers/plc/result_block.hpp"
#include "tests/collisions/pile_scene.hpp"
#include "tests/core/grasp/grasp_memory.hpp"

namespace graspd {

/// Piles of three parts in the bin of a camera whose parts count as detected: what is left of an answer is the choice
/// of a grasp.
class DetectedPiles {
 public:
  /// `parts`: detected ones of each pile; `picks`: wanted of each.
  DetectedPiles(std::size_t parts, std::size_t picks);

  /// The answer to a request, from the piles in turn. In place of the detection the caches are emptied as it leaves
  /// them: that is what the block has as the time of matching; `detection_seconds` is its processor time.
  [[nodiscard]] ResultBlock answer(const PlcRequest& request, double& detection_seconds);

 private:
  std::size_t picks_;
  std::array<HeldShape, 3> shapes_{held_block(), held_bar(), held_bracket()};
  std::array<PileScene, 3> scenes_;
  GraspMemory memory_;
  std::vector<std::uint8_t> other_memory_ = std::vector<std::uint8_t>(64U << 20U);
};

}  // namespace graspd
