#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include "core/detect/voting.hpp"
#include "tests/core/memory/carved.hpp"

namespace graspd {
namespace {

constexpr PpfGrid grid{0.01F, 9, 12};
constexpr float reach = 0.09F;

/// Points on a box with rounded normals: large flat sides, whose pairs fill few cells, and everything in between.
std::vector<OrientedPoint> box_points(std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<float> place(-1.0F, 1.0F);
  std::normal_distribution<float> tilt(0.0F, 0.08F);
  std::vector<OrientedPoint> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    Vector3 position(place(random), place(random), place(random));
    Vector3 normal = Vector3::Zero();
    const auto side = static_cast<Eigen::Index>(i % 3);
    position[side] = i % 2 == 0 ? 1.0F : -1.0F;
    normal[side] = position[side];
    normal += Vector3(tilt(random), tilt(random), tilt(random));
    points[i] = {position.cwiseProduct(Vector3(0.04F, 0.03F, 0.01F)), normal.normalized()};
  }
  return points;
}

/// A bank of two views that can vote, and nothing more.
struct VotingBank {
  std::vector<OrientedPoint> points;
  std::vector<std::uint32_t> references;
  std::vector<std::uint32_t> offsets;
  std::vector<PpfEntry> entries;
  Bank bank;

  VotingBank(std::size_t count, std::mt19937& random) : points(box_points(count, random)), references(count) {
    std::iota(references.begin(), references.end(), 0U);
    std::vector<std::vector<PpfEntry>> cells(grid.cell_count());
    for (const std::uint32_t r : references) {
      const RigidTransform local = local_from_point(points[r]);
      for (const OrientedPoint& second : points) {
        const PpfFeature feature = ppf_feature(points[r], second);
        const std::uint32_t cell = ppf_cell(feature, grid);
        if (feature.distance < 2.0F * grid.distance_step || cell == no_ppf_cell) continue;
        cells[cell].push_back(PpfEntry::pack(r, entry_alpha(alpha_of(local, second.position))));
      }
    }
    offsets.push_back(0);
    for (const std::vector<PpfEntry>& cell : cells) {
      entries.insert(entries.end(), cell.begin(), cell.end());
      offsets.push_back(static_cast<std::uint32_t>(entries.size()));
    }
    bank.grid = grid;
    bank.view_points = points;
    bank.reference_points = references;
    bank.cell_offsets = offsets;
    bank.entries = entries;
  }
};

/// What the voting should leave, counted pair by pair and vote by vote.
struct ExpectedVotes {
  std::vector<int> rows;
  VotingWork work;

