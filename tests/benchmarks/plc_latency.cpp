// How long an answer takes beside capture and detection: from before the trigger is sent until a client has read
// `done`, less the times of those stages. That is more than from the trigger seen to the registers written, by the
// network both ways and the client's own polling. With --parts, grasps are chosen in piles of so many parts that are
// taken as detected, after the caches were emptied as a detection would leave them.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <memory>
#include <numeric>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "drivers/plc/modbus_client.hpp"
#include "drivers/plc/modbus_server.hpp"
#include "drivers/system/clock.hpp"
#include "firmware_app/frame_sources.hpp"
#include "firmware_app/loaded_banks.hpp"
#include "firmware_app/memory_block.hpp"
#include "firmware_app/memory_plan.hpp"
#include "firmware_app/pick_cycle.hpp"
#include "tests/collisions/pile_scene.hpp"
#include "tests/core/grasp/grasp_memory.hpp"

namespace graspd {
namespace {

/// Piles whose parts were all detected, one after the other in the bin of a camera.
class DetectedPiles {
 public:
  DetectedPiles(std::size_t parts, std::size_t picks) : picks_(picks) {
    const PileBin bin{0.25F, 0.19F};
    const Camera camera{1280, 960, 1100.0F, 1100.0F, 639.5F, 479.5F};
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      scenes_[i] = pile_scene(shapes_[i], parts + parts / 2, bin, camera, SensorStrain::medium, 3);
      scenes_[i].detected.resize(std::min(parts, scenes_[i].detected.size()));
    }
  }

  /// The answer to a request; `excluded_ns`: what stands for the detection, whose memory displaces the caches.
  [[nodiscard]] ResultBlock answer(const PlcRequest& request, std::int64_t& excluded_ns) {
    const std::int64_t start = monotonic_ns();
    for (std::size_t i = 0; i < other_memory_.size(); i += 64) ++other_memory_[i];
    excluded_ns = monotonic_ns() - start;
    const std::size_t number = request.sequence % scenes_.size();
    PileScene& scene = scenes_[number];
    const Bank bank = shapes_[number].bank();
    Detections detections;
    detections.instances = scene.detected;
    begin_choice(scene.frame(), detections, {&bank, 1}, scene.parameters, memory_.workspace);
    const PickResult picks = find_picks(memory_.workspace, picks_);
    ResultBlock block;
    block.sequence = request.sequence;
    block.request_id = request.request_id;
    block.code = picks.found ? ResultCode::ok : ResultCode::not_pickable;
    block.verified = true;
    block.pick = picks.best.robot_from_tool;
    block.approach = picks.best.robot_from_approach;
    block.part_pose = picks.best.robot_from_part;
    return block;
  }

