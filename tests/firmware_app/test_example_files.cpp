#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "firmware_app/configuration.hpp"
#include "firmware_app/part_file.hpp"
#include "tests/firmware_app/temporary_folder.hpp"

namespace graspd {
namespace {

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_TRUE(file) << path;
  return text.str();
}

std::string source(const std::string& name) { return std::string(GRASPD_SOURCE_DIR) + "/" + name; }

/// The example with every key that stands behind a `#` switched on.
std::string with_all_keys(const std::string& example) {
  std::istringstream lines(example);
  std::string result;
  std::string line;
  while (std::getline(lines, line)) {
    const bool key = std::regex_search(line, std::regex("^#(\\[|[a-z_]+ = )"));
    result += (key ? line.substr(1) : line) + "\n";
  }
  return result;
}

/// The keys and sections that a source file asks a settings table for.
std::set<std::string> keys_asked_for(const std::string& source_file) {
  const std::string text = text_of(source(source_file));
  const std::regex call(R"re((?:read\w*(?:<\w+>)?|length|tables?)\((?:table, |calibration, )?"([a-z_]+)")re");
  std::set<std::string> keys;
  for (std::sregex_iterator match(text.begin(), text.end(), call); match != std::sregex_iterator(); ++match) {
    keys.insert((*match)[1]);
  }
  return keys;
}

void expect_all_explained(const std::string& example, const std::set<std::string>& keys) {
  EXPECT_GT(keys.size(), 3U);
  for (const std::string& key : keys) {
    const std::regex mention("(^|\\n)(## |#)?(" + key + " = |\\[+([a-z_]+\\.)?" + key + "\\]+)");
    EXPECT_TRUE(std::regex_search(example, mention)) << key << " is not in the example";
  }
}

TEST(ExampleConfiguration, IsAcceptedAsItStands) {
  const Result<Configuration> result = read_configuration(source("configs/graspd.toml"));
  EXPECT_TRUE(result.ok()) << result.status().message();
}

TEST(ExampleConfiguration, IsAcceptedWithEveryKey) {
  const TemporaryFolder folder;
  const std::string all = with_all_keys(text_of(source("configs/graspd.toml")));
  const Result<Configuration> result = read_configuration(folder.write("graspd.toml", all));
  EXPECT_TRUE(result.ok()) << result.status().message();
}

TEST(ExampleConfiguration, ExplainsEveryKey) {
  const std::string example = text_of(source("configs/graspd.toml"));
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source("firmware_app"))) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("configuration") || !name.ends_with(".cpp")) continue;
    const std::set<std::string> keys = keys_asked_for("firmware_app/" + name);
    // Those of the command line ask for none.
    if (keys.empty()) continue;
    ++files;
    expect_all_explained(example, keys);
  }
  EXPECT_GT(files, 4);
}

