#include "core/detect/verify.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/detect/cell_sums.hpp"
#include "core/detect/cell_verdict.hpp"

namespace graspd {

namespace {

constexpr std::array<std::array<int, 2>, 4> directions{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

bool rendered_at(const RenderedModel& model, int u, int v) {
  return model.camera.contains(u, v) && model.front[model.camera.index(u, v)] > 0.0F;
}

/// In which of the directions the model does not cover the neighbours of its cells.
std::array<LaneMask, 4> open_sides(const ModelCells& cells) {
  static_assert(directions[0][0] == 1 && directions[1][0] == -1 && directions[2][1] == 1 && directions[3][1] == -1);
  const LaneMask covered = cells.here > 0.0F;
  return {covered & (cells.right == 0.0F), covered & (cells.left == 0.0F), covered & (cells.below == 0.0F),
          covered & (cells.above == 0.0F)};
}

bool is_claimed(const SceneMap& map, std::span<const std::uint16_t> claimed, int u, int v) {
  return !claimed.empty() && claimed[map.camera.index(u, v)] != 0;
}

/// Votes of the outline on whether the scene ends where the model ends.
struct OutlineCount {
  int consistent = 0;
  int inconsistent = 0;
};

/// The confirmed cell nearest to the rim at (u, v), which is not confirmed itself, inwards from direction (du, dv):
/// sensors round rims off, or do not measure them. Null when there is none within a few cells.
const MapCell* confirmed_inside(const SceneMap& map, const RenderedModel& model, std::span<const std::uint16_t> claimed,
                                int u, int v, int du, int dv, float tolerance) {
  constexpr int deepest = 3;
  for (int k = 1; k <= deepest; ++k) {
    const int x = u - k * du;
    const int y = v - k * dv;
    if (!rendered_at(model, x, y)) return nullptr;
    const int map_u = model.rectangle.left + x;
    const int map_v = model.rectangle.top + y;
    if (map.at(map_u, map_v).foreground == 0 || is_claimed(map, claimed, map_u, map_v)) continue;
    const Verdicts verdicts =
        judge_cells(measured_cells(map, model, x, y), ModelCells(model, x, y), model.camera, x, y, tolerance);
    if (verdicts.confirmed[0] != 0) return &map.at(map_u, map_v);
  }
  return nullptr;
}

/// Looks beyond the rim at (u, v) in direction (du, dv): a surface that goes on there, as the extension
/// of the cell `inside`, contradicts the rim. Sensors round edges off, so the majority of a few cells decides.
void judge_rim(const SceneMap& map, const RenderedModel& model, std::span<const std::uint16_t> claimed,
               const MapCell& inside, int u, int v, int du, int dv, float tolerance, OutlineCount& count) {
  constexpr int first = 2;
  constexpr int last = 6;
  const float front = model.front[model.camera.index(u, v)];
  int seen = 0;
  int going_on = 0;
  for (int k = first; k <= last; ++k) {
    // Beyond a narrow gap, such as one between teeth, the model itself goes on.
    const int x = u + k * du;
    const int y = v + k * dv;
    if (rendered_at(model, x, y)) break;
    if (!map.camera.contains(model.rectangle.left + x, model.rectangle.top + y)) break;
    const MapCell& beyond = map.at(model.rectangle.left + x, model.rectangle.top + y);
    if (!beyond.measured()) continue;
    // A neighbour may go on where this one ends.
    if (is_claimed(map, claimed, model.rectangle.left + x, model.rectangle.top + y)) break;
    // What stands in front hides whether the surface ends.
    if (beyond.point.z() - front < -4.0F * tolerance) break;
    ++seen;
    if (beyond.foreground == 0 || !inside.has_normal()) continue;
    const bool on_plane = std::abs(inside.normal.dot(beyond.point - inside.point)) < tolerance;
    going_on += on_plane && (!beyond.has_normal() || inside.normal.dot(beyond.normal) > 0.85F) ? 1 : 0;
  }
  if (seen > 0) ++(2 * going_on > seen ? count.inconsistent : count.consistent);
}

/// What a better instance explains hides this one, unless this one would stand before it.
void yield_to_claims(const SceneMap& map, const RenderedModel& model, std::span<const std::uint16_t> claimed,
                     const LaneMask& covered, int u, int v, Verdicts& verdicts) {
  LaneMask taken{};
  for (std::size_t i = 0; i < lane_count; ++i) {
    if (covered[i] != 0 &&
        is_claimed(map, claimed, model.rectangle.left + u + static_cast<int>(i), model.rectangle.top + v))
      taken[i] = -1;
  }
  verdicts.occluded |= taken & ~verdicts.behind;
  verdicts.confirmed &= ~taken;
  verdicts.contradicted &= ~taken;
}

/// From how far the normals spread in the direction in which they spread least: without any in that direction the
/// surface could slide along it (Gelfand and Guibas 2004, slippable motions).
float lock_of(const Matrix3& normal_scatter) {
  Eigen::SelfAdjointEigenSolver<Matrix3> solver;
  solver.computeDirect(normal_scatter, Eigen::EigenvaluesOnly);
  return std::clamp(3.0F * solver.eigenvalues().minCoeff(), 0.0F, 1.0F);
}

/// Whether the scene shows free space at (u, v) and half a detail round it. Along a seam, where the pose is a
/// little off or the sensor mixes both sides of an edge, that is so for a right pose too, but nowhere broadly.
bool in_broad_gap(const SceneMap& map, const RenderedModel& model, int u, int v, float detail, float tolerance) {
  constexpr float share_of_detail = 0.6F;
  const float front = model.front[model.camera.index(u, v)];
  const int reach = std::max(1, static_cast<int>(std::lround(share_of_detail * detail / map.footprint(front))));
  return std::all_of(directions.begin(), directions.end(), [&](const auto& d) {
    const int x = u + reach * d[0];
    const int y = v + reach * d[1];
    if (!rendered_at(model, x, y)) return false;
    const MapCell& cell = map.at(model.rectangle.left + x, model.rectangle.top + y);
    return cell.measured() && cell.point.z() - model.front[model.camera.index(x, y)] > tolerance;
  });
}

/// The share of the part's surface whose projection falls inside the image.
float share_inside(const SceneMap& map, const Bank& bank, const RigidTransform& camera_from_part) {
  int inside = 0;
  for (const SurfacePoint& surface : bank.surface) {
    if (map.look_up(camera_from_part * surface.position) != nullptr) ++inside;
  }
  return static_cast<float>(std::max(inside, 1)) / static_cast<float>(bank.surface.size());
}

/// Evidence::blur for a part of this detail (metres).
float blur_of(const SceneMap& map, float detail) {
  constexpr float sharp = 0.17F;
  constexpr float blurred = 0.83F;
  return std::clamp((map.edge_blurs.width(detail) / detail - sharp) / (blurred - sharp), 0.0F, 1.0F);
}

float tolerance_without_noise(const SceneMap& map, const Bank& bank, const VerifyParameters& parameters) {
  const float detail = bank.part->detail;
  const float widest = std::max(parameters.tolerance, parameters.blurred_tolerance);
  return (parameters.tolerance + blur_of(map, detail) * (widest - parameters.tolerance)) * detail;
}

bool touches_border(const ImageRectangle& rectangle, const Camera& camera) {
  return rectangle.left == 0 || rectangle.top == 0 || rectangle.left + rectangle.width == camera.width ||
         rectangle.top + rectangle.height == camera.height;
}

}  // namespace

float surface_tolerance(const SceneMap& map, const Bank& bank, const VerifyParameters& parameters) {
  return std::max(tolerance_without_noise(map, bank, parameters), parameters.noise_tolerance * map.noise);
}

RenderedModel render_model(const SceneMap& map, const Bank& bank, const RigidTransform& camera_from_part,
                           std::span<float> front, std::span<float> back) {
  RenderedModel model;
  model.rectangle = projected_bounds(bank.mesh, camera_from_part, map.camera);
  model.camera = cropped(map.camera, model.rectangle);
  const std::size_t cells = model.rectangle.empty() ? 0 : model.camera.pixel_count();
  if (cells == 0 || cells > front.size()) {
    model.rectangle = {};
    return model;
  }
  if (touches_border(model.rectangle, map.camera)) model.inside = share_inside(map, bank, camera_from_part);
  model.front = front.first(cells);
  if (back.size() >= cells) {
    model.back = back.first(cells);
    render_both_surfaces(bank.mesh, camera_from_part, model.camera, model.front, model.back);
  } else {
    render_depth(bank.mesh, camera_from_part, model.camera, model.front);
  }
  return model;
}

Evidence gather_evidence(const SceneMap& map, const Bank& bank, const RenderedModel& model,
                         const VerifyParameters& parameters, std::span<const std::uint16_t> claimed) {
  Evidence evidence;
  const float tolerance = surface_tolerance(map, bank, parameters);
  const bool edges_judge = parameters.edges && bank.part->edges_judge != 0;
  CellCount rendered_cells, confirmed_cells, behind_cells, occluded_cells, contradicted_cells, halves_below, open_edges,
      normal_cells;
  CellSum depths, squares;
  NormalScatter normals;
  OutlineCount outline;
  float gap = 0;
  for (int v = 0; v < model.rectangle.height; ++v) {
    for (int u = 0; u < model.rectangle.width; u += static_cast<int>(lane_count)) {
      const ModelCells cells(model, u, v);
      const LaneMask covered = cells.here > 0.0F;
      if (!any(covered)) continue;
      const MeasuredCells measured = measured_cells(map, model, u, v);
      const LaneMask has_normal = measured.has_normal();
      const LaneMask bounded = covered & (measured.background > 0.0F);
      const Lanes limit = measured.background + tolerance;
      rendered_cells.add(covered);
      halves_below.add(bounded & (cells.here > limit));
      if (!model.back.empty()) halves_below.add(bounded & (pixels_at(model.camera, model.back, u, v) > limit));
      Verdicts verdicts = judge_cells(measured, cells, model.camera, u, v, tolerance);
      if (!claimed.empty()) yield_to_claims(map, model, claimed, covered, u, v, verdicts);
      const std::array<LaneMask, 4> open = open_sides(cells);
      for (std::size_t side = 0; side < open.size(); ++side) {
        open_edges.add(open[side]);
        if (!edges_judge || !any(open[side])) continue;
        const auto [du, dv] = directions[side];
        for (std::size_t i = 0; i < lane_count; ++i) {
          if (open[side][i] == 0) continue;
          const int x = u + static_cast<int>(i);
          const MapCell* const inside = verdicts.confirmed[i] != 0
                                            ? &map.at(model.rectangle.left + x, model.rectangle.top + v)
                                            : confirmed_inside(map, model, claimed, x, v, du, dv, tolerance);
          if (inside != nullptr) judge_rim(map, model, claimed, *inside, x, v, du, dv, tolerance, outline);
        }
      }
      // Pixels at an edge mix both sides, so a rim that seems to stand before free space says nothing.
      verdicts.behind &= ~(open[0] | open[1] | open[2] | open[3]);
      confirmed_cells.add(verdicts.confirmed);
      behind_cells.add(verdicts.behind);
      occluded_cells.add(verdicts.occluded);
      contradicted_cells.add(verdicts.contradicted);
      depths.add(cells.here, covered);
      squares.add(verdicts.distance * verdicts.distance, verdicts.confirmed);
      normals.add(measured.normal, verdicts.confirmed & has_normal);
      normal_cells.add(verdicts.confirmed & has_normal);
      if (!any(verdicts.behind)) continue;
      for (std::size_t i = 0; i < lane_count; ++i) {
        if (verdicts.behind[i] != 0 &&
            in_broad_gap(map, model, u + static_cast<int>(i), v, bank.part->detail, tolerance))
          gap += 1.0F;
      }
    }
  }
  const float rendered = rendered_cells.total();
  if (rendered == 0.0F) return evidence;
  const float confirmed = confirmed_cells.total();
  const float behind = behind_cells.total();
  const float against = behind + contradicted_cells.total();
  const float measured = confirmed + against + occluded_cells.total();
  // What lies outside the image was not measured.
  evidence.inside = model.inside;
  evidence.visible = model.inside * confirmed / rendered;
  evidence.measured = model.inside * measured / rendered;
  evidence.overlap = measured > 0.0F ? confirmed / measured : 0.0F;
  evidence.purity = confirmed + against > 0.0F ? confirmed / (confirmed + against) : 0.0F;
  evidence.boundary = behind / rendered;
  evidence.below = 0.5F * halves_below.total() / rendered;
  const float residual = confirmed > 0.0F ? std::sqrt(squares.total() / confirmed) : 0.0F;
  evidence.residual = residual / bank.part->sampling;
  evidence.misfit = residual / tolerance;
  evidence.leniency = std::log(tolerance / tolerance_without_noise(map, bank, parameters));
  const float unit_cells = evidence_unit * bank.part->diameter / map.footprint(depths.total() / rendered);
  evidence.confirmed = confirmed / (unit_cells * unit_cells);
  evidence.gap = gap / (unit_cells * unit_cells);
  evidence.blur = blur_of(map, bank.part->detail);
  evidence.outline = open_edges.total() / unit_cells;
  const float normal_count = normal_cells.total();
  evidence.lock = normal_count > 0.0F ? lock_of(normals.total() / normal_count) : 0.0F;
  if (edges_judge) {
    const int decided = outline.consistent + outline.inconsistent;
    evidence.decided = static_cast<float>(decided) / unit_cells;
    evidence.edge = decided > 0 ? static_cast<float>(outline.consistent) / static_cast<float>(decided) : 1.0F;
  } else {
    // What sensors show of most right poses stands in for what nobody asks.
    evidence.decided = (0.06F + 0.07F * evidence.blur) * evidence.outline;
    evidence.edge = 1.0F;
  }
  return evidence;
}

}  // namespace graspd
