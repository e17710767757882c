#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/train/adaptation.hpp"
#include "tests/core/train/shapes.hpp"

namespace graspd {
namespace {

PartDescription bracket() {
  PartDescription part;
  part.name = "bracket";
  part.mesh = shapes::bracket();
  part.symmetry_given = true;
  part.twins.emplace();
  return part;
}

BankBuildParameters quick() {
  BankBuildParameters build;
  build.candidate_views = 42;
  build.surface_points = 400;
  return build;
}

/// Few parts in small pictures of few bins.
AdaptationParameters small() {
  AdaptationParameters adaptation;
  adaptation.samplings = {0.2F, 0.06F};
  adaptation.first_bins = 1;
  adaptation.last_bins = 2;
  adaptation.stranger_bins = 1;
  adaptation.rating_bins = 2;
  adaptation.bins.instances = 4;
  adaptation.bins.maximum_width = 240;
  adaptation.bins.maximum_height = 180;
  return adaptation;
}

TrialOutcome outcome(std::size_t hidden, std::size_t half, std::size_t seen, std::size_t reported) {
  TrialOutcome result;
  result.found = {Share{hidden, 10}, Share{half, 10}, Share{seen, 10}};
  result.precision = {hidden + half + seen, reported};
  return result;
}

TEST(AdaptationMerit, CountsWhatIsFoundAndTakesAwayWhatIsMadeUp) {
  EXPECT_EQ(adaptation_merit({}), 0.0F);
  EXPECT_FLOAT_EQ(adaptation_merit(outcome(10, 10, 10, 30)), 1.0F);
  EXPECT_FLOAT_EQ(adaptation_merit(outcome(0, 10, 10, 20)), 0.8F);
  EXPECT_LT(adaptation_merit(outcome(10, 9, 10, 29)), adaptation_merit(outcome(9, 10, 10, 29)));
  EXPECT_FLOAT_EQ(adaptation_merit(outcome(0, 9, 10, 22)), (19.0F - 3.0F) / 25.0F);
}

TEST(TrialBins, ABinDependsOnItsNumberAlone) {
  const std::vector<std::byte> file = [] {
    BankReport report;
    return build_bank(bracket(), quick(), report, [](float) {}).value();
  }();
  const TrialPart part = trial_part(read_bank(file, "bracket").value()).value();
  TrialRecipe recipe = small().bins;
  const std::vector<SimulatedScene> all = trial_bins(part, 0, 3, recipe);
  recipe.threads = 2;
  const std::vector<SimulatedScene> last = trial_bins(part, 1, 2, recipe);
  EXPECT_EQ(all[1].depth, last[0].depth);
  EXPECT_EQ(all[2].depth, last[1].depth);
  EXPECT_NE(all[0].depth, all[1].depth);
  EXPECT_EQ(all[0].instances.size(), recipe.instances);
}

TEST(TrialBins, ShowLargePartsFromFarEnough) {
  const std::vector<std::byte> file = [] {
    PartDescription large = bracket();
    for (Vector3& vertex : large.mesh.vertices) vertex *= 20.0F;
    BankReport report;
    return build_bank(large, quick(), report, [](float) {}).value();
  }();
  const TrialPart part = trial_part(read_bank(file, "bracket").value()).value();
  ASSERT_GT(part.evaluation.diameter, 1.9F);
  TrialRecipe recipe = small().bins;
  recipe.instances = 10;
  std::size_t shown = 0;
  for (const SimulatedScene& bin : trial_bins(part, 0, 1, recipe)) {
    for (const SimulatedInstance& instance : bin.instances) {
      EXPECT_GT((instance.camera_from_part * part.evaluation.middle).z(), 0.5F * part.evaluation.diameter);
      shown += instance.visibility > 0.3F ? 1 : 0;
    }
  }
  EXPECT_GE(shown, 4U) << "of ten";
}

TEST(Adaptation, TakesTheSamplingThatFindsThePartWhateverTheThreads) {
  std::vector<float> shares;
  BankBuildParameters chosen = quick();
  AdaptationReport report;
  AdaptationParameters adaptation = small();
  const Status adapted = adapt_to_bins(
      bracket(), adaptation, [&](float share) { shares.push_back(share); }, chosen, report);
  ASSERT_TRUE(adapted.ok()) << adapted.message();
  ASSERT_EQ(report.trials.size(), 2U);
  const Share& coarse = report.trials[0].outcome.found[2];
  const Share& fine = report.trials[1].outcome.found[2];
  ASSERT_GT(fine.hits * coarse.total, coarse.hits * fine.total) << "the coarse sampling should not do";
  EXPECT_EQ(report.chosen, 1U);
  EXPECT_EQ(chosen.sampling, report.trials[1].sampling);
  EXPECT_EQ(chosen.model_points, 0);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_FLOAT_EQ(shares.back(), 1.0F);

  adaptation.bins.threads = 2;
  BankBuildParameters again = quick();
  AdaptationReport second;
  ASSERT_TRUE(adapt_to_bins(
                  bracket(), adaptation, [](float) {}, again, second)
                  .ok());
  EXPECT_EQ(second.trials[0].merit, report.trials[0].merit);
  EXPECT_EQ(second.trials[1].merit, report.trials[1].merit);
  EXPECT_EQ(again.sampling, chosen.sampling);
}

TEST(Adaptation, OfSettingsThatFindAsMuchTheCheaperOneIsTaken) {
  AdaptationParameters adaptation = small();
  // Bins without anything to be found: all are alike.
  adaptation.bins.instances = 0;
  BankBuildParameters chosen = quick();
  AdaptationReport report;
  ASSERT_TRUE(adapt_to_bins(
                  bracket(), adaptation, [](float) {}, chosen, report)
                  .ok());
  EXPECT_EQ(report.chosen, 0U);
}

TEST(Adaptation, NothingInABinOfStrangersIsToBeFound) {
  BankReport report;
  const std::vector<std::byte> file = build_bank(bracket(), quick(), report, [](float) {}).value();
  const Bank bank = read_bank(file, "bracket").value();
  const TrialPart part = trial_part(bank).value();
  std::vector<SimulatedScene> bins = stranger_bins(part, 1, small().bins);
  ASSERT_EQ(bins.at(0).instances.size(), small().bins.instances);
  for (const SimulatedInstance& instance : bins[0].instances) EXPECT_GE(instance.part, 1U);
  const TrialOutcome outcome = try_bank(bank, part, bins, 1, [] {}).value();
  EXPECT_EQ(outcome.precision.hits, 0U);
  for (const Share& found : outcome.found) EXPECT_EQ(found.total, 0U);
}

TEST(Adaptation, EdgesThatThePartFileDoesWithoutAreNotTried) {
  AdaptationParameters adaptation = small();
  adaptation.bins.instances = 1;
  BankBuildParameters chosen = quick();
  AdaptationReport report;
  ASSERT_TRUE(adapt_to_bins(
                  bracket(), adaptation, [](float) {}, chosen, report)
                  .ok());
  EXPECT_TRUE(report.edges_tried);
  chosen = quick();
  chosen.edges_judge = false;
  ASSERT_TRUE(adapt_to_bins(
                  bracket(), adaptation, [](float) {}, chosen, report)
                  .ok());
  EXPECT_FALSE(report.edges_tried);
  EXPECT_FALSE(chosen.edges_judge);
  chosen = quick();
  adaptation.edges = false;
  ASSERT_TRUE(adapt_to_bins(
                  bracket(), adaptation, [](float) {}, chosen, report)
                  .ok());
  EXPECT_FALSE(report.edges_tried);
  EXPECT_TRUE(chosen.edges_judge);
}

TEST(Adaptation, ARatedBankIsTheSameButForWhatIsExpectedOfIt) {
  BankReport report;
  const std::vector<std::byte> file = build_bank(bracket(), quick(), report, [](float) {}).value();
  ASSERT_EQ(read_bank(file, "bracket").value().part->expected.instances, 0U);
  const Result<std::vector<std::byte>> rated = rate_bank(file, small(), [](float) {});
  ASSERT_TRUE(rated.ok()) << rated.status().message();
  const Bank before = read_bank(file, "bracket").value();
  const Bank after = read_bank(rated.value(), "bracket").value();
  const BankExpectation& expected = after.part->expected;
  const TrialPart part = trial_part(before).value();
  std::vector<SimulatedScene> bins = trial_bins(part, small().last_bins, small().rating_bins, small().bins);
  const TrialOutcome outcome = try_bank(before, part, bins, 1, [] {}).value();
  EXPECT_GT(outcome.precision.hits, 0U);
  EXPECT_EQ(expected.instances, outcome.found[1].total + outcome.found[2].total);
  EXPECT_FLOAT_EQ(expected.recall_below_half, static_cast<float>(outcome.found[1].value()));
  EXPECT_FLOAT_EQ(expected.recall_above_half, static_cast<float>(outcome.found[2].value()));
  EXPECT_FLOAT_EQ(expected.precision, static_cast<float>(outcome.precision.value()));
  EXPECT_EQ(after.entries.size(), before.entries.size());
  EXPECT_EQ(after.part->sampling, before.part->sampling);
  EXPECT_EQ(file.size(), rated.value().size());
  EXPECT_EQ(rate_bank(std::span(file).first(100), small(), [](float) {}).status().code(), StatusCode::bad_bank);
}

}  // namespace
}  // namespace graspd
