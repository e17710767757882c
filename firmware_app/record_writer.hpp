#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/status.hpp"
#include "firmware_app/background_worker.hpp"
#include "firmware_app/loaded_banks.hpp"
#include "firmware_app/pick_cycle.hpp"
#include "firmware_app/record_folder.hpp"

namespace graspd {

/// Records requests on a thread of its own, after the registers are written: the frame and the frame of the
/// empty bin as they were in every bit, and beside them
///   record.json       the request, what the PLC was told, digests of configuration and banks
///   detections.json   what `graspd detect --replayable` prints for this frame
///   graspd.toml       the configuration
/// While one is being written newer ones are not taken, and the log says so. Recorded are captures that were answered
/// from their frame, and those whose frame was of no use (bad_frame); not those that were given up, timed out, or that
/// failed otherwise.
class RecordWriter {
 public:
  /// Takes all memory that it will need for frames up to `frame_pixels`, and `instances` found or rejected.
  RecordWriter(RecordFolder folder, RecordWhen when, const std::string& configuration_file, const LoadedBanks& banks,
               std::size_t frame_pixels, std::size_t instances);

  /// Copies what is to be recorded and returns; never allocates. `answer` is the one to `request`, whose frame and
  /// detections `capture` holds.
  void offer(const Capture& capture, const PlcRequest& request, const Answer& answer, const DepthFrame& empty_bin);

 private:
  struct BankDigest {
    std::uint32_t part = 0;
    std::string file;
    std::string digest;
  };

  [[nodiscard]] Status record();
  void tell(const Status& recorded) const;
  [[nodiscard]] Status write(const std::filesystem::path& scene) const;
  [[nodiscard]] std::string record_text() const;

  RecordFolder folder_;
  RecordWhen when_;
  std::string configuration_file_;
  std::string configuration_;
  std::vector<BankDigest> digests_;

  // What is being recorded.
  std::vector<float> depth_;
  std::vector<float> empty_depth_;
  std::vector<Instance> instances_;
  Camera camera_;
  bool has_empty_ = false;
  std::span<const Bank> banks_;
  Detections detections_;
  PlcRequest request_;
  Answer answer_;

  // Of what was recorded last; the worker's own.
  std::filesystem::path recorded_scene_;
  std::uint16_t recorded_id_ = 0;
  BackgroundWorker worker_;
};

/// The most memory that a RecordWriter of these sizes takes, with the file that is being written.
[[nodiscard]] std::size_t record_bytes(std::size_t frame_pixels, std::size_t instances);

}  // namespace graspd
