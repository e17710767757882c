#include "core/train/bank_builder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/bank/bank_writer.hpp"
#include "core/train/corner_normals.hpp"
#include "core/train/generalisation.hpp"
#include "core/train/hidden_pieces.hpp"
#include "core/train/mesh_simplification.hpp"
#include "core/train/open_pieces.hpp"
#include "core/train/part_likeness.hpp"
#include "core/train/part_mesh.hpp"
#include "core/train/ppf_table.hpp"
#include "core/train/self_visibility.hpp"
#include "core/train/surface_index.hpp"
#include "core/train/surface_sampling.hpp"
#include "core/train/symmetry_group.hpp"
#include "core/train/view_refinement.hpp"
#include "core/train/view_sphere.hpp"
#include "core/train/view_weights.hpp"

namespace graspd {

namespace {

constexpr float render_error = 0.001F;      ///< Of the bank's mesh, as a share of the diameter.
constexpr float occlusion_error = 0.0005F;  ///< Of the mesh that hides points while the bank is made.
constexpr float samples_per_voxel = 24.0F;
constexpr float least_samples = 16000.0F;
constexpr float most_samples = 60000.0F;
constexpr float least_sampling = 0.01F;
constexpr float most_sampling = 0.2F;
constexpr std::size_t least_cut_out_points = 30;
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
  std::vector<RigidTransform> twins;
};

/// What makes no sense in the parameters, or null.
const char* parameter_fault(const BankBuildParameters& p) {
  const auto within = [](float value, float low, float high) { return value >= low && value <= high; };
  if (!within(p.sampling, least_sampling, most_sampling))
    return "sampling must lie between 0.01 and 0.2 of the diameter";
  if (!within(p.detail, 0.1F, 1.0F)) return "detail must lie between 0.1 and 1 of the sampling";
  if (p.angle_bins < 4 || p.angle_bins > 60) return "angle_bins must lie between 4 and 60";
  if (p.candidate_views < 6 || p.candidate_views > most_candidate_views)
    return "candidate_views must lie between 6 and 2562";
  if (p.maximum_views < 1 || p.maximum_view_points < 10) return "at least one view of 10 points is needed";
  if (!within(p.maximum_overlap, 0.0F, 1.0F)) return "maximum_overlap must lie between 0 and 1";
  if (!within(p.minimum_completeness, 0.0F, 1.0F)) return "minimum_completeness must lie between 0 and 1";
  if (!within(p.maximum_incidence, 0.2F, 1.56F)) return "maximum_incidence must lie between 0.2 and 1.56 radians";
  if (!within(p.sensor_distance, 0.01F, 100.0F)) return "sensor_distance must lie between 0.01 and 100 metres";
  if (p.model_points < 0 || p.model_points > 20000) return "model_points must lie between 0 and 20000";
  if (p.surface_points < 100 || p.surface_points > 20000) return "surface_points must lie between 100 and 20000";
  if (p.visibility_directions < 6 || p.visibility_directions > 5000) {
    return "visibility_directions must lie between 6 and 5000";
  }
  return nullptr;
}

/// As a share of the diameter.
float sampling_of(const BankBuildParameters& parameters, const PartMesh& mesh) {
  if (parameters.model_points == 0) return parameters.sampling;
  const float edge = std::sqrt(mesh.area / static_cast<float>(parameters.model_points));
  return std::clamp(edge / mesh.diameter, least_sampling, most_sampling);
}

/// The middle of the bounding box, moved to where no symmetry moves it: of a part with three alike sides, the middle of
/// the box is not that of the sides.
Vector3 centre_of(const PartMesh& mesh, const SymmetryGroup& symmetry) {
  const Vector3 middle = 0.5F * (mesh.box_min + mesh.box_max);
  Vector3 centre = Vector3::Zero();
  for (const RigidTransform& member : symmetry.discrete) {
    centre += member * middle / static_cast<float>(symmetry.discrete.size());
  }
  if (symmetry.continuous) {
    const Vector3& axis = symmetry.axis.direction;
    centre = symmetry.axis.point + axis * axis.dot(centre - symmetry.axis.point);
  }
  return centre;
}

void describe_part(const PartDescription& part, const PartMesh& mesh, const BankBuildParameters& parameters,
                   BankStorage& storage) {
  BankPart& out = storage.part;
  const std::size_t length = std::min(part.name.size(), out.name.size() - 1);
  std::copy_n(part.name.begin(), length, out.name.begin());
  out.part_id = part.part_id;
  out.diameter = mesh.diameter;
  out.box_min = mesh.box_min;
  out.box_max = mesh.box_max;
  out.centre = centre_of(mesh, storage.symmetry);
  out.sampling = sampling_of(parameters, mesh) * mesh.diameter;
  out.detail = parameters.detail * out.sampling;
  out.thresholds = part.thresholds;
  out.edges_refine = parameters.edges_refine ? 1 : 0;
  out.edges_judge = parameters.edges_judge ? 1 : 0;
  out.symmetry_continuous = storage.symmetry.continuous ? 1 : 0;
  out.symmetry_axis = storage.symmetry.axis;
}

/// The dense surface: evenly spread points out of those that can be seen at all, their visibility,
/// and the visible edges.
void add_surface(const PartMesh& mesh, const MeshView& occluder, const ViewingConditions& conditions,
                 const CandidateViews& candidates, const BankBuildParameters& parameters, BankStorage& storage) {
  std::vector<OrientedPoint> reachable;
  for (std::size_t i = 0; i < candidates.samples.size(); ++i) {
    bool seen = false;
    for (std::size_t d = 0; d < candidates.rendered && !seen; ++d) seen = candidates.visibility.seen.at(d, i);
    if (seen) reachable.push_back(candidates.samples[i]);
  }
  const auto wanted = static_cast<std::size_t>(parameters.surface_points);
  std::vector<OrientedPoint> points;
  for (const std::size_t i : farthest_point_order(reachable, wanted, 0.02F * mesh.diameter)) {
    points.push_back(reachable[i]);
    storage.surface.push_back({reachable[i].position, reachable[i].normal});
  }
  storage.directions = view_sphere(parameters.visibility_directions);
  storage.visibility = find_visibility(occluder, points, storage.directions, conditions).seen;

  const float near_surface = 0.02F * mesh.diameter;
  for (const EdgePoint& edge : sample_edges(mesh.mesh, crease_angle, 0.01F * mesh.diameter)) {
    const bool visible = std::any_of(reachable.begin(), reachable.end(), [&](const OrientedPoint& p) {
      return (p.position - edge.position).squaredNorm() < near_surface * near_surface;
    });
    if (visible) storage.edges.push_back(edge);
  }
}

/// Keeps as many points as are allowed, spread evenly.
void limit_points(std::size_t most, float diameter, std::vector<ViewPoint>& points) {
  if (points.size() <= most) return;
  std::vector<OrientedPoint> places;
  for (const ViewPoint& p : points) places.push_back(p.point);
  std::vector<std::size_t> order = farthest_point_order(places, most, 0.02F * diameter);
  std::sort(order.begin(), order.end());
  std::vector<ViewPoint> kept;
  for (const std::size_t i : order) kept.push_back(points[i]);
  points = std::move(kept);
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

/// Everything as one view: the model that banks of many views are compared with.
std::vector<RefinedView> whole_part(const CandidateViews& candidates, BankReport& report) {
  RefinedView view;
  for (std::size_t i = 0; i < candidates.directions.size(); ++i) {
    if (candidates.eligible(i)) view.fused.push_back(i);
  }
  view.candidate = view.fused.front();
  view.completeness = 1.0F;
  report.views_kept = 1;
  return {view};
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
  bank.twins = storage.twins;
  bank.grasps = part.grasps;
  return bank;
}

/// A few of the points that each candidate shows, for the report.
void add_pictures(const CandidateViews& candidates, BankReport& report) {
  constexpr std::size_t pictured = 400;
  for (std::size_t i = 0; i < report.candidates.size(); ++i) {
    if (!candidates.eligible(i)) continue;
    const std::vector<OrientedPoint> shown = shown_points(candidates, i);
    const std::size_t step = std::max<std::size_t>(1, shown.size() / pictured);
    for (std::size_t p = 0; p < shown.size(); p += step) report.candidates[i].points.push_back(shown[p]);
  }
  std::size_t next = 0;
  std::erase_if(report.candidates, [&](const CandidateReport&) { return !candidates.eligible(next++); });
}

}  // namespace

Result<std::vector<std::byte>> build_bank(const PartDescription& part, const BankBuildParameters& parameters,
                                          BankReport& report, const std::function<void(float)>& progress) {
  return learn_bank(part, {}, true, parameters, report, progress);
}

Result<std::vector<std::byte>> learn_bank(const PartDescription& part, std::vector<CutOut> cut_outs, bool rendered,
                                          const BankBuildParameters& parameters, BankReport& report,
                                          const std::function<void(float)>& progress) {
  if (const char* fault = parameter_fault(parameters); fault != nullptr) {
    return Status(StatusCode::bad_configuration, fault);
  }
  std::erase_if(cut_outs, [](const CutOut& cut) { return cut.points.size() < least_cut_out_points; });
  if (cut_outs.empty() && !rendered) {
    return Status(StatusCode::bad_frame, "the frames show the part nowhere well enough to learn a view");
  }
  auto prepared = prepare_mesh(part.mesh);
  if (!prepared.ok()) return prepared.status();
  PartMesh mesh = std::move(prepared).value();
  orient_open_pieces(mesh);
  const Mesh voids = take_hidden_pieces(mesh);
  report = BankReport{};
  report.remarks = mesh.remarks;
  progress(0.05F);

  BankStorage storage;
  Result<PartLikeness> found = likeness_of(part, mesh);
  if (!found.ok()) return found.status();
  PartLikeness likeness = std::move(found).value();
  report.symmetry_proposed = likeness.proposed;
  report.remarks.insert(report.remarks.end(), likeness.remarks.begin(), likeness.remarks.end());
  storage.symmetry = std::move(likeness.symmetry);
  storage.twins = std::move(likeness.twins);
  describe_part(part, mesh, parameters, storage);
  progress(0.2F);

  const ViewingConditions conditions{storage.part.centre, mesh.diameter, parameters.sensor_distance,
                                     parameters.maximum_incidence};
  const Mesh occluder = simplify_mesh(mesh.mesh, occlusion_error * mesh.diameter);
  const float voxel = storage.part.sampling;
  const auto sample_count = static_cast<std::size_t>(
      std::clamp(samples_per_voxel * mesh.area / (voxel * voxel), least_samples, most_samples));
  CandidateViews candidates =
      rendered_candidates(sample_surface(mesh.mesh, smooth_corner_normals(mesh.mesh, crease_angle), sample_count),
                          view_sphere(parameters.candidate_views), occluder.view(), conditions, storage.symmetry);
  progress(0.4F);
  add_surface(mesh, occluder.view(), conditions, candidates, parameters, storage);
  progress(0.6F);
  if (!rendered) drop_rendered(candidates);
  const SurfaceIndex samples(candidates.samples, voxel);
  if (!cut_outs.empty()) {
    for (CutOut& cut : cut_outs) lay_on(samples, voxel, cut);
    add_cut_outs(std::move(cut_outs), occluder.view(), conditions, storage.symmetry, 0.6F * voxel, candidates);
  }
  progress(0.7F);

  report.resting =
      resting_poses(occluder, centre_of_mass(with_voids(mesh.mesh, voids), mesh.closed()), storage.symmetry);
  const std::vector<float> weights = view_weights(candidates.directions, report.resting, storage.symmetry);
  const std::vector<RefinedView> refined =
      parameters.full_model ? whole_part(candidates, report)
                            : refine_views(candidates, storage.symmetry, weights, mesh.diameter, parameters, report);
  const GeneralisationSettings generalisation{parameters.generalisation, voxel, storage.part.centre};
  std::vector<GeneralisedView> views;
  for (const RefinedView& view : refined) {
    views.push_back(generalise_view(view, candidates, samples, storage.symmetry, generalisation));
    limit_points(static_cast<std::size_t>(parameters.maximum_view_points), mesh.diameter, views.back().references);
  }
  add_pictures(candidates, report);
  progress(0.8F);

  storage.grid = {voxel, static_cast<std::uint32_t>(mesh.diameter / voxel) + 1,
                  static_cast<std::uint32_t>(parameters.angle_bins)};
  storage.table = make_ppf_table(views, candidates, storage.grid, {2.0F * voxel, parameters.full_model});
  add_views(views, refined, candidates, storage);
  progress(0.9F);

  storage.mesh = simplify_mesh(mesh.mesh, render_error * mesh.diameter);
  std::vector<std::byte> file = write_bank(bank_over(storage, part));
  progress(1.0F);
  return file;
}

}  // namespace graspd
