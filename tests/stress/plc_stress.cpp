// Triggers the Modbus server very often while other clients poll it, then lets a PLC misbehave. Ends with 1 when a
// block was torn, a trigger lost or doubled, or an answer stale.

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <memory>
#include <utility>

#include "drivers/plc/modbus_client.hpp"
#include "drivers/plc/modbus_server.hpp"
#include "tests/stress/faulty_plc.hpp"
#include "tests/stress/stress_worker.hpp"
#include "tests/stress/whole_reads.hpp"

namespace graspd {
namespace {

constexpr std::chrono::milliseconds patience{30000};

struct Tally {
  long triggers = 0;
  long answered = 0;
  long stale = 0;
  long torn = 0;
};

/// A whole handshake: false when the connection is lost.
[[nodiscard]] bool trigger_once(ModbusClient& plc, std::uint16_t request_id, Tally& tally) {
  const ClientRequest request{.request_id = request_id, .results_wanted = static_cast<std::uint16_t>(request_id % 6)};
  if (!plc.trigger(request).ok()) return false;
  ++tally.triggers;
  const Result<HandshakeOutputs> out = plc.wait_done(patience);
  if (!out.ok()) return false;
  const Result<ResultBlock> block = plc.read_block();
  const Result<ResultBlock> list = plc.read_list(NumberKind::floating);
  if (!block.ok() || !list.ok()) {
    ++tally.torn;
    return plc.acknowledge().ok();
  }
  ++tally.answered;
  const bool has_pick = request_id % 3 != 2;
  const bool is_mine = block.value().request_id == request_id && list.value().request_id == request_id &&
                       block.value().sequence == list.value().sequence && out.value().result_valid == has_pick &&
                       block.value().verified == has_pick;
  if (!is_mine) ++tally.stale;
  if (!is_whole(block.value()) || !is_whole(list.value())) ++tally.torn;
  return plc.acknowledge().ok();
}

[[nodiscard]] bool check(const char* what, long figure, long expected) {
  std::printf("%-44s %10ld%s\n", what, figure, figure == expected ? "" : "  WRONG");
  return figure == expected;
}

[[nodiscard]] bool stress_triggers(ModbusServer& server, long triggers, int clients) {
  StressWorker worker(server);
  Result<ModbusClient> plc = ModbusClient::connect("127.0.0.1", server.port(), {});
  if (!plc.ok()) return check("connections refused", 1, 0);
  const auto start = std::chrono::steady_clock::now();
  Tally tally;
  long reads = 0;
  long torn = 0;
  long failed = 0;
  {
    const PollingClients polling(server.port(), clients);
    for (long i = 0; i < triggers; ++i) {
      if (!trigger_once(plc.value(), static_cast<std::uint16_t>(i), tally)) break;
    }
    reads = polling.reads();
    torn = polling.torn();
    failed = polling.failed();
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  std::printf("%ld triggers with %d polling clients, %.1f s, %ld reads of block and lists\n", triggers, clients,
              took.count(), reads);
  bool fine = check("triggers sent", tally.triggers, triggers);
  fine = check("answers received", tally.answered, triggers) && fine;
  fine = check("requests that the worker got", worker.requests(), triggers) && fine;
  fine = check("requests out of order", worker.out_of_order(), 0) && fine;
  const Result<std::uint16_t> accepted = plc.value().read_live(live_register::triggers_accepted);
  fine = check("triggers accepted, modulo 65536", accepted.ok() ? accepted.value() : -1, triggers % 65536) && fine;
  fine = check("answers of another request", tally.stale, 0) && fine;
  fine = check("torn blocks or lists", tally.torn + torn, 0) && fine;
  return check("reads that failed", failed, 0) && fine;
}

[[nodiscard]] bool stress_faults(ModbusServer& server, long rounds, int clients) {
  StressWorker worker(server);
  const PollingClients polling(server.port(), clients);
  const Result<FaultyPlcReport> run = run_faulty_plc(server.port(), rounds, 7);
  if (!run.ok()) std::printf("%s\n", run.status().message().data());
  const FaultyPlcReport report = run.ok() ? run.value() : FaultyPlcReport{};
  std::printf("\n%ld rounds with a PLC that misbehaves, %ld requests accepted\n", rounds, worker.requests());
  bool fine = check("rounds", report.rounds, rounds);
  fine = check("answers received", report.verdicts, rounds) && fine;
  fine = check("answers of another request", report.stale, 0) && fine;
  fine = check("result_valid without a verified pick", report.invalid_picks, 0) && fine;
  fine = check("rounds that did not come back to ready", report.not_recovered, 0) && fine;
  fine = check("torn blocks or lists", polling.torn(), 0) && fine;
  return check("reads that failed", polling.failed(), 0) && fine;
}

[[nodiscard]] std::unique_ptr<ModbusServer> start_server() {
  ServerOptions options;
  options.bind_address = "127.0.0.1";
  options.port = 0;
  options.maximum_rate = 0;
  options.maximum_clients = 16;
  Result<std::unique_ptr<ModbusServer>> server = ModbusServer::start(options);
  if (!server.ok()) {
    std::printf("%s\n", server.status().message().data());
    return nullptr;
  }
  return std::move(server).value();
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  CLI::App command_line("Stresses the Modbus server");
  long triggers = 100000;
  long rounds = 2000;
  int clients = 3;
  command_line.add_option("--triggers", triggers, "Whole handshakes")->capture_default_str();
  command_line.add_option("--rounds", rounds, "Handshakes with a fault")->capture_default_str();
  command_line.add_option("--clients", clients, "Clients that poll meanwhile")->capture_default_str();
  CLI11_PARSE(command_line, argc, argv);
  bool fine = true;
  if (const auto server = graspd::start_server(); server) {
    fine = graspd::stress_triggers(*server, triggers, clients);
  } else {
    fine = false;
  }

  if (const auto server = graspd::start_server(); server) {
    fine = graspd::stress_faults(*server, rounds, clients) && fine;
  } else {
    fine = false;
  }
  return fine ? 0 : 1;
}
