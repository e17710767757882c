#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/detect/contest.hpp"
#include "core/geometry/symmetry.hpp"
#include "tests/core/detect/bracket_map.hpp"

namespace graspd {
namespace {

std::int64_t long_past() { return 100; }

/// Poses of a bracket that verification took for equally good.
class Contest : public BracketMap {
 protected:
  [[nodiscard]] static Instance judged(const RigidTransform& camera_from_part) {
    Instance instance;
    instance.camera_from_part = camera_from_part;
    instance.evidence.confirmed = 100.0F;
    instance.evidence.visible = 0.6F;
    instance.evidence.measured = 0.7F;
    instance.evidence.outline = 60.0F;
    return instance;
  }
  /// The first bracket, turned about the optical axis through its centre.
  [[nodiscard]] RigidTransform turned(float angle) const {
    const RigidTransform& truth = bin_.poses.front();
    return turn_about({Vector3::UnitZ(), truth * maker_.bank().part->centre}, angle) * truth;
  }
  [[nodiscard]] ContestOutcome hold(const Instance& own, std::span<const Rival> rivals,
                                    const Execution& execution = {}) const {
    return hold_contest(scene_.map, std::span(&maker_.bank(), 1), {}, execution, own, rivals, 2,
                        memory_.workspace.rendering[0]);
  }
};

TEST_F(Contest, IsWonByThePoseThatExplainsTheDepths) {
  const std::array rivals{Rival{2, judged(turned(-0.4F))}, Rival{2, judged(turned(0.0F))}};
  const ContestOutcome outcome = hold(judged(turned(0.4F)), rivals);
  EXPECT_EQ(outcome.rival, 1U);
  EXPECT_LT(rotation_angle(outcome.winner.camera_from_part.rotation.transpose() * turned(0.0F).rotation), 0.05F);
  EXPECT_LT(outcome.others, 0.5F);
  EXPECT_GT(outcome.others_of_own, 2.0F);
}

TEST_F(Contest, IsWonByTheInstanceItselfWhenThatIsRight) {
  const std::array rivals{Rival{2, judged(turned(-0.4F))}};
  const ContestOutcome outcome = hold(judged(turned(0.0F)), rivals);
  EXPECT_EQ(outcome.rival, no_rival);
  EXPECT_LT(outcome.others, 0.5F);
  EXPECT_EQ(outcome.others, outcome.others_of_own);
}

TEST_F(Contest, IsHeldAmongTheRivalsOfOneInstance) {
  const std::array rivals{Rival{1, judged(turned(0.0F))}, Rival{3, judged(turned(0.0F))}};
  const ContestOutcome outcome = hold(judged(turned(0.4F)), rivals);
  EXPECT_EQ(outcome.rival, no_rival);
  EXPECT_EQ(outcome.others, 0.0F);
}

TEST_F(Contest, IsDecidedByTheEvidenceWhenThereIsNoTime) {
  const std::array rivals{Rival{2, judged(turned(0.0F))}};
  Instance own = judged(turned(0.4F));
  own.evidence.visible = 0.65F;
  const ContestOutcome outcome = hold(own, rivals, {1, long_past, 1});
  EXPECT_EQ(outcome.rival, no_rival);
  EXPECT_EQ(outcome.winner.camera_from_part.rotation, turned(0.4F).rotation);
  const float lead = lead_by_evidence(std::span(&maker_.bank(), 1), own, rivals[0].instance);
  EXPECT_GT(lead, 0.0F);
  EXPECT_NEAR(std::log(outcome.others), 0.45F - lead, 1e-4F);
}

TEST_F(Contest, TwoPosesThatLookAlikeLeaveNeitherSure) {
  // Where one of them cannot be looked at closely, their evidence decides, which is the same.
  RigidTransform aside = bin_.poses.front();
  aside.translation.x() += 1.0F;
  const std::array rivals{Rival{2, judged(aside)}};
  const ContestOutcome outcome = hold(judged(bin_.poses.front()), rivals);
  EXPECT_LT(1.0F / (1.0F + outcome.others), VerifyThresholds{}.minimum_score);
}

TEST(LeadByEvidence, FollowsWhatIsExplained) {
  BracketBank maker;
  const std::span banks(&maker.bank(), 1);
  Instance own;
  own.evidence.confirmed = 100.0F;
  own.evidence.visible = 0.5F;
  Instance other = own;
  EXPECT_EQ(lead_by_evidence(banks, own, other), 0.0F);
  other.evidence.confirmed = 80.0F;
  EXPECT_GT(lead_by_evidence(banks, own, other), 1.0F);
  EXPECT_EQ(lead_by_evidence(banks, other, own), -lead_by_evidence(banks, own, other));
}

}  // namespace
}  // namespace graspd
