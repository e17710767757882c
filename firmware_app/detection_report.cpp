#include "firmware_app/detection_report.hpp"

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "drivers/files/measured_depth.hpp"
#include "firmware_app/append_text.hpp"
#include "firmware_app/pick_report.hpp"

namespace graspd {
namespace {

/// Keeps the keys in the order in which they are written.
using Json = nlohmann::ordered_json;

constexpr std::array<std::pair<std::uint32_t, const char*>, 5> flag_list{{{flag_scene_points_cut, "scene_points_cut"},
                                                                          {flag_hypotheses_cut, "hypotheses_cut"},
                                                                          {flag_instances_cut, "instances_cut"},
                                                                          {flag_deadline, "deadline"},
                                                                          {flag_voting_cut, "voting_cut"}}};

double wide(float value) { return static_cast<double>(value); }

std::string part_name(const DetectionReport& report, const Instance& instance) {
  return std::string(report.banks[instance.bank].part->name_view());
}

/// Evidence counts lengths in voxels of the bank.
double residual_mm(const DetectionReport& report, const Instance& instance) {
  return wide(instance.evidence.residual) * wide(report.banks[instance.bank].part->sampling) * 1e3;
}

void append_poses(std::string& text, const DetectionReport& report) {
  append(text, "%3s  %-20s %6s  %26s  %s\n", "#", "part", "score", "position mm (x, y, z)",
         "rotation, row by row (camera from part)");
  std::size_t number = 0;
  for (const Instance& instance : report.detections->instances) {
    const Vector3& t = instance.camera_from_part.translation;
    const Matrix3& r = instance.camera_from_part.rotation;
    append(text, "%3zu  %-20.40s %6.3f  %8.2f %8.2f %8.2f ", ++number, part_name(report, instance).c_str(),
           wide(instance.score), wide(t.x()) * 1e3, wide(t.y()) * 1e3, wide(t.z()) * 1e3);
    for (int i = 0; i < 9; ++i) append(text, " %7.4f", wide(r(i / 3, i % 3)));
    text += '\n';
  }
}

void append_evidence(std::string& text, const DetectionReport& report, std::span<const Instance> instances,
                     bool rejected) {
  append(text, "%3s  %-20s %6s  %5s %7s %7s %6s %8s %5s %5s %8s %7s%s\n", "#", "part", "score", "view", "overlap",
         "visible", "purity", "boundary", "edge", "below", "residual", "votes",
         rejected ? "  position mm (x, y, z)       rejected for" : "");
  std::size_t number = 0;
  for (const Instance& instance : instances) {
    const Evidence& evidence = instance.evidence;
    append(text, "%3zu  %-20.40s %6.3f  %5u %7.2f %7.2f %6.2f %8.2f %5.2f %5.2f %5.2f mm %7.0f", ++number,
           part_name(report, instance).c_str(), wide(instance.score), instance.view, wide(evidence.overlap),
           wide(evidence.visible), wide(evidence.purity), wide(evidence.boundary), wide(evidence.edge),
           wide(evidence.below), residual_mm(report, instance), wide(instance.votes));
    if (rejected) {
      const Vector3& t = instance.camera_from_part.translation;
      append(text, "  %8.2f %8.2f %8.2f  %s", wide(t.x()) * 1e3, wide(t.y()) * 1e3, wide(t.z()) * 1e3,
             rejection_name(instance.rejection));
    }
    text += '\n';
  }
}

void append_rejections(std::string& text, const Detections& detections) {
  std::uint64_t total = 0;
  std::string reasons;
  for (std::size_t i = 1; i < rejection_count; ++i) {
    if (detections.rejections[i] == 0) continue;
    total += detections.rejections[i];
    append(reasons, "%s%u %s", reasons.empty() ? "" : ", ", detections.rejections[i],
           rejection_name(static_cast<Rejection>(i)));
  }
  append(text, "rejected   %llu hypotheses", static_cast<unsigned long long>(total));
  if (!reasons.empty()) text += ": " + reasons;
  text += '\n';
}

Json instance_as_json(const DetectionReport& report, const Instance& instance) {
  const Vector3& t = instance.camera_from_part.translation;
  const Matrix3& r = instance.camera_from_part.rotation;
  Json rotation = Json::array();
  for (int i = 0; i < 9; ++i) rotation.push_back(r(i / 3, i % 3));
  const Evidence& evidence = instance.evidence;
  return {{"part", part_name(report, instance)},
          {"part_id", report.banks[instance.bank].part->part_id},
          {"score", instance.score},
          {"camera_from_part", pose_values(instance.camera_from_part)},
          {"rotation", rotation},
          {"translation_mm", {wide(t.x()) * 1e3, wide(t.y()) * 1e3, wide(t.z()) * 1e3}},
          {"view", instance.view},
          {"votes", instance.votes},
          {"evidence",
           {{"overlap", evidence.overlap},
            {"visible", evidence.visible},
            {"purity", evidence.purity},
            {"boundary", evidence.boundary},
            {"edge", evidence.edge},
            {"below", evidence.below},
            {"residual_mm", residual_mm(report, instance)},
            {"confirmed_cells", evidence.confirmed}}}};
}

}  // namespace

std::string flag_names(std::uint32_t flags) {
  std::string names;
  for (const auto& [bit, name] : flag_list) {
    if ((flags & bit) != 0) names += (names.empty() ? "" : ", ") + std::string(name);
  }
  return names;
}

std::string report_as_text(const DetectionReport& report) {
  const Detections& detections = *report.detections;
  std::string text;
  append(text,
         "frame      %.200s: %d x %d, %u pixels measured, half of them within %.3f m, %u of them not background, "
         "%u points matched\n",
         std::string(report.frame_name).c_str(), report.frame->camera.width, report.frame->camera.height,
         detections.measured_pixels, wide(median_depth(report.frame->depth)), detections.foreground_pixels,
         detections.scene_points);
  append(text, "time       %.3f s:", report.seconds);
  for (std::size_t i = 0; i < stage_count; ++i) {
    append(text, "%s %s %.3f", i == 0 ? "" : ",", stage_name(static_cast<Stage>(i)),
           static_cast<double>(detections.stage_ns[i]) * 1e-9);
  }
  text += '\n';
  append_rejections(text, detections);
  if (detections.flags != 0) text += "cut        " + flag_names(detections.flags) + '\n';
  append(text, "found      %zu instances\n", detections.instances.size());
  if (report.picks != nullptr) text += picks_as_text(*report.picks, *report.grasp);
  if (!detections.instances.empty()) {
    text += '\n';
    append_poses(text, report);
    text += '\n';
    append_evidence(text, report, detections.instances, false);
  }
  if (report.with_rejected && !detections.rejected.empty()) {
    text += "\nrejected hypotheses\n";
    append_evidence(text, report, detections.rejected, true);
  }
  return text;
}

std::string report_as_json(const DetectionReport& report) {
  const Detections& detections = *report.detections;
  Json document = {{"frame", std::string(report.frame_name)},
                   {"width", report.frame->camera.width},
                   {"height", report.frame->camera.height},
                   {"seconds", report.seconds},
                   {"measured_pixels", detections.measured_pixels},
                   {"foreground_pixels", detections.foreground_pixels},
                   {"scene_points", detections.scene_points},
                   {"flags", Json::array()},
                   {"stage_seconds", Json::object()},
                   {"rejections", Json::object()},
                   {"instances", Json::array()}};
  if (report.replayable) {
    for (const char* key : {"frame", "seconds", "stage_seconds"}) document.erase(key);
  }
  for (const auto& [bit, name] : flag_list) {
    if ((detections.flags & bit) != 0) document["flags"].push_back(name);
  }
  for (std::size_t i = 0; i < stage_count && !report.replayable; ++i) {
    document["stage_seconds"][stage_name(static_cast<Stage>(i))] = static_cast<double>(detections.stage_ns[i]) * 1e-9;
  }
  for (std::size_t i = 1; i < rejection_count; ++i) {
    document["rejections"][rejection_name(static_cast<Rejection>(i))] = detections.rejections[i];
  }
  for (const Instance& instance : detections.instances) {
    document["instances"].push_back(instance_as_json(report, instance));
  }
  if (report.picks != nullptr) document["picks"] = picks_as_json(*report.picks);
  if (report.with_rejected) {
    document["rejected"] = Json::array();
    for (const Instance& instance : detections.rejected) {
      Json entry = instance_as_json(report, instance);
      entry["rejection"] = rejection_name(instance.rejection);
      document["rejected"].push_back(std::move(entry));
    }
  }
  // A file name need not be UTF-8; a report must come out all the same.
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::vector<DrawnInstance> drawn_instances(std::span<const Instance> instances, std::span<const Bank> banks) {
  std::vector<DrawnInstance> drawn;
  for (const Instance& instance : instances) {
    const Bank& bank = banks[instance.bank];
    drawn.push_back({bank.mesh, instance.camera_from_part, std::string(bank.part->name_view()), instance.score});
  }
  return drawn;
}

}  // namespace graspd
