#include "core/detect/detector.hpp"

#include <omp.h>

#include <algorithm>

#include "core/detect/edge_blur.hpp"
#include "core/detect/narrowing.hpp"
#include "core/detect/parallel_for.hpp"
#include "core/detect/refine.hpp"
#include "core/detect/score.hpp"
#include "core/detect/spread.hpp"
#include "core/detect/verify.hpp"

namespace graspd {

namespace {

/// Books the time since the last stage ended.
class StageClock {
 public:
  StageClock(const DetectRequest& request, Detections& detections)
      : now_(request.now_ns), last_(now_ == nullptr ? 0 : now_()), detections_(detections) {}
  void end_of(Stage stage) {
    if (now_ == nullptr) return;
    const std::int64_t now = now_();
    detections_.stage_ns[static_cast<std::size_t>(stage)] += now - last_;
    last_ = now;
  }

 private:
  std::int64_t (*now_)();
  std::int64_t last_;
  Detections& detections_;
};

Status check(const DepthFrame& frame, const DetectRequest& request, const DetectParameters& parameters,
             const DetectCapacity& capacity) {
  const auto fits = [&](const DepthFrame& candidate) {
    return candidate.camera.width > 0 && candidate.camera.height > 0 && candidate.camera.fx > 0.0F &&
           candidate.camera.fy > 0.0F && candidate.depth.size() == candidate.camera.pixel_count();
  };
  if (!fits(frame))
    return {StatusCode::bad_frame, "the frame has no camera or another number of pixels than its camera"};
  if (frame.camera.width > capacity.maximum_width || frame.camera.height > capacity.maximum_height)
    return Status::format(StatusCode::bad_frame, "the frame is %d x %d pixels, memory was set aside for %d x %d",
                          frame.camera.width, frame.camera.height, capacity.maximum_width, capacity.maximum_height);
  if (!request.empty_bin.depth.empty() &&
      (!fits(request.empty_bin) || request.empty_bin.camera.width != frame.camera.width ||
       request.empty_bin.camera.height != frame.camera.height))
    return Status::format(StatusCode::bad_frame, "the empty bin is %d x %d pixels, the frame %d x %d",
                          request.empty_bin.camera.width, request.empty_bin.camera.height, frame.camera.width,
                          frame.camera.height);
  if (parameters.threads < 1 || parameters.threads > capacity.threads)
    return Status::format(StatusCode::memory_limit, "%d threads were asked for, memory was set aside for %d",
                          parameters.threads, capacity.threads);
  for (const Bank& bank : request.banks) {
    if (bank.reference_points.size() > capacity.maximum_references || bank.grid.cell_count() > capacity.maximum_cells)
      return Status::format(StatusCode::memory_limit,
                            "bank '%s' has %zu references and %u cells, the limits are %u and %u",
                            bank.part->name.data(), bank.reference_points.size(), bank.grid.cell_count(),
                            capacity.maximum_references, capacity.maximum_cells);
  }
  return {};
}

/// Holds the refined pose of a cluster against the scene.
Instance judge(const Scene& scene, const Bank& bank, std::uint32_t bank_index, const PoseCluster& cluster,
               const DetectParameters& parameters, std::span<float> image) {
  Instance instance;
  instance.bank = bank_index;
  instance.view = cluster.view;
  instance.votes = cluster.votes;
  instance.camera_from_part = cluster.camera_from_part;
  const RenderedModel model = render_model(scene.map, bank, instance.camera_from_part, image.first(image.size() / 2),
                                           image.subspan(image.size() / 2));
  instance.evidence = gather_evidence(scene.map, bank, model, parameters.verify, {});
  instance.score = score_of(instance.evidence, 0.0F);
  if (parameters.verify.tests)
    instance.rejection = failed_test(instance.evidence, parameters.verify, bank.part->thresholds);
  return instance;
}

constexpr std::uint32_t nobody = 0xFFFFFFFFU;

/// How long the selection among poses that were judged will take, which took `judging_ns`: it renders and judges those
/// anew that passed the tests, some of them several times, in one thread, and compares twins closely in all of them.
std::int64_t expected_selection_ns(std::span<const Instance> judged, std::span<const Bank> banks,
                                   std::int64_t judging_ns, int threads) {
  std::int64_t all = 0;
  std::int64_t halves = 0;
  for (const Instance& instance : judged) {
    if (instance.bank == nobody) continue;
    ++all;
    if (instance.rejection == Rejection::none) halves += 3 * threads + (banks[instance.bank].twins.empty() ? 0 : 6);
  }
  return all == 0 ? 0 : halves * judging_ns / (2 * all);
}

/// How many poses of a part may go on so that they fit into `room` with their twins; one at least.
int most_without_twins(const Bank& bank, const RefineParameters& parameters, std::size_t room) {
  const std::size_t twins = std::min(bank.twins.size(), static_cast<std::size_t>(std::max(parameters.twins, 0)));
  return std::min(parameters.judged, static_cast<int>(std::max<std::size_t>(room / (1 + twins), 1)));
}

/// Refines the clusters to the end and judges them, those that agree best with the scene first, as long as there is
/// time: a few at a time, for only what was judged counts, and so that there is time to select from them.
void judge_clusters(const Scene& scene, const DetectRequest& request, std::uint32_t bank_index,
                    const DetectParameters& parameters, Execution execution, DetectWorkspace& workspace,
                    StageClock& clock, Detections& detections) {
  constexpr std::size_t at_a_time = 16;
  const Bank& bank = request.banks[bank_index];
  const std::size_t first = workspace.judged.size();
  const std::size_t count = std::min(workspace.clusters.size(), workspace.judged.capacity() - first);
  if (count < workspace.clusters.size()) detections.flags |= flag_hypotheses_cut;
  workspace.judged.assume_size(first + count);
  for (std::size_t i = 0; i < count; ++i) workspace.judged[first + i].bank = nobody;
  const auto own_image = [&] { return workspace.rendering[static_cast<std::size_t>(omp_get_thread_num())]; };
  for (std::size_t begin = 0; begin < count; begin += at_a_time) {
    const std::size_t some = std::min(at_a_time, count - begin);
    if (execution.deadline_ns != 0) {
      execution.deadline_ns =
          request.deadline_ns - expected_selection_ns(workspace.judged.span(), request.banks,
                                                      detections.stage_ns[static_cast<std::size_t>(Stage::verify)],
                                                      execution.threads);
    }
    parallel_for(some, execution, 1, [&](std::size_t i) {
      RigidTransform& pose = workspace.clusters[begin + i].camera_from_part;
      pose = refine_finely(scene.map, scene.edges, bank, pose, parameters.refine, own_image());
    });
    clock.end_of(Stage::refine);
    if (execution.late()) break;
    parallel_for(some, execution, 1, [&](std::size_t i) {
      workspace.judged[first + begin + i] =
          judge(scene, bank, bank_index, workspace.clusters[begin + i], parameters, own_image());
    });
    clock.end_of(Stage::verify);
  }
  if (execution.late()) detections.flags |= flag_deadline;
  const Instance* end = std::remove_if(workspace.judged.begin() + first, workspace.judged.end(),
                                       [](const Instance& instance) { return instance.bank == nobody; });
  workspace.judged.truncate(static_cast<std::size_t>(end - workspace.judged.begin()));
}

}  // namespace

Status detect(const DepthFrame& frame, const DetectRequest& request, const DetectParameters& parameters,
              DetectWorkspace& workspace, Detections& detections) {
  detections = Detections{};
  workspace.judged.clear();
  workspace.accepted.clear();
  workspace.rejected.clear();
  if (request.trace != nullptr) request.trace->poses.clear();
  if (Status status = check(frame, request, parameters, workspace.capacity); !status.ok()) return status;
  if (request.banks.empty()) return {};
  StageClock clock(request, detections);

  float finest = request.banks.front().part->detail;
  for (const Bank& bank : request.banks) finest = std::min(finest, bank.part->detail);
  // What is late is left, whatever stage it has come to: only what was verified is an answer.
  const Execution execution{parameters.threads, request.now_ns, request.deadline_ns};
  Scene scene = preprocess(frame, request.empty_bin, finest, parameters.preprocess, execution, workspace.preprocess);
  detections.measured_pixels = scene.measured_pixels;
  detections.foreground_pixels =
      scene.foreground_cells * static_cast<std::uint32_t>(scene.map.stride * scene.map.stride);
  clock.end_of(Stage::preprocess);

  if (scene.measured_pixels == 0 && !execution.late())
    return {StatusCode::bad_frame, "nothing in the frame was measured"};

  const auto out_of_time = [&] { return execution.late() || (detections.flags & flag_deadline) != 0; };
  for (std::uint32_t b = 0; b < request.banks.size() && !out_of_time(); ++b) {
    const Bank& bank = request.banks[b];
    const float reach = bank.grid.distance_step * static_cast<float>(bank.grid.distance_bins);
    know_edge_blur(frame, bank.part->detail, execution, scene.map.edge_blurs);
    const NeighbourGrid points = sample_for(scene, bank.part->sampling, reach, execution, workspace.preprocess);
    clock.end_of(Stage::preprocess);
    if (execution.late()) break;
    detections.scene_points += static_cast<std::uint32_t>(points.points.size());
    if (workspace.preprocess.samples.dropped() > 0) detections.flags |= flag_scene_points_cut;

    const VotingWork voting = match(points, bank, parameters.match, execution, workspace.match, workspace.hypotheses);
    detections.work.voting += voting;
    if (voting.left_out > 0) detections.flags |= flag_voting_cut;
    detections.work.hypotheses += static_cast<std::uint32_t>(workspace.hypotheses.size());
    record(request.trace, b, TracedStage::voted, workspace.hypotheses);
    clock.end_of(Stage::match);
    if (execution.late()) break;

    cluster_hypotheses(workspace.hypotheses.span(), bank, parameters.cluster, execution, workspace.cluster,
                       workspace.clusters);
    detections.work.clusters += static_cast<std::uint32_t>(workspace.clusters.size());
    if (workspace.clusters.dropped() > 0) detections.flags |= flag_hypotheses_cut;
    rate_plausibility(scene.map, bank, execution, workspace.clusters);
    record(request.trace, b, TracedStage::clustered, workspace.clusters);
    if (execution.late()) break;
    keep_spread(scene.map, bank,
                {parameters.cluster.plausible, parameters.cluster.plausible_per_place, 100, bank.part->sampling},
                execution, workspace.select.claims.cells, workspace.clusters);
    record(request.trace, b, TracedStage::plausible, workspace.clusters);
    clock.end_of(Stage::cluster);
    if (execution.late()) break;

    refine_coarsely(scene.map, scene.edges, bank, parameters.refine, execution, workspace.clusters);
    record(request.trace, b, TracedStage::aligned, workspace.clusters);
    if (execution.late()) break;
    // Each part gets its share of the memory, whatever came before it.
    const std::size_t share = workspace.capacity.judged / request.banks.size();
    const int most = most_without_twins(bank, parameters.refine, share);
    narrow_down(scene, bank, parameters.refine, most, execution, workspace.select.claims.cells, workspace.clusters);
    if (most < parameters.refine.judged && workspace.clusters.size() >= static_cast<std::size_t>(most))
      detections.flags |= flag_hypotheses_cut;
    drop_contradicted(scene, bank, parameters.refine, surface_tolerance(scene.map, bank, parameters.verify), execution,
                      workspace.clusters);
    record(request.trace, b, TracedStage::distinct, workspace.clusters);
    clock.end_of(Stage::refine);
    if (execution.late()) break;

    judge_clusters(scene, request, b, parameters, execution, workspace, clock, detections);
  }
  detections.work.judged = static_cast<std::uint32_t>(workspace.judged.size());
  // A selection that takes longer than expected still may bring the best ones.
  constexpr std::int64_t overdraft_ns = 2'000'000;
  Execution selection = execution;
  if (selection.deadline_ns != 0) selection.deadline_ns += overdraft_ns;
  detections.flags |= select_instances(scene.map, request.banks, parameters.verify, request.minimum_score, selection,
                                       workspace.rendering, workspace.judged.span(), workspace.select,
                                       workspace.accepted, workspace.rejected);
  if (execution.late()) detections.flags |= flag_deadline;
  clock.end_of(Stage::verify);
  for (const Instance& instance : workspace.rejected)
    ++detections.rejections[static_cast<std::size_t>(instance.rejection)];
  detections.instances = workspace.accepted.span();
  detections.rejected = workspace.rejected.span();
  return {};
}

}  // namespace graspd
