#include "drivers/plc/poller_loop.hpp"

#include <poll.h>
#include <pthread.h>

#include <algorithm>

#include "drivers/system/clock.hpp"
#include "drivers/system/prompt_thread.hpp"

namespace graspd {
namespace {

constexpr std::int64_t millisecond = 1'000'000;
constexpr std::int64_t first_pause_ns = 100 * millisecond;
constexpr std::int64_t longest_pause_ns = 2000 * millisecond;
constexpr std::int64_t longest_wait_ns = 50 * millisecond;
constexpr std::uint32_t log_lines = 20;
constexpr std::int64_t log_window_ns = 10'000 * millisecond;

}  // namespace

ModbusPoller::Loop::Loop(const PollerOptions& options, const SocketAddress& address)
    : options_(options),
      session_({coils_, discrete_inputs_, holding_registers_, input_registers_}, options.format,
               {nanoseconds(options.heartbeat_timeout), nanoseconds(options.request_timeout)}),
      plc_(address, options.unit, options.response_timeout),
      writer_(options.result_address),
      throttle_(log_lines, log_window_ns),
      connect_pause_ns_(first_pause_ns) {}

ModbusPoller::Loop::~Loop() { stop(); }

void ModbusPoller::Loop::start() {
  thread_ = std::thread([this] { run(); });
  pthread_setname_np(thread_.native_handle(), "graspd-modbus");
}

void ModbusPoller::Loop::stop() {
  stopping_.store(true);
  mailbox_.close();
  if (thread_.joinable()) thread_.join();
}

void ModbusPoller::Loop::run() {
  make_thread_prompt();
  while (!stopping_.load()) {
    wait(monotonic_ns());
    session_.on_news(mailbox_.take(), monotonic_ns());
    // Before what follows, which waits for the PLC: what nobody wants any more must not count as told meanwhile.
    mailbox_.set_wanted(session_.wanted());
    if (!plc_.is_open() && monotonic_ns() >= connect_again_ns_) connect(monotonic_ns());
    if (plc_.is_open()) {
      Status done;
      if (monotonic_ns() >= look_again_ns_) {
        look_again_ns_ = monotonic_ns() + nanoseconds(options_.poll_period);
        done = look(monotonic_ns());
        mailbox_.set_wanted(session_.wanted());
      }
      session_.set_clients(1);
      if (done.ok()) done = writer_.write(plc_, input_registers_, wants_list_);
      if (done.ok()) {
        session_.on_delivered(monotonic_ns());
        note_exchange(monotonic_ns());
      } else {
        lose(done, monotonic_ns());
      }
    }
    mailbox_.set_wanted(session_.wanted());
    progress_.fetch_add(1, std::memory_order_relaxed);
  }
}

/// Until something is due or the worker has news.
void ModbusPoller::Loop::wait(std::int64_t now_ns) const {
  const std::int64_t due_ns = plc_.is_open() ? look_again_ns_ : connect_again_ns_;
  const std::int64_t time_ns = std::clamp<std::int64_t>(due_ns - now_ns, 0, longest_wait_ns);
  pollfd waiting{mailbox_.wake_descriptor(), POLLIN, 0};
  poll(&waiting, 1, static_cast<int>((time_ns + millisecond - 1) / millisecond));
}

void ModbusPoller::Loop::connect(std::int64_t now_ns) {
  const Status opened = plc_.open();
  if (!opened.ok()) {
    connect_again_ns_ = now_ns + connect_pause_ns_;
    connect_pause_ns_ = std::min(2 * connect_pause_ns_, longest_pause_ns);
    if (told_unreachable_) return;
    told_unreachable_ = true;
    log_event(LogLevel::error, "E128", "the PLC cannot be reached, trying on address=%s port=%u reason=\"%s\"",
              options_.address.c_str(), unsigned{options_.port}, opened.message().data());
    return;
  }
  told_unreachable_ = false;
  has_exchanged_ = false;
  writer_.forget();
  look_again_ns_ = now_ns;
}

/// All was read and written: only now the connection is of use.
void ModbusPoller::Loop::note_exchange(std::int64_t now_ns) {
  if (has_exchanged_) return;
  has_exchanged_ = true;
  told_lost_ = false;
  connect_pause_ns_ = first_pause_ns;
  if (may_log(now_ns)) {
    log_event(LogLevel::notice, "N129", "connected to the PLC address=%s port=%u", options_.address.c_str(),
              unsigned{options_.port});
  }
}

/// Reads what the PLC wrote. The coils come first: a request is complete before its trigger is set.
Status ModbusPoller::Loop::look(std::int64_t now_ns) {
  std::array<std::uint8_t, coil::count> coils{};
  if (Status status = plc_.read_coils(options_.coil_address, coils); !status.ok()) return status;
  const std::span<std::uint16_t> requests = std::span(holding_registers_).first(request_register::count);
  if (Status status = plc_.read_registers(options_.request_address, requests); !status.ok()) return status;
  coils_ = coils;
  if (!was_found_) {
    was_found_ = true;
    session_.on_found(now_ns);
    return {};
  }
  PlcRequest request;
  if (!session_.on_written(now_ns, request)) return {};
  wants_list_ = request.results_wanted > 1;
  mailbox_.set_wanted(request.sequence);
  mailbox_.post(request);
  return {};
}

void ModbusPoller::Loop::lose(const Status& reason, std::int64_t now_ns) {
  plc_.close();
  session_.on_lost(now_ns);
  session_.set_clients(0);
  connect_again_ns_ = now_ns + connect_pause_ns_;
  connect_pause_ns_ = std::min(2 * connect_pause_ns_, longest_pause_ns);
  // A PLC that takes connections and nothing else would fill the journal.
  if (told_lost_ && !has_exchanged_) return;
  told_lost_ = true;
  if (!may_log(now_ns)) return;
  if (reason.code() == StatusCode::bad_request) {
    log_event(LogLevel::error, "E131", "the PLC refuses, check its register areas reason=\"%s\"",
              reason.message().data());
  } else {
    log_event(LogLevel::warning, "W130", "connection to the PLC lost: result valid is cleared reason=\"%s\"",
              reason.message().data());
  }
}

bool ModbusPoller::Loop::may_log(std::int64_t now_ns) {
  std::uint32_t suppressed = 0;
  const bool allowed = throttle_.allow(now_ns, suppressed);
  if (suppressed > 0) log_event(LogLevel::warning, "W119", "lines about the PLC held back count=%u", suppressed);
  return allowed;
}

}  // namespace graspd
