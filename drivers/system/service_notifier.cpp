#include "drivers/system/service_notifier.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace graspd {
namespace {

[[nodiscard]] int connect_to(const char* path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::size_t length = std::strlen(path);
  if (length < 2 || length >= sizeof(address.sun_path) || (path[0] != '/' && path[0] != '@')) return -1;
  std::memcpy(address.sun_path, path, length);
  if (path[0] == '@') address.sun_path[0] = '\0';
  const int descriptor = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) return -1;
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + length);
  if (connect(descriptor, reinterpret_cast<const sockaddr*>(&address), size) != 0) {
    close(descriptor);
    return -1;
  }
  return descriptor;
}

[[nodiscard]] std::int64_t watchdog_interval() {
  const char* interval = std::getenv("WATCHDOG_USEC");
  if (interval == nullptr) return 0;
  const char* process = std::getenv("WATCHDOG_PID");
  if (process != nullptr && std::strtol(process, nullptr, 10) != static_cast<long>(getpid())) return 0;
  constexpr long long longest = 9'000'000'000'000'000;
  return std::clamp(std::strtoll(interval, nullptr, 10), 0LL, longest) * 1000;
}

}  // namespace

ServiceNotifier::ServiceNotifier() : watchdog_interval_ns_(watchdog_interval()) {
  if (const char* path = std::getenv("NOTIFY_SOCKET"); path != nullptr) socket_ = connect_to(path);
}

ServiceNotifier::~ServiceNotifier() {
  if (socket_ >= 0) close(socket_);
}

void ServiceNotifier::ready() { send("READY=1"); }

void ServiceNotifier::stopping() { send("STOPPING=1"); }

void ServiceNotifier::watchdog() { send("WATCHDOG=1"); }

void ServiceNotifier::status(const char* format, ...) {
  std::array<char, 512> message{"STATUS="};
  const std::size_t used = std::strlen(message.data());
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(message.data() + used, message.size() - used, format, arguments);
  va_end(arguments);
  std::replace(message.begin(), message.end(), '\n', ' ');
  send(message.data());
}

void ServiceNotifier::send(const char* message) {
  if (socket_ < 0) return;
  // A full queue must not hold up the caller; systemd hears the next message.
  [[maybe_unused]] const ssize_t sent = ::send(socket_, message, std::strlen(message), MSG_NOSIGNAL | MSG_DONTWAIT);
}

}  // namespace graspd
