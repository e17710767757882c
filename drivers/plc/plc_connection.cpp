#include "drivers/plc/plc_connection.hpp"

#include <modbus.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace graspd {
namespace {

/// Connects within the time limit; 0 or the reason why not.
[[nodiscard]] int connect_within(int descriptor, const SocketAddress& address, std::chrono::milliseconds limit) {
  if (connect(descriptor, reinterpret_cast<const sockaddr*>(&address.storage), address.size) == 0) return 0;
  if (errno != EINPROGRESS) return errno;
  pollfd waiting{descriptor, POLLOUT, 0};
  if (poll(&waiting, 1, static_cast<int>(limit.count())) != 1) return ETIMEDOUT;
  int problem = 0;
  socklen_t size = sizeof(problem);
  getsockopt(descriptor, SOL_SOCKET, SO_ERROR, &problem, &size);
  return problem;
}

[[nodiscard]] Status outcome(int returned, const char* what, std::uint16_t first, std::size_t count) {
  if (returned == static_cast<int>(count)) return {};
  const bool is_exception = errno > MODBUS_ENOBASE && errno < EMBBADCRC;
  return Status::format(is_exception ? StatusCode::bad_request : StatusCode::internal, "%s %u to %zu: %s", what,
                        unsigned{first}, first + count - 1, modbus_strerror(errno));
}

}  // namespace

void PlcConnection::FreeContext::operator()(_modbus* context) const { modbus_free(context); }

PlcConnection::PlcConnection(const SocketAddress& address, std::uint8_t unit, std::chrono::milliseconds time_limit)
    : address_(address), time_limit_(time_limit), context_(modbus_new_tcp("127.0.0.1", MODBUS_TCP_DEFAULT_PORT)) {
  if (context_ == nullptr) return;
  if (modbus_set_slave(context_.get(), unit) != 0) {
    // It would ask another unit.
    context_.reset();
    return;
  }
  const auto microseconds = static_cast<std::uint32_t>(std::chrono::microseconds(time_limit).count());
  modbus_set_response_timeout(context_.get(), microseconds / 1'000'000, microseconds % 1'000'000);
  // Without a limit between bytes the one above holds for the whole answer, however it trickles.
  modbus_set_byte_timeout(context_.get(), 0, 0);
}

PlcConnection::~PlcConnection() { close(); }

Status PlcConnection::open() {
  close();
  const int descriptor = socket(address_.storage.ss_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (descriptor < 0) return Status::format(StatusCode::internal, "no socket: %s", strerrordesc_np(errno));
  // libmodbus waits with select, whose sets hold no more.
  const int problem = descriptor < FD_SETSIZE ? connect_within(descriptor, address_, time_limit_) : EMFILE;
  if (problem != 0) {
    ::close(descriptor);
    return Status::format(StatusCode::internal, "cannot connect: %s", strerrordesc_np(problem));
  }
  const int on = 1;
  setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  descriptor_ = descriptor;
  modbus_set_socket(context_.get(), descriptor_);
  return {};
}

void PlcConnection::close() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  descriptor_ = -1;
  modbus_set_socket(context_.get(), -1);
}

Status PlcConnection::read_coils(std::uint16_t first, std::span<std::uint8_t> levels) {
  const int count = modbus_read_bits(context_.get(), first, static_cast<int>(levels.size()), levels.data());
  return outcome(count, "reading the coils", first, levels.size());
}

Status PlcConnection::read_registers(std::uint16_t first, std::span<std::uint16_t> words) {
  const int count = modbus_read_registers(context_.get(), first, static_cast<int>(words.size()), words.data());
  return outcome(count, "reading the holding registers", first, words.size());
}

Status PlcConnection::write_registers(std::uint16_t first, std::span<const std::uint16_t> words) {
  const int count = modbus_write_registers(context_.get(), first, static_cast<int>(words.size()), words.data());
  return outcome(count, "writing the holding registers", first, words.size());
}

}  // namespace graspd
