#pragma once

#include "core/grasp/workspace.hpp"
#include "tests/core/memory/carved.hpp"

namespace graspd {

/// The memory of one choice of a grasp.
struct GraspMemory {
  explicit GraspMemory(const GraspCapacity& capacity = {})
      : workspace(carved_into(bytes, [&](Arena& arena) { return carve_grasp_workspace(arena, capacity); })) {}

  std::unique_ptr<std::byte[]> bytes;
  GraspWorkspace workspace;
};

}  // namespace graspd
