#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "drivers/files/detection_picture.hpp"
#include "firmware_app/background_worker.hpp"
#include "firmware_app/pick_cycle.hpp"

namespace graspd {

/// Draws the latest answer into a PNG file on a thread of its own, after the registers are written, so
/// that no answer waits for it. While a picture is being drawn newer answers are not taken.
class PictureWriter {
 public:
  /// `memory` and `banks` must outlive the writer.
  PictureWriter(std::filesystem::path path, WorkingMemory& memory, const GraspParameters& grasp);

  /// Copies what the picture needs and returns; does nothing while the last picture is not finished.
  void offer(const Capture& capture, const Answer& answer);

 private:
  [[nodiscard]] Status draw() const;

  std::filesystem::path path_;
  WorkingMemory& memory_;
  GraspParameters grasp_;
  Camera camera_;
  std::span<const Bank> banks_;
  std::size_t instance_count_ = 0;
  std::optional<Pick> pick_;
  Answer answer_;
  BackgroundWorker worker_;
};

}  // namespace graspd
