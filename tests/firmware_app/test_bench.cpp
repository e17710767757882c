#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "drivers/files/atomic_file.hpp"
#include "firmware_app/bench_run.hpp"
#include "tests/firmware_app/graspd_process.hpp"
#include "tests/firmware_app/rendered_scene.hpp"

namespace graspd {
namespace {

using nlohmann::json;
using testing::ContainsRegex;
using testing::HasSubstr;

TEST(TimeSpread, IsOfTimesThatWereMeasured) {
  std::vector<double> hundred(100);
  std::iota(hundred.rbegin(), hundred.rend(), 1.0);
  const TimeSpread spread = spread_of(hundred);
  EXPECT_EQ(spread.median, 50);
  EXPECT_EQ(spread.percentile_99, 99);
  EXPECT_EQ(spread.percentile_99_9, 100);
  EXPECT_EQ(spread.worst, 100);
  EXPECT_DOUBLE_EQ(spread.mean, 50.5);
  const TimeSpread few = spread_of({3, 1, 2});
  EXPECT_EQ(few.median, 2);
  EXPECT_EQ(few.percentile_99, 3);
  EXPECT_EQ(spread_of({7}).median, 7);
}

/// Sampled just finely enough to find the bar, which is done dozens of times.
const std::vector<std::byte>& coarse_bank() {
  static const std::vector<std::byte> bytes = angle_bar_bank(7, 0.09F);
  return bytes;
}

/// `graspd bench` on a small frame with an angle bar.
class BenchCommand : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(write_file(folder_.path("bar.bank"), coarse_bank()).ok());
    std::filesystem::create_directories(folder_.path("frames"));
    static_cast<void>(
        folder_.write("frames/camera.json", R"({"fx": 200, "fy": 200, "cx": 79.5, "cy": 59.5, "depth_scale": 0.1})"));
    write_frame("000000.png");
  }
  /// Every other pixel of the scene.
  void write_frame(const std::string& name) const {
    const RenderedScene scene = angle_bar_scene(1);
    std::vector<float> depth;
    for (int v = 0; v < scene.camera.height; v += 2) {
      for (int u = 0; u < scene.camera.width; u += 2) depth.push_back(scene.depth[scene.camera.index(u, v)]);
    }
    ASSERT_TRUE(write_depth_png(folder_.path("frames/" + name), scene.camera.width / 2, scene.camera.height / 2,
                                as_file_values(depth))
                    .ok());
  }
  GraspdOutcome bench(std::vector<std::string> more) {
    std::vector<std::string> arguments{"bench",  folder_.path("frames"),    "--bank", folder_.path("bar.bank"),
                                       "--json", folder_.path("bench.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_graspd(folder_, arguments);
  }
  json measured() const { return json::parse(std::ifstream(folder_.path("bench.json"))); }

  TemporaryFolder folder_;
};

/// The sizes of a curve, after a look at what every curve must be.
std::vector<double> sizes_of(const json& bench, const std::string& with) {
  std::vector<double> sizes;
  for (const json& point : bench["growth"].at(with)) {
    sizes.push_back(point["size"]);
    EXPECT_GT(point["seconds"]["whole"]["median"], 0.0);
  }
  EXPECT_GE(sizes.size(), 1U) << with;
  EXPECT_TRUE(std::ranges::is_sorted(sizes)) << with;
  return sizes;
}

TEST_F(BenchCommand, MeasuresTimesWorkMemoryGrowthAndDeadlines) {
  const GraspdOutcome outcome = bench({"--detections", "1", "--picture", folder_.path("bench.png")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.errors, "");
  EXPECT_THAT(outcome.output, ContainsRegex("\nwhole( +[0-9.]+){4} +100.0%"));
  EXPECT_THAT(outcome.output, ContainsRegex("arena: voting +[0-9.]+ MiB"));
  EXPECT_THAT(outcome.output, HasSubstr("deadline (ms)"));
  EXPECT_GT(std::filesystem::file_size(folder_.path("bench.png")), 10000U);

  const json bench = measured();
  EXPECT_EQ(bench["detections"], 1);
  EXPECT_EQ(bench["work"]["instances"], 1.0);
  EXPECT_GE(bench["work"]["pairs looked up"], bench["work"]["cells visited"]);
  EXPECT_GE(bench["work"]["votes"], bench["work"]["cells visited"]);
  double stages = 0;
  for (const auto& [name, seconds] : bench["seconds"].items()) {
    if (name != "whole") stages += seconds["median"].get<double>();
  }
  const double whole = bench["seconds"]["whole"]["median"];
  EXPECT_LE(stages, whole);
  EXPECT_GT(stages, 0.5 * whole);

  EXPECT_GT(sizes_of(bench, "scene points").size(), 2U);
  EXPECT_EQ(sizes_of(bench, "threads").front(), 1.0);
  const Result<Bank> bank = read_bank(coarse_bank(), "angle bar");
  ASSERT_TRUE(bank.ok());
  EXPECT_EQ(sizes_of(bench, "views").back(), static_cast<double>(bank.value().views.size()));
  EXPECT_EQ(sizes_of(bench, "model references").back(), static_cast<double>(bank.value().reference_points.size()));
  for (const char* with : {"views", "model references"}) {
    const json& curve = bench["growth"][with];
    EXPECT_LT(curve.front()["work"]["votes"], curve.back()["work"]["votes"]) << with;
    EXPECT_EQ(curve.back()["work"]["votes"], bench["work"]["votes"]) << with;
  }
  ASSERT_EQ(bench["deadlines"].size(), 7U);
  EXPECT_EQ(bench["deadlines"].front()["deadline_seconds"], 0.01);
}

TEST_F(BenchCommand, TakesEveryFrameEquallyOften) {
  write_frame("000001.png");
  const GraspdOutcome outcome = bench({"--detections", "3", "--times-only"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("detections     4, threads 1;"));
  EXPECT_EQ(measured()["frames"].size(), 2U);
  EXPECT_TRUE(measured()["growth"].empty());
  EXPECT_TRUE(measured()["deadlines"].empty());
}

TEST_F(BenchCommand, DetectsAsTheConfigurationSays) {
  const std::string configuration = folder_.write(
      "graspd.toml",
      "banks = [\"bar.bank\"]\n[camera]\nsource = \"recorded\"\npath = \"frames\"\n[detect]\nminimum_score = 1.0\n");
  const GraspdOutcome outcome = bench({"--config", configuration, "--detections", "1", "--times-only"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(measured()["work"]["instances"], 0.0);
}

}  // namespace
}  // namespace graspd
