#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>

#include "core/status.hpp"
#include "drivers/plc/client_filter.hpp"

struct _modbus;

namespace graspd {

/// A connection to a PLC that is a Modbus TCP server. Every call ends within the time limit, whatever the
/// PLC does; nothing allocates after construction. Calls fail with bad_request when the PLC answers with
/// an exception, and with internal when it cannot be reached or does not answer: then the connection is
/// of no use any more and has to be closed.
class PlcConnection {
 public:
  PlcConnection(const SocketAddress& address, std::uint8_t unit, std::chrono::milliseconds time_limit);
  ~PlcConnection();
  PlcConnection(const PlcConnection&) = delete;
  PlcConnection& operator=(const PlcConnection&) = delete;

  /// False when there was no memory to construct it with, or `unit` is none that Modbus knows.
  [[nodiscard]] bool is_usable() const { return context_ != nullptr; }
  [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }
  [[nodiscard]] Status open();
  void close();

  [[nodiscard]] Status read_coils(std::uint16_t first, std::span<std::uint8_t> levels);
  [[nodiscard]] Status read_registers(std::uint16_t first, std::span<std::uint16_t> words);
  /// At most 123 registers.
  [[nodiscard]] Status write_registers(std::uint16_t first, std::span<const std::uint16_t> words);

 private:
  struct FreeContext {
    void operator()(_modbus* context) const;
  };

  SocketAddress address_;
  std::chrono::milliseconds time_limit_;
  std::unique_ptr<_modbus, FreeContext> context_;
  int descriptor_ = -1;
};

}  // namespace graspd
