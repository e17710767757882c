#pragma once

#include <memory>
#include <span>
#include <string>

#include "core/evaluate/image_evaluation.hpp"
#include "core/status.hpp"
#include "drivers/files/loaded_frame.hpp"

namespace graspd {

/// graspd as `validate` runs it, on one thread, for the parts that an image asks for.
class GraspdRunner {
 public:
  /// Opens the bank of every part that `images` ask for. Fails as load_banks does.
  [[nodiscard]] static Result<GraspdRunner> open(const std::string& bank_folder,
                                                 std::span<const EvaluationImage> images);
  GraspdRunner(GraspdRunner&&) noexcept;
  ~GraspdRunner();

  /// Detects the image's targets in `frame` and writes its estimates and seconds.
  [[nodiscard]] Status run(LoadedFrame& frame, EvaluationImage& image);

 private:
  struct Opened;
  explicit GraspdRunner(std::unique_ptr<Opened> opened);
  std::unique_ptr<Opened> opened_;
};

}  // namespace graspd
