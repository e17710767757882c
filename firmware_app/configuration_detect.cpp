#include <array>

#include "firmware_app/configuration_sections.hpp"

namespace graspd {
namespace {

RequestBox read_box(SettingsTable table) {
  Vector3 centre = Vector3::Zero();
  Vector3 size = Vector3::Zero();
  float turn = 0;
  table.require("centre", "give the middle of the box, in millimetres");
  table.require("size", "give the lengths of the box, in millimetres");
  table.read("centre", centre, metres_per_millimetre);
  table.read("size", size, metres_per_millimetre);
  table.read("turn", turn, -360, 360, radians_per_degree);
  if (table.has("size") && !(size.minCoeff() > 0)) table.complain("size", "must hold three lengths greater than 0");
  table.finish();
  return {{Eigen::AngleAxisf(turn, Vector3::UnitZ()).toRotationMatrix(), centre}, size / 2};
}

void read_match(SettingsTable table, DetectParameters& parameters) {
  table.read("reference_step", parameters.match.reference_step, 1, 100);
  table.read("minimum_references", parameters.match.minimum_references, 1, 100000);
  table.read("peaks_per_reference", parameters.match.peaks_per_reference, 1, 100);
  table.read("minimum_peak_share", parameters.match.minimum_peak_share, 0, 1);
  table.read("voting_budget", parameters.match.budget, 1, 1000000);
  table.read("plausible", parameters.cluster.plausible, 1, 100000);
  table.read("closer", parameters.refine.closer, 1, 100000);
  table.read("judged", parameters.refine.judged, 1, 100000);
  table.read("plausible_per_place", parameters.cluster.plausible_per_place, 1, 1000);
  table.read("closer_per_place", parameters.refine.closer_per_place, 1, 1000);
  table.read("judged_per_place", parameters.refine.judged_per_place, 1, 1000);
  table.read("twins", parameters.refine.twins, 0, 100);
  table.read("verify_tolerance", parameters.verify.tolerance, 0.05, 5);
  table.read("verify_blurred_tolerance", parameters.verify.blurred_tolerance, 0.05, 5);
  table.read("verify_noise_tolerance", parameters.verify.noise_tolerance, 0, 10);
  table.read("minimum_measured", parameters.verify.minimum_measured, 0, 1);
  table.read("minimum_inside", parameters.verify.minimum_inside, 0, 1);
  table.read("minimum_purity", parameters.verify.minimum_purity, 0, 1);
  table.finish();
}

}  // namespace

void read_detect_section(SettingsTable table, const RigidTransform& robot_from_camera, DetectSettings& detect) {
  PreprocessParameters& preprocess = detect.parameters.preprocess;
  constexpr std::array backgrounds{NamedValue<BackgroundMode>{"automatic", BackgroundMode::automatic},
                                   NamedValue<BackgroundMode>{"none", BackgroundMode::none},
                                   NamedValue<BackgroundMode>{"plane", BackgroundMode::plane},
                                   NamedValue<BackgroundMode>{"box", BackgroundMode::box}};
  float deadline = 0;
  table.read("threads", detect.parameters.threads, 1, 256);
  detect.capacity.threads = detect.parameters.threads;
  table.read("minimum_score", detect.minimum_score, 0, 1);
  table.read("deadline", deadline, 0, 3600);
  detect.deadline_ns = static_cast<std::int64_t>(static_cast<double>(deadline) * 1e9);
  table.read_choice<BackgroundMode>("background", preprocess.background, backgrounds);
  table.read("background_margin", preprocess.background_margin, 0, 100, metres_per_millimetre);
  table.read("segmentation", preprocess.segmentation);
  if (const SettingsTable given = table.table("box"); given.present()) {
    const RequestBox box = read_box(given);
    detect.robot_from_box = box.reference_from_box;
    preprocess.box_from_camera = inverse(box.reference_from_box) * robot_from_camera;
    preprocess.box_half_size = box.half_size;
  }
  if (preprocess.background == BackgroundMode::box) {
    table.require("box", "background = \"box\" needs [detect.box] with centre and size");
  }
  read_match(table.table("match"), detect.parameters);
  table.finish();
}

void read_region_sections(std::span<const SettingsTable> tables, std::vector<RequestBox>& regions) {
  for (const SettingsTable& table : tables) regions.push_back(read_box(table));
}

void read_limits_section(SettingsTable table, DetectCapacity& detect, GraspCapacity& grasp) {
  table.read("map_cells", detect.map_cells, 1000, 16777216);
  table.read("scene_points", detect.scene_points, 100, 1000000);
  table.read("hypotheses", detect.hypotheses, 100, 10000000);
  table.read("clusters", detect.clusters, 10, 1000000);
  table.read("judged", detect.judged, 10, 100000);
  table.read("instances", detect.instances, 1, 10000);
  table.read("grasp_candidates", grasp.candidates, 1, 100000);
  table.read("grasp_checks", grasp.checks, 1, 1000000);
  table.read("grasp_cells", grasp.cloud_cells, 1000, 16777216);
  table.finish();
  // Whatever is found is looked at by the planner: a second limit could only lose picks.
  grasp.instances = detect.instances;
}

}  // namespace graspd
