#include "core/detect/normals.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/lanes.hpp"

namespace graspd {

namespace {

/// Planes z = a x + b y + c by least squares about cells that stand side by side, one in each lane.
struct PlaneFits {
  Lanes a{};
  Lanes b{};
  Lanes c{};
  Lanes deviation{};  ///< Root mean square, along z.
  LaneMask count{};   ///< Of the points; 0: they do not hold a plane.
};

/// The points around a few cells of a row, column by column.
struct Neighbourhood {
  static constexpr int most_radius = 4;
  static constexpr std::size_t width = lane_count + 2 * most_radius;
  using Row = std::array<float, width>;
  std::array<Row, 2 * most_radius + 1> x, y, z;
  int radius;

  /// Around the cells from (u, v) on; beyond the map nothing is measured.
  Neighbourhood(const SceneMap& map, int u, int v, int around) : radius(around) {
    const int left = u - radius;
    const int top = v - radius;
    const int columns = static_cast<int>(lane_count) + 2 * radius;
    const int rows = 2 * radius + 1;
    const bool inside = map.camera.contains(left, top) && map.camera.contains(left + columns - 1, top + rows - 1);
    for (int j = 0; j < rows; ++j) {
      const auto row = static_cast<std::size_t>(j);
      for (int i = 0; i < columns; ++i) {
        const auto column = static_cast<std::size_t>(i);
        const bool seen = inside || map.camera.contains(left + i, top + j);
        const Vector3 point = seen ? map.at(left + i, top + j).point : Vector3(Vector3::Zero());
        x[row][column] = point.x();
        y[row][column] = point.y();
        z[row][column] = point.z();
      }
    }
  }
};

/// Fits the planes to what is within `gate` of those so far.
PlaneFits fit_planes(const Neighbourhood& near, const PlaneFits& guess, const Lanes& gate) {
  const auto middle = static_cast<std::size_t>(near.radius);
  const Lanes origin_x = load_lanes(near.x[middle].data() + near.radius);
  const Lanes origin_y = load_lanes(near.y[middle].data() + near.radius);
  const Lanes origin_z = load_lanes(near.z[middle].data() + near.radius);
  Lanes sx{};
  Lanes sy{};
  Lanes sz{};
  Lanes sxx{};
  Lanes sxy{};
  Lanes syy{};
  Lanes sxz{};
  Lanes syz{};
  Lanes szz{};
  LaneMask n{};
  for (std::size_t row = 0; row <= 2 * middle; ++row) {
    for (int column = 0; column <= 2 * near.radius; ++column) {
      const Lanes z = load_lanes(near.z[row].data() + column);
      Lanes dx = load_lanes(near.x[row].data() + column) - origin_x;
      Lanes dy = load_lanes(near.y[row].data() + column) - origin_y;
      Lanes dz = z - origin_z;
      const Lanes off = dz - (guess.a * dx + guess.b * dy + guess.c);
      const LaneMask counts = (z > 0.0F) & (magnitude(off) <= gate);
      dx = counts ? dx : Lanes{};
      dy = counts ? dy : Lanes{};
      dz = counts ? dz : Lanes{};
      sx += dx;
      sy += dy;
      sz += dz;
      sxx += dx * dx;
      sxy += dx * dy;
      syy += dy * dy;
      sxz += dx * dz;
      syz += dy * dz;
      szz += dz * dz;
      n -= counts;
    }
  }
  PlaneFits fit;
  const Lanes scale = 1.0F / __builtin_convertvector(n, Lanes);
  const Lanes cxx = sxx - sx * sx * scale;
  const Lanes cxy = sxy - sx * sy * scale;
  const Lanes cyy = syy - sy * sy * scale;
  const Lanes cxz = sxz - sx * sz * scale;
  const Lanes cyz = syz - sy * sz * scale;
  const Lanes determinant = cxx * cyy - cxy * cxy;
  fit.count = ((n >= 5) & (determinant > 1e-3F * cxx * cyy)) ? n : LaneMask{};
  fit.a = (cxz * cyy - cyz * cxy) / determinant;
  fit.b = (cyz * cxx - cxz * cxy) / determinant;
  fit.c = (sz - fit.a * sx - fit.b * sy) * scale;
  const Lanes czz = szz - sz * sz * scale;
  const Lanes square = (czz - fit.a * cxz - fit.b * cyz) * scale;
  for (std::size_t i = 0; i < lane_count; ++i) fit.deviation[i] = std::sqrt(std::max(0.0F, square[i]));
  return fit;
}

/// Fits the normals of those of the cells from (u, v) on that belong to the foreground.
void fit_normals_from(int u, int v, int radius, SceneMap& map) {
  const int some = std::min(static_cast<int>(lane_count), map.camera.width - u);
  const std::span<MapCell> cells = map.cells.subspan(map.camera.index(u, v), static_cast<std::size_t>(some));
  if (std::none_of(cells.begin(), cells.end(), [](const MapCell& cell) { return cell.foreground != 0; })) return;
  const Neighbourhood near(map, u, v, radius);
  Lanes coarse_gate{};
  Lanes narrowest{};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    coarse_gate[i] = map.surface_step(cells[i].point.z()) * static_cast<float>(radius);
    narrowest[i] = 0.2F * map.footprint(cells[i].point.z());
  }
  const PlaneFits coarse = fit_planes(near, {}, coarse_gate);
  const Lanes wide = 1.5F * coarse.deviation;
  const PlaneFits fine = fit_planes(near, coarse, wide < narrowest ? narrowest : wide);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    MapCell& cell = cells[i];
    if (cell.foreground == 0 || coarse.count[i] < 5) continue;
    const PlaneFits& fit = fine.count[i] >= 5 ? fine : coarse;
    cell.normal = Vector3(fit.a[i], fit.b[i], -1.0F).normalized();
    // A cell seen from behind its fitted plane is no surface that the sensor could have measured.
    if (cell.normal.dot(cell.point) >= 0.0F) cell.normal.setZero();
  }
}

}  // namespace

void fit_normals(int radius, const Execution& execution, SceneMap& map) {
  radius = std::min(radius, Neighbourhood::most_radius);
  parallel_for(map.camera.height, execution, 8, [&](int v) {
    for (int u = 0; u < map.camera.width; u += static_cast<int>(lane_count)) fit_normals_from(u, v, radius, map);
  });
}

}  // namespace graspd
