#include "core/detect/close_comparison.hpp"

#include <algorithm>
#include <cmath>

#include "core/detect/cell_sums.hpp"
#include "core/detect/cell_verdict.hpp"
#include "core/detect/normal_equations.hpp"

namespace graspd {

namespace {

/// Four cells of the rendered model side by side, and how far the measured surface is from them.
struct ComparedCells {
  LaneMask seen;      ///< Measured, and covered by the model, but for its rims and steps, where sensors mix both sides.
  Lanes distance;     ///< Along the model's normal, positive where the scene lies behind (metres).
  LaneVectors point;  ///< Of the model.
  LaneVectors normal;  ///< Of the model.
  MeasuredCells measured;
};

/// Calls visit(ComparedCells) for all cells that the model covers.
template <class Visit>
void for_each_compared(const SceneMap& map, const RenderedModel& model, const Visit& visit) {
  for (int v = 0; v < model.rectangle.height; ++v) {
    const ColumnRays column(model.camera, v);
    for (int u = 0; u < model.rectangle.width; u += static_cast<int>(lane_count)) {
      const ModelCells cells(model, u, v);
      if (!any(cells.here > 0.0F)) continue;
      const RowRays row(model.camera, u);
      const RenderedNormals normals = rendered_normals(cells, row, column, model.camera.fx);
      ComparedCells compared;
      compared.measured = measured_cells(map, model, u, v);
      compared.seen = (cells.here > 0.0F) & (compared.measured.depth > 0.0F) & normals.inner;
      if (!any(compared.seen)) continue;
      const LaneVectors ray = rays_through(row, column);
      compared.normal = normals.direction;
      compared.point = ray * cells.here;
      compared.distance = (compared.measured.depth - cells.here) *
                          larger(Lanes{} + least_slope, magnitude(dot(normals.direction, ray)));
      visit(compared);
    }
  }
}

}  // namespace

DenseFit refine_densely(const SceneMap& map, const Bank& bank, const RigidTransform& camera_from_part, float tolerance,
                        std::span<float> image) {
  constexpr int iterations = 4;
  constexpr float damping = 0.002F;
  constexpr int fewest_pairs = 30;
  const float radius = 0.5F * bank.part->diameter;
  DenseFit fit{camera_from_part, 0.0F, true};
  float gate = tolerance;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const RenderedModel model = render_model(map, bank, fit.camera_from_part, image, {});
    const Vector3 centre = fit.camera_from_part * bank.part->centre;
    NormalEquations equations;
    float squares = 0;
    float weights = 0;
    for_each_compared(map, model, [&](const ComparedCells& cells) {
      const LaneMask agree = cells.seen & (cells.measured.foreground != 0) & (magnitude(cells.distance) < gate) &
                             like_normals(cells.measured, cells.normal);
      if (!any(agree)) return;
      for (std::size_t i = 0; i < lane_count; ++i) {
        if (agree[i] == 0) continue;
        const Vector3 normal = cells.normal[i];
        // The measured point lies beyond the model's along the ray, against the normal that faces the sensor.
        const float squared = cells.distance[i] * cells.distance[i];
        const float weight = tukey(squared, gate);
        equations.add((cells.point[i] - centre) / radius, normal, -cells.distance[i], weight);
        squares += weight * squared;
        weights += weight;
        ++equations.pairs;
      }
    });
    if (equations.pairs < fewest_pairs) return {camera_from_part, 0.0F, false};
    fit.camera_from_part = equations.moved(fit.camera_from_part, bank.part->centre, radius, damping);
    fit.residual = std::sqrt(squares / weights);
    gate = std::clamp(4.0F * fit.residual, 0.1F * tolerance, gate);
  }
  fit.camera_from_part.rotation = orthonormalised(fit.camera_from_part.rotation);
  return fit;
}

float log_likelihood(const SceneMap& map, const Bank& bank, const RigidTransform& camera_from_part,
                     const DepthNoise& noise, std::span<float> image) {
  // What a cell shows when it does not show the part: rarely what lies behind it, more often what hides it.
  constexpr float measured_rightly = 0.85F;
  constexpr float in_front = 0.12F;
  constexpr float behind = 0.03F;
  const float peak = std::log(measured_rightly * 0.3989F * noise.spread / noise.deviation);
  const Lanes log_front = Lanes{} + std::log(in_front);
  const Lanes log_behind = Lanes{} + std::log(behind);
  const RenderedModel model = render_model(map, bank, camera_from_part, image, {});
  CellSum sum;
  for_each_compared(map, model, [&](const ComparedCells& cells) {
    const Lanes deviations = cells.distance / noise.deviation;
    const Lanes outlier = cells.distance < 0.0F ? log_front : log_behind;
    sum.add(larger(peak - 0.5F * deviations * deviations, outlier), cells.seen);
  });
  return sum.total();
}

}  // namespace graspd
