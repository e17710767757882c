#include "drivers/files/bop_writer.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <string>
#include <vector>

#include "drivers/files/atomic_file.hpp"
#include "drivers/files/json_file.hpp"

namespace graspd {
namespace {

namespace fs = std::filesystem;

/// A little-endian TIFF while it is put together.
class TiffBytes {
 public:
  template <class Number>
  void put(Number number) {
    const std::size_t end = bytes.size();
    bytes.resize(end + sizeof number);
    std::memcpy(bytes.data() + end, &number, sizeof number);
  }
  /// A field with one 32-bit value.
  void field(std::uint16_t tag, std::uint32_t value) {
    constexpr std::uint16_t long_type = 4;
    put(tag);
    put(long_type);
    put(std::uint32_t{1});
    put(value);
  }

  std::vector<std::byte> bytes;
};

int number_behind(const nlohmann::json& images) {
  int next = 0;
  for (const auto& [key, value] : images.items()) {
    int number = -1;
    std::from_chars(key.data(), key.data() + key.size(), number);
    next = std::max(next, number + 1);
  }
  return next;
}

}  // namespace

Status write_depth_tiff(const fs::path& path, const DepthFrame& frame) {
  constexpr std::uint16_t field_count = 10;
  constexpr std::uint32_t header_bytes = 8;
  constexpr std::uint32_t pixels_at = header_bytes + 2 + field_count * 12 + 4;
  const auto width = static_cast<std::uint32_t>(frame.camera.width);
  const auto height = static_cast<std::uint32_t>(frame.camera.height);
  const auto pixel_bytes = static_cast<std::uint32_t>(frame.depth.size_bytes());
  TiffBytes tiff;
  tiff.bytes.reserve(pixels_at + pixel_bytes);
  tiff.put(std::uint16_t{0x4949});  // "II": little-endian
  tiff.put(std::uint16_t{42});
  tiff.put(header_bytes);
  tiff.put(field_count);
  tiff.field(256, width);
  tiff.field(257, height);
  tiff.field(258, 32);           // BitsPerSample
  tiff.field(259, 1);            // Compression: none
  tiff.field(262, 1);            // Photometric: black is zero
  tiff.field(273, pixels_at);    // StripOffsets
  tiff.field(277, 1);            // SamplesPerPixel
  tiff.field(278, height);       // RowsPerStrip
  tiff.field(279, pixel_bytes);  // StripByteCounts
  tiff.field(339, 3);            // SampleFormat: IEEE floats
  tiff.put(std::uint32_t{0});
  const std::span<const std::byte> pixels = std::as_bytes(frame.depth);
  tiff.bytes.insert(tiff.bytes.end(), pixels.begin(), pixels.end());
  return write_file(path, tiff.bytes);
}

Result<fs::path> append_bop_image(const fs::path& scene_folder, const DepthFrame& frame) {
  if (Status made = make_folder(scene_folder / "depth"); !made.ok()) return made;
  const fs::path cameras_file = scene_folder / "scene_camera.json";
  nlohmann::json images = nlohmann::json::object();
  if (is_bop_scene(scene_folder)) {
    Result<nlohmann::json> read = read_json(cameras_file);
    if (!read.ok()) return read.status();
    images = std::move(read).value();
    if (!images.is_object())
      return Status::format(StatusCode::bad_file, "%s: not a list of images", cameras_file.c_str());
  }
  const int number = number_behind(images);
  const fs::path image = scene_folder / "depth" / (bop_number(number) + ".tiff");
  if (Status written = write_depth_tiff(image, frame); !written.ok()) return written;
  const Camera& c = frame.camera;
  constexpr double millimetres_per_metre = 1000.0;
  images[std::to_string(number)] = {{"cam_K", {c.fx, 0.0, c.cx, 0.0, c.fy, c.cy, 0.0, 0.0, 1.0}},
                                    {"depth_scale", millimetres_per_metre}};
  if (Status written = write_file(cameras_file, images.dump(1) + "\n"); !written.ok()) return written;
  return image;
}

Result<fs::path> write_bop_empty_bin(const fs::path& scene_folder, const DepthFrame& frame) {
  if (Status made = make_folder(scene_folder / "empty"); !made.ok()) return made;
  const fs::path image = scene_folder / "empty" / "000000.tiff";
  if (Status written = write_depth_tiff(image, frame); !written.ok()) return written;
  const Camera& c = frame.camera;
  const nlohmann::json camera = {{"fx", c.fx},       {"fy", c.fy},         {"cx", c.cx},        {"cy", c.cy},
                                 {"width", c.width}, {"height", c.height}, {"depth_scale", 1e3}};
  if (Status written = write_file(image.parent_path() / "camera.json", camera.dump(1) + "\n"); !written.ok()) {
    return written;
  }
  return image;
}

Status write_bop_ground_truth(const fs::path& scene_folder, std::span<const BopInstance> instances) {
  nlohmann::json truth = nlohmann::json::object();
  nlohmann::json visibility = nlohmann::json::object();
  for (const BopInstance& instance : instances) {
    const RigidTransform& pose = instance.camera_from_part;
    nlohmann::json rotation = nlohmann::json::array();
    nlohmann::json translation = nlohmann::json::array();
    for (int i = 0; i < 9; ++i) rotation.push_back(pose.rotation(i / 3, i % 3));
    for (int i = 0; i < 3; ++i) translation.push_back(static_cast<double>(pose.translation[i]) * 1e3);
    const std::string image = std::to_string(instance.im_id);
    truth[image].push_back({{"obj_id", instance.obj_id}, {"cam_R_m2c", rotation}, {"cam_t_m2c", translation}});
    visibility[image].push_back({{"visib_fract", instance.visible_share}});
  }
  if (Status written = write_file(scene_folder / "scene_gt.json", truth.dump(1) + "\n"); !written.ok()) return written;
  return write_file(scene_folder / "scene_gt_info.json", visibility.dump(1) + "\n");
}

}  // namespace graspd
