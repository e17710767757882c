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

struct Spread {
  const SceneMap& map;
  int reach;
  DepthEdges& edges;

  /// Takes over the edge of a neighbour when it is nearer than the cell's own.
  void from(int u, int v, int du, int dv) {
    if (!map.camera.contains(u + du, v + dv)) return;
    const std::uint32_t candidate = edges.nearest[map.camera.index(u + du, v + dv)];
    if (candidate == no_edge) return;
    std::uint32_t& own = edges.nearest[map.camera.index(u, v)];
    const int distance = squared_distance(u, v, candidate);
    if (distance <= reach * reach && (own == no_edge || distance < squared_distance(u, v, own))) own = candidate;
  }
  [[nodiscard]] int squared_distance(int u, int v, std::uint32_t cell) const {
    const int du = u - static_cast<int>(cell) % map.camera.width;
    const int dv = v - static_cast<int>(cell) / map.camera.width;
    return du * du + dv * dv;
  }
};

}  // namespace

void find_depth_edges(const SceneMap& map, int reach, const Execution& execution, DepthEdges& edges) {
  constexpr std::array<std::array<int, 2>, 4> directions{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  for (int v = 0; v < map.camera.height; ++v) {
    if (execution.late()) return;
    for (int u = 0; u < map.camera.width; ++u) {
      const std::size_t index = map.camera.index(u, v);
      edges.nearest[index] = no_edge;
      if (map.cells[index].foreground == 0) continue;
      for (const auto& [du, dv] : directions) {
        if (falls_away(map, u, v, du, dv)) edges.nearest[index] = static_cast<std::uint32_t>(index);
      }
    }
  }
  // Two sweeps, as for a distance transform: each cell hears of the edges of the cells before it.
  Spread spread{map, reach, edges};
  for (int v = 0; v < map.camera.height; ++v) {
    if (execution.late()) return;
    for (int u = 0; u < map.camera.width; ++u) {
      for (const auto& [du, dv] : {std::array{-1, 0}, std::array{-1, -1}, std::array{0, -1}, std::array{1, -1}})
        spread.from(u, v, du, dv);
    }
    for (int u = map.camera.width - 1; u >= 0; --u) spread.from(u, v, 1, 0);
  }
  for (int v = map.camera.height - 1; v >= 0; --v) {
    if (execution.late()) return;
    for (int u = map.camera.width - 1; u >= 0; --u) {
      for (const auto& [du, dv] : {std::array{1, 0}, std::array{1, 1}, std::array{0, 1}, std::array{-1, 1}})
        spread.from(u, v, du, dv);
    }
    for (int u = 0; u < map.camera.width; ++u) spread.from(u, v, -1, 0);
  }
}

}  // namespace graspd
