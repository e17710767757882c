#pragma once

#include "core/status.hpp"
#include "firmware_app/configuration.hpp"

namespace graspd {

/// Serves the PLC until SIGTERM or SIGINT. Everything that can fail is tried before the service says
/// that it is ready: banks, frames, memory budget, the Modbus address, locking. Fails with the code of
/// the first of these that did not work.
[[nodiscard]] Status run_daemon(const Configuration& configuration);

}  // namespace graspd
