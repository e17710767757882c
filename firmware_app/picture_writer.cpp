#include "firmware_app/picture_writer.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "drivers/system/log.hpp"
#include "firmware_app/answer_text.hpp"
#include "firmware_app/detection_report.hpp"
#include "firmware_app/drawn_grasps.hpp"

namespace graspd {

PictureWriter::PictureWriter(std::filesystem::path path, WorkingMemory& memory, const GraspParameters& grasp)
    : path_(std::move(path)),
      memory_(memory),
      grasp_(grasp),
      worker_([this] { return draw(); },
              [](const Status& drawn) {
                if (drawn.ok()) return;
                log_event(LogLevel::warning, "W013", "picture not written: %.*s",
                          static_cast<int>(drawn.message().size()), drawn.message().data());
              }) {}

void PictureWriter::offer(const Capture& capture, const Answer& answer) {
  if (capture.frame.depth.empty()) return;
  static_cast<void>(worker_.offer([&] {
    camera_ = capture.frame.camera;
    std::copy(capture.frame.depth.begin(), capture.frame.depth.end(), memory_.pictured_frame.begin());
    instance_count_ = std::min(capture.detections.instances.size(), memory_.pictured_instances.size());
    std::copy_n(capture.detections.instances.begin(), instance_count_, memory_.pictured_instances.begin());
    banks_ = capture.banks;
    grasp_.robot_from_camera = capture.robot_from_camera;
    pick_.reset();
    if (has_poses(answer.block)) pick_ = capture.picks.picks[answer.block.result_index - std::size_t{1}];
    answer_ = answer;
  }));
}

Status PictureWriter::draw() const {
  const DepthFrame frame{camera_, memory_.pictured_frame.first(camera_.pixel_count()), 0, 0};
  const std::vector<DrawnInstance> instances =
      drawn_instances(memory_.pictured_instances.first(instance_count_), banks_);
  std::optional<DrawnPick> pick;
  if (pick_) pick = drawn_pick(*pick_, grasp_);
  std::array<char, 640> caption{};
  explain_answer(answer_, caption);
  return write_picture(path_, draw_detections(frame, instances, pick, caption.data()));
}

}  // namespace graspd
