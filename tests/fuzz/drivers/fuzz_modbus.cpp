#include <modbus.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

#include "drivers/plc/client_table.hpp"
#include "drivers/plc/plc_session.hpp"
#include "drivers/plc/request_check.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace graspd {
namespace {

constexpr std::size_t header_size = 7;
using Bytes = std::span<const std::uint8_t>;

void demand(bool holds) {
  if (!holds) std::abort();
}

/// A server without its thread and its clock: one client at the other end of a pair of sockets, a worker whose answers
/// are part of the input.
class Server {
 public:
  explicit Server(bool watch_heartbeat)
      : context_(modbus_new_tcp("127.0.0.1", 1502), modbus_free),
        mapping_(modbus_mapping_new(coil::count, discrete_input::count, holding_register_space, input_register_space),
                 modbus_mapping_free),
        session_({{mapping_->tab_bits, coil::count},
                  {mapping_->tab_input_bits, discrete_input::count},
                  {mapping_->tab_registers, holding_register_space},
                  {mapping_->tab_input_registers, input_register_space}},
                 {}, {watch_heartbeat ? 500'000'000 : 0, 2'000'000'000}) {
    demand(socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, sockets_.data()) == 0);
    modbus_set_socket(context_.get(), sockets_[0]);
  }
  ~Server() {
    for (const int socket : sockets_) close(socket);
  }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Bytes from the client. False when what it sends is not Modbus.
  [[nodiscard]] bool receive(Bytes bytes) {
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    for (;;) {
      const Frame frame = next_frame(buffer_);
      if (frame.state == FrameState::not_modbus) return false;
      if (frame.state == FrameState::incomplete) return true;
      const std::vector<std::uint8_t> request(buffer_.begin(),
                                              buffer_.begin() + static_cast<std::ptrdiff_t>(frame.size));
      buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(frame.size));
      serve(request);
    }
  }

  void answer(std::uint8_t code, bool verified, bool late) {
    ResultBlock result;
    result.sequence = static_cast<std::uint16_t>(asked_.sequence - (late ? 1 : 0));
    result.code = static_cast<ResultCode>(code);
    result.verified = verified;
    if (!late && asked_.sequence != answered_) {
      answered_ = asked_.sequence;
      answered_with_pick_ = has_pick(result) ? asked_.sequence : 0;
    }
    session_.on_answer(result, now_ns_);
  }
  void capture_done() { session_.on_capture_done(asked_.sequence, now_ns_); }
  void pass_time(std::uint8_t steps, bool camera_ok, bool model_loaded) {
    now_ns_ += std::int64_t{steps} * 20'000'000;
    session_.on_time(camera_ok, model_loaded, now_ns_);
  }

  /// What must hold at any moment: a whole block, and a valid result only with the pick that was asked for.
  void check() const {
    const Result<ResultBlock> shown = decode({mapping_->tab_input_registers, block::count}, {});
    demand(shown.ok());
    if (mapping_->tab_input_bits[discrete_input::result_valid] == 0) return;
    demand(has_pick(shown.value()));
    demand(mapping_->tab_input_bits[discrete_input::done] != 0);
    demand(shown.value().sequence == asked_.sequence && asked_.sequence == answered_with_pick_);
  }

 private:
  void serve(const std::vector<std::uint8_t>& request) {
    const RequestVerdict verdict = check_request(Bytes(request).subspan(header_size));
    if (verdict == RequestVerdict::accept) {
      demand(modbus_reply(context_.get(), request.data(), static_cast<int>(request.size()), mapping_.get()) > 0);
      PlcRequest wanted;
      if (session_.on_written(now_ns_, wanted)) asked_ = wanted;
    } else {
      demand(modbus_reply_exception(context_.get(), request.data(), static_cast<unsigned>(verdict)) > 0);
    }
    check_reply(request, verdict);
  }

  void check_reply(const std::vector<std::uint8_t>& request, RequestVerdict verdict) const {
    std::array<std::uint8_t, 300> reply{};
    const ssize_t size = recv(sockets_[1], reply.data(), reply.size(), 0);
    demand(size > static_cast<ssize_t>(header_size));
    demand(std::equal(request.begin(), request.begin() + 4, reply.begin()));
    demand((reply[4] << 8) + reply[5] + 6 == size);
    demand(reply[6] == request[6]);
    const bool refused = verdict != RequestVerdict::accept;
    demand(reply[7] == (refused ? (request[7] | 0x80) & 0xFF : request[7]));
    demand(!refused || reply[8] == static_cast<std::uint8_t>(verdict));
  }

  std::unique_ptr<modbus_t, decltype(&modbus_free)> context_;
  std::unique_ptr<modbus_mapping_t, decltype(&modbus_mapping_free)> mapping_;
  PlcSession session_;
  std::array<int, 2> sockets_{};
  std::vector<std::uint8_t> buffer_;
  PlcRequest asked_;
  std::uint16_t answered_ = 0;  ///< Only the first answer to a request counts.
  std::uint16_t answered_with_pick_ = 0;
  std::int64_t now_ns_ = 1'000'000'000;
};

}  // namespace
}  // namespace graspd

/// A conversation: the first byte says whether the PLC's heartbeat is watched; then each step is a byte that says what
/// happens and one for how, then the bytes that the client sends.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace graspd;
  if (size == 0) return 0;
  Server server(*data % 2 == 1);
  Bytes input(data + 1, size - 1);
  while (input.size() >= 2) {
    const std::uint8_t what = input[0] % 4;
    const std::uint8_t how = input[1];
    input = input.subspan(2);
    if (what == 0) {
      const std::size_t length = std::min<std::size_t>(how, input.size());
      if (!server.receive(input.first(length))) return 0;
      input = input.subspan(length);
    } else if (what == 1) {
      server.answer(how & 0x1FU, (how & 0x20U) != 0, (how & 0x40U) != 0);
    } else if (what == 2) {
      server.capture_done();
    } else {
      server.pass_time(how >> 2U, (how & 1U) != 0, (how & 2U) != 0);
    }
    server.check();
  }
  return 0;
}
