#pragma once

#include <netinet/in.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/status.hpp"

namespace graspd {

/// An address and a port as the kernel wants them.
struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t size = 0;
};

/// Reads an IPv4 or IPv6 address written as a number. Fails with bad_configuration.
[[nodiscard]] Result<SocketAddress> parse_address(const std::string& text, std::uint16_t port);

/// Writes "address:port" ("[address]:port") into `text` and returns what was written.
std::string_view format_address(const sockaddr_storage& address, std::span<char> text);

/// Decides by address who may connect.
class ClientFilter {
 public:
  /// `networks`: addresses ("10.0.0.7") or networks ("10.0.0.0/24", "fd00::/8"); none: everybody may. Fails
  /// with bad_configuration, naming the entry.
  [[nodiscard]] static Result<ClientFilter> make(std::span<const std::string> networks);
  [[nodiscard]] bool allows(const sockaddr_storage& client) const;

 private:
  /// IPv4 is kept as IPv6 maps it, so that a socket bound to either sees the same list.
  struct Network {
    std::array<std::uint8_t, 16> address{};
    int bits = 0;
  };
  std::vector<Network> networks_;
};

}  // namespace graspd
