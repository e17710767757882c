#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "core/status.hpp"
#include "drivers/camera/frame_source.hpp"
#include "drivers/files/load_frame.hpp"

namespace graspd {

/// What a recorded source plays.
struct RecordedSourceOptions {
  std::filesystem::path path;  ///< A BOP scene folder, a folder of frame files, or one frame file.
  std::vector<int> images;     ///< For a BOP scene: which images, in this order; empty: all.
  FrameFileOptions files;      ///< For frames outside a BOP scene.
  std::size_t maximum_bytes = std::size_t{256} << 20U;  ///< For all frames together.
};

/// Reads all frames that the options name. Fails as load_frame and load_bop_frame do, with bad_file when there are
/// none, and with memory_limit when they need more than maximum_bytes.
[[nodiscard]] Result<std::vector<LoadedFrame>> load_recorded_frames(const RecordedSourceOptions& options);

/// Frames from files, over and over. All are read when it opens, so that grabbing one is a copy.
class RecordedSource final : public FrameSource {
 public:
  /// Fails as load_recorded_frames does.
  [[nodiscard]] static Result<std::unique_ptr<RecordedSource>> open(const RecordedSourceOptions& options);

  [[nodiscard]] Status grab(std::span<float> storage, DepthFrame& frame) override;
  [[nodiscard]] FrameLimits limits() const override { return limits_; }
  [[nodiscard]] DepthFrame empty_bin() override;
  [[nodiscard]] std::string_view frame_name() const override;

  [[nodiscard]] std::size_t frame_count() const { return frames_.size(); }
  /// What the frames take, for the memory budget.
  [[nodiscard]] std::size_t bytes() const;

 private:
  explicit RecordedSource(std::vector<LoadedFrame> frames);

  std::vector<LoadedFrame> frames_;
  FrameLimits limits_;
  std::size_t last_ = 0;
  std::uint64_t grabbed_ = 0;
};

}  // namespace graspd
