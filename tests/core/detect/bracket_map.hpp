#pragma once

#include <gtest/gtest.h>

#include "core/detect/preprocess.hpp"
#include "tests/core/detect/bracket_scene.hpp"

namespace graspd {

/// The brackets laid out as a map.
class BracketMap : public testing::Test {
 protected:
  BracketBank maker_;
  BracketScene bin_;
  DetectMemory memory_{1};
  Scene scene_;

  void SetUp() override { lay_out(); }
  /// Makes the map of the depths as they are now.
  void lay_out() {
    scene_ = preprocess(bin_.frame(), {}, maker_.bank().part->detail, {}, {}, memory_.workspace.preprocess);
  }
};

}  // namespace graspd
