#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "drivers/camera/depth_decoding.hpp"
#include "drivers/camera/depth_encoding.hpp"

namespace graspd {

/// What the pixels of a part tell.
enum class StreamComponent : std::uint8_t { range, confidence, intensity };

/// One component of a frame on its way out of a simulated camera.
struct StreamPart {
  StreamComponent component = StreamComponent::range;
  PixelFormat format = PixelFormat::coordinate_c16;
  SensorRegion region;
  std::vector<std::byte> bytes;
};

class PacketWriter;

/// A frame cut into the packets of GigE Vision's stream protocol: a leader, the pixels, a trailer. Any packet
/// can be made again, for a client that lost it.
class StreamFrame {
 public:
  /// `packet_size` is that of the whole packet with its IP and UDP headers. More than one part makes a
  /// multipart frame. `truncated` leaves out the second half of the pixels.
  StreamFrame(std::uint16_t id, std::uint64_t timestamp_ns, std::vector<StreamPart> parts, std::size_t packet_size,
              bool truncated);

  [[nodiscard]] std::uint16_t id() const { return id_; }
  [[nodiscard]] std::uint32_t packet_count() const { return static_cast<std::uint32_t>(payloads_.size()) + 2; }
  /// Writes packet `index`, which must be below packet_count(), to `packet`.
  void make_packet(std::uint32_t index, std::vector<std::byte>& packet) const;

 private:
  /// A run of bytes that travels in one packet.
  struct Payload {
    std::size_t part = 0;
    std::size_t start = 0;  ///< In the part.
    std::size_t start_in_frame = 0;
    std::size_t size = 0;
  };

  void make_image_packet(std::uint32_t index, PacketWriter& writer) const;
  void make_multipart_packet(std::uint32_t index, PacketWriter& writer) const;

  std::uint16_t id_;
  std::uint64_t timestamp_ns_;
  std::vector<StreamPart> parts_;
  std::vector<Payload> payloads_;
};

}  // namespace graspd
