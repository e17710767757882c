#include "drivers/plc/client_table.hpp"

#include <unistd.h>

#include <algorithm>

namespace graspd {
namespace {

/// Transaction, protocol, length, unit; then at least a function code.
constexpr std::size_t header_size = 7;
constexpr std::size_t length_ends = 6;
constexpr std::size_t smallest_length = 2;
constexpr std::size_t largest_length = 254;

}  // namespace

Frame next_frame(std::span<const std::uint8_t> bytes) {
  if (bytes.size() >= 4 && (bytes[2] != 0 || bytes[3] != 0)) return {FrameState::not_modbus};
  if (bytes.size() < length_ends) return {};
  const std::size_t length = static_cast<std::size_t>(bytes[4]) << 8U | bytes[5];
  if (length < smallest_length || length > largest_length) return {FrameState::not_modbus};
  const std::size_t size = length_ends + length;
  if (bytes.size() < std::max(size, header_size + 1)) return {};
  // Functions from 128 on mark exceptions; libmodbus would answer them with what looks like a success.
  if ((bytes[header_size] & 0x80U) != 0) return {FrameState::not_modbus};
  return {FrameState::complete, size};
}

ClientTable::~ClientTable() {
  for (ModbusClientSlot& slot : slots()) {
    if (slot.is_open()) close(slot);
  }
}

std::size_t ClientTable::open_count() const {
  return static_cast<std::size_t>(std::ranges::count_if(slots_, &ModbusClientSlot::is_open));
}

ModbusClientSlot* ClientTable::free_slot() {
  const auto slot = std::ranges::find_if(slots(), [](const ModbusClientSlot& s) { return !s.is_open(); });
  return slot == slots().end() ? nullptr : &*slot;
}

ModbusClientSlot* ClientTable::most_idle(std::int64_t now_ns, std::int64_t idle_ns) {
  ModbusClientSlot* found = nullptr;
  for (ModbusClientSlot& slot : slots()) {
    if (!slot.is_open() || now_ns - slot.heard_ns < idle_ns) continue;
    if (found == nullptr || slot.heard_ns < found->heard_ns) found = &slot;
  }
  return found;
}

void ClientTable::open(ModbusClientSlot& slot, int descriptor, std::int64_t now_ns) {
  slot.descriptor = descriptor;
  slot.opened_ns = now_ns;
  slot.was_told = false;
  slot.heard_ns = now_ns;
  slot.paid_ns = now_ns;
  slot.was_slowed = false;
  slot.filled = 0;
}

void ClientTable::close(ModbusClientSlot& slot) {
  ::close(slot.descriptor);
  slot.descriptor = -1;
  slot.filled = 0;
}

}  // namespace graspd
