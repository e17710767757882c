#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "firmware_app/snapshot_writer.hpp"
#include "tests/firmware_app/temporary_folder.hpp"

namespace graspd {
namespace {

namespace fs = std::filesystem;

TEST(SnapshotWriter, KeepsTheNewestAlthoughTheClockWasSetBack) {
  const TemporaryFolder folder;
  const fs::path snapshots = folder.path("kept");
  for (const char* time : {"20990101T000001", "20990101T000002"}) {
    fs::create_directories(snapshots / (std::string("snapshot_") + time + ".000Z_request_1"));
  }
  ASSERT_TRUE(prepare_snapshots(snapshots).ok());
  std::vector<float> depth(12, 0.5F);
  std::vector<float> memory(depth.size());
  {
    SnapshotWriter writer(snapshots, 2, memory);
    writer.offer({Camera{4, 3, 4, 4, 1.5F, 1}, depth, 0, 1}, 7);
  }
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(snapshots)) names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  ASSERT_EQ(names.size(), 2U);
  EXPECT_TRUE(names[0].ends_with("_request_7")) << names[0];
  EXPECT_EQ(names[1], "snapshot_20990101T000002.000Z_request_1") << "the older of the two gave way";
}

}  // namespace
}  // namespace graspd
