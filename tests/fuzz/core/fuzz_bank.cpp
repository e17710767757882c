#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "core/bank/bank.hpp"
#include "core/bank/bank_format.hpp"
#include "core/detect/detector.hpp"
#include "core/geometry/depth_render.hpp"
#include "core/grasp/planner.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/fuzz/small_bank.hpp"

namespace graspd {
namespace {

/// The input as a list of damages to a whole bank: two bytes of place, one of length, then the bytes to write there.
void apply_damages(std::span<const std::uint8_t> input, std::vector<std::byte>& file) {
  while (input.size() > 3) {
    const std::size_t place = (input[0] | std::size_t{input[1]} << 8U) % file.size();
    const std::size_t length = std::min({std::size_t{input[2]} % 16 + 1, input.size() - 3, file.size() - place});
    std::memcpy(file.data() + place, input.data() + 3, length);
    input = input.subspan(3 + length);
  }
}

/// Puts size and checksum right, so that the damage is met by the checks behind them.
void repair_header(std::vector<std::byte>& file) {
  const std::uint64_t size = file.size();
  std::memcpy(file.data() + offsetof(BankHeader, file_size), &size, sizeof(size));
  const std::uint64_t checksum = bank_checksum(file);
  std::memcpy(file.data() + offsetof(BankHeader, checksum), &checksum, sizeof(checksum));
}

DetectCapacity small_capacity() {
  DetectCapacity capacity;
  capacity.maximum_width = 48;
  capacity.maximum_height = 36;
  capacity.map_cells = 48 * 36;
  capacity.scene_points = 500;
  capacity.hypotheses = 600;
  capacity.clusters = 100;
  capacity.judged = 20;
  capacity.instances = 5;
  capacity.maximum_references = 64;
  capacity.maximum_cells = 4096;
  return capacity;
}

/// Does with the bank what the pipeline does, where a wrong index or number would show.
void use(const Bank& bank) {
  std::uint64_t sum = 0;
  for (std::size_t cell = 0; cell + 1 < bank.cell_offsets.size(); ++cell) {
    for (std::uint32_t i = bank.cell_offsets[cell]; i < bank.cell_offsets[cell + 1]; ++i) {
      sum += bank.reference_points[bank.entries[i].reference()] + bank.reference_views[bank.entries[i].reference()];
    }
  }
  for (const BankView& view : bank.views) {
    for (const std::uint64_t word : bank.visibility.row(view.direction)) sum += word;
  }
  if (sum == 1 && bank.part->name_view().size() > 64) std::abort();

  static std::vector<float> depth(48UL * 36UL);
  static std::vector<std::byte> memory(1U << 24U);
  const DepthFrame frame{{48, 36, 60.0F, 60.0F, 23.5F, 17.5F}, depth, 0, 0};
  Instance instance;
  instance.camera_from_part.translation = Vector3(0.0F, 0.0F, 0.1F);
  std::fill(depth.begin(), depth.end(), 0.12F);
  draw_depth(bank.mesh, instance.camera_from_part, frame.camera, depth);

  Arena arena(memory);
  DetectWorkspace detect_workspace = carve_detect_workspace(arena, small_capacity());
  GraspWorkspace grasp_workspace = carve_grasp_workspace(arena, {});
  if (arena.exhausted()) std::abort();
  DetectRequest request;
  request.banks = {&bank, 1};
  request.minimum_score = 0.0F;
  Detections detections;
  if (!detect(frame, request, {}, detect_workspace, detections).ok()) return;
  for (const Instance& found : detections.instances) {
    if (!found.camera_from_part.translation.allFinite() || !(found.score >= 0.0F)) std::abort();
  }
  if (detections.instances.empty()) detections.instances = {&instance, 1};
  const PickResult result = choose_pick(frame, detections, request.banks, {}, grasp_workspace);
  if (result.found && !result.best.robot_from_tool.translation.allFinite()) std::abort();
}

}  // namespace
}  // namespace graspd

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace graspd;
  if (size == 0) return 0;
  static const std::vector<std::byte> whole = small_bank_file();
  const std::span<const std::uint8_t> input(data + 1, size - 1);
  std::vector<std::byte> file;
  if (*data == 0) {
    const auto bytes = std::as_bytes(input);
    file.assign(bytes.begin(), bytes.end());
  } else {
    file = whole;
    apply_damages(input, file);
    if (*data % 2 == 1) repair_header(file);
  }
  const Result<Bank> bank = read_bank(file, "fuzzed");
  if (bank.ok()) use(bank.value());
  if (size == 1 && *data == 1 && !bank.ok()) std::abort();
  return 0;
}
