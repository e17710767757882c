#include "core/evaluate/image_evaluation.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/evaluate/surface_error.hpp"
#include "core/evaluate/symmetry_set.hpp"

namespace graspd {
namespace {

constexpr float largest_surface_error = 0.5F;      // Of the diameter.
constexpr float largest_projection_error = 50.0F;  // Pixels of an image 640 wide.

/// Whether two spheres of `radius` around `a` and `b` may touch in the image.
bool may_overlap_in_image(const Vector3& a, const Vector3& b, float radius) {
  if (a.z() == 0.0F || b.z() == 0.0F) return false;
  const float distance = (a / a.z() - b / b.z()).norm();
  return distance < radius * (1.0F / a.z() + 1.0F / b.z());
}

PoseError pose_error(const RigidTransform& estimate, const DistanceImage& estimate_image, const RigidTransform& truth,
                     const DistanceImage& truth_image, const DistanceImage& measured, const EvaluationPart& part,
                     const Camera& camera) {
  PoseError error;
  error.visible_surface.fill(1.0F);
  // Around its middle, a sphere as wide as the part holds it, wherever its own origin is.
  if (may_overlap_in_image(estimate * part.middle, truth * part.middle, part.diameter)) {
    error.visible_surface =
        visible_surface_discrepancy(estimate_image, truth_image, measured, bop19_visibility_delta, part.diameter);
  }
  error.surface =
      maximum_surface_distance(estimate, truth, part.vertices, part.symmetries, largest_surface_error * part.diameter) /
      part.diameter;
  const float pixels_per_unit = static_cast<float>(camera.width) / 640.0F;
  error.projection = maximum_projection_distance(estimate, truth, camera, part.vertices, part.symmetries,
                                                 largest_projection_error * pixels_per_unit) /
                     pixels_per_unit;
  return error;
}

/// The `count` most visible, the earlier one first among equals.
std::vector<bool> most_visible(std::span<const float> visibilities, std::size_t count) {
  std::vector<std::size_t> order(visibilities.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return visibilities[a] > visibilities[b]; });
  std::vector<bool> chosen(visibilities.size(), false);
  for (std::size_t i = 0; i < std::min(count, order.size()); ++i) chosen[order[i]] = true;
  return chosen;
}

std::uint32_t instances_wanted(const EvaluationImage& image, std::uint32_t part) {
  std::uint32_t wanted = 0;
  for (const EvaluationTarget& target : image.targets) wanted += target.part == part ? target.instances : 0U;
  return wanted;
}

PartErrors part_errors(const EvaluationImage& image, const EvaluationPart& part, const DistanceImage& measured,
                       const Camera& camera) {
  PartErrors result;
  result.part = part.id;
  result.instances = instances_wanted(image, part.id);

  for (std::size_t i = 0; i < image.estimates.size(); ++i) {
    if (image.estimates[i].part == part.id) result.sources.push_back(i);
  }
  std::stable_sort(result.sources.begin(), result.sources.end(),
                   [&](std::size_t a, std::size_t b) { return image.estimates[a].score > image.estimates[b].score; });

  std::vector<RigidTransform> truths;
  std::vector<DistanceImage> truth_images;
  for (const TruePose& truth : image.truths) {
    if (truth.part != part.id) continue;
    truths.push_back(truth.camera_from_part);
    truth_images.push_back(rendered_distance(part.mesh.view(), truth.camera_from_part, camera));
    result.visibilities.push_back(truth.visibility);
  }
  result.targeted = most_visible(result.visibilities, result.instances);

  for (const std::size_t source : result.sources) {
    const PoseEstimate& estimate = image.estimates[source];
    result.scores.push_back(estimate.score);
    const DistanceImage estimate_image = rendered_distance(part.mesh.view(), estimate.camera_from_part, camera);
    for (std::size_t truth = 0; truth < truths.size(); ++truth) {
      result.errors.push_back(pose_error(estimate.camera_from_part, estimate_image, truths[truth], truth_images[truth],
                                         measured, part, camera));
    }
  }
  return result;
}

}  // namespace

EvaluationPart evaluation_part(std::uint32_t id, Mesh mesh, float diameter, const Symmetry& symmetry) {
  EvaluationPart part{id, diameter, std::move(mesh), {}, symmetry_set(symmetry), Vector3::Zero()};
  part.vertices = outermost_first(part.mesh.vertices);
  for (const Vector3& vertex : part.vertices) part.middle += vertex / static_cast<float>(part.vertices.size());
  return part;
}

ImageErrors image_errors(const EvaluationImage& image, const DepthFrame& frame, std::span<const EvaluationPart> parts) {
  ImageErrors result{image.scene, image.image, image.level, image.seconds, {}};
  const DistanceImage measured = measured_distance(frame);
  for (const EvaluationPart& part : parts) {
    const bool reported = std::any_of(image.estimates.begin(), image.estimates.end(),
                                      [&](const PoseEstimate& estimate) { return estimate.part == part.id; });
    if (!reported && instances_wanted(image, part.id) == 0) continue;
    result.parts.push_back(part_errors(image, part, measured, frame.camera));
  }
  return result;
}

}  // namespace graspd
