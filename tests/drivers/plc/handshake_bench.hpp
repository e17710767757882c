#pragma once

#include <cstdint>

#include "drivers/plc/handshake.hpp"

namespace graspd {

constexpr std::int64_t second = 1'000'000'000;
constexpr HandshakeInputs none;
constexpr HandshakeInputs trigger{true, false, false, false};
constexpr HandshakeInputs acknowledge{false, true, false, false};
constexpr HandshakeInputs reset{false, false, true, false};
constexpr HandshakeInputs next{false, false, false, true};

/// A handshake with a clock of its own.
struct Bench {
  HandshakeOptions options;
  HandshakeState state;
  std::int64_t now_ns = 0;

  HandshakeActions take(const HandshakeEvent& event) { return step(state, event, now_ns, options); }
  HandshakeActions coils(const HandshakeInputs& levels) { return take(HandshakeEvent::of_coils(levels)); }
  HandshakeActions pulse(const HandshakeInputs& levels) {
    const HandshakeActions actions = coils(levels);
    coils(none);
    return actions;
  }
  HandshakeActions answer(ResultCode code = ResultCode::ok, bool pick = true) {
    return take(HandshakeEvent::of_answer(state.sequence, code, pick));
  }
  void make_ready() {
    take(HandshakeEvent::of_camera(true));
    take(HandshakeEvent::of_model(true));
  }
  [[nodiscard]] HandshakeOutputs out() const { return outputs(state, options); }
};

}  // namespace graspd
