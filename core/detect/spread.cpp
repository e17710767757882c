#include "core/detect/spread.hpp"

#include <algorithm>
#include <array>

#include "core/detect/consistency.hpp"

namespace graspd {

namespace {

constexpr std::size_t most_places = 512;
constexpr int cells_per_place = 4;

}  // namespace

void keep_spread(const SceneMap& map, const Bank& bank, const SpreadLimits& limits, const Execution& execution,
                 std::span<std::uint16_t> counts, FixedVector<PoseCluster>& clusters) {
  const int places_per_row = map.camera.width / cells_per_place + 1;
  const int rows = map.camera.height / cells_per_place + 1;
  std::fill_n(counts.begin(), static_cast<std::size_t>(places_per_row) * static_cast<std::size_t>(rows),
              std::uint16_t{0});
  std::array<std::uint32_t, most_places> places;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < clusters.size() && kept < static_cast<std::size_t>(limits.count); ++k) {
    if (k % 64 == 0 && execution.late()) break;
    std::size_t explained = 0;
    std::size_t open = 0;
    for_each_confirmed(map, bank, clusters[k].camera_from_part, limits.points, limits.tolerance, [&](std::size_t cell) {
      if (explained == most_places) return;
      const int u = static_cast<int>(cell) % map.camera.width / cells_per_place;
      const int v = static_cast<int>(cell) / map.camera.width / cells_per_place;
      const auto place = static_cast<std::uint32_t>(v * places_per_row + u);
      open += counts[place] < limits.per_place ? 1U : 0U;
      places[explained++] = place;
    });
    if (2 * open < explained || explained == 0) continue;
    std::sort(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(explained));
    const auto end = std::unique(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(explained));
    std::for_each(places.begin(), end, [&](std::uint32_t place) { ++counts[place]; });
    clusters[kept++] = clusters[k];
  }
  clusters.truncate(kept);
}

}  // namespace graspd
