#include "core/train/candidate_views.hpp"

#include <algorithm>

#include "core/train/surface_index.hpp"

namespace graspd {

namespace {

constexpr int continuous_turns = 36;

void append_row(VisibilityRows& rows, std::span<const std::uint64_t> row) {
  rows.bits.insert(rows.bits.end(), row.begin(), row.end());
}

/// The samples that lie within `reach` of a measured point on the same side of the surface.
std::vector<std::uint64_t> measured_samples(const std::vector<OrientedPoint>& samples,
                                            const std::vector<OrientedPoint>& measured, float reach,
                                            std::size_t words) {
  std::vector<std::uint64_t> row(words, 0);
  if (measured.empty()) return row;
  const SurfaceIndex index(measured, reach);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const OrientedPoint& nearest = measured[index.nearest(samples[i])];
    if ((nearest.position - samples[i].position).norm() < reach && nearest.normal.dot(samples[i].normal) > 0.5F) {
      row[i / 64] |= std::uint64_t{1} << (i % 64);
    }
  }
  return row;
}

/// For each sample, the one that `member` carries onto it.
std::vector<std::uint32_t> origins(const std::vector<OrientedPoint>& samples, const SurfaceIndex& index,
                                   const RigidTransform& member) {
  const RigidTransform back = inverse(member);
  std::vector<std::uint32_t> result(samples.size());
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < samples.size(); ++i) {
    result[i] = static_cast<std::uint32_t>(index.nearest(back * samples[i]));
  }
  return result;
}

std::vector<std::uint64_t> carried(std::span<const std::uint64_t> row, const std::vector<std::uint32_t>& from) {
  std::vector<std::uint64_t> result(row.size(), 0);
  for (std::size_t i = 0; i < from.size(); ++i) {
    result[i / 64] |= (row[from[i] / 64] >> (from[i] % 64) & 1U) << (i % 64);
  }
  return result;
}

}  // namespace

std::vector<std::vector<std::size_t>> direction_orbits(std::span<const Vector3> directions,
                                                       const SymmetryGroup& symmetry) {
  const std::vector<RigidTransform> members = sampled_members(symmetry, continuous_turns);
  std::vector<std::vector<std::size_t>> orbits(directions.size());
  for (std::size_t i = 0; i < directions.size(); ++i) {
    for (const RigidTransform& member : members) {
      const Vector3 moved = member.rotation * directions[i];
      std::size_t nearest = 0;
      for (std::size_t j = 1; j < directions.size(); ++j) {
        if (directions[j].dot(moved) > directions[nearest].dot(moved)) nearest = j;
      }
      orbits[i].push_back(nearest);
    }
    std::sort(orbits[i].begin(), orbits[i].end());
    orbits[i].erase(std::unique(orbits[i].begin(), orbits[i].end()), orbits[i].end());
  }
  return orbits;
}

CandidateViews rendered_candidates(std::vector<OrientedPoint> samples, std::vector<Vector3> directions,
                                   const MeshView& occluder, const ViewingConditions& conditions,
                                   const SymmetryGroup& symmetry) {
  CandidateViews candidates;
  candidates.visibility = find_visibility(occluder, samples, directions, conditions);
  candidates.orbits = direction_orbits(directions, symmetry);
  candidates.rendered = directions.size();
  candidates.samples = std::move(samples);
  candidates.directions = std::move(directions);
  return candidates;
}

void drop_rendered(CandidateViews& candidates) {
  candidates.directions.clear();
  candidates.orbits.clear();
  candidates.visibility.seen.bits.clear();
  candidates.visibility.facing.bits.clear();
  candidates.rendered = 0;
}

void add_cut_outs(std::vector<CutOut> cut_outs, const MeshView& occluder, const ViewingConditions& conditions,
                  const SymmetryGroup& symmetry, float reach, CandidateViews& candidates) {
  const std::size_t words = candidates.visibility.seen.words_per_row;
  const std::vector<RigidTransform> members = sampled_members(symmetry, continuous_turns);
  const SurfaceIndex index(candidates.samples, reach);
  std::vector<std::vector<std::uint32_t>> carried_from;
  for (const RigidTransform& member : members) carried_from.push_back(origins(candidates.samples, index, member));
  for (CutOut& cut : cut_outs) {
    const std::size_t first = candidates.directions.size();
    const std::size_t number = candidates.cut_outs.size();
    const std::vector<std::uint64_t> row = measured_samples(candidates.samples, cut.points, reach, words);
    // What could have been measured from there.
    const Visibility whole = find_visibility(occluder, candidates.samples, std::span(&cut.direction, 1), conditions);
    for (std::size_t m = 0; m < members.size(); ++m) {
      candidates.directions.push_back(members[m].rotation * cut.direction);
      candidates.twins.push_back({number, members[m]});
      candidates.orbits.emplace_back();
      candidates.orbits[first].push_back(first + m);
      append_row(candidates.visibility.seen, m == 0 ? row : carried(row, carried_from[m]));
      append_row(candidates.visibility.facing, m == 0 ? whole.seen.row(0) : std::vector<std::uint64_t>(words, 0));
    }
    candidates.cut_outs.push_back(std::move(cut));
  }
}

}  // namespace graspd
