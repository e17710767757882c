#include "firmware_app/progress_bar.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace graspd {

ProgressBar::ProgressBar() : terminal_(isatty(STDERR_FILENO) == 1) {}

void ProgressBar::show(const std::string& label, float share) {
  const auto now = std::chrono::steady_clock::now();
  if (!terminal_ || (drawn_ && now - last_ < std::chrono::milliseconds(100))) return;
  last_ = now;
  drawn_ = true;
  constexpr int width = 30;
  const float part = std::clamp(share, 0.0F, 1.0F);
  const int full = static_cast<int>(part * static_cast<float>(width));
  std::fprintf(stderr, "\r\033[K[%s%s] %3d%%  %s", std::string(static_cast<std::size_t>(full), '#').c_str(),
               std::string(static_cast<std::size_t>(width - full), '.').c_str(), static_cast<int>(part * 100.0F),
               label.c_str());
  std::fflush(stderr);
}

void ProgressBar::clear() {
  if (!drawn_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace graspd