TEST(ExampleConfiguration, ShowsTheDefaults) {
  const TemporaryFolder folder;
  const std::string all = with_all_keys(text_of(source("configs/graspd.toml")));
  const Result<Configuration> example = read_configuration(folder.write("graspd.toml", all));
  const Result<Configuration> bare = read_configuration(
      folder.write("bare.toml", "banks = [\"part.bank\"]\n[camera]\nsource = \"recorded\"\npath = \"frames\"\n"));
  ASSERT_TRUE(example.ok() && bare.ok());
  const Configuration& shown = example.value();
  const Configuration& real = bare.value();
  const auto same = [](double a, double b, const char* key) {
    EXPECT_NEAR(a, b, 1e-3 * std::abs(b)) << "configs/graspd.toml shows another default of " << key;
  };
  const auto compare = [&](auto member, const char* key) {
    same(static_cast<double>(member(shown)), static_cast<double>(member(real)), key);
  };
  EXPECT_EQ(shown.camera.genicam.exposure_event, real.camera.genicam.exposure_event);
#define GRASPD_COMPARE(path) compare([](const Configuration& c) { return c.path; }, #path)
  GRASPD_COMPARE(camera.maximum_age);
  GRASPD_COMPARE(record.when);
  GRASPD_COMPARE(record.maximum_frames);
  GRASPD_COMPARE(record.maximum_bytes);
  GRASPD_COMPARE(camera.genicam.trigger);
  GRASPD_COMPARE(camera.genicam.timeout_ns);
  GRASPD_COMPARE(camera.genicam.confidence);
  GRASPD_COMPARE(camera.genicam.packet_resend);
  GRASPD_COMPARE(camera.genicam.limits.maximum_width);
  GRASPD_COMPARE(camera.genicam.limits.maximum_height);
  GRASPD_COMPARE(camera.recorded.maximum_bytes);
  GRASPD_COMPARE(detect.parameters.threads);
  GRASPD_COMPARE(detect.deadline_ns);
  GRASPD_COMPARE(detect.parameters.preprocess.background);
  GRASPD_COMPARE(detect.parameters.preprocess.background_margin);
  GRASPD_COMPARE(detect.parameters.preprocess.segmentation);
  GRASPD_COMPARE(detect.parameters.match.reference_step);
  GRASPD_COMPARE(detect.parameters.match.minimum_references);
  GRASPD_COMPARE(detect.parameters.match.budget);
  GRASPD_COMPARE(detect.parameters.match.peaks_per_reference);
  GRASPD_COMPARE(detect.parameters.match.minimum_peak_share);
  GRASPD_COMPARE(detect.parameters.cluster.plausible);
  GRASPD_COMPARE(detect.parameters.refine.closer);
  GRASPD_COMPARE(detect.parameters.refine.judged);
  GRASPD_COMPARE(detect.parameters.refine.closer_per_place);
  GRASPD_COMPARE(detect.parameters.refine.judged_per_place);
  GRASPD_COMPARE(detect.parameters.refine.twins);
  GRASPD_COMPARE(detect.parameters.verify.tolerance);
  GRASPD_COMPARE(detect.parameters.verify.blurred_tolerance);
  GRASPD_COMPARE(detect.parameters.verify.noise_tolerance);
  GRASPD_COMPARE(detect.parameters.verify.minimum_measured);
  GRASPD_COMPARE(detect.parameters.verify.minimum_inside);
  GRASPD_COMPARE(detect.parameters.verify.minimum_purity);
  GRASPD_COMPARE(detect.capacity.map_cells);
  GRASPD_COMPARE(detect.capacity.scene_points);
  GRASPD_COMPARE(detect.capacity.hypotheses);
  GRASPD_COMPARE(detect.capacity.clusters);
  GRASPD_COMPARE(detect.capacity.judged);
  GRASPD_COMPARE(detect.capacity.instances);
  GRASPD_COMPARE(grasp.capacity.candidates);
  GRASPD_COMPARE(grasp.count_all);
  GRASPD_COMPARE(grasp.parameters.maximum_tilt);
  GRASPD_COMPARE(grasp.parameters.approach_distance);
  GRASPD_COMPARE(grasp.parameters.symmetry_steps);
  GRASPD_COMPARE(grasp.parameters.collision.minimum_clearance);
  GRASPD_COMPARE(grasp.parameters.collision.clearance_range);
  GRASPD_COMPARE(grasp.parameters.collision.sample_spacing);
  GRASPD_COMPARE(grasp.parameters.collision.minimum_points);
  GRASPD_COMPARE(grasp.parameters.weights.priority);
  GRASPD_COMPARE(grasp.parameters.weights.score);
  GRASPD_COMPARE(grasp.parameters.weights.tilt);
  GRASPD_COMPARE(grasp.parameters.weights.clearance);
  GRASPD_COMPARE(grasp.parameters.weights.height);
  GRASPD_COMPARE(grasp.parameters.weights.turn);
  GRASPD_COMPARE(grasp.parameters.weights.hidden);
  GRASPD_COMPARE(grasp.parameters.weights.height_range);
  GRASPD_COMPARE(grasp.capacity.checks);
  GRASPD_COMPARE(grasp.capacity.cloud_cells);
  GRASPD_COMPARE(grasp.parameters.collision.unexplained_clearance);
  GRASPD_COMPARE(grasp.parameters.collision.unseen_clearance);
  GRASPD_COMPARE(grasp.parameters.collision.hidden_clearance);
  GRASPD_COMPARE(grasp.parameters.collision.maximum_hidden);
  GRASPD_COMPARE(grasp.parameters.retreat.direction);
  GRASPD_COMPARE(grasp.parameters.retreat.distance);
  GRASPD_COMPARE(grasp.parameters.order.order);
  GRASPD_COMPARE(grasp.parameters.order.step);
  GRASPD_COMPARE(grasp.parameters.order.neighbour_distance);
  GRASPD_COMPARE(grasp.parameters.avoid.radius);
  GRASPD_COMPARE(grasp.parameters.avoid.runs);
  GRASPD_COMPARE(grasp.parameters.bin.wall);
  GRASPD_COMPARE(grasp.parameters.bin.fitted);
  GRASPD_COMPARE(grasp.parameters.bin.search);
  GRASPD_COMPARE(grasp.parameters.bin.search_turn);
  GRASPD_COMPARE(grasp.parameters.tools.count);
  GRASPD_COMPARE(grasp.parameters.tools.tools[0].minimum_opening);
  GRASPD_COMPARE(grasp.parameters.tools.tools[0].maximum_opening);
  GRASPD_COMPARE(grasp.parameters.tools.tools[0].finger_thickness);
  GRASPD_COMPARE(grasp.parameters.tools.tools[0].finger_width);
  GRASPD_COMPARE(grasp.parameters.tools.tools[0].finger_length);
  GRASPD_COMPARE(grasp.parameters.tools.tools[0].finger_tip);
  GRASPD_COMPARE(grasp.parameters.tools.tools[0].palm_width);
  GRASPD_COMPARE(grasp.parameters.tools.tools[0].palm_depth);
  GRASPD_COMPARE(grasp.parameters.tools.tools[0].palm_height);
  GRASPD_COMPARE(grasp.parameters.tools.tools[0].contact_margin);
  GRASPD_COMPARE(grasp.parameters.tools.tools[0].half_turn);
  GRASPD_COMPARE(grasp.parameters.tools.tools[0].kind);
  GRASPD_COMPARE(grasp.parameters.tools.tools[0].number);
  GRASPD_COMPARE(grasp.parameters.tools.tools[1].cup_radius);
  GRASPD_COMPARE(grasp.parameters.tools.tools[1].cup_length);
  GRASPD_COMPARE(grasp.parameters.tools.tools[1].tube_radius);
  GRASPD_COMPARE(grasp.parameters.tools.tools[1].tube_length);
  GRASPD_COMPARE(grasp.parameters.tools.tools[1].contact_margin);
  GRASPD_COMPARE(grasp.parameters.tools.tools[1].kind);
  GRASPD_COMPARE(grasp.parameters.tools.tools[1].number);
  GRASPD_COMPARE(modbus.port);
  GRASPD_COMPARE(modbus.maximum_clients);
  GRASPD_COMPARE(modbus.maximum_rate);
  GRASPD_COMPARE(modbus.idle_time.count());
  GRASPD_COMPARE(modbus.heartbeat_timeout.count());
  GRASPD_COMPARE(modbus.request_timeout.count());
  GRASPD_COMPARE(modbus.format.word_order);
  GRASPD_COMPARE(modbus.format.convention);
  GRASPD_COMPARE(modbus.format.length);
  GRASPD_COMPARE(modbus.format.angle);
  GRASPD_COMPARE(modbus_role);
  GRASPD_COMPARE(plc.port);
  GRASPD_COMPARE(plc.unit);
  GRASPD_COMPARE(plc.coil_address);
  GRASPD_COMPARE(plc.request_address);
  GRASPD_COMPARE(plc.result_address);
  GRASPD_COMPARE(plc.poll_period.count());
  GRASPD_COMPARE(plc.response_timeout.count());
  GRASPD_COMPARE(memory_budget);
  GRASPD_COMPARE(memory_lock);
  GRASPD_COMPARE(snapshots_kept);
#undef GRASPD_COMPARE
  EXPECT_EQ(shown.modbus.bind_address, real.modbus.bind_address);
}

