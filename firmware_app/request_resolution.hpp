#pragma once

#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/parameters.hpp"
#include "firmware_app/pick_cycle.hpp"

namespace graspd {

/// Fails with bad_request when a register holds what has no meaning, or asks for what graspd does not serve or was
/// not configured for.
[[nodiscard]] Status check_served(const PlcRequest& request, const PickSettings& settings);

/// Turns what the PLC asked for into what the detection needs: the banks of the part asked for (all of them for
/// part 0), and the region in `parameters`. Fails with bad_request, naming the register, when a number names nothing
/// or is no number.
[[nodiscard]] Status resolve_request(const PlcRequest& request, const PickSettings& settings,
                                     std::span<const Bank> banks, std::span<const Bank>& selected,
                                     DetectParameters& parameters);

}  // namespace graspd
