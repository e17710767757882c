#include "core/detect/empty_bin.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "core/detect/parallel_for.hpp"
#include "core/detect/scene_map.hpp"

namespace graspd {

namespace {

/// Sixteen words that are mixed at once.
using Words = std::uint32_t __attribute__((vector_size(16)));
struct WordBlock {
  std::array<Words, 4> words;
};

/// Every step can be undone, so that no change of a single pixel is lost; the turn carries high bits to low ones.
void mix(const float* pixels, WordBlock& state) {
  constexpr std::uint32_t odd = 0x9E3779B1U;
  WordBlock block;
  std::memcpy(&block, pixels, sizeof block);
  for (std::size_t i = 0; i < block.words.size(); ++i) {
    const Words mixed = state.words[i] ^ block.words[i];
    state.words[i] = ((mixed << 13U) | (mixed >> 19U)) * odd;
  }
}

constexpr float unknown = std::numeric_limits<float>::infinity();
/// Marks a cell that was not measured and whose gap is wide along its column.
constexpr float wide_gap = -1.0F;

/// The widest gap between two depths that a wall's shadow makes in a line of so many cells. A floor that the sensor
/// does not see at all is no shadow, and may lie deeper than what stands around it.
int widest_shadow(int cells) { return cells / 8; }

/// Marks the gaps of a column that are too wide for a shadow.
void mark_column(const Camera& camera, int u, std::span<float> depths) {
  int begin = 0;  // Of the gap in hand.
  for (int v = 0; v < camera.height; ++v) {
    if (depths[camera.index(u, v)] <= 0.0F) continue;
    const bool is_wide = begin > 0 && v - begin > widest_shadow(camera.height);
    for (; is_wide && begin < v; ++begin) depths[camera.index(u, begin)] = wide_gap;
    begin = v + 1;
  }
}

/// Bridges the gaps of a row; what is wide along row and column is unknown. Only a row in which nothing was measured
/// stays empty.
void bridge_row(std::span<float> row) {
  const auto widest = static_cast<std::size_t>(widest_shadow(static_cast<int>(row.size())));
  std::size_t begin = 0;  // Of the gap in hand.
  for (std::size_t i = 0; i < row.size(); ++i) {
    const float depth = row[i];
    if (depth <= 0.0F) continue;
    const float nearest = begin == 0 ? depth : std::min(row[begin - 1], depth);
    const bool is_wide = begin > 0 && i - begin > widest;
    for (; begin < i; ++begin) row[begin] = is_wide && row[begin] < 0.0F ? unknown : nearest;
    begin = i + 1;
  }
  for (std::size_t i = begin; begin > 0 && i < row.size(); ++i) row[i] = row[begin - 1];
}

/// Bridges empty rows likewise, once all others are full.
void bridge_empty_rows(const Camera& camera, std::span<float> depths) {
  const auto row = [&](int v) { return &depths[camera.index(0, v)]; };
  int begin = 0;
  for (int v = 0; v <= camera.height; ++v) {
    const bool end = v == camera.height;
    if (!end && *row(v) <= 0.0F) continue;
    for (; begin < v; ++begin) {
      for (int u = 0; u < camera.width; ++u) {
        const float above = begin > 0 ? row(begin - 1)[u] : 0.0F;
        const float below = end ? above : row(v)[u];
        row(begin)[u] = begin > 0 ? std::min(above, below) : below;
      }
    }
    begin = v + 1;
  }
}

}  // namespace

FrameDigest digest_of(const DepthFrame& frame) {
  constexpr std::size_t at_once = sizeof(WordBlock) / sizeof(float);
  WordBlock state{};
  std::size_t i = 0;
  for (; i + at_once <= frame.depth.size(); i += at_once) mix(&frame.depth[i], state);
  std::array<float, at_once> rest{};
  std::copy(frame.depth.begin() + static_cast<std::ptrdiff_t>(i), frame.depth.end(), rest.begin());
  mix(rest.data(), state);
  FrameDigest digest{frame.camera, {}};
  static_assert(sizeof digest.pixels == sizeof state);
  std::memcpy(digest.pixels.data(), &state, sizeof state);
  return digest;
}

EmptyBin carve_empty_bin(Arena& arena, std::size_t cells) {
  EmptyBin bin;
  bin.origin = arena.take<EmptyBinOrigin>(1, "scene map");
  bin.depths = arena.take<float>(cells, "scene map");
  bin.nearest = arena.take<float>(cells, "scene map");
  return bin;
}

void keep_empty_bin(const DepthFrame& frame, int stride, const Execution& execution, std::span<float> scratch,
                    EmptyBin& bin) {
  const EmptyBinOrigin origin{digest_of(frame), stride};
  if (bin.origin.front() == origin) return;
  bin.origin.front() = {};
  const SceneMap layout = make_scene_map(frame.camera, stride, {});
  bin_depths(frame, execution, layout, scratch, bin.depths);
  std::copy_n(bin.depths.begin(), layout.camera.pixel_count(), scratch.begin());
  find_nearest_background(layout.camera, execution, scratch, bin.nearest);
  if (!execution.late()) bin.origin.front() = origin;
}

void find_nearest_background(const Camera& camera, const Execution& execution, std::span<float> depths,
                             std::span<float> nearest) {
  const auto width = static_cast<std::size_t>(camera.width);
  parallel_for(camera.width, execution, 8, [&](int u) { mark_column(camera, u, depths); });
  if (execution.late()) return;
  parallel_for(camera.height, execution, 8, [&](int v) { bridge_row(depths.subspan(camera.index(0, v), width)); });
  if (execution.late()) return;
  bridge_empty_rows(camera, depths);
  parallel_for(camera.height, execution, 8, [&](int v) {
    const float* const here = &depths[camera.index(0, v)];
    const float* const above = v > 0 ? here - width : here;
    const float* const below = v + 1 < camera.height ? here + width : here;
    float* const row = &nearest[camera.index(0, v)];
    const auto nearest_in_column = [&](std::size_t u) { return std::min(std::min(above[u], here[u]), below[u]); };
    float before = nearest_in_column(0);
    float at = before;
    for (std::size_t u = 0; u < width; ++u) {
      const float after = u + 1 < width ? nearest_in_column(u + 1) : at;
      row[u] = std::min(std::min(before, at), after);
      before = at;
      at = after;
    }
  });
}

}  // namespace graspd