  ExpectedVotes(const NeighbourGrid& scene, const Bank& bank, const OrientedPoint& reference)
      : rows(bank.reference_points.size() * alpha_bins) {
    const RigidTransform local = local_from_point(reference);
    std::set<std::pair<std::uint32_t, std::uint32_t>> met;
    for (const OrientedPoint& second : scene.points) {
      const float distance = (second.position - reference.position).norm();
      if (distance < grid.distance_step || distance >= reach) continue;
      ++work.pairs;
      const std::uint32_t cell = ppf_cell(ppf_feature(reference, second), grid);
      const std::uint32_t alpha = entry_alpha(alpha_of(local, second.position));
      if (cell == no_ppf_cell || bank.cell_offsets[cell] == bank.cell_offsets[cell + 1]) continue;
      if (!met.emplace(cell, alpha / 8).second) continue;
      ++work.cells;
      for (std::uint32_t e = bank.cell_offsets[cell]; e < bank.cell_offsets[cell + 1]; ++e) {
        ++work.votes;
        const std::uint32_t turn = (alpha + 4 + 256 - bank.entries[e].alpha()) % 256 / 8;
        ++rows[bank.entries[e].reference() * alpha_bins + turn];
      }
    }
  }
  [[nodiscard]] int doubled_best(std::size_t reference) const {
    int best = 0;
    for (std::size_t a = 0; a < alpha_bins; ++a) {
      const auto at = [&](std::size_t turn) { return rows[reference * alpha_bins + turn % alpha_bins]; };
      best = std::max(best, 2 * at(a) + at(a + 1) + at(a + alpha_bins - 1));
    }
    return best;
  }
};

std::vector<InstructionSet> supported_sets() {
  std::vector<InstructionSet> sets;
  std::copy_if(every_instruction_set.begin(), every_instruction_set.end(), std::back_inserter(sets), is_supported);
  return sets;
}

class VotingWith : public testing::TestWithParam<InstructionSet> {};

/// Holds what every 23rd point of a scene votes for, in a bank of `bank_points`, against the same counted vote by vote.
/// Returns how often the narrow rows did not do.
int count_wide_rows(Voting vote, std::size_t scene_points, std::size_t bank_points) {
  std::mt19937 random(7);
  const VotingBank made(bank_points, random);
  const RigidTransform pose{Eigen::AngleAxisf(0.7F, Vector3(1, 2, 3).normalized()).toRotationMatrix(),
                            Vector3(0.1F, -0.05F, 0.6F)};
  std::vector<OrientedPoint> points;
  for (const OrientedPoint& point : box_points(scene_points, random)) points.push_back(pose * point);
  std::unique_ptr<std::byte[]> grid_bytes;
  const NeighbourGrid scene = build_neighbour_grid(points, 0.5F * reach, carved_into(grid_bytes, [&](Arena& arena) {
                                                     return carve_neighbour_grid(arena, points.size());
                                                   }));

  DetectCapacity capacity;
  capacity.maximum_references = static_cast<std::uint32_t>(made.references.size());
  capacity.maximum_cells = grid.cell_count();
  std::unique_ptr<std::byte[]> bytes;
  VotingScratch scratch = carved_into(bytes, [&](Arena& arena) { return carve_voting_scratch(arena, capacity); });
  prepare_voting(made.bank, scratch);
  VotingWork work;
  int wide = 0;
  for (std::size_t i = 0; i < scene.points.size(); i += 23) {
    vote(scene, made.bank, scene.points[i], scratch);
    wide += scratch.wide ? 1 : 0;
    const ExpectedVotes expected(scene, made.bank, scene.points[i]);
    work += expected.work;
    for (std::size_t r = 0; r < made.references.size(); ++r) {
      const std::array<std::uint16_t, alpha_bins> votes = scratch.votes_of(r);
      for (std::size_t a = 0; a < alpha_bins; ++a)
        EXPECT_EQ(votes[a], expected.rows[r * alpha_bins + a]) << "reference " << r << ", turn " << a;
      EXPECT_EQ(scratch.best_votes[r], expected.doubled_best(r)) << "reference " << r;
    }
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_EQ(scratch.work.pairs, work.pairs);
  EXPECT_EQ(scratch.work.cells, work.cells);
  EXPECT_EQ(scratch.work.votes, work.votes);
  EXPECT_GT(work.votes, 100000U);
  return wide;
}

TEST_P(VotingWith, EveryVoteIsCountedOnceAndInItsPlace) {
  EXPECT_EQ(count_wide_rows(voting_with(GetParam()), 500, 240), 0);
}

TEST_P(VotingWith, NoVoteIsLostWhereAByteDoesNotHoldThem) {
  const int wide = count_wide_rows(voting_with(GetParam()), 700, 500);
  EXPECT_GT(wide, 0);
  EXPECT_LT(wide, 31);
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, VotingWith, testing::ValuesIn(supported_sets()),
                         [](const auto& set) -> std::string {
                           switch (set.param) {
                             case InstructionSet::baseline:
                               return "baseline";
                             case InstructionSet::avx2:
                               return "avx2";
                             case InstructionSet::avx512:
                               return "avx512";
                           }
                           return "unknown";
                         });

}  // namespace
}  // namespace graspd
