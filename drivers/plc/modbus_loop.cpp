#include "drivers/plc/modbus_loop.hpp"

#include <modbus.h>
#include <netinet/tcp.h>
#include <pthread.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "drivers/plc/request_check.hpp"
#include "drivers/system/clock.hpp"
#include "drivers/system/prompt_thread.hpp"

namespace graspd {
namespace {

constexpr std::int64_t longest_wait_ns = 50'000'000;
constexpr std::int64_t accept_pause_ns = 1'000'000'000;
constexpr std::uint32_t log_lines = 20;
constexpr std::int64_t log_window_ns = 10'000'000'000;
/// Some PLCs connect anew for every request: that would fill the journal, and hold back the lines that matter.
constexpr std::int64_t lasting_ns = 2'000'000'000;
constexpr std::size_t header_size = 7;
constexpr int receives_at_once = 4;

void set_option(int descriptor, int level, int option, int value) {
  setsockopt(descriptor, level, option, &value, sizeof(value));
}

/// Answers at once, and notices within half a minute that a peer is gone.
void tune_connection(int descriptor) {
  set_option(descriptor, IPPROTO_TCP, TCP_NODELAY, 1);
  set_option(descriptor, SOL_SOCKET, SO_KEEPALIVE, 1);
  set_option(descriptor, IPPROTO_TCP, TCP_KEEPIDLE, 10);
  set_option(descriptor, IPPROTO_TCP, TCP_KEEPINTVL, 5);
  set_option(descriptor, IPPROTO_TCP, TCP_KEEPCNT, 3);
}

[[nodiscard]] Status cannot_bind(const ServerOptions& options, int reason) {
  const char* remedy = "another program holds the port: stop it, or set another port";
  if (reason == EACCES) remedy = "ports below 1024 need CAP_NET_BIND_SERVICE: start the unit, or set a higher port";
  if (reason == EADDRNOTAVAIL) remedy = "no network interface of this machine has that address";
  return Status::format(StatusCode::address_in_use, "Modbus server: cannot bind %s port %u: %s; %s",
                        options.bind_address.c_str(), unsigned{options.port}, strerrordesc_np(reason), remedy);
}

}  // namespace

void ModbusServer::Loop::FreeContext::operator()(_modbus* context) const { modbus_free(context); }
void ModbusServer::Loop::FreeMapping::operator()(_modbus_mapping_t* mapping) const { modbus_mapping_free(mapping); }

ModbusServer::Loop::Loop(const ServerOptions& options, ClientFilter filter)
    : filter_(std::move(filter)),
      clients_(static_cast<std::size_t>(options.maximum_clients)),
      rate_(options.maximum_rate),
      idle_ns_(nanoseconds(options.idle_time)),
      unfinished_ns_(nanoseconds(options.unfinished_time)),
      format_(options.format),
      handshake_{nanoseconds(options.heartbeat_timeout), nanoseconds(options.request_timeout)},
      throttle_(log_lines, log_window_ns) {}

ModbusServer::Loop::~Loop() {
  stop();
  if (listener_ >= 0) close(listener_);
}

Status ModbusServer::Loop::open(const ServerOptions& options) {
  Result<SocketAddress> address = parse_address(options.bind_address, options.port);
  if (!address.ok()) return address.status();
  auto* bound = reinterpret_cast<sockaddr*>(&address.value().storage);
  listener_ = socket(bound->sa_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (listener_ < 0) return cannot_bind(options, errno);
  set_option(listener_, SOL_SOCKET, SO_REUSEADDR, 1);
  if (bind(listener_, bound, address.value().size) != 0 || listen(listener_, SOMAXCONN) != 0) {
    return cannot_bind(options, errno);
  }
  sockaddr_storage actual{};
  socklen_t size = sizeof(actual);
  getsockname(listener_, reinterpret_cast<sockaddr*>(&actual), &size);
  sockaddr_in with_port{};  // The port lies at the same place for IPv6.
  std::memcpy(&with_port, &actual, sizeof(with_port));
  port_ = ntohs(with_port.sin_port);

  context_.reset(modbus_new_tcp("0.0.0.0", options.port));
  mapping_.reset(modbus_mapping_new(coil::count, discrete_input::count, holding_register_space, input_register_space));
  if (context_ == nullptr || mapping_ == nullptr || !mailbox_.is_usable()) {
    return {StatusCode::internal, "Modbus server: no memory or no descriptor left to start with"};
  }
  const RegisterTables tables{{mapping_->tab_bits, coil::count},
                              {mapping_->tab_input_bits, discrete_input::count},
                              {mapping_->tab_registers, holding_register_space},
                              {mapping_->tab_input_registers, input_register_space}};
  session_ = std::make_unique<PlcSession>(tables, format_, handshake_);
  return {};
}

void ModbusServer::Loop::start() {
  thread_ = std::thread([this] { run(); });
  pthread_setname_np(thread_.native_handle(), "graspd-modbus");
}

void ModbusServer::Loop::stop() {
  stopping_.store(true);
  mailbox_.close();
  if (thread_.joinable()) thread_.join();
}

void ModbusServer::Loop::run() {
  make_thread_prompt();
  while (!stopping_.load()) {
    std::int64_t wait_ns = longest_wait_ns;
    const std::span<pollfd> waiting = prepare_poll(monotonic_ns(), wait_ns);
    const timespec time{0, static_cast<long>(wait_ns)};
    const int ready = ppoll(waiting.data(), waiting.size(), &time, nullptr);
    if (ready < 0 && errno != EINTR) std::this_thread::sleep_for(std::chrono::nanoseconds(longest_wait_ns));
    const std::int64_t now_ns = monotonic_ns();
    session_->on_news(mailbox_.take(), now_ns);
    session_->on_delivered(monotonic_ns());
    const std::span<ModbusClientSlot> slots = clients_.slots();
    for (ModbusClientSlot& client : slots) {
      if (client.is_open() && client.filled > 0) serve_buffered(client, now_ns);
    }
    if (ready > 0) {
      for (std::size_t i = 0; i < slots.size(); ++i) {
        if (waiting[i + 2].revents != 0 && slots[i].is_open()) receive(slots[i], now_ns);
      }
      if (waiting[1].revents != 0) accept_client(now_ns);
    }
    tell_of_lasting_clients(now_ns);
    drop_unfinished(now_ns);
    session_->set_clients(static_cast<std::uint16_t>(clients_.open_count()));
    mailbox_.set_wanted(session_->wanted());
    progress_.fetch_add(1, std::memory_order_relaxed);
  }
}

/// A client that has used up its rate is not listened to for a while: its requests wait in the network.
std::span<pollfd> ModbusServer::Loop::prepare_poll(std::int64_t now_ns, std::int64_t& wait_ns) {
  waiting_[0] = {mailbox_.wake_descriptor(), POLLIN, 0};
  waiting_[1] = {now_ns < accept_again_ns_ ? -1 : listener_, POLLIN, 0};
  const std::span<ModbusClientSlot> slots = clients_.slots();
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const std::int64_t slowed_ns = slots[i].is_open() ? rate_.wait_ns(slots[i], now_ns) : 0;
    if (slowed_ns > 0) wait_ns = std::min(wait_ns, slowed_ns);
    waiting_[i + 2] = {slowed_ns > 0 ? -1 : slots[i].descriptor, POLLIN, 0};
  }
  return std::span(waiting_).first(slots.size() + 2);
}

void ModbusServer::Loop::accept_client(std::int64_t now_ns) {
  sockaddr_storage peer{};
  socklen_t size = sizeof(peer);
  const int descriptor = accept4(listener_, reinterpret_cast<sockaddr*>(&peer), &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (descriptor < 0) {
    if (errno == EAGAIN || errno == EINTR || errno == ECONNABORTED) return;
    // Out of descriptors or memory: the listener stays readable, so look away for a while.
    log_event(LogLevel::error, "E127", "connections cannot be accepted reason=\"%s\"", strerrordesc_np(errno));
    accept_again_ns_ = now_ns + accept_pause_ns;
    return;
  }
  std::array<char, 64> name{};
  format_address(peer, name);
  if (!filter_.allows(peer)) {
    if (may_log(now_ns)) log_event(LogLevel::warning, "W112", "client not on the list, refused peer=%s", name.data());
    close(descriptor);
    return;
  }
  ModbusClientSlot* slot = descriptor < FD_SETSIZE ? make_room(now_ns) : nullptr;
  if (slot == nullptr) {
    if (may_log(now_ns)) log_event(LogLevel::warning, "W114", "too many clients, refused peer=%s", name.data());
    close(descriptor);
    return;
  }
  tune_connection(descriptor);
  clients_.open(*slot, descriptor, now_ns);
  slot->name = name;
}

ModbusClientSlot* ModbusServer::Loop::make_room(std::int64_t now_ns) {
  if (ModbusClientSlot* slot = clients_.free_slot(); slot != nullptr) return slot;
  ModbusClientSlot* idle = clients_.most_idle(now_ns, idle_ns_);
  if (idle == nullptr) return nullptr;
  if (idle->was_told && may_log(now_ns)) {
    log_event(LogLevel::notice, "N113", "idle client gives way to a new one peer=%s", idle->name.data());
  }
  clients_.close(*idle);
  return idle;
}

void ModbusServer::Loop::receive(ModbusClientSlot& client, std::int64_t now_ns) {
  // More than once, so that a client which sent something and hung up is gone before the next is let in.
  for (int i = 0; i < receives_at_once && client.is_open(); ++i) {
    const std::span<std::uint8_t> room = std::span(client.buffer).subspan(client.filled);
    if (room.empty()) return;
    const ssize_t received = recv(client.descriptor, room.data(), room.size(), 0);
    if (received < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (received <= 0) {
      if (client.was_told && may_log(now_ns)) {
        log_event(LogLevel::info, "I111", "client disconnected peer=%s", client.name.data());
      }
      clients_.close(client);
      return;
    }
    if (client.filled == 0) client.begun_ns = now_ns;
    client.filled += static_cast<std::size_t>(received);
    client.heard_ns = now_ns;
    serve_buffered(client, now_ns);
  }
}

void ModbusServer::Loop::serve_buffered(ModbusClientSlot& client, std::int64_t now_ns) {
  std::size_t used = 0;
  for (;;) {
    const std::span<const std::uint8_t> bytes = std::span(client.buffer).first(client.filled).subspan(used);
    const Frame frame = next_frame(bytes);
    if (frame.state == FrameState::incomplete) break;
    if (rate_.wait_ns(client, now_ns) > 0) {
      if (!client.was_slowed && may_log(now_ns)) {
        log_event(LogLevel::warning, "W132", "client asks more often than it may, and is slowed down peer=%s",
                  client.name.data());
      }
      client.was_slowed = true;
      break;
    }
    if (frame.state == FrameState::not_modbus) {
      if (may_log(now_ns)) {
        log_event(LogLevel::warning, "W115", "what the client sends is not Modbus TCP: closed peer=%s",
                  client.name.data());
      }
      clients_.close(client);
      return;
    }
    if (!serve(client, bytes.first(frame.size), now_ns)) {
      if (may_log(now_ns)) {
        log_event(LogLevel::warning, "W116", "client does not take its answers: closed peer=%s", client.name.data());
      }
      clients_.close(client);
      return;
    }
    used += frame.size;
    rate_.count(client, now_ns);
    client.heard_ns = client.begun_ns = now_ns;
  }
  std::copy(client.buffer.begin() + static_cast<std::ptrdiff_t>(used),
            client.buffer.begin() + static_cast<std::ptrdiff_t>(client.filled), client.buffer.begin());
  client.filled -= used;
}

bool ModbusServer::Loop::serve(ModbusClientSlot& client, std::span<const std::uint8_t> request, std::int64_t now_ns) {
  modbus_set_socket(context_.get(), client.descriptor);
  const RequestVerdict verdict = check_request(request.subspan(header_size));
  if (verdict != RequestVerdict::accept) {
    if (may_log(now_ns)) {
      log_event(LogLevel::warning, "W117", "request refused peer=%s function=%u exception=%u", client.name.data(),
                unsigned{request[header_size]}, static_cast<unsigned>(verdict));
    }
    return modbus_reply_exception(context_.get(), request.data(), static_cast<unsigned>(verdict)) >= 0;
  }
  const bool answered =
      modbus_reply(context_.get(), request.data(), static_cast<int>(request.size()), mapping_.get()) >= 0;
  PlcRequest wanted;
  if (session_->on_written(now_ns, wanted)) {
    mailbox_.set_wanted(wanted.sequence);
    mailbox_.post(wanted);
  }
  return answered;
}

void ModbusServer::Loop::tell_of_lasting_clients(std::int64_t now_ns) {
  for (ModbusClientSlot& client : clients_.slots()) {
    if (!client.is_open() || client.was_told || now_ns - client.opened_ns < lasting_ns) continue;
    client.was_told = true;
    if (may_log(now_ns)) log_event(LogLevel::info, "I110", "client connected peer=%s", client.name.data());
  }
}

void ModbusServer::Loop::drop_unfinished(std::int64_t now_ns) {
  for (ModbusClientSlot& client : clients_.slots()) {
    if (!client.is_open() || client.filled == 0 || now_ns - client.begun_ns < unfinished_ns_) continue;
    if (next_frame(std::span(client.buffer).first(client.filled)).state == FrameState::complete) continue;
    if (may_log(now_ns)) {
      log_event(LogLevel::warning, "W120", "client left a request unfinished: closed peer=%s", client.name.data());
    }
    clients_.close(client);
  }
}

bool ModbusServer::Loop::may_log(std::int64_t now_ns) {
  std::uint32_t suppressed = 0;
  const bool allowed = throttle_.allow(now_ns, suppressed);
  if (suppressed > 0) log_event(LogLevel::warning, "W119", "lines about clients held back count=%u", suppressed);
  return allowed;
}

}  // namespace graspd
