#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>

#include "core/grasp/candidates.hpp"
#include "drivers/files/atomic_file.hpp"
#include "firmware_app/commands.hpp"
#include "firmware_app/configuration.hpp"
#include "firmware_app/frame_sources.hpp"
#include "firmware_app/loaded_banks.hpp"
#include "firmware_app/memory_plan.hpp"

namespace graspd {
namespace {

/// Which tool takes each grasp: that is fixed, so that a PLC which changes tools knows it from part and grasp.
void print_grasps(const Bank& bank, const ToolSet& tools) {
  for (const PartGrasp& grasp : bank.grasps) {
    GraspRejection reason = GraspRejection::none;
    const std::uint32_t tool = tool_for(tools, grasp, reason);
    if (tool < tools.count) {
      std::printf("               grasp %u: tool %u\n", grasp.number, tools.tools[tool].number);
    } else {
      std::printf("               note: grasp %u will never be used: %s\n", grasp.number,
                  reason == GraspRejection::opening ? "no tool opens that wide" : "no tool is of its kind and number");
    }
  }
}

void print_banks(const LoadedBanks& banks, const ToolSet& tools) {
  for (std::size_t i = 0; i < banks.banks.size(); ++i) {
    const Bank& bank = banks.banks[i];
    std::printf("bank           %s: part %u, %.*s, %zu views, %zu grasps\n", banks.paths[i].c_str(), bank.part->part_id,
                static_cast<int>(bank.part->name_view().size()), bank.part->name_view().data(), bank.views.size(),
                bank.grasps.size());
    print_grasps(bank, tools);
    if (bank.grasps.empty()) {
      std::printf("               note: its part file lists no [[grasp]], so it will be found but never picked\n");
    }
  }
}

/// Half of WatchdogSec in graspd.service.
constexpr std::int64_t longest_camera_timeout_ns = 15'000'000'000;

void print_frames(const CameraSettings& camera, const FrameLimits& limits) {
  std::printf("frames         up to %d x %d pixels\n", limits.maximum_width, limits.maximum_height);
  if (camera.kind != CameraKind::genicam || camera.genicam.timeout_ns <= longest_camera_timeout_ns) return;
  std::printf(
      "               note: camera.timeout is %.1f s: graspd.service with its WatchdogSec of 30 s will not start\n",
      static_cast<double>(camera.genicam.timeout_ns) * 1e-9);
}

Status check(const std::string& path) {
  const std::size_t baseline = resident_bytes();
  const Result<Configuration> read = read_configuration(path);
  if (!read.ok()) return read.status();
  const Configuration& configuration = read.value();
  std::printf("configuration  %s: fine\n", path.c_str());
  const Result<LoadedBanks> banks = load_banks(configuration.banks);
  if (!banks.ok()) return banks.status();
  print_banks(banks.value(), configuration.grasp.parameters.tools);
  const Result<OpenedSource> frames = open_source(configuration.camera, false);
  if (!frames.ok()) return frames.status();
  const FrameLimits limits = frames.value().limits;
  print_frames(configuration.camera, limits);
  if (!configuration.picture.empty()) {
    if (Status writable = check_writable(configuration.picture); !writable.ok()) return writable;
  }
  for (const std::string& folder : {configuration.snapshots, configuration.record.folder}) {
    if (folder.empty()) continue;
    if (Status writable = check_folder(folder); !writable.ok()) return writable;
  }
  const MemoryPlan plan = plan_memory(configuration, banks.value(), limits, frames.value().bytes, baseline);
  std::printf("\n%s", memory_table(plan, configuration.memory_budget).c_str());
  std::fflush(stdout);
  return check_budget(configuration, plan);
}

}  // namespace

void add_check_command(CLI::App& command_line, Status& outcome) {
  auto path = std::make_shared<std::string>("/etc/graspd/graspd.toml");
  CLI::App* command = command_line.add_subcommand("check", "Check configuration, banks and memory budget");
  command->add_option("--config", *path, "Configuration file")->capture_default_str();
  command->footer(
      "Does what `graspd run` does before it serves anybody: reads the configuration, checks every\n"
      "bank, tells which tool takes each grasp, opens the frames, looks whether the outputs can be\n"
      "written, and prints the memory that the daemon would take, owner by owner.\n"
      "Ends with code 7 when that is more than memory.budget.\n"
      "\n"
      "Example:\n"
      "  graspd check --config /etc/graspd/graspd.toml");
  command->callback([path, &outcome] { outcome = check(*path); });
}

}  // namespace graspd
