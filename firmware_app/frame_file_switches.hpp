#pragma once

#include <string>

#include "drivers/files/load_frame.hpp"

namespace CLI {
class App;
}

namespace graspd {

/// What commands that read frames from files are told about them on the command line.
struct FrameFileSwitches {
  std::string units = "mm";
  std::string axes = "opencv";
  std::string camera;
  std::string empty;

  /// For the reader. Fails with bad_configuration for units or axes that have no meaning.
  [[nodiscard]] Result<FrameFileOptions> options() const;
};
void add_frame_file_switches(CLI::App& command, FrameFileSwitches& switches);

}  // namespace graspd
