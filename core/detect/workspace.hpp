#pragma once

#include "core/detect/detections.hpp"
#include "core/detect/parameters.hpp"
#include "core/memory/arena.hpp"
#include "core/memory/fixed_vector.hpp"

namespace graspd {

/// All the memory that a detection writes to.
struct DetectWorkspace {
  DetectCapacity capacity;
  FixedVector<Instance> accepted;
  FixedVector<Instance> rejected;
};

/// Carves the memory of a detection for frames and banks up to `capacity`.
[[nodiscard]] DetectWorkspace carve_detect_workspace(Arena& arena, const DetectCapacity& capacity);

}  // namespace graspd
