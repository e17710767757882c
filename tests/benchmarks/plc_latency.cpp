// How long an answer takes beside capture and detection: in the daemon, from the trigger seen to the registers written;
// and as a client sees it, from before the trigger is sent until it has read `done`, which adds the network both ways
// and the client's own polling. With --parts, grasps are chosen in piles of so many parts that are taken as detected,
// after the caches were emptied as a detection would leave them.

#include <sched.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "drivers/plc/modbus_client.hpp"
#include "drivers/plc/modbus_server.hpp"
#include "drivers/system/clock.hpp"
#include "drivers/system/prompt_thread.hpp"
#include "firmware_app/frame_sources.hpp"
#include "firmware_app/loaded_banks.hpp"
#include "firmware_app/memory_block.hpp"
#include "firmware_app/memory_plan.hpp"
#include "firmware_app/pick_cycle.hpp"
#include "tests/benchmarks/detected_piles.hpp"
#include "tests/benchmarks/latency_table.hpp"
#include "tests/benchmarks/thread_seconds.hpp"

namespace graspd {
namespace {

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

/// Answers requests. What it knows of the last answer may be read once that has reached the client.
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

  struct Times {
    std::int64_t detection_ns = 0;
    std::int64_t woken_after_ns = 0;
    std::int64_t answered_after_ns = 0;  ///< After the trigger was seen, as the one above.
    double processor_seconds = 0;
  };
  /// Waits until the answer to request number `id` is handed over whole.
  [[nodiscard]] Times times_of(std::uint16_t id) const {
    while (answered_id_ != id) std::this_thread::yield();
    return times_;
  }

 private:
  void work() {
    make_thread_prompt();
    if (equipment_.is_real && !warm_up(equipment_.cycle).ok()) std::printf("the warm-up failed\n");
    link_.set_camera_ok(true);
    link_.set_model_loaded(true);
    ready_ = true;
    ready_.notify_all();
    while (!stop_) {
      const double start_seconds = thread_seconds();
      PlcRequest request;
      if (!link_.wait_for_request(request, std::chrono::milliseconds(20))) continue;
      const std::int64_t woken_ns = monotonic_ns();
      if (!equipment_.is_real) link_.capture_done(request.sequence);
      double detection_seconds = 0.0;
      const ResultBlock block = answer(request, detection_seconds);
      const std::int64_t answered_ns = monotonic_ns();
      link_.commit(block);
      times_ = {detection_ns(block), woken_ns - request.received_ns, answered_ns - request.received_ns,
                thread_seconds() - start_seconds - detection_seconds};
      answered_id_ = request.request_id;
    }
  }

  [[nodiscard]] ResultBlock answer(const PlcRequest& request, double& detection_seconds) {
    if (equipment_.piles != nullptr) return equipment_.piles->answer(request, detection_seconds);
    if (!equipment_.is_real) return answer_at_once(request);
    return answer_request(equipment_.cycle, request, link_).block;
  }

