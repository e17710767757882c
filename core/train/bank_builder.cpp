#include "core/train/bank_builder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/bank/bank_writer.hpp"
#include "core/train/generalisation.hpp"
#include "core/train/mesh_simplification.hpp"
#include "core/train/part_mesh.hpp"
#include "core/train/ppf_table.hpp"
#include "core/train/self_visibility.hpp"
#include "core/train/surface_sampling.hpp"
#include "core/train/symmetry_group.hpp"
#include "core/train/view_refinement.hpp"
#include "core/train/view_sphere.hpp"

namespace graspd {

namespace {

constexpr int visibility_directions = 642;
constexpr float render_error = 0.001F;      ///< Of the bank's mesh, as a share of the diameter.
constexpr float occlusion_error = 0.0005F;  ///< Of the mesh that hides points while the bank is made.
constexpr float crease_angle = std::numbers::pi_v<float> / 6.0F;

/// The arrays of a bank while it is being made.
struct BankStorage {
  BankPart part;
  PpfGrid grid;
  std::vector<BankView> views;
  std::vector<OrientedPoint> view_points;
  PpfTable table;
  std::vector<std::uint32_t> reference_points;
  std::vector<std::uint32_t> reference_views;
  std::vector<SurfacePoint> surface;
  std::vector<EdgePoint> edges;
  std::vector<Vector3> directions;
  VisibilityRows visibility;
  Mesh mesh;
  SymmetryGroup symmetry;
};

void describe_part(const PartDescription& part, const PartMesh& mesh, const BankBuildParameters& parameters,
                   BankStorage& storage) {
  BankPart& out = storage.part;
  const std::size_t length = std::min(part.name.size(), out.name.size() - 1);
  std::copy_n(part.name.begin(), length, out.name.begin());
  out.part_id = part.part_id;
  out.diameter = mesh.diameter;
  out.box_min = mesh.box_min;
  out.box_max = mesh.box_max;
  out.centre = 0.5F * (mesh.box_min + mesh.box_max);
  out.sampling = parameters.sampling * mesh.diameter;
  out.thresholds = part.thresholds;
  out.symmetry_continuous = storage.symmetry.continuous ? 1 : 0;
  out.symmetry_axis = storage.symmetry.axis;
}

/// The dense surface: evenly spread points that can be seen from anywhere at all, their visibility,
/// and the visible edges.
void add_surface(const PartMesh& mesh, const MeshView& occluder, const ViewingConditions& conditions,
                 const BankBuildParameters& parameters, BankStorage& storage) {
  const auto wanted = static_cast<std::size_t>(parameters.surface_points);
  const std::vector<OrientedPoint> pool = sample_surface(mesh.mesh, wanted * 8);
  storage.directions = view_sphere(visibility_directions);
  const Visibility coarse = find_visibility(occluder, pool, view_sphere(92), conditions);
  std::vector<OrientedPoint> reachable;
  for (std::size_t i = 0; i < pool.size(); ++i) {
    bool seen = false;
    for (std::size_t d = 0; d < 92 && !seen; ++d) seen = coarse.seen.at(d, i);
    if (seen) reachable.push_back(pool[i]);
  }
  std::vector<OrientedPoint> points;
  for (const std::size_t i : farthest_point_order(reachable, wanted, 0.02F * mesh.diameter)) {
    points.push_back(reachable[i]);
    storage.surface.push_back({reachable[i].position, reachable[i].normal});
  }
  storage.visibility = find_visibility(occluder, points, storage.directions, conditions).seen;

  const float near_surface = 0.02F * mesh.diameter;
  for (const EdgePoint& edge : sample_edges(mesh.mesh, crease_angle, 0.01F * mesh.diameter)) {
    const bool visible = std::any_of(reachable.begin(), reachable.end(), [&](const OrientedPoint& p) {
      return (p.position - edge.position).squaredNorm() < near_surface * near_surface;
    });
    if (visible) storage.edges.push_back(edge);
  }
}

void add_views(std::span<const GeneralisedView> views, std::span<const RefinedView> refined,
               const CandidateViews& candidates, BankStorage& storage) {
  for (std::size_t v = 0; v < views.size(); ++v) {
    BankView view;
    view.direction = candidates.directions[refined[v].candidate];
    view.first_point = static_cast<std::uint32_t>(storage.view_points.size());
    view.first_reference = static_cast<std::uint32_t>(storage.reference_points.size());
    view.reference_count = static_cast<std::uint32_t>(views[v].references.size());
    view.point_count = static_cast<std::uint32_t>(views[v].references.size() + views[v].others.size());
    view.completeness = refined[v].completeness;
    for (const ViewPoint& p : views[v].references) {
      storage.reference_points.push_back(static_cast<std::uint32_t>(storage.view_points.size()));
      storage.reference_views.push_back(static_cast<std::uint32_t>(v));
      storage.view_points.push_back(p.point);
    }
    for (const ViewPoint& p : views[v].others) storage.view_points.push_back(p.point);
    storage.views.push_back(view);
  }
}

Bank bank_over(const BankStorage& storage, const PartDescription& part) {
  Bank bank;
  bank.part = &storage.part;
  bank.grid = storage.grid;
  bank.views = storage.views;
  bank.view_points = storage.view_points;
  bank.cell_offsets = storage.table.cell_offsets;
  bank.entries = storage.table.entries;
  bank.reference_points = storage.reference_points;
  bank.reference_views = storage.reference_views;
  bank.surface = storage.surface;
  bank.edges = storage.edges;
  bank.visibility = {storage.directions, storage.visibility.bits,
                     static_cast<std::uint32_t>(storage.visibility.words_per_row)};
  bank.mesh = storage.mesh.view();
  bank.symmetry_discrete = storage.symmetry.discrete;
  bank.grasps = part.grasps;
  return bank;
}

}  // namespace

Result<std::vector<std::byte>> build_bank(const PartDescription& part, const BankBuildParameters& parameters,
                                          BankReport& report, const std::function<void(float)>& progress) {
  const auto prepared = prepare_mesh(part.mesh);
  if (!prepared.ok()) return prepared.status();
  const PartMesh& mesh = prepared.value();
  report = BankReport{};
  report.remarks = mesh.remarks;
  progress(0.05F);

  BankStorage storage;
  storage.symmetry = close_group(part.symmetry_discrete, part.symmetry_continuous, part.symmetry_axis, mesh.diameter);
  describe_part(part, mesh, parameters, storage);
  const ViewingConditions conditions{storage.part.centre, mesh.diameter, parameters.sensor_distance,
                                     parameters.maximum_incidence};
  const Mesh occluder = simplify_mesh(mesh.mesh, occlusion_error * mesh.diameter);
  add_surface(mesh, occluder.view(), conditions, parameters, storage);
  progress(0.5F);

  const float voxel = storage.part.sampling;
  constexpr float samples_per_voxel = 24.0F;
  const auto sample_count =
      static_cast<std::size_t>(std::clamp(samples_per_voxel * mesh.area / (voxel * voxel), 2000.0F, 60000.0F));
  const std::vector<OrientedPoint> samples = sample_surface(mesh.mesh, sample_count);
  const std::vector<Vector3> directions = view_sphere(parameters.candidate_views);
  const Visibility visibility = find_visibility(occluder.view(), samples, directions, conditions);
  const CandidateViews candidates{directions, samples, visibility};
  progress(0.7F);

  const std::vector<RefinedView> refined =
      refine_views(candidates, storage.symmetry, mesh.diameter, parameters, report);
  const auto orbits = direction_orbits(directions, storage.symmetry);
  std::vector<GeneralisedView> views;
  for (const RefinedView& view : refined) {
    views.push_back(generalise_view(view, candidates, orbits, storage.symmetry, storage.part.centre, voxel));
  }
  progress(0.8F);

  storage.grid = {voxel, static_cast<std::uint32_t>(mesh.diameter / voxel) + 1,
                  static_cast<std::uint32_t>(parameters.angle_bins)};
  storage.table = make_ppf_table(views, candidates, storage.grid, {2.0F * voxel});
  add_views(views, refined, candidates, storage);
  progress(0.9F);

  storage.mesh = simplify_mesh(mesh.mesh, render_error * mesh.diameter);
  std::vector<std::byte> file = write_bank(bank_over(storage, part));
  progress(1.0F);
  return file;
}

}  // namespace graspd
