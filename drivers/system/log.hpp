#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace graspd {

/// How much an event matters; the numbers are those of syslog and of the journal.
enum class LogLevel : std::uint8_t { error = 3, warning = 4, notice = 5, info = 6 };

/// Writes one event as one line to standard error, in one write, without allocating and without waiting: while nobody
/// takes what is written, lines are lost, and the next one that is taken says how many.
/// `code=<code> <text> key=value ...`. `code` is a literal such as "E101" that configs/log-codes.md
/// explains: its letter is the level (E error, W warning, N notice, I info). When the journal reads
/// standard error, the line starts with the level as the journal wants it, otherwise with its name.
/// Line breaks inside the text become spaces; a line that is too long is cut.
[[gnu::format(printf, 3, 4)]] void log_event(LogLevel level, const char* code, const char* format, ...);

/// The line that log_event writes, with its line break, put into `buffer`; returns its length.
[[nodiscard]] std::size_t format_log_line(std::span<char> buffer, LogLevel level, const char* code,
                                          std::string_view text, bool for_journal);

/// True when standard error is the stream that JOURNAL_STREAM names.
[[nodiscard]] bool stderr_is_journal();

/// Keeps events that others can cause at will from filling the journal: so many lines in a window.
class LogThrottle {
 public:
  LogThrottle(std::uint32_t lines, std::int64_t window_ns) : lines_(lines), window_ns_(window_ns) {}

  /// True when a line may be written now. `suppressed` gets the number of lines held back in the window
  /// that has just ended, and is 0 otherwise.
  [[nodiscard]] bool allow(std::int64_t now_ns, std::uint32_t& suppressed);

 private:
  std::uint32_t lines_;
  std::int64_t window_ns_;
  std::int64_t window_start_ns_ = 0;
  std::uint32_t written_ = 0;
  std::uint32_t held_back_ = 0;
};

}  // namespace graspd
