#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "drivers/files/frame_folder.hpp"
#include "drivers/files/load_frame.hpp"
#include "tests/core/geometry/expect_camera.hpp"
#include "tests/drivers/files/temporary_folder.hpp"

namespace graspd {
namespace {

using ::testing::HasSubstr;

class FrameFolder : public ::testing::Test {
 protected:
  FrameFolder() : depth_(7 * 5) {
    std::iota(depth_.begin(), depth_.end(), 0.5F);
    depth_[3] = 0.0F;
    depth_[4] = 1.23456F;
  }
  DepthFrame frame() { return {{7, 5, 410.5F, 409.25F, 3.25F, 2.5F}, depth_, 0, 0}; }

  TemporaryFolder folder_;
  std::vector<float> depth_;
};

TEST_F(FrameFolder, IsReadBackAsItWasWritten) {
  const std::filesystem::path path = folder_.path() / "frame";
  const Status written = write_frame_folder(path, frame());
  ASSERT_TRUE(written.ok()) << written.message();
  const Result<LoadedFrame> back = load_frame(path / "depth.png", {});
  ASSERT_TRUE(back.ok()) << back.status().message();
  expect_same_camera(back.value().camera, frame().camera);
  for (std::size_t i = 0; i < depth_.size(); ++i) {
    const bool is_lost = depth_[i] > 6.5535F;
    EXPECT_NEAR(back.value().depth[i], is_lost ? 0.0F : depth_[i], 0.00005F + 1e-6F) << i;
  }
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".unfinished"));
}

TEST_F(FrameFolder, LeavesNothingWhereItCannotBeWritten) {
  const std::filesystem::path path = folder_.path() / "frame";
  std::filesystem::create_directories(path / "taken");
  const Status written = write_frame_folder(path, frame());
  EXPECT_EQ(written.code(), StatusCode::cannot_write);
  EXPECT_THAT(std::string(written.message()), HasSubstr("frame"));
  EXPECT_TRUE(std::filesystem::exists(path / "taken"));
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".unfinished"));
}

}  // namespace
}  // namespace graspd
