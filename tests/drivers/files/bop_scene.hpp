#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "drivers/files/png_codec.hpp"
#include "tests/drivers/files/temporary_folder.hpp"

namespace graspd {

/// A small BOP data set in a temporary folder: scene 3 of split `val` with images 0 and 7 of 8 x 6 pixels,
/// one object that stands twice in image 7.
class BopFolder {
 public:
  static constexpr int width = 8;
  static constexpr int height = 6;

  BopFolder() {
    write("val/000003/scene_camera.json",
          R"({"7": {"cam_K": [500.0, 0.0, 4.5, 0.0, 510.0, 3.25, 0.0, 0.0, 1.0], "depth_scale": 0.1,
                    "cam_R_w2c": [1,0,0, 0,0,-1, 0,1,0], "cam_t_w2c": [10, 20, 30]},
              "0": {"cam_K": [400, 0, 4, 0, 400, 3, 0, 0, 1], "depth_scale": 0.5}})");
    write("val/000003/scene_gt.json",
          R"({"7": [{"cam_R_m2c": [1,0,0, 0,0,-1, 0,1,0], "cam_t_m2c": [100, -200, 700], "obj_id": 2},
                    {"cam_R_m2c": [1,0,0, 0,1,0, 0,0,1], "cam_t_m2c": [0, 0, 650.5], "obj_id": 2}], "0": []})");
    write("val/000003/scene_gt_info.json", R"({"7": [{"visib_fract": 0.25}, {"visib_fract": 1.0}], "0": []})");
    write("val_targets_bop19.json",
          R"([{"scene_id": 3, "im_id": 7, "obj_id": 2, "inst_count": 2}, {"scene_id": 3, "im_id": 0, "obj_id": 2}])");
    write("models/models_info.json",
          R"({"2": {"diameter": 50.0, "symmetries_discrete": [[-1,0,0,4, 0,-1,0,2, 0,0,1,0, 0,0,0,1]],
                    "symmetries_continuous": [{"axis": [0, 0, 2], "offset": [1, 0, 0]}]}})");
    write("models/obj_000002.ply", "ply\n");
    write_depth("val/000003/depth/000000.png", 1000);
    write_depth("val/000003/depth/000007.png", 7000);
    write_depth("val/000003/empty/000000.png", 8000);
  }

  [[nodiscard]] const std::filesystem::path& root() const { return folder_.path(); }
  [[nodiscard]] std::filesystem::path scene() const { return root() / "val" / "000003"; }
  std::filesystem::path write(const std::string& name, std::string_view content) const {
    return folder_.write(name, content);
  }
  /// Replaces the first `from` in a file.
  void change(const std::string& name, const std::string& from, const std::string& to) const {
    std::ifstream file(root() / name);
    std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    write(name, text.replace(text.find(from), from.size(), to));
  }
  /// An image of one value, but for its first pixel, which is not measured.
  void write_depth(const std::string& name, std::uint16_t value, int image_width = width) const {
    std::vector<std::uint16_t> values(static_cast<std::size_t>(image_width * height), value);
    values[0] = 0;
    const auto png = encode_png(image_width, height, PngPixels::grey16, std::as_bytes(std::span(values)));
    write(name, {reinterpret_cast<const char*>(png.value().data()), png.value().size()});
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace graspd
