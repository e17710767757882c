#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <span>
#include <thread>

#include "core/geometry/depth_frame.hpp"
#include "core/status.hpp"

namespace graspd {

/// Makes the folder for snapshots unless it is there, and tells whether it can be written to. Fails with cannot_write.
[[nodiscard]] Status prepare_snapshots(const std::filesystem::path& folder);

/// Keeps the frames that the PLC asked to keep, on a thread of its own, after the registers are written. Each is a
/// folder named by its time (UTC), which `graspd detect` reads; the oldest give way.
class SnapshotWriter {
 public:
  /// Of the snapshots in `folder` at most `kept` stay. `memory` holds the largest frame and must outlive the writer.
  SnapshotWriter(std::filesystem::path folder, std::size_t kept, std::span<float> memory);
  /// Writes what was offered before it ends.
  ~SnapshotWriter();
  SnapshotWriter(const SnapshotWriter&) = delete;
  SnapshotWriter& operator=(const SnapshotWriter&) = delete;

  /// Copies the frame and returns; without a frame it does nothing. While the last snapshot is being written the
  /// frame is not taken, and the log says so.
  void offer(const DepthFrame& frame, std::uint16_t request_id);

 private:
  void work();
  [[nodiscard]] Status write() const;
  void drop_oldest() const;

  std::filesystem::path folder_;
  std::size_t kept_;
  std::span<float> memory_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool pending_ = false;
  bool stop_ = false;
  Camera camera_;
  std::uint16_t request_id_ = 0;
  std::thread thread_;
};

}  // namespace graspd
