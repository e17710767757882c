#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "core/status.hpp"
#include "drivers/plc/plc_link.hpp"

namespace graspd {

struct PollerOptions {
  std::string address;  ///< Of the PLC: IPv4 or IPv6, as a number.
  std::uint16_t port = 502;
  std::uint8_t unit = 255;                          ///< Unit id, see is_unit; 255 for a PLC that is reached directly.
  std::uint16_t coil_address = 0;                   ///< Where the PLC keeps the coils of the register map,
  std::uint16_t request_address = 0;                ///< among its holding registers the request registers,
  std::uint16_t result_address = 1000;              ///< and room for what graspd writes.
  std::chrono::milliseconds poll_period{10};        ///< Between looks at the coils.
  std::chrono::milliseconds response_timeout{500};  ///< A PLC that takes longer counts as lost; 10 ms to 10 s.
  BlockFormat format;                               ///< The convention applies when the request names none.
  std::chrono::milliseconds heartbeat_timeout{0};   ///< The PLC's heartbeat must change this often; 0: not watched.
  std::chrono::milliseconds request_timeout{0};     ///< The worker must answer within; 0: not watched.
};

/// The link's thread shows no progress while it waits for the PLC: longer than this it must not stand still.
inline constexpr std::chrono::milliseconds longest_response_timeout{10'000};

/// Whether Modbus TCP knows this unit id: the numbers from 248 on are reserved, but for 255.
[[nodiscard]] constexpr bool is_unit(std::uint8_t unit) { return unit < 248 || unit == 255; }

/// Whether the PLC's request registers and the room for what graspd writes share an address.
[[nodiscard]] bool areas_overlap(const PollerOptions& options);

/// graspd as the Modbus client of a PLC that is a server: looks at the PLC's coils and request registers,
/// and writes the result block, the lists and the live registers into its holding registers, each block with
/// its last sequence number by itself after the rest, and `done` after all of them. One thread of its own;
/// connects again by itself. A PLC that cannot be reached counts as silent. Nothing allocates after start().
class ModbusPoller : public PlcLink {
 public:
  /// Starts the thread; the PLC need not be there yet. Fails with bad_configuration for options that make
  /// no sense.
  [[nodiscard]] static Result<std::unique_ptr<ModbusPoller>> start(const PollerOptions& options);
  ~ModbusPoller() override;

  [[nodiscard]] bool wait_for_request(PlcRequest& request, std::chrono::milliseconds timeout) override;
  [[nodiscard]] bool is_wanted(std::uint16_t sequence) const override;
  void capture_done(std::uint16_t sequence) override;
  void commit(const ResultBlock& result) override;
  void set_camera_ok(bool ok) override;
  void set_model_loaded(bool loaded) override;
  [[nodiscard]] std::uint64_t progress_count() const override;
  void stop() override;

 private:
  class Loop;
  explicit ModbusPoller(std::unique_ptr<Loop> loop);
  std::unique_ptr<Loop> loop_;
};

}  // namespace graspd
