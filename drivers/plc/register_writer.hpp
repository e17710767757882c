#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/status.hpp"
#include "drivers/plc/plc_connection.hpp"
#include "drivers/plc/register_map.hpp"

namespace graspd {

/// Carries result block, lists and live registers into the holding registers of a PLC, and only what the PLC
/// does not hold yet. The order is what keeps a PLC from using half an answer: first `done` and
/// `result_valid` go out, then comes each block without its last sequence number, then that number, and at
/// the end `done`.
class RegisterWriter {
 public:
  /// `first`: where the register that is input register 0 of the map lies among the PLC's holding registers.
  explicit RegisterWriter(std::uint16_t first) : first_(first) {}

  /// The PLC may hold anything.
  void forget() { is_known_ = false; }
  /// Writes what differs in `registers` (input_register_space words); the lists only when `lists` is set.
  [[nodiscard]] Status write(PlcConnection& plc, std::span<const std::uint16_t> registers, bool lists);

 private:
  [[nodiscard]] Status write_block(PlcConnection& plc, std::span<const std::uint16_t> registers, std::size_t first,
                                   std::size_t count);
  [[nodiscard]] Status put(PlcConnection& plc, std::size_t first, std::span<const std::uint16_t> words);
  [[nodiscard]] bool differs(std::span<const std::uint16_t> registers, std::size_t first, std::size_t count) const;

  std::uint16_t first_;
  bool is_known_ = false;
  std::array<std::uint16_t, input_register_space> written_{};  ///< What the PLC holds.
};

}  // namespace graspd
