#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "drivers/files/detection_picture.hpp"
#include "firmware_app/pick_cycle.hpp"

namespace graspd {

/// Draws the latest answer into a PNG file on a thread of its own, after the registers are written, so
/// that no answer waits for it. While a picture is being drawn newer answers are not taken.
class PictureWriter {
 public:
  /// `memory` and `banks` must outlive the writer.
  PictureWriter(std::filesystem::path path, WorkingMemory& memory, const GraspParameters& grasp);
  ~PictureWriter();
  PictureWriter(const PictureWriter&) = delete;
  PictureWriter& operator=(const PictureWriter&) = delete;

  /// Copies what the picture needs and returns; does nothing while the last picture is not finished.
  void offer(const Capture& capture, const Answer& answer);

 private:
  void work();
  void draw();

  std::filesystem::path path_;
  WorkingMemory& memory_;
  GraspParameters grasp_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool pending_ = false;
  bool stop_ = false;
  Camera camera_;
  std::span<const Bank> banks_;
  std::size_t instance_count_ = 0;
  std::optional<Pick> pick_;
  Answer answer_;
  std::thread thread_;
};

}  // namespace graspd
