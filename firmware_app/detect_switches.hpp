#pragma once

#include <string>
#include <vector>

#include "firmware_app/configuration.hpp"

namespace CLI {
class App;
}

namespace graspd {

/// What commands that detect in files are told about the configuration on the command line.
struct ConfigurationSwitches {
  std::string file;
  std::vector<float> flange;  ///< x y z qx qy qz qw, millimetres; empty: not given.

  /// As the configuration file says, with a camera on the flange where it was when the frame was taken; the
  /// defaults without a file. Fails as read_configuration does, and with usage when the flange's pose is missing
  /// or none.
  [[nodiscard]] Result<Configuration> read() const;
};
/// `what` tells what the command takes from the file.
void add_configuration_switches(CLI::App& command, ConfigurationSwitches& switches, const std::string& what);

}  // namespace graspd
