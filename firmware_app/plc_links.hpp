#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/status.hpp"
#include "drivers/plc/plc_link.hpp"
#include "firmware_app/configuration.hpp"

namespace graspd {

/// The line to the PLC, with what the journal says of it.
struct OpenedLink {
  std::unique_ptr<PlcLink> link;
  const char* role = "";
  std::string address;  ///< That is listened on, or the PLC's.
  std::uint16_t port = 0;
};

/// Opens the line in the configured role. Fails with bad_configuration or address_in_use.
[[nodiscard]] Result<OpenedLink> open_plc_link(const Configuration& configuration);

}  // namespace graspd
