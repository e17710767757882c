#include "firmware_app/record_writer.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "drivers/files/atomic_file.hpp"
#include "drivers/files/bop_writer.hpp"
#include "drivers/files/digest.hpp"
#include "drivers/files/whole_file.hpp"
#include "drivers/system/log.hpp"
#include "firmware_app/detection_report.hpp"

namespace graspd {
namespace {

using Json = nlohmann::ordered_json;

Json pose_as_json(const RigidTransform& pose) {
  Json rotation = Json::array();
  for (int i = 0; i < 9; ++i) rotation.push_back(pose.rotation(i / 3, i % 3));
  const Vector3& t = pose.translation;
  constexpr double millimetres = 1000.0;
  return {{"rotation", rotation},
          {"translation_mm",
           {static_cast<double>(t.x()) * millimetres, static_cast<double>(t.y()) * millimetres,
            static_cast<double>(t.z()) * millimetres}}};
}

bool is_worth_recording(RecordWhen when, ResultCode code) {
  if (when == RecordWhen::always) return true;
  return code != ResultCode::ok && code != ResultCode::dry_run && code != ResultCode::empty_bin &&
         code != ResultCode::given_up;
}

}  // namespace

std::size_t record_bytes(std::size_t frame_pixels, std::size_t instances) {
  return frame_pixels * sizeof(float) * 3 + instances * sizeof(Instance);
}

RecordWriter::RecordWriter(RecordFolder folder, RecordWhen when, const std::string& configuration_file,
                           const LoadedBanks& banks, std::size_t frame_pixels, std::size_t instances)
    : folder_(std::move(folder)),
      when_(when),
      configuration_file_(configuration_file),
      depth_(frame_pixels),
      empty_depth_(frame_pixels),
      instances_(instances),
      worker_([this] { return record(); }, [this](const Status& recorded) { tell(recorded); }) {
  Result<std::string> configuration = read_file(configuration_file);
  if (configuration.ok()) configuration_ = std::move(configuration).value();
  for (std::size_t i = 0; i < banks.banks.size(); ++i) {
    digests_.push_back({banks.banks[i].part->part_id, banks.paths[i], content_digest(banks.files[i].bytes())});
  }
}

void RecordWriter::offer(const Capture& capture, const PlcRequest& request, const Answer& answer,
                         const DepthFrame& empty_bin) {
  if (request.kind != RequestKind::capture || capture.frame.depth.empty()) return;
  // A frame that nothing could be made of is worth a look as much as one in which nothing was found.
  if (!capture.answered && answer.block.code != ResultCode::bad_frame) return;
  if (!is_worth_recording(when_, answer.block.code) || capture.frame.depth.size() > depth_.size()) return;
  const bool taken = worker_.offer([&] {
    camera_ = capture.frame.camera;
    std::copy(capture.frame.depth.begin(), capture.frame.depth.end(), depth_.begin());
    has_empty_ = empty_bin.depth.size() == capture.frame.depth.size();
    if (has_empty_) std::copy(empty_bin.depth.begin(), empty_bin.depth.end(), empty_depth_.begin());
    const std::span<Instance> room(instances_);
    detections_ = capture.detections;
    const std::size_t accepted = std::min(capture.detections.instances.size(), room.size());
    const std::size_t rejected = std::min(capture.detections.rejected.size(), room.size() - accepted);
    std::copy_n(capture.detections.instances.begin(), accepted, room.begin());
    std::copy_n(capture.detections.rejected.begin(), rejected, room.subspan(accepted).begin());
    detections_.instances = room.first(accepted);
    detections_.rejected = room.subspan(accepted, rejected);
    banks_ = capture.banks;
    request_ = request;
    answer_ = answer;
  });
  if (taken) return;
  log_event(LogLevel::warning, "W018", "not recorded: the last one is still being written request=%u",
            unsigned{request.request_id});
}

Status RecordWriter::record() {
  recorded_id_ = request_.request_id;
  std::set<std::uint32_t> parts;
  for (const Bank& bank : banks_) parts.insert(bank.part->part_id);
  Result<std::filesystem::path> added =
      folder_.add(parts, [this](const std::filesystem::path& scene) { return write(scene); });
  if (!added.ok()) return added.status();
  recorded_scene_ = std::move(added).value();
  return {};
}

void RecordWriter::tell(const Status& recorded) const {
  if (recorded.ok()) {
    log_event(LogLevel::info, "I017", "recorded %s request=%u", recorded_scene_.c_str(), unsigned{recorded_id_});
  } else {
    log_event(LogLevel::warning, "W016", "not recorded: %.*s", static_cast<int>(recorded.message().size()),
              recorded.message().data());
  }
}

Status RecordWriter::write(const std::filesystem::path& scene) const {
  // DepthFrame shows its pixels to those who may change them; nobody does here.
  const auto pixels = [this](const std::vector<float>& depth) {
    return std::span(const_cast<float*>(depth.data()), camera_.pixel_count());
  };
  const DepthFrame frame{camera_, pixels(depth_), 0, 0};
  if (const auto image = append_bop_image(scene, frame); !image.ok()) return image.status();
  if (has_empty_) {
    const auto image = write_bop_empty_bin(scene, {camera_, pixels(empty_depth_), 0, 0});
    if (!image.ok()) return image.status();
  }
  DetectionReport report;
  report.frame = &frame;
  report.banks = banks_;
  report.detections = &detections_;
  report.with_rejected = true;
  report.replayable = true;
  if (Status written = write_file(scene / "detections.json", report_as_json(report)); !written.ok()) return written;
  if (Status written = write_file(scene / "graspd.toml", configuration_); !written.ok()) return written;
  return write_file(scene / "record.json", record_text());
}

std::string RecordWriter::record_text() const {
  const ResultBlock& block = answer_.block;
  Json record;
  record["request"] = {{"id", request_.request_id},
                       {"sequence", request_.sequence},
                       {"part", request_.part},
                       {"minimum_score", request_.minimum_score}};
  if (request_.has_flange_pose) record["request"]["flange"] = pose_as_json(request_.robot_from_flange);
  record["result"] = {{"code", std::string(result_code_name(block.code))},
                      {"reason", std::string(result_reason_name(block.reason))},
                      {"instances_found", block.instances_found},
                      {"pickable", block.pickable}};
  if (has_pick(block)) {
    record["result"]["part"] = block.part;
    record["result"]["grasp"] = block.grasp;
    record["result"]["score"] = block.score;
    record["result"]["in_frame_of"] = block.frame == PoseFrame::robot ? "robot" : "camera";
    record["result"]["pick"] = pose_as_json(block.pick);
  }
  record["configuration"] = {{"file", configuration_file_},
                             {"digest", content_digest(std::as_bytes(std::span(configuration_)))}};
  record["banks"] = Json::array();
  for (const BankDigest& bank : digests_) {
    const bool asked = std::any_of(banks_.begin(), banks_.end(),
                                   [&](const Bank& candidate) { return candidate.part->part_id == bank.part; });
    if (asked) record["banks"].push_back({{"part", bank.part}, {"file", bank.file}, {"digest", bank.digest}});
  }
  return record.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace graspd
