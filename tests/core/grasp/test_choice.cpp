#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <random>

#include "core/grasp/checks.hpp"
#include "core/grasp/ranking.hpp"
#include "tests/core/grasp/planner_fixture.hpp"

namespace graspd {
namespace {

/// Blocks at random in two layers, some of which lean, with two sizes of jaws.
struct GraspChoiceTest : Planner {
  GraspChoiceTest() {
    scene.camera = {160, 120, 200.0F, 200.0F, 79.5F, 59.5F};
    Tool slim = parameters.tools.tools[0];
    slim.number = 3;
    slim.finger_thickness = 0.005F;
    parameters.tools.tools[parameters.tools.count++] = slim;
    part.grasps[1].tool = 3;
    part.grasps[1].priority = 1;
    RigidTransform lower = part.grasps[0].part_from_tool;
    lower.translation.y() = 0.015F;
    part.grasps.push_back({lower, 0.036F, 1, 3});
    for (PartGrasp& grasp : part.grasps) {
      grasp.least_opening = grasp.opening - 0.004F;
      grasp.opening += 0.012F;
    }
    parameters.collision.maximum_hidden = 0.1F;
  }
  void lay_pile(std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
    scene.boxes.clear();
    instances.clear();
    for (int i = 0; i < 14; ++i) {
      add_block(0.13F * unit(random), 0.09F * unit(random), i < 9 ? 0.585F : 0.555F, 1.6F * unit(random),
                0.8F + 0.1F * unit(random));
      instances.back().camera_from_part.rotation *= turn(Vector3::UnitX(), 0.2F * unit(random)).rotation;
      scene.boxes.back().camera_from_box = instances.back().camera_from_part;
    }
    frame = scene.render();
  }
  void begin() {
    detections.instances = instances;
    bank = part.bank();
    begin_choice(frame, detections, {&bank, 1}, parameters, grasp_memory.workspace, avoided);
  }
  /// The picks in their order, found without any bound: every grasp of every instance is looked up.
  std::vector<Pick> by_brute_force() {
    begin();
    GraspWorkspace& workspace = grasp_memory.workspace;
    std::vector<GraspCandidate> memory(512);
    FixedVector<GraspCandidate> candidates(memory);
    std::vector<Pick> picks;
    for (std::size_t i = 0; i < instances.size(); ++i) {
      const GraspSearch& search = workspace.searches[i];
      static_cast<void>(grasp_candidates(bank, search.target, parameters, avoided, candidates));
      Pick best;
      best.value = -std::numeric_limits<float>::infinity();
      for (const GraspCandidate& candidate : candidates) {
        const float any = -std::numeric_limits<float>::infinity();
        const GraspCheck check = check_grasp(workspace.choice.around, i, candidate, parameters, any);
        if (check.reason != GraspRejection::none) continue;
        const float value = grasp_value({bank.grasps[candidate.grasp].priority, search.target.score, candidate.tilt,
                                         check.clearance, search.target.drop, candidate.turn, check.hidden},
                                        parameters.weights, parameters.collision.clearance_range);
        if (value <= best.value) continue;
        best.value = value;
        best.robot_from_tool = candidate.robot_from_tool;
        best.opening = check.opening;
        best.instance = static_cast<std::uint32_t>(i);
      }
      if (std::isfinite(best.value)) picks.push_back(best);
    }
    std::stable_sort(picks.begin(), picks.end(), [&](const Pick& a, const Pick& b) {
      const std::int32_t rank_a = workspace.searches[a.instance].rank;
      const std::int32_t rank_b = workspace.searches[b.instance].rank;
      return rank_a != rank_b ? rank_a > rank_b : a.value > b.value;
    });
    return picks;
  }
  void expect_as_by_brute_force(const PickResult& full) {
    const std::vector<Pick> picks(full.picks.begin(), full.picks.end());
    const std::vector<Pick> expected = by_brute_force();
    ASSERT_EQ(picks.size(), expected.size());
    for (std::size_t i = 0; i < picks.size(); ++i) {
      EXPECT_EQ(picks[i].instance, expected[i].instance) << i;
      EXPECT_EQ(picks[i].value, expected[i].value);
      EXPECT_EQ(picks[i].opening, expected[i].opening);
      EXPECT_EQ(picks[i].robot_from_tool.translation, expected[i].robot_from_tool.translation);
    }
  }
  /// Asks for `wanted` picks at a time and holds them against those of a choice that asked every instance.
  void expect_same_in_steps(std::size_t wanted, const PickResult& full, std::span<const Pick> picks) {
    begin();
    for (std::size_t asked = wanted;; asked += wanted) {
      const PickResult some = find_picks(grasp_memory.workspace, asked);
      const std::size_t given = std::min(asked, picks.size());
      ASSERT_EQ(some.picks.size(), given);
      const bool same = given == 0 || std::memcmp(some.picks.data(), picks.data(), given * sizeof(Pick)) == 0;
      ASSERT_TRUE(same) << wanted << " at a time";
      EXPECT_EQ(some.found, full.found);
      EXPECT_LE(some.checks, full.checks);
      const bool not_all_asked = (some.flags & flag_not_all_asked) != 0;
      EXPECT_EQ(some.pickable < full.pickable || some.rejections != full.rejections, not_all_asked);
      EXPECT_EQ(some.unlisted, some.pickable - given);
      if (asked == wanted) not_asked += not_all_asked ? 1 : 0;
      if (asked <= picks.size()) continue;
      EXPECT_EQ(some.checks, full.checks);
      EXPECT_EQ(some.main_reason, full.main_reason);
      EXPECT_FALSE(not_all_asked);
      break;
    }
  }
  /// All of it, for the pile that was laid.
  void expect_same() {
    const PickResult full = choose_again();
    EXPECT_EQ(full.flags & flag_not_all_asked, 0U);
    EXPECT_EQ(full.unlisted, 0U);
    const std::vector<Pick> picks(full.picks.begin(), full.picks.end());
    found += picks.size();
    for (std::size_t wanted = 1; wanted <= 5; ++wanted) expect_same_in_steps(wanted, full, picks);
  }

