#include "tests/stress/faulty_plc.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <optional>
#include <random>
#include <thread>
#include <utility>

#include "drivers/plc/modbus_client.hpp"
#include "drivers/plc/register_map.hpp"
#include "tests/stress/whole_reads.hpp"

namespace graspd {
namespace {

constexpr std::chrono::milliseconds patience{10000};

/// Sends the first bytes of a request that would trigger, and hangs up or leaves them there.
void send_half_a_trigger(std::uint16_t port, std::size_t bytes, bool hang_up, int& left_open) {
  constexpr std::array<std::uint8_t, 12> trigger{0, 1, 0, 0, 0, 6, 1, 5, 0, coil::trigger, 0xFF, 0};
  const int descriptor = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof(address)) == 0) {
    (void)send(descriptor, trigger.data(), bytes % trigger.size(), MSG_NOSIGNAL);
  }
  if (left_open >= 0) close(left_open);
  left_open = hang_up ? -1 : descriptor;
  if (hang_up) close(descriptor);
}

class FaultyPlc {
 public:
  FaultyPlc(std::uint16_t port, std::uint32_t seed) : port_(port), random_(seed) {}
  ~FaultyPlc() {
    if (half_sent_ >= 0) close(half_sent_);
  }
  FaultyPlc(const FaultyPlc&) = delete;
  FaultyPlc& operator=(const FaultyPlc&) = delete;

  [[nodiscard]] Status run(long rounds) {
    if (Status connected = reconnect(); !connected.ok()) return connected;
    for (; report.rounds < rounds; ++report.rounds) {
      if (Status went = misbehave(); !went.ok()) return went;
      if (Status went = recover(); !went.ok()) return went;
      if (Status went = pick(); !went.ok()) return went;
    }
    return {};
  }

  FaultyPlcReport report;

 private:
  [[nodiscard]] Status reconnect() {
    client_.reset();
    Result<ModbusClient> client = ModbusClient::connect("127.0.0.1", port_, {});
    if (!client.ok()) return client.status();
    client_.emplace(std::move(client).value());
    return {};
  }

  /// A request, with the fault of this round somewhere in it.
  [[nodiscard]] Status misbehave() {
    const auto fault = static_cast<int>(report.rounds % 6);
    const std::uint32_t place = random_() % 4;
    for (std::uint32_t step = 0; step < 4; ++step) {
      Status done;
      if (step == place) done = commit(fault);
      if (done.ok() && step == 0) done = client_->trigger({.request_id = ++request_id_});
      if (done.ok() && step == 1) done = look();
      if (done.ok() && step == 2) std::this_thread::sleep_for(std::chrono::microseconds(random_() % 500));
      if (done.ok() && step == 3) done = client_->pulse(coil::acknowledge);
      if (!done.ok()) return done;
    }
    return {};
  }

  [[nodiscard]] Status commit(int fault) {
    switch (fault) {
      case 0:
        return reconnect();
      case 1:
        send_half_a_trigger(port_, random_(), random_() % 2 == 0, half_sent_);
        return {};
      case 2:
        return client_->pulse(coil::reset);
      case 3:
        return client_->pulse(coil::acknowledge);
      case 4:
        return client_->pulse(coil::next);
      default:
        return client_->pulse(coil::trigger);
    }
  }

  /// What must hold at any moment: `result_valid` comes with a block that is whole and has a pick.
  [[nodiscard]] Status look() {
    const Result<HandshakeOutputs> out = client_->read_outputs();
    if (!out.ok()) return out.status();
    if (!out.value().result_valid) return {};
    const Result<ResultBlock> block = client_->read_block();
    const Result<HandshakeOutputs> after = client_->read_outputs();
    if (!after.ok()) return after.status();
    // The block may have changed in between only if somebody asked for more: nobody but this thread does.
    if (after.value().result_valid && !(block.ok() && block.value().verified && is_whole(block.value()))) {
      ++report.invalid_picks;
    }
    return {};
  }

  [[nodiscard]] Status recover() {
    for (const std::uint16_t address : {coil::trigger, coil::next, coil::acknowledge}) {
      if (Status done = client_->write_coil(address, false); !done.ok()) return done;
    }
    if (Status done = client_->pulse(coil::reset); !done.ok()) return done;
    const auto end = std::chrono::steady_clock::now() + patience;
    while (std::chrono::steady_clock::now() < end) {
      const Result<HandshakeOutputs> out = client_->read_outputs();
      if (!out.ok()) return out.status();
      if (out.value().ready) return {};
    }
    ++report.not_recovered;
    return {};
  }

  [[nodiscard]] Status pick() {
    ++request_id_;
    const Result<ResultBlock> block = client_->request_pick({.request_id = request_id_}, patience);
    if (!block.ok()) return block.status();
    ++report.verdicts;
    const bool has_pick = request_id_ % 3 != 2;
    if (block.value().request_id != request_id_) ++report.stale;
    if (block.value().verified != has_pick || !is_whole(block.value())) ++report.invalid_picks;
    return {};
  }

  std::uint16_t port_;
  std::mt19937 random_;
  std::optional<ModbusClient> client_;
  std::uint16_t request_id_ = 0;
  int half_sent_ = -1;
};

}  // namespace

Result<FaultyPlcReport> run_faulty_plc(std::uint16_t port, long rounds, std::uint32_t seed) {
  FaultyPlc plc(port, seed);
  if (Status went = plc.run(rounds); !went.ok()) return went;
  return plc.report;
}

}  // namespace graspd
