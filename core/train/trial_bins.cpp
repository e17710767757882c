#include "core/train/trial_bins.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "core/detect/detector.hpp"
#include "core/detect/parallel_for.hpp"
#include "core/evaluate/match.hpp"
#include "core/evaluate/surface_error.hpp"
#include "core/train/part_mesh.hpp"

namespace graspd {

namespace {

constexpr std::array strains{SensorStrain::medium, SensorStrain::hard, SensorStrain::clean, SensorStrain::hard,
                             SensorStrain::medium};

/// Diameters from the sensor to the bin's floor, at least: a pile is up to one high, and a sensor that looks at it from
/// nearer than twice that sees only some of it.
constexpr float least_distance = 3.0F;

constexpr float least_visibility = 0.1F;  ///< Below it an instance is not missed, but right when it is found.

/// The memory of detections with one bank in frames up to a size.
struct TrialMemory {
  std::unique_ptr<std::byte[]> bytes;
  DetectWorkspace workspace;

  TrialMemory(const Bank& bank, std::span<const SimulatedScene> bins, int threads) {
    DetectCapacity capacity;
    capacity.maximum_width = 1;
    capacity.maximum_height = 1;
    for (const SimulatedScene& bin : bins) {
      capacity.maximum_width = std::max(capacity.maximum_width, bin.camera.width);
      capacity.maximum_height = std::max(capacity.maximum_height, bin.camera.height);
    }
    capacity.maximum_references = static_cast<std::uint32_t>(bank.reference_points.size());
    capacity.maximum_cells = bank.grid.cell_count();
    capacity.threads = threads;
    Arena measuring = Arena::measuring();
    static_cast<void>(carve_detect_workspace(measuring, capacity));
    std::size_t space = measuring.used() + Arena::alignment;
    bytes = std::make_unique<std::byte[]>(space);
    void* first = bytes.get();
    std::align(Arena::alignment, measuring.used(), first, space);
    Arena arena({static_cast<std::byte*>(first), measuring.used()});
    workspace = carve_detect_workspace(arena, capacity);
  }
};

TrialOutcome judged(const Detections& detections, const SimulatedScene& bin, const EvaluationPart& part) {
  const auto error = [&](std::size_t estimate, std::size_t truth) {
    const RigidTransform& found = detections.instances[estimate].camera_from_part;
    const RigidTransform& real = bin.instances[truth].camera_from_part;
    const bool stranger = bin.instances[truth].part != 0;
    // The middle of the vertices need not lie on an axis of symmetry, but not far from it.
    if (stranger || (found * part.middle - real * part.middle).norm() > 0.5F * part.diameter) return 1.0;
    const float limit = 2.0F * static_cast<float>(right_pose_error) * part.diameter;
    const float distance = maximum_surface_distance(found, real, part.vertices, part.symmetries, limit);
    return static_cast<double>(distance / part.diameter);
  };
  const std::vector<bool> any_visibility(bin.instances.size(), true);
  const std::vector<std::size_t> claimed =
      match_greedily(detections.instances.size(), any_visibility, right_pose_error, error);
  TrialOutcome outcome;
  for (const SimulatedInstance& instance : bin.instances) {
    const bool wanted = instance.part == 0 && instance.visibility >= least_visibility;
    if (wanted) ++outcome.found[visibility_class(instance.visibility)].total;
  }
  for (const std::size_t truth : claimed) {
    ++outcome.precision.total;
    if (truth == unmatched) continue;
    ++outcome.precision.hits;
    const float visibility = bin.instances[truth].visibility;
    if (visibility >= least_visibility) ++outcome.found[visibility_class(visibility)].hits;
  }
  return outcome;
}

std::vector<SimulatedScene> simulated_bins(std::span<const SimulatedPart> parts, std::size_t first, std::size_t count,
                                           const TrialRecipe& recipe) {
  float largest = 0.0F;
  for (const SimulatedPart& part : parts) largest = std::max(largest, part.shape.diameter);
  std::vector<SimulatedScene> bins(count);
  parallel_for(count, recipe.threads, 1, [&](std::size_t i) {
    SceneRecipe scene;
    scene.instances = recipe.instances;
    scene.strain = strains[(first + i) % strains.size()];
    scene.sensor_distance = std::max(recipe.sensor_distance, least_distance * largest);
    scene.maximum_width = recipe.maximum_width;
    scene.maximum_height = recipe.maximum_height;
    scene.seed = first + i + 1;
    bins[i] = simulate_scene(parts, scene);
  });
  return bins;
}

}  // namespace

Result<TrialPart> trial_part(const Bank& bank) {
  Mesh mesh;
  mesh.vertices.assign(bank.mesh.vertices.begin(), bank.mesh.vertices.end());
  mesh.triangles.assign(bank.mesh.triangles.begin(), bank.mesh.triangles.end());
  const Result<PartMesh> prepared = prepare_mesh(mesh);
  if (!prepared.ok()) return prepared.status();
  const PartMesh& whole = prepared.value();
  return TrialPart{simulated_part(whole.mesh, whole.closed()),
                   evaluation_part(bank.part->part_id, whole.mesh, bank.part->diameter, bank.symmetry()),
                   whole.closed()};
}

std::vector<SimulatedScene> trial_bins(const TrialPart& part, std::size_t first, std::size_t count,
                                       const TrialRecipe& recipe) {
  return simulated_bins(std::span(&part.simulated, 1), first, count, recipe);
}

std::vector<SimulatedScene> stranger_bins(const TrialPart& part, std::size_t count, const TrialRecipe& recipe) {
  const std::array proportions{Vector3(1.4F, 1.4F, 1.4F), Vector3(0.7F, 0.7F, 0.7F), Vector3(1.5F, 1.0F, 0.7F)};
  std::vector<SimulatedPart> strangers;
  for (const Vector3& factors : proportions) {
    Mesh mesh = part.simulated.mesh;
    for (Vector3& vertex : mesh.vertices) vertex = vertex.cwiseProduct(factors);
    strangers.push_back(simulated_part(mesh, part.closed));
  }
  std::vector<SimulatedScene> bins = simulated_bins(strangers, 0, count, recipe);
  for (SimulatedScene& bin : bins) {
    for (SimulatedInstance& instance : bin.instances) ++instance.part;
  }
  return bins;
}

TrialOutcome& TrialOutcome::operator+=(const TrialOutcome& other) {
  for (std::size_t i = 0; i < found.size(); ++i) {
    found[i].hits += other.found[i].hits;
    found[i].total += other.found[i].total;
  }
  precision.hits += other.precision.hits;
  precision.total += other.precision.total;
  return *this;
}

Result<TrialOutcome> try_bank(const Bank& bank, const TrialPart& part, std::span<SimulatedScene> bins, int threads,
                              const std::function<void()>& done) {
  TrialMemory memory(bank, bins, threads);
  DetectParameters parameters;
  parameters.threads = threads;
  DetectRequest request;
  request.banks = std::span(&bank, 1);
  TrialOutcome outcome;
  for (SimulatedScene& bin : bins) {
    request.empty_bin = bin.empty_bin();
    Detections detections;
    const Status detected = detect(bin.frame(), request, parameters, memory.workspace, detections);
    if (!detected.ok()) return detected;
    outcome += judged(detections, bin, part.evaluation);
    done();
  }
  return outcome;
}

}  // namespace graspd