  Detections detections;
  Bank bank;
  std::size_t found = 0;
  int not_asked = 0;  ///< Choices that did not have to ask every instance for their first picks.
};

TEST_F(GraspChoiceTest, PicksAreThoseOfAFullChoiceInEveryOrder) {
  std::uint32_t seed = 0;
  parameters.order.point = Vector3(0.05F, 0.02F, 0.55F);
  for (const PickOrder order :
       {PickOrder::value, PickOrder::top_first, PickOrder::nearest, PickOrder::fewest_neighbours}) {
    parameters.order.order = order;
    for (int pile = 0; pile < 15; ++pile) {
      lay_pile(++seed);
      expect_same();
      expect_as_by_brute_force(choose_again());
    }
  }
  EXPECT_GT(found, 150U);
  EXPECT_GT(not_asked, 100);
}

TEST_F(GraspChoiceTest, PicksAreThoseOfAFullChoiceWithAvoidedPlacesAndTools) {
  for (std::uint32_t seed = 100; seed < 120; ++seed) {
    lay_pile(seed);
    avoided.clear();
    parameters.tools.count = 3;
    const PickResult all = choose_again();
    if (!all.found) continue;
    avoided = {{all.picks.front().robot_from_tool.translation, 1}, {all.picks.back().robot_from_tool.translation, 1}};
    expect_same();
    expect_as_by_brute_force(choose_again());
    parameters.tools.count = 2;
    expect_same();
    expect_as_by_brute_force(choose_again());
  }
  EXPECT_GT(found, 50U);
}

TEST_F(GraspChoiceTest, PicksAreThoseOfAFullChoiceWhenChecksRunOut) {
  grasp_memory = GraspMemory({512, 100, 30});
  int cut = 0;
  for (std::uint32_t seed = 200; seed < 215; ++seed) {
    lay_pile(seed);
    expect_same();
    cut += (choose_again().flags & flag_grasps_cut) != 0 ? 1 : 0;
  }
  EXPECT_GT(cut, 5);
  EXPECT_GT(found, 15U);
}

TEST_F(GraspChoiceTest, GoesByThePlacesThatWereAvoidedWhenItBegan) {
  lay_pile(300);
  const PickResult full = choose_again();
  ASSERT_GE(full.picks.size(), 2U);
  const std::vector<Pick> picks(full.picks.begin(), full.picks.end());
  begin();
  ASSERT_EQ(find_picks(grasp_memory.workspace, 1).picks.size(), 1U);
  avoided.assign(2, {picks[1].robot_from_tool.translation, 1});
  parameters.maximum_tilt = 0.0F;
  EXPECT_EQ(find_picks(grasp_memory.workspace, 2).picks[1].instance, picks[1].instance);
}

TEST_F(GraspChoiceTest, AnotherChoiceLeavesNothingOfTheOneBefore) {
  lay_pile(301);
  begin();
  ASSERT_TRUE(find_picks(grasp_memory.workspace, 1).found);
  instances.clear();
  begin();
  const PickResult nothing = find_picks(grasp_memory.workspace, 5);
  EXPECT_FALSE(nothing.found);
  EXPECT_TRUE(nothing.picks.empty());
  EXPECT_TRUE(nothing.reasons.empty());
  EXPECT_EQ(nothing.pickable, 0U);
  EXPECT_EQ(nothing.flags, 0U);
}

}  // namespace
}  // namespace graspd
