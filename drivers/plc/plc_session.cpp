#include "drivers/plc/plc_session.hpp"

#include <algorithm>
#include <limits>

#include "drivers/plc/pick_list.hpp"
#include "drivers/plc/request_words.hpp"

namespace graspd {
namespace {

constexpr std::int64_t heartbeat_period_ns = 1'000'000'000;
constexpr std::uint32_t log_lines = 20;
constexpr std::int64_t log_window_ns = 10'000'000'000;

[[nodiscard]] std::uint16_t status_word(std::span<const std::uint8_t> discrete_inputs) {
  unsigned word = 0;
  for (std::size_t i = 0; i < discrete_input::count; ++i) word |= static_cast<unsigned>(discrete_inputs[i]) << i;
  return static_cast<std::uint16_t>(word);
}

}  // namespace

PlcSession::PlcSession(const RegisterTables& tables, const BlockFormat& format, const HandshakeOptions& options)
    : tables_(tables),
      format_(format),
      options_(options),
      request_convention_(format.convention),
      throttle_(log_lines, log_window_ns) {
  // Before the first request the block is there, with sequence 0: the test pattern can be read at once.
  ResultBlock empty;
  empty.code = ResultCode::no_answer;
  commit(empty);
  publish(0);
}

bool PlcSession::on_written(std::int64_t now_ns, PlcRequest& request) {
  const std::span<const std::uint16_t> registers = tables_.holding_registers;
  take(HandshakeEvent::of_heartbeat(registers[request_register::plc_heartbeat]), now_ns);
  const HandshakeActions actions = take(HandshakeEvent::of_coils(levels()), now_ns);
  publish(now_ns);
  if (!actions.start) return false;

  request = read_request(registers, format_);
  request.kind = actions.kind;
  request.sequence = state_.sequence;
  request.received_ns = now_ns;
  request_id_ = request.request_id;
  request_convention_ = request_convention(registers, format_);
  return true;
}

void PlcSession::on_found(std::int64_t now_ns) {
  const std::uint16_t heartbeat = tables_.holding_registers[request_register::plc_heartbeat];
  take(HandshakeEvent::of_found(levels(), heartbeat), now_ns);
  publish(now_ns);
}

void PlcSession::on_lost(std::int64_t now_ns) {
  take(HandshakeEvent::of_lost(), now_ns);
  delivery_from_ns_.reset();
  publish(now_ns);
}

void PlcSession::on_capture_done(std::uint16_t sequence, std::int64_t now_ns) {
  take(HandshakeEvent::of_capture_done(sequence), now_ns);
  publish(now_ns);
}

void PlcSession::on_answer(const ResultBlock& result, std::int64_t now_ns) {
  ResultBlock answer = result;
  const bool claims_poses = answer.code == ResultCode::ok || answer.code == ResultCode::dry_run;
  if (claims_poses && !has_poses(answer)) {
    log_event(LogLevel::error, "E126", "answer without a verified, finite pick sequence=%u", unsigned{answer.sequence});
    answer.code = ResultCode::internal;
  }
  const HandshakeActions actions =
      take(HandshakeEvent::of_answer(answer.sequence, answer.code, has_pick(answer)), now_ns);
  // A PLC that reads the code alone must not be led to a pick either. To the worker such a request is given up.
  const bool withheld = has_pick(answer) || answer.code == ResultCode::given_up;
  if (actions.commit && state_.was_silent && withheld) answer.code = ResultCode::plc_silent;
  if (actions.commit) {
    commit(answer);
    delivery_from_ns_ = state_.started_ns + detection_ns(answer);
  }
  if (actions.drop) {
    log_event(LogLevel::notice, "N124", "answer dropped: nobody waits for it any more sequence=%u result=%.*s",
              unsigned{answer.sequence}, static_cast<int>(result_code_name(answer.code).size()),
              result_code_name(answer.code).data());
  }
  publish(now_ns);
}

void PlcSession::on_time(bool camera_ok, bool model_loaded, std::int64_t now_ns) {
  take(HandshakeEvent::of_camera(camera_ok), now_ns);
  take(HandshakeEvent::of_model(model_loaded), now_ns);
  publish(now_ns);
}

void PlcSession::on_news(const WorkerNews& news, std::int64_t now_ns) {
  on_time(news.camera_ok, news.model_loaded, now_ns);
  if (news.capture_done != 0) on_capture_done(news.capture_done, now_ns);
  if (news.has_answer) on_answer(news.answer, now_ns);
}

void PlcSession::on_delivered(std::int64_t now_ns) {
  if (!delivery_from_ns_) return;
  constexpr std::int64_t most = std::numeric_limits<std::uint16_t>::max();
  const std::int64_t overhead_us = std::clamp<std::int64_t>((now_ns - *delivery_from_ns_) / 1000, 0, most);
  put_live(live_register::answer_overhead, static_cast<std::uint16_t>(overhead_us));
  delivery_from_ns_.reset();
}

void PlcSession::set_clients(std::uint16_t clients) { put_live(live_register::clients, clients); }

std::uint16_t PlcSession::wanted() const {
  const bool running = state_.phase == HandshakePhase::capturing || state_.phase == HandshakePhase::processing;
  return running && !state_.was_silent ? state_.sequence : std::uint16_t{0};
}

HandshakeInputs PlcSession::levels() const {
  const std::span<const std::uint8_t> coils = tables_.coils;
  return {coils[coil::trigger] != 0, coils[coil::acknowledge] != 0, coils[coil::reset] != 0, coils[coil::next] != 0};
}

HandshakeActions PlcSession::take(const HandshakeEvent& event, std::int64_t now_ns) {
  const HandshakeActions actions = step(state_, event, now_ns, options_);
  if (actions.timed_out) {
    ResultBlock late;
    late.sequence = state_.sequence;
    late.request_id = request_id_;
    late.code = ResultCode::deadline;
    const auto total_ns = static_cast<double>(now_ns - state_.started_ns);
    late.stage_time[static_cast<std::size_t>(BlockStage::total)] = static_cast<float>(total_ns * 1e-9);
    commit(late);
  }
  log(actions, now_ns);
  return actions;
}

void PlcSession::commit(const ResultBlock& result) {
  BlockFormat format = format_;
  format.convention = request_convention_;
  const std::span<std::uint16_t> registers = tables_.input_registers;
  encode(result, format, registers);
  encode_list(result, NumberKind::floating, format, registers.subspan(pick_list::floats_first));
  encode_list(result, NumberKind::scaled, format, registers.subspan(pick_list::scaled_first));
  const auto mirror = [&](std::size_t first, std::size_t count) {
    std::ranges::copy(registers.subspan(first, count),
                      tables_.holding_registers.subspan(holding_mirror + first).begin());
  };
  mirror(0, block::count);
  mirror(pick_list::floats_first, pick_list::count);
  mirror(pick_list::scaled_first, pick_list::count);
}

void PlcSession::publish(std::int64_t now_ns) {
  const HandshakeOutputs out = outputs(state_, options_);
  const std::span<std::uint8_t> bits = tables_.discrete_inputs;
  bits[discrete_input::ready] = out.ready;
  bits[discrete_input::busy] = out.busy;
  bits[discrete_input::capture_done] = out.capture_done;
  bits[discrete_input::done] = out.done;
  bits[discrete_input::error] = out.error;
  bits[discrete_input::result_valid] = out.result_valid;
  bits[discrete_input::camera_ok] = out.camera_ok;
  bits[discrete_input::model_loaded] = out.model_loaded;
  bits[discrete_input::plc_alive] = out.plc_alive;
  put_live(live_register::heartbeat, static_cast<std::uint16_t>(now_ns / heartbeat_period_ns));
  put_live(live_register::phase, static_cast<std::uint16_t>(state_.phase));
  put_live(live_register::status_word, status_word(bits));
  put_live(live_register::sequence, state_.sequence);
  put_live(live_register::triggers_accepted, state_.accepted);
  put_live(live_register::triggers_refused, state_.refused);
  put_live(live_register::last_refusal, static_cast<std::uint16_t>(state_.refusal));
}

void PlcSession::put_live(std::uint16_t address, std::uint16_t value) {
  tables_.input_registers[address] = value;
  tables_.holding_registers[std::size_t{holding_mirror} + address] = value;
}

void PlcSession::log(const HandshakeActions& actions, std::int64_t now_ns) {
  const unsigned sequence = state_.sequence;
  if (actions.timed_out) {
    log_event(LogLevel::error, "E125", "no answer from the worker within %lld ms sequence=%u",
              static_cast<long long>(options_.request_timeout_ns / 1'000'000), sequence);
  }
  if (!actions.given_up && !actions.refused && !actions.plc_silent && !actions.plc_back) return;
  std::uint32_t suppressed = 0;
  const bool allowed = throttle_.allow(now_ns, suppressed);
  if (suppressed > 0) log_event(LogLevel::warning, "W119", "lines about the handshake held back count=%u", suppressed);
  if (!allowed) return;
  if (actions.given_up) log_event(LogLevel::warning, "W123", "reset: request given up sequence=%u", sequence);
  if (actions.refused) {
    log_event(LogLevel::warning, "W118", "request refused reason=%s count=%u", result_code_name(state_.refusal).data(),
              unsigned{state_.refused});
  }
  if (actions.plc_silent) {
    log_event(LogLevel::warning, "W121", "heartbeat of the PLC stopped: result valid is cleared timeout_ms=%lld",
              static_cast<long long>(options_.heartbeat_timeout_ns / 1'000'000));
  }
  if (actions.plc_back) log_event(LogLevel::notice, "N122", "heartbeat of the PLC beats");
}

}  // namespace graspd
