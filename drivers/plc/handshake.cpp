#include "drivers/plc/handshake.hpp"

namespace graspd {
namespace {

[[nodiscard]] bool is_running(const HandshakeState& state) {
  return state.phase == HandshakePhase::capturing || state.phase == HandshakePhase::processing;
}

[[nodiscard]] bool is_silent(const HandshakeState& state, const HandshakeOptions& options) {
  return options.heartbeat_timeout_ns > 0 && !state.plc_alive;
}

void clear_answer(HandshakeState& state) {
  state.phase = HandshakePhase::idle;
  state.error = false;
  state.result_valid = false;
}

/// Why a request cannot be accepted now; ok if it can.
[[nodiscard]] ResultCode refusal(const HandshakeState& state, RequestKind kind, const HandshakeOptions& options) {
  if (is_silent(state, options)) return ResultCode::plc_silent;
  if (is_running(state) || state.worker_sequence != 0) return ResultCode::busy;
  // `next` takes the place of an acknowledgement: the PLC asks for more because it has read this one.
  if (state.phase == HandshakePhase::finished && kind == RequestKind::capture) return ResultCode::not_acknowledged;
  return ResultCode::ok;
}

void request(HandshakeState& state, RequestKind kind, std::int64_t now_ns, const HandshakeOptions& options,
             HandshakeActions& actions) {
  if (const ResultCode why = refusal(state, kind, options); why != ResultCode::ok) {
    ++state.refused;
    state.refusal = why;
    actions.refused = true;
    return;
  }
  clear_answer(state);
  state.phase = kind == RequestKind::capture ? HandshakePhase::capturing : HandshakePhase::processing;
  state.sequence = static_cast<std::uint16_t>(state.sequence == 0xFFFF ? 1 : state.sequence + 1);
  state.worker_sequence = state.sequence;
  state.started_ns = now_ns;
  state.was_silent = false;
  ++state.accepted;
  actions.start = true;
  actions.kind = kind;
}

void on_coils(HandshakeState& state, const HandshakeInputs& coils, std::int64_t now_ns, const HandshakeOptions& options,
              HandshakeActions& actions) {
  const HandshakeInputs before = state.coils;
  state.coils = coils;
  if (coils.reset && !before.reset) {
    actions.given_up = is_running(state);
    clear_answer(state);
  }
  if (coils.acknowledge && !before.acknowledge && state.phase == HandshakePhase::finished) clear_answer(state);
  if (coils.trigger && !before.trigger) request(state, RequestKind::capture, now_ns, options, actions);
  if (coils.next && !before.next) request(state, RequestKind::next, now_ns, options, actions);
}

void on_heartbeat(HandshakeState& state, std::uint16_t value, std::int64_t now_ns, const HandshakeOptions& options,
                  HandshakeActions& actions) {
  if (value == state.heartbeat) return;
  state.heartbeat = value;
  // Nobody would notice its end.
  if (options.heartbeat_timeout_ns <= 0) return;
  state.heartbeat_ns = now_ns;
  actions.plc_back = !state.plc_alive;
  state.plc_alive = true;
}

void on_answer(HandshakeState& state, const HandshakeEvent& event, HandshakeActions& actions) {
  if (event.sequence != 0 && event.sequence == state.worker_sequence) state.worker_sequence = 0;
  if (!is_running(state) || event.sequence != state.sequence) {
    actions.drop = true;
    return;
  }
  state.phase = HandshakePhase::finished;
  state.error = is_fault(event.code);
  state.result_valid = event.flag && event.code == ResultCode::ok && !state.was_silent;
  actions.commit = true;
}

void fall_silent(HandshakeState& state) {
  state.plc_alive = false;
  state.was_silent = true;
  state.result_valid = false;
}

/// What the passing of time alone brings about; looked at before every event.
void on_time(HandshakeState& state, std::int64_t now_ns, const HandshakeOptions& options, HandshakeActions& actions) {
  if (options.heartbeat_timeout_ns > 0 && state.plc_alive &&
      now_ns - state.heartbeat_ns > options.heartbeat_timeout_ns) {
    fall_silent(state);
    actions.plc_silent = true;
  }
  if (options.request_timeout_ns > 0 && is_running(state) && now_ns - state.started_ns > options.request_timeout_ns) {
    state.phase = HandshakePhase::finished;
    state.error = true;
    state.result_valid = false;
    actions.timed_out = true;
  }
}

}  // namespace

HandshakeEvent HandshakeEvent::of_coils(const HandshakeInputs& levels) {
  HandshakeEvent event;
  event.kind = Kind::coils;
  event.coils = levels;
  return event;
}

HandshakeEvent HandshakeEvent::of_heartbeat(std::uint16_t value) {
  HandshakeEvent event;
  event.kind = Kind::heartbeat;
  event.heartbeat = value;
  return event;
}

HandshakeEvent HandshakeEvent::of_found(const HandshakeInputs& levels, std::uint16_t value) {
  HandshakeEvent event = of_coils(levels);
  event.kind = Kind::found;
  event.heartbeat = value;
  return event;
}

HandshakeEvent HandshakeEvent::of_lost() {
  HandshakeEvent event;
  event.kind = Kind::lost;
  return event;
}

HandshakeEvent HandshakeEvent::of_capture_done(std::uint16_t sequence) {
  HandshakeEvent event;
  event.kind = Kind::capture_done;
  event.sequence = sequence;
  return event;
}

HandshakeEvent HandshakeEvent::of_answer(std::uint16_t sequence, ResultCode code, bool has_verified_pick) {
  HandshakeEvent event;
  event.kind = Kind::answer;
  event.sequence = sequence;
  event.code = code;
  event.flag = has_verified_pick;
  return event;
}

HandshakeEvent HandshakeEvent::of_camera(bool ok) {
  HandshakeEvent event;
  event.kind = Kind::camera;
  event.flag = ok;
  return event;
}

HandshakeEvent HandshakeEvent::of_model(bool loaded) {
  HandshakeEvent event;
  event.kind = Kind::model;
  event.flag = loaded;
  return event;
}

HandshakeActions step(HandshakeState& state, const HandshakeEvent& event, std::int64_t now_ns,
                      const HandshakeOptions& options) {
  HandshakeActions actions;
  on_time(state, now_ns, options, actions);
  switch (event.kind) {
    case HandshakeEvent::Kind::coils:
      on_coils(state, event.coils, now_ns, options, actions);
      break;
    case HandshakeEvent::Kind::heartbeat:
      on_heartbeat(state, event.heartbeat, now_ns, options, actions);
      break;
    case HandshakeEvent::Kind::found:
      state.coils = event.coils;
      state.heartbeat = event.heartbeat;
      break;
    case HandshakeEvent::Kind::lost:
      fall_silent(state);
      break;
    case HandshakeEvent::Kind::capture_done:
      if (state.phase == HandshakePhase::capturing && event.sequence == state.sequence) {
        state.phase = HandshakePhase::processing;
      }
      break;
    case HandshakeEvent::Kind::answer:
      on_answer(state, event, actions);
      break;
    case HandshakeEvent::Kind::camera:
      state.camera_ok = event.flag;
      break;
    case HandshakeEvent::Kind::model:
      state.model_loaded = event.flag;
      break;
    case HandshakeEvent::Kind::tick:
      break;
  }
  return actions;
}

HandshakeOutputs outputs(const HandshakeState& state, const HandshakeOptions& options) {
  const bool idle = state.phase == HandshakePhase::idle;
  const bool worker_free = state.worker_sequence == 0;
  HandshakeOutputs out;
  out.busy = is_running(state) || (idle && !worker_free);
  out.ready = idle && worker_free && state.camera_ok && state.model_loaded && !is_silent(state, options);
  out.capture_done = state.phase == HandshakePhase::processing || state.phase == HandshakePhase::finished;
  out.done = state.phase == HandshakePhase::finished;
  out.error = state.error;
  out.result_valid = state.result_valid;
  out.camera_ok = state.camera_ok;
  out.model_loaded = state.model_loaded;
  out.plc_alive = state.plc_alive;
  return out;
}

}  // namespace graspd
