#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>

#include "firmware_app/pick_cycle.hpp"
#include "firmware_app/picture_writer.hpp"
#include "firmware_app/record_writer.hpp"
#include "firmware_app/snapshot_writer.hpp"

namespace graspd {

/// What looks at a request after the PLC has its answer; all may be null, `snapshots` only if the settings say that
/// none are kept.
struct AnswerWriters {
  PictureWriter* pictures = nullptr;
  SnapshotWriter* snapshots = nullptr;
  RecordWriter* records = nullptr;
};

/// The thread that answers requests: waits for one, runs the pick cycle, commits the answer, then logs
/// one line and offers a picture, where the PLC asked for it a snapshot, and a recording.
class PickWorker {
 public:
  /// Starts the thread, which warms up first. Everything must outlive the worker.
  PickWorker(PickCycle& cycle, PlcLink& plc, AnswerWriters writers);
  ~PickWorker();
  PickWorker(const PickWorker&) = delete;
  PickWorker& operator=(const PickWorker&) = delete;

  /// Waits until requests can be answered. Fails as warm_up does.
  [[nodiscard]] Status wait_ready();
  /// Grows as long as the thread is alive, requests or none.
  [[nodiscard]] std::uint64_t progress_count() const { return progress_.load(std::memory_order_relaxed); }
  /// Ends the thread after the request in hand. May be called more than once.
  void stop();

 private:
  void work();

  PickCycle& cycle_;
  PlcLink& plc_;
  AnswerWriters writers_;
  std::atomic<std::uint64_t> progress_{0};
  std::atomic<bool> stop_{false};
  std::atomic<bool> ready_{false};
  Status readiness_;
  std::thread thread_;
};

}  // namespace graspd
