#include "drivers/plc/request_check.hpp"

#include <array>
#include <cstddef>

#include "drivers/plc/orientation.hpp"
#include "drivers/plc/register_map.hpp"

namespace graspd {
namespace {

constexpr std::size_t maximum_read_bits = 2000;
constexpr std::size_t maximum_read_registers = 125;
constexpr std::size_t maximum_write_registers = 123;

struct AddressRange {
  std::size_t first;
  std::size_t count;
};

constexpr std::array<AddressRange, 1> coil_ranges{{{0, coil::count}}};
constexpr std::array<AddressRange, 1> discrete_ranges{{{0, discrete_input::count}}};
constexpr std::array<AddressRange, 4> input_ranges{{
    {0, block::count},
    {live_register::first, live_register::count},
    {pick_list::floats_first, pick_list::count},
    {pick_list::scaled_first, pick_list::count},
}};
constexpr std::array<AddressRange, 5> holding_ranges{{
    {0, request_register::count},
    {holding_mirror, block::count},
    {holding_mirror + live_register::first, live_register::count},
    {holding_mirror + pick_list::floats_first, pick_list::count},
    {holding_mirror + pick_list::scaled_first, pick_list::count},
}};
constexpr std::array<AddressRange, 1> writable_ranges{{{0, request_register::count}}};

[[nodiscard]] bool contains(std::span<const AddressRange> ranges, std::size_t address, std::size_t count) {
  for (const AddressRange& range : ranges) {
    if (address >= range.first && address + count <= range.first + range.count) return true;
  }
  return false;
}

/// Reads big-endian words out of a request.
class Fields {
 public:
  explicit Fields(std::span<const std::uint8_t> request) : request_(request) {}
  [[nodiscard]] unsigned byte(std::size_t offset) const { return request_[offset]; }
  [[nodiscard]] unsigned word(std::size_t offset) const { return byte(offset) << 8U | byte(offset + 1); }
  [[nodiscard]] bool values_allowed(std::size_t offset, std::size_t address, std::size_t count) const {
    for (std::size_t i = 0; i < count; ++i) {
      if (!is_request_value(address + i, word(offset + 2 * i))) return false;
    }
    return true;
  }

 private:
  std::span<const std::uint8_t> request_;
};

[[nodiscard]] RequestVerdict check_read(std::span<const std::uint8_t> request, std::span<const AddressRange> ranges,
                                        std::size_t maximum) {
  if (request.size() != 5) return RequestVerdict::illegal_value;
  const Fields fields(request);
  const std::size_t count = fields.word(3);
  if (count < 1 || count > maximum) return RequestVerdict::illegal_value;
  return contains(ranges, fields.word(1), count) ? RequestVerdict::accept : RequestVerdict::illegal_address;
}

[[nodiscard]] RequestVerdict check_write_coil(std::span<const std::uint8_t> request) {
  if (request.size() != 5) return RequestVerdict::illegal_value;
  const Fields fields(request);
  if (!contains(coil_ranges, fields.word(1), 1)) return RequestVerdict::illegal_address;
  const unsigned value = fields.word(3);
  return value == 0x0000 || value == 0xFF00 ? RequestVerdict::accept : RequestVerdict::illegal_value;
}

[[nodiscard]] RequestVerdict check_write_register(std::span<const std::uint8_t> request) {
  if (request.size() != 5) return RequestVerdict::illegal_value;
  const Fields fields(request);
  if (!contains(writable_ranges, fields.word(1), 1)) return RequestVerdict::illegal_address;
  return is_request_value(fields.word(1), fields.word(3)) ? RequestVerdict::accept : RequestVerdict::illegal_value;
}

[[nodiscard]] RequestVerdict check_write_coils(std::span<const std::uint8_t> request) {
  if (request.size() < 6) return RequestVerdict::illegal_value;
  const Fields fields(request);
  const std::size_t count = fields.word(3);
  const std::size_t bytes = fields.byte(5);
  if (count < 1 || bytes != (count + 7) / 8 || request.size() != 6 + bytes) return RequestVerdict::illegal_value;
  return contains(coil_ranges, fields.word(1), count) ? RequestVerdict::accept : RequestVerdict::illegal_address;
}

[[nodiscard]] RequestVerdict check_write_registers(std::span<const std::uint8_t> request) {
  if (request.size() < 6) return RequestVerdict::illegal_value;
  const Fields fields(request);
  const std::size_t count = fields.word(3);
  const std::size_t bytes = fields.byte(5);
  if (count < 1 || count > maximum_write_registers || bytes != 2 * count || request.size() != 6 + bytes) {
    return RequestVerdict::illegal_value;
  }
  if (!contains(writable_ranges, fields.word(1), count)) return RequestVerdict::illegal_address;
  return fields.values_allowed(6, fields.word(1), count) ? RequestVerdict::accept : RequestVerdict::illegal_value;
}

[[nodiscard]] RequestVerdict check_write_and_read(std::span<const std::uint8_t> request) {
  if (request.size() < 10) return RequestVerdict::illegal_value;
  const Fields fields(request);
  const std::size_t read_count = fields.word(3);
  const std::size_t write_count = fields.word(7);
  const std::size_t bytes = fields.byte(9);
  if (read_count < 1 || read_count > maximum_read_registers || write_count < 1 || bytes != 2 * write_count ||
      request.size() != 10 + bytes) {
    return RequestVerdict::illegal_value;
  }
  if (!contains(holding_ranges, fields.word(1), read_count) ||
      !contains(writable_ranges, fields.word(5), write_count)) {
    return RequestVerdict::illegal_address;
  }
  return fields.values_allowed(10, fields.word(5), write_count) ? RequestVerdict::accept
                                                                : RequestVerdict::illegal_value;
}

}  // namespace

bool is_request_value(std::size_t address, unsigned value) {
  if (address == request_register::minimum_score) return value <= 10000;
  if (address == request_register::pose_convention) return value <= pose_convention_count;
  if (address == request_register::options) return value <= request_option::all;
  if (address == request_register::results_wanted) return value <= pick_list::entries;
  if (address == request_register::region) {
    return value <= request_region::most_numbers || value == request_region::box;
  }
  return true;
}

RequestVerdict check_request(std::span<const std::uint8_t> request) {
  if (request.empty()) return RequestVerdict::illegal_function;
  switch (request[0]) {
    case 0x01:
      return check_read(request, coil_ranges, maximum_read_bits);
    case 0x02:
      return check_read(request, discrete_ranges, maximum_read_bits);
    case 0x03:
      return check_read(request, holding_ranges, maximum_read_registers);
    case 0x04:
      return check_read(request, input_ranges, maximum_read_registers);
    case 0x05:
      return check_write_coil(request);
    case 0x06:
      return check_write_register(request);
    case 0x0F:
      return check_write_coils(request);
    case 0x10:
      return check_write_registers(request);
    case 0x17:
      return check_write_and_read(request);
    default:
      return RequestVerdict::illegal_function;
  }
}

}  // namespace graspd
