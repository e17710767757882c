#include "firmware_app/memory_plan.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "firmware_app/detection_session.hpp"
#include "firmware_app/record_writer.hpp"

namespace graspd {
namespace {

/// Drawing works on the C library's heap, after the answer is out: the picture (enlarged up to twice),
/// its coloured depth, a depth image for occlusion and the PNG.
constexpr std::size_t picture_bytes_per_pixel = 40;

/// The same for a snapshot: 16-bit depth, rows for the encoder and the PNG.
constexpr std::size_t snapshot_bytes_per_pixel = 8;

}  // namespace

WorkingMemory carve_working_memory(Arena& arena, const WorkingCapacity& capacity) {
  WorkingMemory memory;
  memory.frame = arena.take<float>(capacity.frame_pixels, "frame");
  memory.detect = carve_detect_workspace(arena, capacity.detect);
  memory.grasp = carve_grasp_workspace(arena, capacity.grasp);
  memory.avoided = carve_avoid_list(arena);
  if (capacity.picture) {
    memory.pictured_frame = arena.take<float>(capacity.frame_pixels, "picture");
    memory.pictured_instances = arena.take<Instance>(capacity.detect.instances, "picture");
  }
  if (capacity.snapshots) memory.snapshot_frame = arena.take<float>(capacity.frame_pixels, "snapshot");
  return memory;
}

std::size_t recorded_instances(const WorkingCapacity& capacity) {
  return std::size_t{capacity.detect.instances} + capacity.detect.judged;
}

std::size_t MemoryPlan::total() const {
  std::size_t sum = 0;
  for (const Row& row : rows) sum += row.bytes;
  return sum;
}

void add_arena_rows(const Arena& arena, MemoryPlan& plan) {
  plan.arena_bytes += arena.used();
  for (const ArenaOwner& owner : arena.owners())
    plan.rows.push_back({"arena: " + std::string(owner.name), owner.bytes});
}

std::size_t resident_bytes() {
  std::size_t pages = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%*u %zu", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

MemoryPlan plan_memory(const Configuration& configuration, const LoadedBanks& banks, const FrameLimits& limits,
                       std::size_t recorded_bytes, std::size_t baseline) {
  MemoryPlan plan;
  plan.capacity.frame_pixels =
      static_cast<std::size_t>(limits.maximum_width) * static_cast<std::size_t>(limits.maximum_height);
  plan.capacity.detect = fitted_capacity(configuration.detect.capacity, limits, banks.banks);
  plan.capacity.grasp = configuration.grasp.capacity;
  plan.capacity.picture = !configuration.picture.empty();
  plan.capacity.snapshots = !configuration.snapshots.empty();

  Arena arena = Arena::measuring();
  static_cast<void>(carve_working_memory(arena, plan.capacity));
  add_arena_rows(arena, plan);
  plan.rows.push_back({"banks", banks.bytes()});
  if (recorded_bytes > 0) plan.rows.push_back({"camera or recorded frames", recorded_bytes});
  if (plan.capacity.picture) {
    plan.rows.push_back({"drawing the picture", plan.capacity.frame_pixels * picture_bytes_per_pixel});
  }
  if (plan.capacity.snapshots) {
    plan.rows.push_back({"writing snapshots", plan.capacity.frame_pixels * snapshot_bytes_per_pixel});
  }
  const bool records = !configuration.record.folder.empty();
  if (records) {
    plan.rows.push_back({"recording", record_bytes(plan.capacity.frame_pixels, recorded_instances(plan.capacity))});
  }
  // The worker is one of the detection's threads; beside them: Modbus, when wanted pictures, snapshots and recording,
  // and the camera with Aravis' two.
  const std::size_t threads = static_cast<std::size_t>(configuration.detect.parameters.threads) + 1 +
                              (plan.capacity.picture ? 1U : 0U) + (plan.capacity.snapshots ? 1U : 0U) +
                              (records ? 1U : 0U) + (configuration.camera.kind == CameraKind::genicam ? 3U : 0U);
  plan.rows.push_back({"thread stacks", threads * thread_stack_bytes});
  plan.rows.push_back({"program and libraries", baseline});
  return plan;
}

Status check_budget(const Configuration& configuration, const MemoryPlan& plan) {
  const std::size_t total = plan.total();
  if (total <= configuration.memory_budget) return {};
  const auto largest = std::max_element(plan.rows.begin(), plan.rows.end(),
                                        [](const auto& a, const auto& b) { return a.bytes < b.bytes; });
  return Status::format(StatusCode::memory_limit,
                        "%s: memory.budget is %.1f MiB, but %.1f MiB are needed, %.1f of them for %s; raise the budget "
                        "or lower [limits]",
                        configuration.path.c_str(), mebibytes(configuration.memory_budget), mebibytes(total),
                        mebibytes(largest->bytes), largest->name.c_str());
}

std::string memory_rows(const MemoryPlan& plan) {
  std::string table;
  char line[160];
  for (const MemoryPlan::Row& row : plan.rows) {
    std::snprintf(line, sizeof line, "%-32s %10.2f MiB\n", row.name.c_str(), mebibytes(row.bytes));
    table += line;
  }
  std::snprintf(line, sizeof line, "%-32s %10.2f MiB\n", "together", mebibytes(plan.total()));
  return table + line;
}

std::string memory_table(const MemoryPlan& plan, std::size_t budget) {
  char line[160];
  std::snprintf(line, sizeof line, "%-32s %10.2f MiB (memory.budget)\n", "allowed", mebibytes(budget));
  return memory_rows(plan) + line;
}

}  // namespace graspd
