#include "core/train/turned_look.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "core/train/surface_moments.hpp"
#include "core/train/view_sphere.hpp"

namespace graspd {

namespace {

constexpr int view_count = 100;
constexpr float maximum_incidence = 1.3F;
// Shares of the diameter.
constexpr float unseen_mean = 0.004F;
constexpr float unseen_distance = 0.012F;
/// Of what is seen in a view: less than that is also the error of the samples.
constexpr float unseen_share = 0.01F;

std::size_t count_bits(std::span<const std::uint64_t> row, std::span<const std::uint64_t> mask) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < row.size(); ++i) count += static_cast<std::size_t>(std::popcount(row[i] & mask[i]));
  return count;
}

}  // namespace

SurroundedSurface::SurroundedSurface(const Mesh& mesh, float diameter) : surface(mesh, diameter, 20000, 4000) {
  const ViewingConditions conditions{surface_moments(mesh).box_middle, diameter, 10.0F * diameter, maximum_incidence};
  seen = find_visibility(mesh.view(), surface.probes, view_sphere(view_count), conditions).seen;
}

bool looks_the_same(const SurroundedSurface& part, const RigidTransform& part_from_part) {
  const std::vector<float> distances = self_distances(part.surface, part.surface.probes, part_from_part);
  const float sum = std::accumulate(distances.begin(), distances.end(), 0.0F);
  if (sum >= unseen_mean * static_cast<float>(distances.size())) return false;
  const std::vector<std::uint64_t> all(part.seen.words_per_row, ~std::uint64_t{0});
  std::vector<std::uint64_t> differing(part.seen.words_per_row, 0);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if (distances[i] >= unseen_distance) differing[i / 64] |= std::uint64_t{1} << (i % 64);
  }
  int telling = 0;
  for (std::size_t d = 0; d < view_count; ++d) {
    const auto seen = static_cast<float>(count_bits(part.seen.row(d), all));
    if (static_cast<float>(count_bits(part.seen.row(d), differing)) > unseen_share * seen) ++telling;
  }
  return 2 * telling < view_count;
}

}  // namespace graspd
