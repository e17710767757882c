#pragma once

#include <cstdint>

#include "core/status.hpp"

namespace graspd {

/// What a PLC that misbehaves has seen.
struct FaultyPlcReport {
  long rounds = 0;
  long verdicts = 0;       ///< Answers that it took, with a pick or without.
  long stale = 0;          ///< `done` with the block of another request.
  long invalid_picks = 0;  ///< `result_valid` without a whole, verified block of the request at hand.
  long not_recovered = 0;  ///< Rounds after which the handshake did not come back to `ready`.
};

/// Goes `rounds` times through the handshake and each time misbehaves once, by turns and at a place that `seed`
/// chooses: vanishes and reconnects, leaves a request half sent, resets, acknowledges and triggers where it should
/// not. Then it goes through one request as it should. Fails when the server cannot be reached.
[[nodiscard]] Result<FaultyPlcReport> run_faulty_plc(std::uint16_t port, long rounds, std::uint32_t seed);

}  // namespace graspd
