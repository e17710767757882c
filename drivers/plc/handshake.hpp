#pragma once

#include <cstdint>

#include "drivers/plc/plc_link.hpp"
#include "drivers/plc/result_codes.hpp"

namespace graspd {

/// The coils, as levels.
struct HandshakeInputs {
  bool trigger = false;
  bool acknowledge = false;
  bool reset = false;
  bool next = false;
};

/// The discrete inputs.
struct HandshakeOutputs {
  bool ready = false;
  bool busy = false;
  bool capture_done = false;
  bool done = false;
  bool error = false;
  bool result_valid = false;
  bool camera_ok = false;
  bool model_loaded = false;
  bool plc_alive = false;
};

enum class HandshakePhase : std::uint8_t {
  idle = 0,
  capturing = 1,   ///< A request runs; the scene must stand still.
  processing = 2,  ///< A request runs; the frame is taken.
  finished = 3,    ///< Answered; waits for acknowledge, next or reset.
};

struct HandshakeOptions {
  std::int64_t heartbeat_timeout_ns = 0;  ///< 0: the PLC's heartbeat is not watched.
  std::int64_t request_timeout_ns = 0;    ///< 0: the worker may take as long as it likes.
};

/// Everything the handshake remembers. A plain value: copying it forks the handshake.
struct HandshakeState {
  HandshakePhase phase = HandshakePhase::idle;
  HandshakeInputs coils;              ///< Levels seen last.
  std::uint16_t sequence = 0;         ///< Of the request that runs or ran last; 0 before the first.
  std::uint16_t worker_sequence = 0;  ///< Of the request that the worker has not answered yet; 0: none.
  std::int64_t started_ns = 0;        ///< When the request that runs began.
  bool error = false;
  bool result_valid = false;
  bool was_silent = false;  ///< The PLC fell silent while the request ran: its answer is not valid.
  bool camera_ok = false;
  bool model_loaded = false;
  bool plc_alive = false;               ///< The heartbeat is watched and beats.
  std::uint16_t heartbeat = 0;          ///< The PLC's value seen last.
  std::int64_t heartbeat_ns = 0;        ///< When it changed.
  std::uint16_t accepted = 0;           ///< Requests accepted, wrapping.
  std::uint16_t refused = 0;            ///< Requests refused, wrapping.
  ResultCode refusal = ResultCode::ok;  ///< Why the last refused one was.
};

/// Something that happened: one of these a step.
struct HandshakeEvent {
  enum class Kind : std::uint8_t { coils, heartbeat, found, lost, capture_done, answer, camera, model, tick };
  Kind kind = Kind::tick;
  HandshakeInputs coils;             ///< coils, found: the levels now.
  std::uint16_t heartbeat = 0;       ///< heartbeat, found: the register's value now.
  std::uint16_t sequence = 0;        ///< capture_done, answer: the request that is meant.
  ResultCode code = ResultCode::ok;  ///< answer: what became of it.
  bool flag = false;                 ///< answer: carries a verified pick; camera, model: present.

  [[nodiscard]] static HandshakeEvent of_coils(const HandshakeInputs& levels);
  [[nodiscard]] static HandshakeEvent of_heartbeat(std::uint16_t value);
  /// What stood in the PLC when it was looked at first: neither an edge nor a beat.
  [[nodiscard]] static HandshakeEvent of_found(const HandshakeInputs& levels, std::uint16_t heartbeat);
  /// The PLC cannot be reached any more: as silent as one can be.
  [[nodiscard]] static HandshakeEvent of_lost();
  [[nodiscard]] static HandshakeEvent of_capture_done(std::uint16_t sequence);
  [[nodiscard]] static HandshakeEvent of_answer(std::uint16_t sequence, ResultCode code, bool has_verified_pick);
  [[nodiscard]] static HandshakeEvent of_camera(bool ok);
  [[nodiscard]] static HandshakeEvent of_model(bool loaded);
  [[nodiscard]] static HandshakeEvent of_time() { return {}; }
};

/// What the caller has to do after a step.
struct HandshakeActions {
  bool start = false;  ///< Hand a request named HandshakeState::sequence to the worker.
  RequestKind kind = RequestKind::capture;
  bool commit = false;      ///< The answer of this event belongs into the registers.
  bool drop = false;        ///< The answer of this event came too late and must not be shown.
  bool given_up = false;    ///< A reset ended a request that still runs.
  bool timed_out = false;   ///< The worker overran request_timeout: an answer with code deadline is due.
  bool refused = false;     ///< A request was refused; HandshakeState::refusal says why.
  bool plc_silent = false;  ///< The heartbeat has just stopped.
  bool plc_back = false;    ///< The heartbeat has just begun.
};

/// One step of the handshake. The rising edges in one event of kind `coils` count in the order reset,
/// acknowledge, trigger, next. `result_valid` is set by nothing but the answer to the request that runs,
/// and only if that answer carries a verified pick, has code ok, and the PLC was not silent meanwhile.
[[nodiscard]] HandshakeActions step(HandshakeState& state, const HandshakeEvent& event, std::int64_t now_ns,
                                    const HandshakeOptions& options);

/// The discrete inputs that belong to `state`.
[[nodiscard]] HandshakeOutputs outputs(const HandshakeState& state, const HandshakeOptions& options);

}  // namespace graspd
