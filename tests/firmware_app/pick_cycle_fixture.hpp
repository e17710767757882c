#pragma once

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "drivers/system/clock.hpp"
#include "firmware_app/answer_text.hpp"
#include "firmware_app/detection_session.hpp"
#include "firmware_app/pick_cycle.hpp"
#include "tests/firmware_app/scripted_plc.hpp"
#include "tests/firmware_app/shared_bank.hpp"

namespace graspd {

/// What the journal says of an answer.
inline std::string explained(const Answer& answer) {
  std::array<char, 640> text{};
  const std::size_t length = explain_answer(answer, text);
  return {text.data(), length};
}

/// A pick cycle over a scripted camera and PLC, on memory as the daemon would take it.
class PickCycleFixture {
 public:
  explicit PickCycleFixture(RenderedScene scene, int threads = 1) : source(std::move(scene)) {
    const Result<Bank> bank = read_bank(shared_angle_bar_bank(), "angle bar");
    if (!bank.ok()) {
      ADD_FAILURE() << bank.status().message();
      return;
    }
    banks.push_back(bank.value());
    WorkingCapacity capacity;
    capacity.frame_pixels = source.scene.camera.pixel_count();
    capacity.detect.threads = threads;
    capacity.detect = fitted_capacity(capacity.detect, source.limits(), banks);
    Arena measure = Arena::measuring();
    static_cast<void>(carve_working_memory(measure, capacity));
    block = MemoryBlock(measure.used());
    Arena arena(block.bytes());
    cycle.memory = carve_working_memory(arena, capacity);
    EXPECT_FALSE(arena.exhausted());
    cycle.settings.detect.threads = threads;
    cycle.settings.maximum_age_ns = 1'000'000'000;
    cycle.settings.now_ns = &monotonic_ns;
    cycle.banks = banks;
    cycle.source = &source;
  }

  Answer ask(RequestKind kind = RequestKind::capture, std::uint16_t part = 0) {
    PlcRequest request;
    request.kind = kind;
    request.part = part;
    return ask(request);
  }
  /// Asks for what `request` says, under the next sequence number.
  Answer ask(PlcRequest request) {
    request.sequence = ++sequence;
    request.request_id = static_cast<std::uint16_t>(100 + sequence);
    request.received_ns = monotonic_ns();
    return answer_request(cycle, request, plc);
  }

  ScriptedSource source;
  ScriptedPlc plc;
  std::vector<Bank> banks;
  MemoryBlock block;
  PickCycle cycle;
  std::uint16_t sequence = 0;
};

}  // namespace graspd
