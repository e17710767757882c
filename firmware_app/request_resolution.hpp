#pragma once

#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/parameters.hpp"
#include "core/grasp/parameters.hpp"
#include "firmware_app/pick_cycle.hpp"

namespace graspd {

/// What detection and choice go by for one request.
struct ResolvedRequest {
  std::span<const Bank> banks;  ///< Of the part asked for; all of them for part 0.
  DetectParameters detect;      ///< With the region.
  GraspParameters grasp;        ///< With the camera where it is at the exposure.
};

/// What requests of both kinds must keep to. Fails with bad_request when a register holds what has no meaning, names no
/// part or tool that there is, or asks for what graspd was not configured for.
[[nodiscard]] Status check_served(const PlcRequest& request, const PickSettings& settings, std::span<const Bank> banks);

/// Turns what the PLC asked for into what is needed to answer it. With a camera on the flange the request's pose says
/// where it is, and all that is given in the robot's frame follows. Fails with bad_request, naming the register, when a
/// number names nothing or is no number, or when the pose is needed and not given.
[[nodiscard]] Status resolve_request(const PlcRequest& request, const PickSettings& settings,
                                     std::span<const Bank> banks, ResolvedRequest& resolved);

}  // namespace graspd
