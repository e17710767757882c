#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/detect/segmentation.hpp"

namespace graspd {
namespace {

/// A map drawn with letters: a height of its own for each, a step of 25 mm from one to the next; '.': background.
struct DrawnMap {
  std::vector<MapCell> cells;
  SceneMap map;

  explicit DrawnMap(const std::vector<std::string>& rows) {
    const auto width = static_cast<int>(rows.front().size());
    cells.resize(rows.size() * rows.front().size());
    map.camera = {width, static_cast<int>(rows.size()), 100.0F, 100.0F, 0.0F, 0.0F};
    map.cells = cells;
    std::size_t i = 0;
    for (const std::string& row : rows) {
      for (const char letter : row) {
        cells[i].point.z() = letter == '.' ? 0.6F : 0.5F + 0.025F * static_cast<float>(letter - 'a');
        cells[i++].foreground = letter == '.' ? 0 : 1;
      }
    }
  }
  /// The numbers of the segments, row by row.
  [[nodiscard]] std::string segmented(std::uint32_t minimum_cells) {
    std::vector<std::uint32_t> parent(cells.size());
    std::vector<std::uint32_t> size(cells.size());
    SegmentWorkspace workspace{parent, size};
    segment_foreground(minimum_cells, {}, workspace, map);
    std::string numbers;
    for (const MapCell& cell : cells) numbers += std::to_string(cell.foreground);
    return numbers;
  }
};

TEST(Segmentation, NumbersConnectedSurfacesInTheOrderOfTheImage) {
  DrawnMap map({"aa.bb", "aa.bb", ".....", "aaaaa"});
  EXPECT_EQ(map.segmented(1),
            "1102211022"
            "00000"
            "33333");
}

TEST(Segmentation, JoinsArmsThatMeetLater) {
  DrawnMap map({"a.a.a", "a.a.a", "a.aaa", "aaa.."});
  EXPECT_EQ(map.segmented(1),
            "10101"
            "10101"
            "10111"
            "11100");
}

TEST(Segmentation, CutsAtStepsInDepth) {
  // At half a metre these cells may rise by 20 mm and still be one surface.
  DrawnMap map({"aabb", "aabb", "cccc"});
  EXPECT_EQ(map.segmented(1),
            "1122"
            "1122"
            "3333");
}

TEST(Segmentation, DropsWhatIsTooSmallToBeAPart) {
  DrawnMap map({"aa..b", "aa...", "...cc", "....c"});
  EXPECT_EQ(map.segmented(4),
            "11000"
            "11000"
            "00000"
            "00000");
  DrawnMap again({"aa..b", "aa...", "...cc", "....c"});
  EXPECT_EQ(again.segmented(3),
            "11000"
            "11000"
            "00022"
            "00002");
}

}  // namespace
}  // namespace graspd
