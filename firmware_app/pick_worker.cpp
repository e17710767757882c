#include "firmware_app/pick_worker.hpp"

#include <chrono>

#include "drivers/system/prompt_thread.hpp"
#include "firmware_app/answer_text.hpp"

namespace graspd {

PickWorker::PickWorker(PickCycle& cycle, PlcLink& plc, AnswerWriters writers)
    : cycle_(cycle), plc_(plc), writers_(writers) {
  thread_ = std::thread([this] { work(); });
}

PickWorker::~PickWorker() { stop(); }

Status PickWorker::wait_ready() {
  ready_.wait(false);
  return readiness_;
}

void PickWorker::stop() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

void PickWorker::work() {
  make_thread_prompt();
  readiness_ = warm_up(cycle_);
  plc_.set_model_loaded(readiness_.ok());
  plc_.set_camera_ok(readiness_.ok() && cycle_.source->connected());
  ready_ = true;
  ready_.notify_all();
  if (!readiness_.ok()) return;
  while (!stop_) {
    progress_.fetch_add(1, std::memory_order_relaxed);
    PlcRequest request;
    if (!plc_.wait_for_request(request, std::chrono::milliseconds(200))) {
      plc_.set_camera_ok(cycle_.source->connected());
      continue;
    }
    const Answer answer = answer_request(cycle_, request, plc_);
    plc_.commit(answer.block);
    log_answer(answer, cycle_.source->frame_name());
    if (writers_.pictures != nullptr) writers_.pictures->offer(cycle_.capture, answer);
    if (request.save_snapshot && writers_.snapshots != nullptr)
      writers_.snapshots->offer(cycle_.capture.frame, request.request_id);
    if (writers_.records != nullptr)
      writers_.records->offer(cycle_.capture, request, answer, cycle_.source->empty_bin());
  }
}

}  // namespace graspd
