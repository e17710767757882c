#include "firmware_app/answer_text.hpp"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>

#include "drivers/system/log.hpp"

namespace graspd {
namespace {

[[gnu::format(printf, 2, 3)]] std::size_t put(std::span<char> text, const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const int written = std::vsnprintf(text.data(), text.size(), format, arguments);
  va_end(arguments);
  return std::min(static_cast<std::size_t>(std::max(written, 0)), text.size() - 1);
}

/// Metres to millimetres, seconds to milliseconds.
double thousandths(float value) { return static_cast<double>(value) * 1e3; }

}  // namespace

std::size_t explain_answer(const Answer& answer, std::span<char> text) {
  const ResultBlock& block = answer.block;
  const std::string_view reason = result_reason_name(block.reason);
  const int reason_length = static_cast<int>(reason.size());
  switch (block.code) {
    case ResultCode::ok:
    case ResultCode::dry_run: {
      const Vector3& place = block.pick.translation;
      return put(text, "%spick %u of part %u: grasp %u with tool %u at %.1f %.1f %.1f mm in the %s's frame, score %.2f",
                 block.code == ResultCode::dry_run ? "dry run: would be " : "", unsigned{block.result_index},
                 unsigned{block.part}, unsigned{block.grasp}, unsigned{block.tool}, thousandths(place.x()),
                 thousandths(place.y()), thousandths(place.z()), block.frame == PoseFrame::robot ? "robot" : "camera",
                 static_cast<double>(block.score));
    }
    case ResultCode::empty_bin:
      return put(text, "no pick: the bin is empty");
    case ResultCode::no_match:
      return put(text, "no pick: something lies in the bin, but no part was recognised; most candidates fell at: %.*s",
                 reason_length, reason.data());
    case ResultCode::not_pickable:
      return put(text, "no pick: %u found, but none can be gripped; mostly because of: %.*s",
                 unsigned{block.instances_found}, reason_length, reason.data());
    case ResultCode::nothing_left:
      return put(text, "no pick: the last capture holds no further one");
    case ResultCode::given_up:
      return put(text, "no pick: the request was given up before it had an answer");
    default:
      break;
  }
  const std::string_view message = answer.status.message();
  const std::string_view name = message.empty() ? result_code_name(block.code) : message;
  return put(text, "no pick: %.*s", static_cast<int>(name.size()), name.data());
}

void log_answer(const Answer& answer, std::string_view frame_name) {
  std::array<char, 900> line{};
  const std::span<char> text(line);
  const std::size_t length = explain_answer(answer, text.first(640));
  const ResultBlock& block = answer.block;
  const std::string_view result = result_code_name(block.code);
  put(text.subspan(length),
      " result=%.*s request=%u sequence=%u found=%u pickable=%u remaining=%u flags=%u total_ms=%.0f frame=%.*s",
      static_cast<int>(result.size()), result.data(), unsigned{block.request_id}, unsigned{block.sequence},
      unsigned{block.instances_found}, unsigned{block.pickable}, unsigned{block.remaining}, unsigned{block.flags},
      thousandths(block.stage_time[0]), static_cast<int>(frame_name.size()), frame_name.data());
  if (block.code == ResultCode::ok) {
    log_event(LogLevel::info, "I010", "%s", line.data());
  } else if (is_fault(block.code)) {
    log_event(LogLevel::error, "E012", "%s", line.data());
  } else {
    log_event(LogLevel::notice, "N011", "%s", line.data());
  }
}

}  // namespace graspd
