#include "drivers/plc/register_writer.hpp"

#include <algorithm>

#include "drivers/plc/handshake.hpp"

namespace graspd {
namespace {

constexpr std::size_t most_registers = 123;
constexpr unsigned answered_bits =
    1U << discrete_input::done | 1U << discrete_input::error | 1U << discrete_input::result_valid;

using LiveRegisters = std::array<std::uint16_t, live_register::count>;

[[nodiscard]] LiveRegisters live_of(std::span<const std::uint16_t> registers) {
  LiveRegisters live{};
  std::ranges::copy(registers.subspan(live_register::first, live_register::count), live.begin());
  return live;
}

/// The live registers as they were before the answer.
[[nodiscard]] LiveRegisters unanswered(LiveRegisters live) {
  std::uint16_t& status = live[live_register::status_word - live_register::first];
  std::uint16_t& phase = live[live_register::phase - live_register::first];
  status = static_cast<std::uint16_t>(status & ~answered_bits);
  if (phase == static_cast<std::uint16_t>(HandshakePhase::finished)) {
    phase = static_cast<std::uint16_t>(HandshakePhase::processing);
  }
  return live;
}

}  // namespace

Status RegisterWriter::write(PlcConnection& plc, std::span<const std::uint16_t> registers, bool lists) {
  const bool block_differs = differs(registers, 0, block::count);
  const bool floats_differ = lists && differs(registers, pick_list::floats_first, pick_list::count);
  const bool scaled_differ = lists && differs(registers, pick_list::scaled_first, pick_list::count);
  if (block_differs || floats_differ || scaled_differ) {
    if (!is_known_ || (written_[live_register::status_word] & answered_bits) != 0) {
      if (Status status = put(plc, live_register::first, unanswered(live_of(registers))); !status.ok()) return status;
    }
    const auto write_if = [&](bool wanted, std::size_t first, std::size_t count) {
      return wanted ? write_block(plc, registers, first, count) : Status();
    };
    // The lists first: once the block has its last sequence number, all three belong to one answer.
    if (Status status = write_if(floats_differ, pick_list::floats_first, pick_list::count); !status.ok()) return status;
    if (Status status = write_if(scaled_differ, pick_list::scaled_first, pick_list::count); !status.ok()) return status;
    if (Status status = write_if(block_differs, 0, block::count); !status.ok()) return status;
  }
  if (differs(registers, live_register::first, live_register::count)) {
    if (Status status = put(plc, live_register::first, live_of(registers)); !status.ok()) return status;
  }
  is_known_ = true;
  return {};
}

Status RegisterWriter::write_block(PlcConnection& plc, std::span<const std::uint16_t> registers, std::size_t first,
                                   std::size_t count) {
  const std::size_t last = first + count - 1;
  if (!is_known_) {
    // What an earlier run of graspd left there could carry the same number by chance.
    const std::array<std::uint16_t, 1> other{static_cast<std::uint16_t>(~registers[last])};
    if (Status status = put(plc, last, other); !status.ok()) return status;
  }
  for (std::size_t at = first; at < last; at += most_registers) {
    const std::size_t size = std::min(most_registers, last - at);
    if (Status status = put(plc, at, registers.subspan(at, size)); !status.ok()) return status;
  }
  return put(plc, last, registers.subspan(last, 1));
}

Status RegisterWriter::put(PlcConnection& plc, std::size_t first, std::span<const std::uint16_t> words) {
  std::ranges::copy(words, written_.begin() + static_cast<std::ptrdiff_t>(first));
  return plc.write_registers(static_cast<std::uint16_t>(first_ + first), words);
}

bool RegisterWriter::differs(std::span<const std::uint16_t> registers, std::size_t first, std::size_t count) const {
  return !is_known_ || !std::ranges::equal(registers.subspan(first, count), std::span(written_).subspan(first, count));
}

}  // namespace graspd
