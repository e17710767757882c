#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "drivers/camera/genicam_device.hpp"
#include "drivers/files/file_descriptor.hpp"

namespace graspd {

/// Hears a camera say that an exposure is over, long before the frame is there: events over GigE Vision's message
/// channel, which Aravis knows nothing of. One thread at a time; neither clear() nor arrived() allocates.
class ExposureEvents {
 public:
  /// Has the camera send the event that its EventSelector calls `name`. None when the camera has no such event or no
  /// message channel.
  [[nodiscard]] static std::optional<ExposureEvents> subscribe(const GenicamDevice& device, const std::string& name);

  /// Forgets what came so far.
  void clear() { static_cast<void>(arrived()); }
  /// Whether the event came since the last call. Never waits.
  [[nodiscard]] bool arrived();

 private:
  ExposureEvents(FileDescriptor socket, std::optional<std::uint16_t> identifier)
      : socket_(std::move(socket)), identifier_(identifier) {}

  FileDescriptor socket_;
  std::optional<std::uint16_t> identifier_;  ///< None: the camera does not tell it, so that every event counts.
};

}  // namespace graspd
