#pragma once

#include <cstddef>
#include <span>

#include "firmware_app/pick_cycle.hpp"

namespace graspd {

/// Says in one sentence, for the operator, what became of a request: what was picked, or why nothing.
/// Written to `text`, zero-terminated, without allocating; returns its length.
std::size_t explain_answer(const Answer& answer, std::span<char> text);

/// Writes the one line of the journal that belongs to an answer.
void log_answer(const Answer& answer, std::string_view frame_name);

}  // namespace graspd
