#pragma once

#include <atomic>
#include <thread>

#include "drivers/plc/plc_link.hpp"

namespace graspd {

/// Metres in the block that follow from the number of the request: a block put together of two would show.
[[nodiscard]] inline float mark_of(std::uint16_t sequence) { return static_cast<float>(sequence) / 1000.0F; }

/// The answer to `request`, every pose of which carries its mark. Every third has no pick.
[[nodiscard]] inline ResultBlock marked_answer(const PlcRequest& request) {
  ResultBlock result;
  result.sequence = request.sequence;
  result.request_id = request.request_id;
  result.code = request.request_id % 3 == 2 ? ResultCode::no_match : ResultCode::ok;
  result.verified = result.code == ResultCode::ok;
  result.part = request.part;
  const float mark = mark_of(request.sequence);
  result.opening = mark;
  result.pick.translation = {mark, 0.1F, 0.5F};
  result.approach.translation = {mark, 0.2F, 0.4F};
  result.part_pose.translation = {mark, 0.3F, 0.6F};
  result.listed_count = request.results_wanted;
  for (std::size_t i = 0; i < result.listed_count; ++i) result.listed[i].pick.translation = {mark, 0.4F, 0.7F};
  return result;
}

/// Answers requests at once until it is destroyed.
class StressWorker {
 public:
  explicit StressWorker(PlcLink& link) : link_(link) {
    link_.set_camera_ok(true);
    link_.set_model_loaded(true);
    thread_ = std::thread([this] { work(); });
  }
  ~StressWorker() {
    stop_ = true;
    thread_.join();
  }
  StressWorker(const StressWorker&) = delete;
  StressWorker& operator=(const StressWorker&) = delete;

  [[nodiscard]] long requests() const { return requests_; }
  /// Requests whose number did not follow on the one before: doubled or skipped.
  [[nodiscard]] long out_of_order() const { return out_of_order_; }

 private:
  void work() {
    std::uint16_t last = 0;
    while (!stop_) {
      PlcRequest request;
      if (!link_.wait_for_request(request, std::chrono::milliseconds(20))) continue;
      ++requests_;
      const std::uint16_t expected = last == 0xFFFF ? std::uint16_t{1} : static_cast<std::uint16_t>(last + 1);
      if (request.sequence != expected) ++out_of_order_;
      last = request.sequence;
      link_.capture_done(request.sequence);
      link_.commit(marked_answer(request));
    }
  }

  PlcLink& link_;
  std::atomic<bool> stop_{false};
  std::atomic<long> requests_{0};
  std::atomic<long> out_of_order_{0};
  std::thread thread_;
};

}  // namespace graspd
