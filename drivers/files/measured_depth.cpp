#include "drivers/files/measured_depth.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

#include "core/geometry/depth_frame.hpp"

namespace graspd {

float median_depth(std::span<const float> depth) {
  std::vector<float> measured;
  measured.reserve(depth.size());
  std::copy_if(depth.begin(), depth.end(), std::back_inserter(measured), is_measured);
  if (measured.empty()) return 0.0F;
  const auto middle = measured.begin() + static_cast<std::ptrdiff_t>(measured.size() / 2);
  std::nth_element(measured.begin(), middle, measured.end());
  return *middle;
}

Status check_measured(std::span<const float> depth, const std::filesystem::path& path) {
  const float median = median_depth(depth);
  if (median == 0.0F) {
    return Status::format(StatusCode::bad_frame, "%s: no pixel is measured: was the camera covered or its light off?",
                          path.c_str());
  }
  if (is_bin_distance(median)) return {};
  return Status::format(StatusCode::bad_frame,
                        "%s: what it shows lies %g metres away: is depth_scale (millimetres of one step) right?",
                        path.c_str(), static_cast<double>(median));
}

}  // namespace graspd