  PlcLink& link_;
  Equipment& equipment_;
  Times times_;
  std::atomic<std::uint16_t> answered_id_{0};
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

/// How the kernel lets a thread run.
struct Rank {
  int niceness = 0;
  int realtime = 0;  ///< Priority; 0: none.
};

/// Gives the calling thread a rank, which threads that it starts inherit.
[[nodiscard]] Status take_rank(const Rank& rank) {
  sched_param parameters{};
  parameters.sched_priority = rank.realtime;
  if (sched_setscheduler(0, rank.realtime > 0 ? SCHED_RR : SCHED_OTHER, &parameters) == 0 &&
      setpriority(PRIO_PROCESS, 0, rank.niceness) == 0) {
    return {};
  }
  return Status::format(StatusCode::internal, "the priority is not allowed: %s", strerrordesc_np(errno));
}

/// Triggers once and goes through the handshake; `id` names the request.
[[nodiscard]] Status trigger_once(ModbusClient& plc, const Worker& worker, std::uint16_t id, LatencySample& sample) {
  constexpr double ms = 1e-6;
  if (Status done = plc.write_request({.request_id = id}); !done.ok()) return done;
  const std::int64_t start = monotonic_ns();
  if (Status done = plc.write_coil(coil::trigger, true); !done.ok()) return done;
  for (;;) {
    const Result<HandshakeOutputs> out = plc.read_outputs();
    if (!out.ok()) return out.status();
    if (out.value().done) break;
  }
  const std::int64_t read = monotonic_ns();
  const Result<std::uint16_t> overhead_us = plc.read_live(live_register::answer_overhead);
  if (!overhead_us.ok()) return overhead_us.status();
  const Worker::Times times = worker.times_of(id);
  sample.client = static_cast<double>(read - start - times.detection_ns) * ms;
  sample.daemon = static_cast<double>(overhead_us.value()) * 1e-3;
  sample.waking = static_cast<double>(times.woken_after_ns) * ms;
  sample.answering = static_cast<double>(times.answered_after_ns - times.woken_after_ns - times.detection_ns) * ms;
  sample.writing = sample.daemon - sample.waking - sample.answering;
  sample.processor = times.processor_seconds * 1e3;
  return plc.acknowledge();
}

[[nodiscard]] Status measure(std::uint16_t port, const Worker& worker, int triggers,
                             std::vector<LatencySample>& samples) {
  // The daemon touches its memory before the first trigger; here the first answers do.
  constexpr int warm_ups = 6;
  Result<ModbusClient> connected = ModbusClient::connect("127.0.0.1", port, {});
  if (!connected.ok()) return connected.status();
  for (int i = 0; i < warm_ups + triggers; ++i) {
    LatencySample sample;
    const auto id = static_cast<std::uint16_t>(1 + i % 0xFFFF);
    if (Status done = trigger_once(connected.value(), worker, id, sample); !done.ok()) return done;
    if (i >= warm_ups) samples.push_back(sample);
  }
  return {};
}

struct Load {
  int triggers = 10000;
  int clients = 3;
  int rate = 100;  ///< Reads a second of each client.
  Rank daemon;
};

[[nodiscard]] Status run(const std::string& path, std::size_t parts, std::size_t picks, const Load& load) {
  Equipment equipment;
  if (parts > 0) equipment.piles = std::make_unique<DetectedPiles>(parts, picks);
  if (!path.empty()) {
    if (Status equipped = equip(path, equipment); !equipped.ok()) return equipped;
  }
  ServerOptions options;
  options.bind_address = "127.0.0.1";
  options.port = 0;
  options.maximum_rate = 0;
  if (Status taken = take_rank(load.daemon); !taken.ok()) return taken;
  Result<std::unique_ptr<ModbusServer>> server = ModbusServer::start(options);
  if (!server.ok()) return server.status();
  const Worker worker(*server.value(), equipment);
  if (Status taken = take_rank({}); !taken.ok()) return taken;
  const std::uint16_t port = server.value()->port();
  std::atomic<bool> stop{false};
  std::vector<std::thread> pollers;
  for (int i = 0; i < load.clients; ++i) {
    pollers.emplace_back([&] { poll(port, load.rate, stop); });
  }
  std::vector<LatencySample> samples;
  const Status measured = measure(port, worker, load.triggers, samples);
  stop = true;
  for (std::thread& poller : pollers) poller.join();
  if (measured.ok() && !samples.empty()) print_latencies(samples, !equipment.is_real);
  return measured;
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  CLI::App command_line("Measures an answer's time beside capture and detection");
  std::string configuration;
  std::size_t parts = 0;
  std::size_t picks = 1;
  graspd::Load load;
  CLI::Option* const from_file =
      command_line.add_option("--config", configuration, "Pick from this configuration's frames; else answer at once");
  command_line.add_option("--parts", parts, "Choose grasps in piles of so many parts")->excludes(from_file);
  command_line.add_option("--picks", picks, "Picks wanted of each pile")->capture_default_str();
  command_line.add_option("--triggers", load.triggers, "Requests")->check(CLI::PositiveNumber)->capture_default_str();
  command_line.add_option("--clients", load.clients, "Clients that read the block meanwhile")->capture_default_str();
  command_line.add_option("--rate", load.rate, "Reads a second of each")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command_line.add_option("--nice", load.daemon.niceness, "Niceness of the daemon's threads; the service unit has -10")
      ->capture_default_str();
  command_line.add_option("--realtime", load.daemon.realtime, "Real-time priority of the daemon's threads; 0: none")
      ->capture_default_str();
  CLI11_PARSE(command_line, argc, argv);
  const graspd::Status status = graspd::run(configuration, parts, picks, load);
  if (!status.ok()) std::fprintf(stderr, "%s\n", status.message().data());
  return status.ok() ? 0 : 1;
}
