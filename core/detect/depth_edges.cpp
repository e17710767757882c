#include "core/detect/depth_edges.hpp"

#include <algorithm>
#include <array>

namespace graspd {

namespace {

constexpr int widest_gap = 12;

/// True when the scene falls away in direction (du, dv), seen from a cell of the foreground.
bool falls_away(const SceneMap& map, int u, int v, int du, int dv) {
  const float z = map.at(u, v).point.z();
  for (int k = 1; k <= widest_gap; ++k) {
    const int x = u + k * du;
    const int y = v + k * dv;
    if (!map.camera.contains(x, y)) return false;
    const MapCell& next = map.at(x, y);
    if (!next.measured()) continue;
    return next.point.z() - z > static_cast<float>(k) * map.surface_step(z);
  }
  return false;
}

// While edges spread, they are kept by row and column.
constexpr std::uint32_t packed(int u, int v) {
  return static_cast<std::uint32_t>(v) << 16U | static_cast<std::uint32_t>(u);
}
static_assert(no_edge == packed(0xFFFF, 0xFFFF));

void mark_row(const SceneMap& map, int v, std::span<std::uint32_t> nearest) {
  constexpr std::array<std::array<int, 2>, 4> directions{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  const int width = map.camera.width;
  const bool inner_row = v > 0 && v + 1 < map.camera.height;
  const MapCell* const cells = &map.at(0, v);
  for (int u = 0; u < width; ++u) {
    nearest[static_cast<std::size_t>(u)] = no_edge;
    if (cells[u].foreground == 0) continue;
    bool falls = false;
    const auto looked_across = [&] {
      return std::any_of(directions.begin(), directions.end(),
                         [&](const auto& d) { return falls_away(map, u, v, d[0], d[1]); });
    };
    if (inner_row && u > 0 && u + 1 < width) {
      // Next to most cells something was measured, which decides at once.
      const float z = cells[u].point.z();
      const std::array<float, 4> next{cells[u + 1].point.z(), cells[u - 1].point.z(), cells[u + width].point.z(),
                                      cells[u - width].point.z()};
      const float deepest = std::max(std::max(next[0], next[1]), std::max(next[2], next[3]));
      const float nearest_next = std::min(std::min(next[0], next[1]), std::min(next[2], next[3]));
      falls = deepest - z > map.surface_step(z) || (nearest_next <= 0.0F && looked_across());
    } else {
      falls = looked_across();
    }
    if (falls) nearest[static_cast<std::size_t>(u)] = packed(u, v);
  }
}

/// Lets each cell hear of the edges of its neighbours, in the order of a distance transform.
struct Spread {
  int reach;
  int width;
  std::span<std::uint32_t> nearest;

  [[nodiscard]] static int squared_distance(int u, int v, std::uint32_t edge) {
    const int du = u - static_cast<int>(edge & 0xFFFFU);
    const int dv = v - static_cast<int>(edge >> 16U);
    return du * du + dv * dv;
  }
  /// Takes over an edge that is nearer than the cell's own.
  void take(int u, int v, std::uint32_t candidate, std::uint32_t& own) const {
    if (candidate == no_edge) return;
    const int distance = squared_distance(u, v, candidate);
    if (distance <= reach * reach && (own == no_edge || distance < squared_distance(u, v, own))) own = candidate;
  }
  /// A row hears of the row beside it (null at the border) and of itself in direction `step`, and then back.
  void sweep_row(int v, int step, const std::uint32_t* beside) const {
    std::uint32_t* const row = nearest.data() + static_cast<std::size_t>(v) * static_cast<std::size_t>(width);
    const int first = step > 0 ? 0 : width - 1;
    const auto at = [&](const std::uint32_t* of, int u) { return u >= 0 && u < width ? of[u] : no_edge; };
    std::uint32_t before = no_edge;
    for (int u = first; u >= 0 && u < width; u += step) {
      const std::array<std::uint32_t, 3> there =
          beside == nullptr ? std::array{no_edge, no_edge, no_edge}
                            : std::array{at(beside, u - step), beside[u], at(beside, u + step)};
      if ((before & there[0] & there[1] & there[2]) != no_edge) {
        take(u, v, before, row[u]);
        for (const std::uint32_t candidate : there) take(u, v, candidate, row[u]);
      }
      before = row[u];
    }
    before = no_edge;
    for (int u = width - 1 - first; u >= 0 && u < width; u -= step) {
      take(u, v, before, row[u]);
      before = row[u];
    }
  }
};

}  // namespace

void find_depth_edges(const SceneMap& map, int reach, const Execution& execution, DepthEdges& edges) {
  const int width = map.camera.width;
  const int height = map.camera.height;
  const auto row = [&](int v) {
    return edges.nearest.subspan(map.camera.index(0, v), static_cast<std::size_t>(width));
  };
  parallel_for(height, execution, 8, [&](int v) { mark_row(map, v, row(v)); });
  const Spread spread{reach, width, edges.nearest};
  for (int v = 0; v < height; ++v) {
    if (execution.late()) return;
    spread.sweep_row(v, 1, v > 0 ? row(v - 1).data() : nullptr);
  }
  for (int v = height - 1; v >= 0; --v) {
    if (execution.late()) return;
    spread.sweep_row(v, -1, v + 1 < height ? row(v + 1).data() : nullptr);
  }
  for (std::uint32_t& edge : edges.nearest) {
    const std::uint32_t index = (edge >> 16U) * static_cast<std::uint32_t>(width) + (edge & 0xFFFFU);
    edge = edge == no_edge ? no_edge : index;
  }
}

}  // namespace graspd
