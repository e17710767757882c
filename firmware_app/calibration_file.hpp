#pragma once

#include <string>
#include <vector>

#include "core/calibrate/hand_eye.hpp"
#include "core/status.hpp"

namespace graspd {

/// What `graspd calibrate` works on (configs/calibration.toml explains each key). Metres.
struct CalibrationFile {
  HandEyeSetup setup = HandEyeSetup::eye_to_hand;
  std::vector<HandEyePair> pairs;
  std::vector<int> lines;  ///< Where each pair stands in the file.
};

/// Reads a file of pairs. Fails with bad_configuration: file, line, key, what is wrong and what is allowed.
[[nodiscard]] Result<CalibrationFile> read_calibration_file(const std::string& path);

}  // namespace graspd