 private:
  std::size_t picks_;
  std::array<HeldShape, 3> shapes_{held_block(), held_bar(), held_bracket()};
  std::array<PileScene, 3> scenes_;
  GraspMemory memory_;
  std::vector<std::uint8_t> other_memory_ = std::vector<std::uint8_t>(64U << 20U);
};

/// What a configuration names, ready to pick, or piles; without either, requests are answered at once.
struct Equipment {
  std::unique_ptr<DetectedPiles> piles;
  Configuration configuration;
  LoadedBanks banks;
  OpenedSource frames;
  MemoryBlock block;
  PickCycle cycle;
  bool is_real = false;
};

[[nodiscard]] Status equip(const std::string& path, Equipment& equipment) {
  Result<Configuration> read = read_configuration(path);
  if (!read.ok()) return read.status();
  equipment.configuration = std::move(read).value();
  const Configuration& configuration = equipment.configuration;
  Result<LoadedBanks> banks = load_banks(configuration.banks);
  if (!banks.ok()) return banks.status();
  equipment.banks = std::move(banks).value();
  Result<OpenedSource> frames = open_source(configuration.camera, true);
  if (!frames.ok()) return frames.status();
  equipment.frames = std::move(frames).value();
  const MemoryPlan plan =
      plan_memory(configuration, equipment.banks, equipment.frames.source->limits(), equipment.frames.bytes, 0);
  equipment.block = MemoryBlock(plan.arena_bytes);
  Arena arena(equipment.block.bytes());
  PickCycle& cycle = equipment.cycle;
  cycle.settings.detect = configuration.detect.parameters;
  cycle.settings.grasp = configuration.grasp.parameters;
  cycle.settings.count_all = configuration.grasp.count_all;
  cycle.settings.calibrated = configuration.calibrated;
  cycle.settings.maximum_age_ns = 1'000'000'000;
  cycle.settings.now_ns = &monotonic_ns;
  cycle.banks = equipment.banks.banks;
  cycle.source = equipment.frames.source.get();
  cycle.memory = carve_working_memory(arena, plan.capacity);
  equipment.is_real = true;
  return {};
}

[[nodiscard]] ResultBlock answer_at_once(const PlcRequest& request) {
  ResultBlock block;
  block.sequence = request.sequence;
  block.request_id = request.request_id;
  block.code = ResultCode::ok;
  block.verified = true;
  return block;
}

/// Seconds of capture and detection in an answer.
[[nodiscard]] double excluded(const ResultBlock& block) {
  double sum = 0;
  for (const BlockStage stage : {BlockStage::capture, BlockStage::preprocess, BlockStage::match, BlockStage::cluster,
                                 BlockStage::refine, BlockStage::verify}) {
    sum += static_cast<double>(block.stage_time[static_cast<std::size_t>(stage)]);
  }
  return sum;
}

/// Answers requests; `excluded_ns` is that of the last answer.
class Worker {
 public:
  Worker(PlcLink& link, Equipment& equipment) : link_(link), equipment_(equipment) {
    thread_ = std::thread([this] { work(); });
    ready_.wait(false);
  }
  ~Worker() {
    stop_ = true;
    thread_.join();
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  std::atomic<std::int64_t> excluded_ns{0};

 private:
  void work() {
    if (equipment_.is_real && !warm_up(equipment_.cycle).ok()) std::printf("the warm-up failed\n");
    link_.set_camera_ok(true);
    link_.set_model_loaded(true);
    ready_ = true;
    ready_.notify_all();
    while (!stop_) {
      PlcRequest request;
      if (!link_.wait_for_request(request, std::chrono::milliseconds(20))) continue;
      if (!equipment_.is_real) link_.capture_done(request.sequence);
      std::int64_t without_ns = 0;
      const ResultBlock block = answer(request, without_ns);
      excluded_ns = without_ns;
      link_.commit(block);
    }
  }

  [[nodiscard]] ResultBlock answer(const PlcRequest& request, std::int64_t& without_ns) {
    if (equipment_.piles != nullptr) return equipment_.piles->answer(request, without_ns);
    if (!equipment_.is_real) return answer_at_once(request);
    const ResultBlock block = answer_request(equipment_.cycle, request, link_).block;
    without_ns = static_cast<std::int64_t>(excluded(block) * 1e9);
    return block;
  }

  PlcLink& link_;
  Equipment& equipment_;
  std::atomic<bool> stop_{false};
  std::atomic<bool> ready_{false};
  std::thread thread_;
};

/// Reads the block `rate` times a second until told to stop.
void poll(std::uint16_t port, int rate, const std::atomic<bool>& stop) {
  Result<ModbusClient> client = ModbusClient::connect("127.0.0.1", port, {});
  if (!client.ok()) return;
  const auto period = std::chrono::microseconds(1'000'000 / rate);
  auto next = std::chrono::steady_clock::now();
  while (!stop) {
    static_cast<void>(client.value().read_block());
    next += period;
    std::this_thread::sleep_until(next);
  }
}

[[nodiscard]] Status measure(ModbusServer& server, Equipment& equipment, int triggers, std::vector<double>& latencies) {
  Worker worker(server, equipment);
  Result<ModbusClient> connected = ModbusClient::connect("127.0.0.1", server.port(), {});
  if (!connected.ok()) return connected.status();
  ModbusClient& plc = connected.value();
  for (int i = 0; i < triggers; ++i) {
    if (Status done = plc.write_request({.request_id = static_cast<std::uint16_t>(i)}); !done.ok()) return done;
    const std::int64_t start = monotonic_ns();
    if (Status done = plc.write_coil(coil::trigger, true); !done.ok()) return done;
    for (;;) {
      const Result<HandshakeOutputs> out = plc.read_outputs();
      if (!out.ok()) return out.status();
      if (out.value().done) break;
    }
    latencies.push_back(static_cast<double>(monotonic_ns() - start - worker.excluded_ns) * 1e-6);
    if (Status done = plc.acknowledge(); !done.ok()) return done;
  }
  return {};
}

void print(std::vector<double> latencies) {
  std::sort(latencies.begin(), latencies.end());
  const auto at = [&](double share) {
    return latencies[static_cast<std::size_t>(share * static_cast<double>(latencies.size() - 1))];
  };
  const double mean = std::accumulate(latencies.begin(), latencies.end(), 0.0) / static_cast<double>(latencies.size());
  std::printf("%zu triggers: mean %.3f ms, median %.3f ms, 99%% %.3f ms, 99.9%% %.3f ms, most %.3f ms\n",
              latencies.size(), mean, at(0.5), at(0.99), at(0.999), latencies.back());
}

[[nodiscard]] Status run(const std::string& path, std::size_t parts, std::size_t picks, int triggers, int clients,
                         int rate) {
  Equipment equipment;
  if (parts > 0) equipment.piles = std::make_unique<DetectedPiles>(parts, picks);
  if (!path.empty()) {
    if (Status equipped = equip(path, equipment); !equipped.ok()) return equipped;
  }
  ServerOptions options;
  options.bind_address = "127.0.0.1";
  options.port = 0;
  options.maximum_rate = 0;
  Result<std::unique_ptr<ModbusServer>> server = ModbusServer::start(options);
  if (!server.ok()) return server.status();
  std::atomic<bool> stop{false};
  std::vector<std::thread> pollers;
  for (int i = 0; i < clients; ++i) {
    pollers.emplace_back([&] { poll(server.value()->port(), rate, stop); });
  }
  std::vector<double> latencies;
  const Status measured = measure(*server.value(), equipment, triggers, latencies);
  stop = true;
  for (std::thread& poller : pollers) poller.join();
  if (measured.ok()) print(std::move(latencies));
  return measured;
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  CLI::App command_line("Measures an answer's time beside capture and detection");
  std::string configuration;
  std::size_t parts = 0;
  std::size_t picks = 1;
  int triggers = 10000;
  int clients = 3;
  int rate = 100;
  CLI::Option* const from_file =
      command_line.add_option("--config", configuration, "Pick from this configuration's frames; else answer at once");
  command_line.add_option("--parts", parts, "Choose grasps in piles of so many parts")->excludes(from_file);
  command_line.add_option("--picks", picks, "Picks wanted of each pile")->capture_default_str();
  command_line.add_option("--triggers", triggers, "Requests")->capture_default_str();
  command_line.add_option("--clients", clients, "Clients that read the block meanwhile")->capture_default_str();
  command_line.add_option("--rate", rate, "Reads a second of each")->check(CLI::PositiveNumber)->capture_default_str();
  CLI11_PARSE(command_line, argc, argv);
  const graspd::Status status = graspd::run(configuration, parts, picks, triggers, clients, rate);
  if (!status.ok()) std::fprintf(stderr, "%s\n", status.message().data());
  return status.ok() ? 0 : 1;
}
