#include "drivers/camera/stream_packets.hpp"

#include <algorithm>
#include <utility>

namespace graspd {
namespace {

constexpr std::size_t ip_and_udp_bytes = 28;
constexpr std::size_t header_bytes = 8;
constexpr std::size_t extended_header_bytes = 20;
constexpr std::size_t part_header_bytes = 8;

enum class Content : std::uint8_t { leader = 1, trailer = 2, pixels = 3, part_of_several = 7 };

constexpr std::uint16_t payload_image = 0x0001;
constexpr std::uint16_t payload_multipart = 0x000A;
constexpr std::uint16_t part_two_dimensional_image = 0x0001;
constexpr std::uint16_t part_three_dimensional_image = 0x0005;
constexpr std::uint16_t part_confidence_map = 0x0009;

std::uint16_t data_type(StreamComponent component) {
  if (component == StreamComponent::confidence) return part_confidence_map;
  return component == StreamComponent::range ? part_three_dimensional_image : part_two_dimensional_image;
}

}  // namespace

/// Appends numbers in the network's order.
class PacketWriter {
 public:
  explicit PacketWriter(std::vector<std::byte>& bytes) : bytes_(bytes) { bytes_.clear(); }

  template <class Number>
  void put(Number number) {
    for (std::size_t i = sizeof number; i-- > 0;) {
      bytes_.push_back(static_cast<std::byte>(static_cast<std::uint64_t>(number) >> (8 * i) & 0xFFU));
    }
  }
  void put(std::span<const std::byte> run) { bytes_.insert(bytes_.end(), run.begin(), run.end()); }

 private:
  std::vector<std::byte>& bytes_;
};

namespace {

void put_header(PacketWriter& writer, std::uint16_t frame, Content content, std::uint32_t index) {
  writer.put(std::uint16_t{0});
  writer.put(frame);
  writer.put(static_cast<std::uint32_t>(content) << 24U | (index & 0xFFFFFFU));
}

/// Multipart frames carry the count of their parts where the number of the packet stands otherwise, so their
/// numbers are in the longer form of the header.
void put_extended_header(PacketWriter& writer, std::uint16_t frame, Content content, std::uint32_t index,
                         std::size_t part_count) {
  constexpr std::uint32_t extended = 1U << 31U;
  writer.put(std::uint16_t{0});
  writer.put(std::uint16_t{0});
  writer.put(extended | static_cast<std::uint32_t>(content) << 24U | static_cast<std::uint32_t>(part_count));
  writer.put(std::uint64_t{frame});
  writer.put(index);
}

void put_region(PacketWriter& writer, const SensorRegion& region) {
  for (const int number : {region.width, region.height, region.left, region.top}) {
    writer.put(static_cast<std::uint32_t>(number));
  }
}

void put_part_description(PacketWriter& writer, const StreamPart& part, std::uint16_t purpose) {
  writer.put(data_type(part.component));
  writer.put(std::uint16_t{0});
  writer.put(static_cast<std::uint32_t>(part.bytes.size()));
  writer.put(static_cast<std::uint32_t>(part.format));
  writer.put(std::uint32_t{0});
  writer.put(std::uint32_t{0});
  writer.put(purpose);
  writer.put(std::uint16_t{0});
  put_region(writer, part.region);
  for (int i = 0; i < 2; ++i) writer.put(std::uint32_t{0});
}

}  // namespace

StreamFrame::StreamFrame(std::uint16_t id, std::uint64_t timestamp_ns, std::vector<StreamPart> parts,
                         std::size_t packet_size, bool truncated)
    : id_(id), timestamp_ns_(timestamp_ns), parts_(std::move(parts)) {
  const bool several = parts_.size() > 1;
  const std::size_t overhead = ip_and_udp_bytes + (several ? extended_header_bytes + part_header_bytes : header_bytes);
  const std::size_t room = packet_size > overhead + 4 ? packet_size - overhead : 4;
  std::size_t start_in_frame = 0;
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    const std::size_t size = parts_[part].bytes.size();
    for (std::size_t start = 0; start < size; start += room) {
      payloads_.push_back({part, start, start_in_frame + start, std::min(room, size - start)});
    }
    start_in_frame += size;
  }
  if (truncated) payloads_.resize(payloads_.size() / 2);
}

void StreamFrame::make_packet(std::uint32_t index, std::vector<std::byte>& packet) const {
  PacketWriter writer(packet);
  if (parts_.size() > 1) {
    make_multipart_packet(index, writer);
  } else {
    make_image_packet(index, writer);
  }
}

void StreamFrame::make_image_packet(std::uint32_t index, PacketWriter& writer) const {
  if (index == 0) {
    put_header(writer, id_, Content::leader, index);
    writer.put(std::uint16_t{0});
    writer.put(payload_image);
    writer.put(timestamp_ns_);
    writer.put(static_cast<std::uint32_t>(parts_[0].format));
    put_region(writer, parts_[0].region);
    writer.put(std::uint32_t{0});
  } else if (index == packet_count() - 1) {
    put_header(writer, id_, Content::trailer, index);
    writer.put(std::uint32_t{payload_image});
    writer.put(static_cast<std::uint32_t>(parts_[0].region.height));
  } else {
    const Payload& payload = payloads_[index - 1];
    put_header(writer, id_, Content::pixels, index);
    writer.put(std::span(parts_[payload.part].bytes).subspan(payload.start, payload.size));
  }
}

void StreamFrame::make_multipart_packet(std::uint32_t index, PacketWriter& writer) const {
  if (index == 0) {
    put_extended_header(writer, id_, Content::leader, index, parts_.size());
    writer.put(std::uint16_t{0});
    writer.put(payload_multipart);
    writer.put(timestamp_ns_);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      put_part_description(writer, parts_[i], static_cast<std::uint16_t>(i));
    }
  } else if (index == packet_count() - 1) {
    put_extended_header(writer, id_, Content::trailer, index, 0);
    writer.put(std::uint32_t{payload_multipart});
    writer.put(std::uint32_t{0});
  } else {
    const Payload& payload = payloads_[index - 1];
    put_extended_header(writer, id_, Content::part_of_several, index, 0);
    writer.put(static_cast<std::uint8_t>(payload.part));
    writer.put(std::uint8_t{0});
    writer.put(std::uint16_t{0});
    writer.put(static_cast<std::uint32_t>(payload.start_in_frame));
    writer.put(std::span(parts_[payload.part].bytes).subspan(payload.start, payload.size));
  }
}

}  // namespace graspd
