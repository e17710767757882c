#pragma once

#include <cstdint>
#include <span>

#include "drivers/plc/plc_link.hpp"

namespace graspd {

/// The convention in which a request writes and wants orientations: its own, or that of `format`.
[[nodiscard]] PoseConvention request_convention(std::span<const std::uint16_t> registers, const BlockFormat& format);

/// Reads the request registers (request_register::count words) as the PLC wrote them. Kind, sequence and
/// time are left as they are in a fresh PlcRequest. A flange pose in quaternions that are no rotation is
/// given as not finite, so that nobody takes it for one.
[[nodiscard]] PlcRequest read_request(std::span<const std::uint16_t> registers, const BlockFormat& format);

}  // namespace graspd
