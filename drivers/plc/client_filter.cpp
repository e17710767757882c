#include "drivers/plc/client_filter.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstring>

namespace graspd {
namespace {

using AddressBytes = std::array<std::uint8_t, 16>;
constexpr int mapped_bits = 96;

[[nodiscard]] AddressBytes bytes_of(const sockaddr_storage& address) {
  AddressBytes bytes{};
  if (address.ss_family == AF_INET6) {
    sockaddr_in6 six{};
    std::memcpy(&six, &address, sizeof(six));
    std::memcpy(bytes.data(), &six.sin6_addr, bytes.size());
  } else {
    sockaddr_in four{};
    std::memcpy(&four, &address, sizeof(four));
    bytes[10] = 0xFF;
    bytes[11] = 0xFF;
    std::memcpy(&bytes[12], &four.sin_addr, 4);
  }
  return bytes;
}

[[nodiscard]] bool same_prefix(const AddressBytes& a, const AddressBytes& b, int bits) {
  for (std::size_t i = 0; i < a.size() && bits > 0; ++i, bits -= 8) {
    const unsigned mask = bits >= 8 ? 0xFFU : (0xFF00U >> static_cast<unsigned>(bits)) & 0xFFU;
    if (((a[i] ^ b[i]) & mask) != 0) return false;
  }
  return true;
}

}  // namespace

Result<SocketAddress> parse_address(const std::string& text, std::uint16_t port) {
  SocketAddress address;
  sockaddr_in four{};
  sockaddr_in6 six{};
  if (inet_pton(AF_INET, text.c_str(), &four.sin_addr) == 1) {
    four.sin_family = AF_INET;
    four.sin_port = htons(port);
    std::memcpy(&address.storage, &four, sizeof(four));
    address.size = sizeof(four);
  } else if (inet_pton(AF_INET6, text.c_str(), &six.sin6_addr) == 1) {
    six.sin6_family = AF_INET6;
    six.sin6_port = htons(port);
    std::memcpy(&address.storage, &six, sizeof(six));
    address.size = sizeof(six);
  } else {
    return Status::format(StatusCode::bad_configuration,
                          "'%s' is no IP address: write it as a number, as in 192.168.1.10", text.c_str());
  }
  return address;
}

std::string_view format_address(const sockaddr_storage& address, std::span<char> text) {
  std::array<char, INET6_ADDRSTRLEN> name{};
  unsigned port = 0;
  const bool is_six = address.ss_family == AF_INET6;
  if (is_six) {
    sockaddr_in6 six{};
    std::memcpy(&six, &address, sizeof(six));
    inet_ntop(AF_INET6, &six.sin6_addr, name.data(), name.size());
    port = ntohs(six.sin6_port);
  } else {
    sockaddr_in four{};
    std::memcpy(&four, &address, sizeof(four));
    inet_ntop(AF_INET, &four.sin_addr, name.data(), name.size());
    port = ntohs(four.sin_port);
  }
  const int wanted = std::snprintf(text.data(), text.size(), is_six ? "[%s]:%u" : "%s:%u", name.data(), port);
  return {text.data(), std::min(static_cast<std::size_t>(std::max(wanted, 0)), text.size() - 1)};
}

Result<ClientFilter> ClientFilter::make(std::span<const std::string> networks) {
  ClientFilter filter;
  for (const std::string& text : networks) {
    const std::size_t slash = text.find('/');
    Result<SocketAddress> address = parse_address(text.substr(0, slash), 0);
    if (!address.ok()) {
      return Status::format(StatusCode::bad_configuration,
                            "allowed client '%s': write an address (192.168.1.10) or a network (192.168.1.0/24)",
                            text.c_str());
    }
    const bool is_four = address.value().storage.ss_family == AF_INET;
    const int most = is_four ? 32 : 128;
    int bits = most;
    if (slash != std::string::npos) {
      const char* end = text.data() + text.size();
      const auto [stop, error] = std::from_chars(text.data() + slash + 1, end, bits);
      if (error != std::errc() || stop != end || bits < 0 || bits > most) {
        return Status::format(StatusCode::bad_configuration, "allowed client '%s': the prefix must be 0 to %d",
                              text.c_str(), most);
      }
    }
    filter.networks_.push_back({bytes_of(address.value().storage), bits + (is_four ? mapped_bits : 0)});
  }
  return filter;
}

bool ClientFilter::allows(const sockaddr_storage& client) const {
  if (networks_.empty()) return true;
  const AddressBytes bytes = bytes_of(client);
  return std::ranges::any_of(networks_,
                             [&](const Network& network) { return same_prefix(network.address, bytes, network.bits); });
}

}  // namespace graspd
