#pragma once

#include <span>
#include <string_view>

#include "core/geometry/depth_frame.hpp"
#include "core/status.hpp"

namespace graspd {

/// The largest frame that a source can deliver: it fixes the storage for frames.
struct FrameLimits {
  int maximum_width = 0;
  int maximum_height = 0;
};

/// Somebody who waits for the end of exposures.
class ExposureListener {
 public:
  virtual ~ExposureListener() = default;

  /// The frame that is being grabbed has been exposed: what the camera looks at may move from now on.
  virtual void exposure_over() = 0;
};

/// Where depth frames come from.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// Takes the next frame: writes its depth to `storage` (at least the pixels of limits()) and points
  /// `frame` at it. Never allocates. Fails with camera_lost, bad_frame or stale_frame; `frame` is
  /// untouched then.
  [[nodiscard]] virtual Status grab(std::span<float> storage, DepthFrame& frame) = 0;

  [[nodiscard]] virtual FrameLimits limits() const = 0;

  /// The bin without parts that belongs to the last frame grabbed, in memory of the source; empty `depth`
  /// when there is none.
  [[nodiscard]] virtual DepthFrame empty_bin() = 0;

  /// A name of the last frame grabbed, for the journal.
  [[nodiscard]] virtual std::string_view frame_name() const = 0;

  /// From now on grab() tells `listener` (null: nobody), which must live as long, when an exposure is over before its
  /// frame is there; on the thread that grabs. Sources that cannot know stay silent.
  virtual void set_exposure_listener(ExposureListener* /*listener*/) {}

  /// False as long as a frame asked for now could not come: the camera is not connected.
  [[nodiscard]] virtual bool connected() const { return true; }
};

}  // namespace graspd
