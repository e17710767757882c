#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "core/geometry/depth_frame.hpp"
#include "core/status.hpp"
#include "firmware_app/background_worker.hpp"

namespace graspd {

/// Makes the folder for snapshots unless it is there, and tells whether it can be written to. Fails with cannot_write.
[[nodiscard]] Status prepare_snapshots(const std::filesystem::path& folder);

/// Keeps the frames that the PLC asked to keep, on a thread of its own, after the registers are written. Each is a
/// folder named by its time (UTC), which `graspd detect` reads; the oldest give way.
class SnapshotWriter {
 public:
  /// Of the snapshots in `folder` at most `kept` stay. `memory` holds the largest frame and must outlive the writer.
  SnapshotWriter(std::filesystem::path folder, std::size_t kept, std::span<float> memory);

  /// Copies the frame and returns; without a frame it does nothing. While the last snapshot is being written the
  /// frame is not taken, and the log says so.
  void offer(const DepthFrame& frame, std::uint16_t request_id);

 private:
  [[nodiscard]] Status write();
  void tell(const Status& written) const;
  void drop_oldest(const std::filesystem::path& newest) const;

  std::filesystem::path folder_;
  std::size_t kept_;
  std::span<float> memory_;
  Camera camera_;
  std::uint16_t request_id_ = 0;
  std::uint16_t written_id_ = 0;  ///< Of the request whose snapshot was written last; the worker's own.
  BackgroundWorker worker_;
};

}  // namespace graspd
