#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/detect/workspace.hpp"
#include "core/grasp/avoid_list.hpp"
#include "core/grasp/workspace.hpp"
#include "core/memory/arena.hpp"
#include "drivers/camera/frame_source.hpp"
#include "firmware_app/configuration.hpp"
#include "firmware_app/loaded_banks.hpp"

namespace graspd {

/// The bounds that fix how much memory the daemon writes to.
struct WorkingCapacity {
  std::size_t frame_pixels = 0;
  DetectCapacity detect;
  GraspCapacity grasp;
  bool picture = false;    ///< Keep a copy of the last answer for the annotated picture.
  bool snapshots = false;  ///< Keep a copy of the frame for a snapshot.
};

/// All the memory that the daemon writes to between a trigger and the registers.
struct WorkingMemory {
  std::span<float> frame;
  DetectWorkspace detect;
  GraspWorkspace grasp;
  AvoidList avoided;
  std::span<float> pictured_frame;
  std::span<Instance> pictured_instances;
  std::span<float> snapshot_frame;
};

/// Carves it; on a measuring arena only counts.
[[nodiscard]] WorkingMemory carve_working_memory(Arena& arena, const WorkingCapacity& capacity);

/// What the daemon will take, row by row.
struct MemoryPlan {
  struct Row {
    std::string name;
    std::size_t bytes = 0;
  };
  std::vector<Row> rows;
  std::size_t arena_bytes = 0;
  WorkingCapacity capacity;

  [[nodiscard]] std::size_t total() const;
};

/// Adds what each owner takes of `arena`.
void add_arena_rows(const Arena& arena, MemoryPlan& plan);

/// Memory of this process that is resident now (bytes): to be asked before anything is loaded.
[[nodiscard]] std::size_t resident_bytes();

/// Stack of each thread of the daemon. Small, since a locked stack is resident whether used or not.
inline constexpr std::size_t thread_stack_bytes = std::size_t{2} << 20U;

/// Room for the instances of one answer, found or rejected.
[[nodiscard]] std::size_t recorded_instances(const WorkingCapacity& capacity);

/// Plans the memory of `graspd run` for this configuration. `baseline` is resident_bytes() of the bare
/// process, `recorded_bytes` what a recorded source keeps.
[[nodiscard]] MemoryPlan plan_memory(const Configuration& configuration, const LoadedBanks& banks,
                                     const FrameLimits& limits, std::size_t recorded_bytes, std::size_t baseline);

/// Fails with memory_limit when the plan exceeds the configured budget: says by how much and what to do.
[[nodiscard]] Status check_budget(const Configuration& configuration, const MemoryPlan& plan);

[[nodiscard]] constexpr double mebibytes(std::size_t bytes) { return static_cast<double>(bytes) / (1024.0 * 1024.0); }

/// The plan as a table for a person: its rows and their sum,
[[nodiscard]] std::string memory_rows(const MemoryPlan& plan);
/// and what is allowed.
[[nodiscard]] std::string memory_table(const MemoryPlan& plan, std::size_t budget);

}  // namespace graspd
