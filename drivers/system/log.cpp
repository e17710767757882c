#include "drivers/system/log.hpp"

#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <mutex>

namespace graspd {
namespace {

constexpr std::size_t line_capacity = 1024;

/// Lines that nobody took, since the last that somebody did.
std::atomic<std::uint32_t> lost_lines{0};

[[nodiscard]] bool can_write_at_once() {
  pollfd out{STDERR_FILENO, POLLOUT, 0};
  return poll(&out, 1, 0) == 1 && (out.revents & POLLOUT) != 0;
}

/// False when it would have to wait.
[[nodiscard]] bool write_at_once(std::span<const char> line) {
  // Two threads at once could find room for one.
  static std::mutex writing;
  const std::lock_guard lock(writing);
  if (!can_write_at_once()) return false;
  // A log that cannot be written leaves nobody to tell.
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, line.data(), line.size());
  return true;
}

[[nodiscard]] const char* level_name(LogLevel level) {
  switch (level) {
    case LogLevel::error:
      return "error";
    case LogLevel::warning:
      return "warning";
    case LogLevel::notice:
      return "notice";
    case LogLevel::info:
      return "info";
  }
  return "?";
}

}  // namespace

std::size_t format_log_line(std::span<char> buffer, LogLevel level, const char* code, std::string_view text,
                            bool for_journal) {
  std::array<char, 24> head{};
  if (for_journal) {
    std::snprintf(head.data(), head.size(), "<%u>", static_cast<unsigned>(level));
  } else {
    std::snprintf(head.data(), head.size(), "graspd %s: ", level_name(level));
  }
  const int wanted = std::snprintf(buffer.data(), buffer.size(), "%scode=%s %.*s", head.data(), code,
                                   static_cast<int>(text.size()), text.data());
  const std::size_t length = std::min(static_cast<std::size_t>(std::max(wanted, 0)), buffer.size() - 1);
  std::replace_if(
      buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(length),
      [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  buffer[length] = '\n';
  return length + 1;
}

bool stderr_is_journal() {
  const char* stream = std::getenv("JOURNAL_STREAM");
  struct stat status {};
  unsigned long device = 0;
  unsigned long inode = 0;
  return stream != nullptr && std::sscanf(stream, "%lu:%lu", &device, &inode) == 2 &&
         fstat(STDERR_FILENO, &status) == 0 && status.st_dev == device && status.st_ino == inode;
}

void log_event(LogLevel level, const char* code, const char* format, ...) {
  static const bool for_journal = stderr_is_journal();
  std::array<char, line_capacity> text{};
  va_list arguments;
  va_start(arguments, format);
  const int wanted = std::vsnprintf(text.data(), text.size(), format, arguments);
  va_end(arguments);
  const std::size_t length = std::min(static_cast<std::size_t>(std::max(wanted, 0)), text.size() - 1);
  std::array<char, line_capacity + 64> line{};
  const std::size_t size = format_log_line(line, level, code, {text.data(), length}, for_journal);
  if (lost_lines.load() > 0 && can_write_at_once()) {
    const std::uint32_t lost = lost_lines.exchange(0);
    log_event(LogLevel::warning, "W007", "%u lines before this one are lost: who reads the log took none", lost);
  }
  if (!write_at_once(std::span(line).first(size))) lost_lines.fetch_add(1);
}

bool LogThrottle::allow(std::int64_t now_ns, std::uint32_t& suppressed) {
  suppressed = 0;
  if (now_ns - window_start_ns_ >= window_ns_) {
    suppressed = held_back_;
    window_start_ns_ = now_ns;
    written_ = 0;
    held_back_ = 0;
  }
  if (written_ < lines_) {
    ++written_;
    return true;
  }
  ++held_back_;
  return false;
}

}  // namespace graspd
