#include "core/train/turned_look.hpp"

#include <span>
#include <vector>

#include "core/train/surface_moments.hpp"
#include "core/train/view_sphere.hpp"

namespace graspd {

namespace {

constexpr int view_count = 100;
constexpr std::size_t probe_count = 4000;
constexpr std::size_t few_probes = 300;
constexpr float maximum_incidence = 1.3F;
// Shares of the diameter.
constexpr float unseen_mean = 0.004F;
constexpr float unseen_distance = 0.012F;
/// Of what is seen in a view: less than that is also the error of the samples.
constexpr float unseen_share = 0.01F;

/// Whether a view that shows the probes `seen`, of which the first have `distances`, tells by `slack` times
/// what counts.
bool tells(std::span<const std::uint64_t> seen, std::span<const float> distances, float slack) {
  std::size_t count = 0;
  std::size_t differing = 0;
  float sum = 0;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if ((seen[i / 64] >> (i % 64) & 1U) == 0) continue;
    ++count;
    if (distances[i] >= unseen_distance) ++differing;
    sum += distances[i];
  }
  const float allowed = slack * static_cast<float>(count);
  return sum > unseen_mean * allowed || static_cast<float>(differing) > unseen_share * allowed;
}

bool most_views_tell(const SurroundedSurface& part, const RigidTransform& part_from_part, std::size_t probes,
                     float slack) {
  const std::vector<float> distances = self_distances(part.surface, part.surface.first_probes(probes), part_from_part);
  int telling = 0;
  for (std::size_t d = 0; d < view_count; ++d) telling += tells(part.seen.row(d), distances, slack) ? 1 : 0;
  return 2 * telling >= view_count;
}

}  // namespace

SurroundedSurface::SurroundedSurface(const Mesh& mesh, float diameter) : surface(mesh, diameter, 20000, probe_count) {
  const ViewingConditions conditions{surface_moments(mesh).box_middle, diameter, 10.0F * diameter, maximum_incidence};
  seen = find_visibility(mesh.view(), surface.probes, view_sphere(view_count), conditions).seen;
}

bool looks_the_same(const SurroundedSurface& part, const RigidTransform& part_from_part) {
  // Most turns that are none show it at a glance.
  return !most_views_tell(part, part_from_part, few_probes, 3.0F) &&
         !most_views_tell(part, part_from_part, probe_count, 1.0F);
}

}  // namespace graspd
