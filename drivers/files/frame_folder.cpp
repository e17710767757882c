#include "drivers/files/frame_folder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <vector>

#include "drivers/files/atomic_file.hpp"
#include "drivers/files/depth_image.hpp"

namespace graspd {
namespace {

namespace fs = std::filesystem;

constexpr double millimetres_per_step = 0.1;

[[nodiscard]] std::vector<std::uint16_t> depth_steps(const DepthFrame& frame) {
  std::vector<std::uint16_t> steps(frame.depth.size());
  std::ranges::transform(frame.depth, steps.begin(), [](float metres) {
    const double value = std::round(static_cast<double>(metres) * 1e3 / millimetres_per_step);
    constexpr double most = std::numeric_limits<std::uint16_t>::max();
    return value > 0 && value <= most ? static_cast<std::uint16_t>(value) : std::uint16_t{0};
  });
  return steps;
}

[[nodiscard]] std::string camera_text(const Camera& camera) {
  const nlohmann::json json{{"fx", camera.fx},
                            {"fy", camera.fy},
                            {"cx", camera.cx},
                            {"cy", camera.cy},
                            {"width", camera.width},
                            {"height", camera.height},
                            {"depth_scale", millimetres_per_step}};
  return json.dump(2) + "\n";
}

[[nodiscard]] Status cannot_write(const fs::path& folder, const std::error_code& problem) {
  return Status::format(StatusCode::cannot_write, "%s: %s", folder.c_str(), problem.message().c_str());
}

}  // namespace

Status write_frame_folder(const fs::path& folder, const DepthFrame& frame) {
  const fs::path unfinished = folder.string() + ".unfinished";
  if (Status made = make_folder(unfinished); !made.ok()) return made;
  std::error_code problem;
  Status written =
      write_depth_png(unfinished / "depth.png", frame.camera.width, frame.camera.height, depth_steps(frame));
  if (written.ok()) written = write_file(unfinished / "camera.json", camera_text(frame.camera));
  if (written.ok()) {
    fs::rename(unfinished, folder, problem);
    if (problem) written = cannot_write(folder, problem);
  }
  if (!written.ok()) fs::remove_all(unfinished, problem);
  return written;
}

}  // namespace graspd
