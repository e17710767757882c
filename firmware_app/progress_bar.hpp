#pragma once

#include <chrono>
#include <string>

namespace graspd {

/// A line on stderr that shows how far long work has come. Silent when stderr is not a terminal, so
/// that journals and pipes stay clean.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Draws `label` and `share` in [0, 1], a few times a second at most.
  void show(const std::string& label, float share);
  /// Removes the line, before something else is printed.
  void clear();

 private:
  bool terminal_ = false;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace graspd
