#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/status.hpp"
#include "drivers/camera/frame_source.hpp"
#include "drivers/camera/genicam_device.hpp"
#include "drivers/camera/scan3d.hpp"

namespace graspd {

/// What makes the camera expose.
enum class CameraTrigger : std::uint8_t {
  software,      ///< graspd, once for each request.
  hardware,      ///< A line into the camera; graspd takes the next frame, or one that is not too old.
  free_running,  ///< Nothing: the camera exposes all the time; graspd takes frames as with hardware.
};

/// How a GenICam camera is used.
struct GenicamOptions {
  std::string device = "first";  ///< Serial number, IP address, or "first".
  CameraTrigger trigger = CameraTrigger::software;
  std::string trigger_line = "Line0";  ///< TriggerSource for CameraTrigger::hardware.
  std::string exposure_event =
      "ExposureEnd";                        ///< What EventSelector calls the end of an exposure; empty: not asked for.
  std::int64_t timeout_ns = 2'000'000'000;  ///< From the request for a frame to the frame.
  std::int64_t maximum_age_ns = 1'000'000'000;  ///< Of a frame that was exposed before it was asked for.
  bool confidence = true;                       ///< Have the camera send confidences where it can, and use them.
  bool packet_resend = true;                    ///< Ask for lost packets again.
  int packet_size = 0;                          ///< Bytes of a packet with its headers; 0: as the camera has it.
  std::vector<Feature> features;                ///< Set in this order.
  Scan3dSettings scan3d;
  FrameLimits limits{1280, 1024};
};

/// Frames under way, being decoded, and kept for a request.
inline constexpr std::size_t genicam_buffer_count = 3;

/// The most bytes that buffers of frames up to `limits` take, with three coordinates and confidences.
[[nodiscard]] std::size_t genicam_buffer_bytes(const FrameLimits& limits);

/// Sets components, features and trigger of a camera that is not streaming. `sends_confidence` tells whether
/// frames will bring confidences. Fails with bad_configuration for what the camera does not take, and with
/// camera_lost.
[[nodiscard]] Status set_up_camera(const GenicamDevice& device, const GenicamOptions& options, bool& sends_confidence);

/// Reads the Scan3d nodes of the component that is selected.
[[nodiscard]] Scan3dNodes read_scan3d_nodes(const GenicamDevice& device);

/// The number behind Scan3dOutputMode; none when the camera has no such node or does not answer.
[[nodiscard]] std::optional<std::int64_t> read_output_mode(const GenicamDevice& device);

}  // namespace graspd
