#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/camera/recorded_source.hpp"
#include "tests/drivers/files/bop_scene.hpp"

namespace graspd {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class RecordedFrames : public ::testing::Test {
 protected:
  static std::unique_ptr<RecordedSource> open(const RecordedSourceOptions& options) {
    Result<std::unique_ptr<RecordedSource>> source = RecordedSource::open(options);
    EXPECT_TRUE(source.ok()) << source.status().message();
    return std::move(source).value();
  }
  static std::string refusal(const RecordedSourceOptions& options, StatusCode code = StatusCode::bad_file) {
    const Result<std::unique_ptr<RecordedSource>> source = RecordedSource::open(options);
    EXPECT_EQ(source.status().code(), code);
    return std::string(source.status().message());
  }
  /// The depth of pixel (1, 0) of the next frame.
  float next(FrameSource& source) {
    DepthFrame frame;
    const Status status = source.grab(storage_, frame);
    EXPECT_TRUE(status.ok()) << status.message();
    EXPECT_EQ(frame.depth.data(), storage_.data());
    sequence_ = frame.sequence;
    return frame.at(1, 0);
  }

  BopFolder folder_;
  std::vector<float> storage_ = std::vector<float>(1000);
  std::uint64_t sequence_ = 0;
};

TEST_F(RecordedFrames, PlaysASceneOverAndOver) {
  const auto source = open({folder_.scene(), {}, {}});
  EXPECT_EQ(source->frame_count(), 2U);
  EXPECT_EQ(source->limits().maximum_width, BopFolder::width);
  EXPECT_EQ(source->limits().maximum_height, BopFolder::height);
  EXPECT_FLOAT_EQ(next(*source), 0.5F);
  EXPECT_FLOAT_EQ(source->empty_bin().at(1, 0), 4.0F);
  EXPECT_FLOAT_EQ(next(*source), 0.7F);
  EXPECT_FLOAT_EQ(source->empty_bin().at(1, 0), 0.8F);
  EXPECT_THAT(std::string(source->frame_name()), HasSubstr("000007.png"));
  EXPECT_EQ(sequence_, 2U);
  EXPECT_FLOAT_EQ(next(*source), 0.5F);
  EXPECT_EQ(sequence_, 3U);
  EXPECT_EQ(source->bytes(), 4U * BopFolder::width * BopFolder::height * sizeof(float));
}

TEST_F(RecordedFrames, PlaysASceneWithTheEmptyBinThatIsNamed) {
  RecordedSourceOptions options{folder_.scene(), {}, {}};
  folder_.write_depth("other.png", 4000);
  options.files.empty_file = folder_.root() / "other.png";
  const auto source = open(options);
  EXPECT_FLOAT_EQ(next(*source), 0.5F);
  EXPECT_FLOAT_EQ(source->empty_bin().at(1, 0), 2.0F);
  options.files.empty_file = folder_.root() / "none.png";
  EXPECT_THAT(refusal(options), HasSubstr("none.png: No such file"));
}

TEST_F(RecordedFrames, PlaysChosenImagesInTheirOrder) {
  const auto source = open({folder_.scene(), {7, 7, 0}, {}});
  EXPECT_FLOAT_EQ(next(*source), 0.7F);
  EXPECT_FLOAT_EQ(next(*source), 0.7F);
  EXPECT_FLOAT_EQ(next(*source), 0.5F);
  EXPECT_THAT(refusal({folder_.scene(), {1}, {}}), HasSubstr("no image 1"));
}

TEST_F(RecordedFrames, PlaysAFolderAndASingleFile) {
  folder_.write_depth("loose/b.png", 2000);
  folder_.write_depth("loose/a.png", 1000);
  folder_.write("loose/camera.json", R"({"fx": 600, "fy": 600, "cx": 4, "cy": 3})");
  const auto source = open({folder_.root() / "loose", {}, {}});
  EXPECT_FLOAT_EQ(next(*source), 1.0F);
  EXPECT_FLOAT_EQ(next(*source), 2.0F);
  EXPECT_TRUE(source->empty_bin().depth.empty());
  const auto single = open({folder_.root() / "loose" / "b.png", {}, {}});
  EXPECT_FLOAT_EQ(next(*single), 2.0F);
  EXPECT_FLOAT_EQ(next(*single), 2.0F);
  EXPECT_THAT(refusal({folder_.root() / "loose", {3}, {}}), HasSubstr("from a BOP scene only"));
}

TEST_F(RecordedFrames, TooManyFramesAreRefused) {
  RecordedSourceOptions options{folder_.scene(), {}, {}};
  options.maximum_bytes = 3 * BopFolder::width * BopFolder::height * sizeof(float);
  EXPECT_THAT(refusal(options, StatusCode::memory_limit), HasSubstr("by frame 2: play fewer images"));
}

TEST_F(RecordedFrames, NothingToPlayIsRefused) {
  fs::create_directory(folder_.root() / "void");
  EXPECT_THAT(refusal({folder_.root() / "void", {}, {}}), HasSubstr("void: nothing to play"));
  EXPECT_THAT(refusal({folder_.root() / "none", {}, {}}), HasSubstr("No such file"));
  fs::remove(folder_.scene() / "depth" / "000007.png");
  EXPECT_THAT(refusal({folder_.scene(), {}, {}}), HasSubstr("000007.png: no such file"));
}

TEST_F(RecordedFrames, StorageThatIsTooSmallIsRefused) {
  const auto source = open({folder_.scene(), {}, {}});
  DepthFrame frame;
  const Status status = source->grab(std::span(storage_).first(10), frame);
  EXPECT_EQ(status.code(), StatusCode::bad_frame);
  EXPECT_TRUE(frame.depth.empty());
}

}  // namespace
}  // namespace graspd
