#pragma once

#include "core/detect/verify.hpp"
#include "core/geometry/image_lanes.hpp"
#include "core/geometry/lane_vectors.hpp"

namespace graspd {

/// Depths of the model at four cells side by side and at their neighbours (metres); 0 where it is not.
struct ModelCells {
  Lanes here, right, left, below, above;

  /// The cells from (u, v) of the model's rectangle on.
  ModelCells(const RenderedModel& model, int u, int v)
      : here(pixels_at(model.camera, model.front, u, v)),
        right(pixels_at(model.camera, model.front, u + 1, v)),
        left(pixels_at(model.camera, model.front, u - 1, v)),
        below(pixels_at(model.camera, model.front, u, v + 1)),
        above(pixels_at(model.camera, model.front, u, v - 1)) {}
};

/// Four cells of the map side by side.
struct MeasuredCells {
  Lanes depth{};
  Lanes background{};
  LaneVectors normal;
  LaneMask foreground{};

  /// As MapCell has it.
  [[nodiscard]] LaneMask has_normal() const { return normal.z != 0.0F; }
};

/// Those that lie on the cells from (u, v) of the model's rectangle on; beyond it nothing is measured.
[[nodiscard]] inline MeasuredCells measured_cells(const SceneMap& map, const RenderedModel& model, int u, int v) {
  MeasuredCells measured;
  const MapCell* const cells = &map.at(model.rectangle.left + u, model.rectangle.top + v);
  const auto take = [&](std::size_t i) {
    measured.depth[i] = cells[i].point.z();
    measured.background[i] = cells[i].background;
    measured.normal.set(i, cells[i].normal);
    measured.foreground[i] = static_cast<std::int32_t>(cells[i].foreground);
  };
  const auto inside = static_cast<std::size_t>(model.rectangle.width - u);
  if (inside >= lane_count) {
    for (std::size_t i = 0; i < lane_count; ++i) take(i);
  } else {
    for (std::size_t i = 0; i < inside; ++i) take(i);
  }
  return measured;
}

/// Where rays point at depth 1, through four cells of a row and their neighbours in it.
struct RowRays {
  Lanes before, here, after;

  RowRays(const Camera& camera, int u)
      : before(columns(camera, u - 1)), here(columns(camera, u)), after(columns(camera, u + 1)) {}

 private:
  static Lanes columns(const Camera& camera, int u) {
    return (static_cast<float>(u) + Lanes{0.0F, 1.0F, 2.0F, 3.0F} - camera.cx) / camera.fx;
  }
};

/// The same for a cell of a column.
struct ColumnRays {
  float before, here, after;

  ColumnRays(const Camera& camera, int v)
      : before((static_cast<float>(v - 1) - camera.cy) / camera.fy),
        here((static_cast<float>(v) - camera.cy) / camera.fy),
        after((static_cast<float>(v + 1) - camera.cy) / camera.fy) {}
};

/// Through four cells, of length 1 along z.
[[nodiscard]] inline LaneVectors rays_through(const RowRays& row, const ColumnRays& column) {
  return {row.here, Lanes{} + column.here, Lanes{} + 1.0F};
}

/// Along a grazing ray a small gap between surfaces looks long; below this slope it is noise of the rim.
inline constexpr float least_slope = 0.25F;

/// Whether a surface of normal `direction` may be the measured one: also where no normal was measured.
[[nodiscard]] inline LaneMask like_normals(const MeasuredCells& measured, const LaneVectors& direction) {
  constexpr float same_normal = 0.6F;
  return ~measured.has_normal() | (dot(direction, measured.normal) > same_normal);
}

struct RenderedNormals {
  LaneVectors direction;  ///< Of unit length.
  LaneMask known;         ///< Not at the rim of the surface.
  LaneMask inner;         ///< No neighbour lies beyond a rim or a step in depth.
};

/// The normals of the rendered surface, from its neighbours.
[[nodiscard]] inline RenderedNormals rendered_normals(const ModelCells& cells, const RowRays& row,
                                                      const ColumnRays& column, float focal_length) {
  const Lanes step = 8.0F * cells.here / focal_length;
  const auto fits = [&](const Lanes& depth) { return (depth > 0.0F) & (magnitude(depth - cells.here) < step); };
  const LaneMask right_fits = fits(cells.right);
  const LaneMask left_fits = fits(cells.left);
  const LaneMask below_fits = fits(cells.below);
  const LaneMask above_fits = fits(cells.above);
  const auto point = [](const Lanes& x, const Lanes& y, const Lanes& z) { return LaneVectors{x * z, y * z, z}; };
  const Lanes y = Lanes{} + column.here;
  const LaneVectors middle = point(row.here, y, cells.here);
  const LaneVectors across = select(right_fits, point(row.after, y, cells.right), middle) -
                             select(left_fits, point(row.before, y, cells.left), middle);
  const LaneVectors down = select(below_fits, point(row.here, Lanes{} + column.after, cells.below), middle) -
                           select(above_fits, point(row.here, Lanes{} + column.before, cells.above), middle);
  const LaneVectors normal = cross(down, across);
  const Lanes length = square_root(dot(normal, normal));
  return {normal / length, (left_fits | right_fits) & (above_fits | below_fits) & (length > 0.0F),
          left_fits & right_fits & above_fits & below_fits};
}

/// What the scene says at four cells of the rendered model, a mask for each; none: nothing was measured there.
struct Verdicts {
  LaneMask confirmed{};
  LaneMask behind{};
  LaneMask occluded{};
  LaneMask contradicted{};
  Lanes distance{};  ///< Between the surfaces, along the model's normal (metres); of confirmed cells.
};

[[nodiscard]] inline Verdicts judge_cells(const MeasuredCells& measured, const ModelCells& cells, const Camera& camera,
                                          int u, int v, float tolerance) {
  const Lanes gap = measured.depth - cells.here;
  const LaneMask seen = (measured.depth > 0.0F) & (cells.here > 0.0F);
  const LaneMask in_reach = seen & (magnitude(gap) * least_slope <= tolerance);
  Verdicts verdicts{{}, seen & (gap > 0.0F), seen & ~(gap > 0.0F), {}, {}};
  if (!any(in_reach)) return verdicts;
  const RowRays row(camera, u);
  const ColumnRays column(camera, v);
  const RenderedNormals normals = rendered_normals(cells, row, column, camera.fx);
  const LaneVectors ray = rays_through(row, column);
  const Lanes facing = magnitude(dot(normals.direction, ray)) / square_root(dot(ray, ray));
  const Lanes slope = normals.known ? larger(Lanes{} + least_slope, facing) : Lanes{} + 1.0F;
  verdicts.distance = magnitude(gap) * slope;
  const LaneMask together = in_reach & (verdicts.distance <= tolerance);
  const LaneMask agrees = ~normals.known | like_normals(measured, normals.direction);
  verdicts.behind &= ~together;
  verdicts.occluded &= ~together;
  verdicts.confirmed = together & agrees & (measured.foreground != 0);
  verdicts.contradicted = together & ~verdicts.confirmed;
  return verdicts;
}

}  // namespace graspd