TEST(ExamplePartFile, IsAcceptedAsItStandsAndWithEveryKey) {
  const Result<PartFile> as_is = read_part_file(source("configs/part.toml"));
  EXPECT_TRUE(as_is.ok()) << as_is.status().message();
  const TemporaryFolder folder;
  const Result<PartFile> all =
      read_part_file(folder.write("part.toml", with_all_keys(text_of(source("configs/part.toml")))));
  EXPECT_TRUE(all.ok()) << all.status().message();
}

TEST(ExamplePartFile, ExplainsEveryKey) {
  expect_all_explained(text_of(source("configs/part.toml")), keys_asked_for("firmware_app/part_file.cpp"));
}

TEST(ExamplePartFile, ShowsTheDefaults) {
  const TemporaryFolder folder;
  const Result<PartFile> example =
      read_part_file(folder.write("part.toml", with_all_keys(text_of(source("configs/part.toml")))));
  ASSERT_TRUE(example.ok());
  const VerifyThresholds& thresholds = example.value().part.thresholds;
  const VerifyThresholds real_thresholds;
  const BankBuildParameters& build = example.value().build;
  const BankBuildParameters real_build;
  constexpr const char* message = "configs/part.toml shows another default";
  EXPECT_FLOAT_EQ(thresholds.minimum_edge, real_thresholds.minimum_edge) << message;
  EXPECT_FLOAT_EQ(thresholds.minimum_overlap, real_thresholds.minimum_overlap) << message;
  EXPECT_FLOAT_EQ(thresholds.maximum_boundary, real_thresholds.maximum_boundary) << message;
  EXPECT_FLOAT_EQ(thresholds.maximum_below, real_thresholds.maximum_below) << message;
  EXPECT_FLOAT_EQ(thresholds.minimum_score, real_thresholds.minimum_score) << message;
  EXPECT_FLOAT_EQ(build.sampling, real_build.sampling) << message;
  EXPECT_EQ(build.angle_bins, real_build.angle_bins) << message;
  EXPECT_EQ(build.candidate_views, real_build.candidate_views) << message;
  EXPECT_EQ(build.maximum_views, real_build.maximum_views) << message;
  EXPECT_EQ(build.maximum_view_points, real_build.maximum_view_points) << message;
  EXPECT_FLOAT_EQ(build.maximum_overlap, real_build.maximum_overlap) << message;
  EXPECT_FLOAT_EQ(build.minimum_completeness, real_build.minimum_completeness) << message;
  EXPECT_NEAR(build.maximum_incidence, real_build.maximum_incidence, 0.002F) << message;
  EXPECT_FLOAT_EQ(build.sensor_distance, real_build.sensor_distance) << message;
  EXPECT_EQ(build.surface_points, real_build.surface_points) << message;
  EXPECT_EQ(build.edges_refine, real_build.edges_refine) << message;
  EXPECT_EQ(build.edges_judge, real_build.edges_judge) << message;
}

}  // namespace
}  // namespace graspd
