#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace graspd {

/// The answer that a request deserves; the numbers are Modbus exception codes.
enum class RequestVerdict : std::uint8_t {
  accept = 0,
  illegal_function = 1,
  illegal_address = 2,
  illegal_value = 3,
};

/// Whether the request register at `address` may hold `value`.
[[nodiscard]] bool is_request_value(std::size_t address, unsigned value);

/// Judges a request, from its function code on (without the MBAP header), against the register map:
/// whether its length fits its function, whether every address exists and may be written, and whether
/// every value is allowed. What is accepted can be carried out without looking again.
[[nodiscard]] RequestVerdict check_request(std::span<const std::uint8_t> request);

}  // namespace graspd
