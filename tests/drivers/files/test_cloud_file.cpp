#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "drivers/files/cloud_file.hpp"
#include "drivers/files/lzf.hpp"
#include "tests/drivers/files/bytes.hpp"
#include "tests/drivers/files/temporary_folder.hpp"

namespace graspd {
namespace {

using ::testing::HasSubstr;

class CloudFile : public ::testing::Test {
 protected:
  Result<Cloud> read(const std::string& name, std::string_view content, LengthUnit unit = LengthUnit::metres,
                     CameraAxes axes = CameraAxes::opencv) {
    return read_cloud(folder_.write(name, content), unit, axes);
  }
  std::string refusal(const std::string& name, std::string_view content) {
    const Result<Cloud> cloud = read(name, content);
    EXPECT_EQ(cloud.status().code(), StatusCode::bad_file);
    return std::string(cloud.status().message());
  }

  TemporaryFolder folder_;
};

/// A PCD header for three columns and two rows of points with an extra field between y and z.
std::string pcd_header(const std::string& data) {
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y normal z\nSIZE 4 4 4 8\nTYPE F F F F\nCOUNT 1 1 2 1\nWIDTH 3\nHEIGHT 2\n"
         "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 6\nDATA " +
         data + "\n";
}

void expect_pcd_points(const Result<Cloud>& cloud) {
  ASSERT_TRUE(cloud.ok()) << cloud.status().message();
  EXPECT_TRUE(cloud.value().organised());
  EXPECT_EQ(cloud.value().width, 3);
  ASSERT_EQ(cloud.value().points.size(), 6U);
  EXPECT_TRUE(cloud.value().points[4].isApprox(Vector3(4.0F, 40.0F, 400.0F)));
  EXPECT_TRUE(std::isnan(cloud.value().points[5].z()));
}

float z_of(int i) { return i == 5 ? std::nanf("") : 100.0F * static_cast<float>(i); }

std::string binary_points() {
  std::string bytes;
  for (int i = 0; i < 6; ++i) {
    append_value<float>(bytes, static_cast<float>(i));
    append_value<float>(bytes, 10.0F * static_cast<float>(i));
    append_value<float>(bytes, 0.5F);
    append_value<float>(bytes, 0.5F);
    append_value<double>(bytes, static_cast<double>(z_of(i)));
  }
  return bytes;
}

TEST_F(CloudFile, AsciiPcd) {
  std::string text = pcd_header("ascii");
  for (int i = 0; i < 5; ++i) {
    text += std::to_string(i) + " " + std::to_string(10 * i) + " 0.5 0.5 " + std::to_string(100 * i) + "\n";
  }
  expect_pcd_points(read("a.pcd", text + "nan nan 0 0 nan\n"));
  EXPECT_THAT(refusal("a.pcd", text), HasSubstr("a.pcd:16: the file ends after 5 of 6 points"));
  EXPECT_THAT(refusal("a.pcd", text + "1 2 3\n"), HasSubstr("a.pcd:17: field normal is not a number"));
}

TEST_F(CloudFile, BinaryPcd) {
  expect_pcd_points(read("a.pcd", pcd_header("binary") + binary_points()));
  EXPECT_THAT(refusal("a.pcd", pcd_header("binary") + binary_points().substr(1)), HasSubstr("cut short"));
}

TEST_F(CloudFile, CompressedPcd) {
  std::string fields;
  for (int i = 0; i < 6; ++i) append_value<float>(fields, static_cast<float>(i));
  for (int i = 0; i < 6; ++i) append_value<float>(fields, 10.0F * static_cast<float>(i));
  const std::size_t before_normals = fields.size();
  for (int i = 0; i < 12; ++i) append_value<float>(fields, 0.5F);
  const std::size_t after_normals = fields.size();
  for (int i = 0; i < 6; ++i) append_value<double>(fields, static_cast<double>(z_of(i)));

  // Literal runs, and the normals as one repetition of their first four bytes.
  std::string packed;
  const auto append_literal = [&](std::size_t begin, std::size_t end) {
    for (; begin < end; begin += 32) {
      const std::size_t length = std::min<std::size_t>(32, end - begin);
      packed += static_cast<char>(length - 1);
      packed += fields.substr(begin, length);
    }
  };
  append_literal(0, before_normals + 4);
  packed += static_cast<char>(7 << 5);
  packed += static_cast<char>(after_normals - before_normals - 4 - 9);
  packed += static_cast<char>(3);
  append_literal(after_normals, fields.size());

  std::string body;
  append_value<std::uint32_t>(body, static_cast<std::uint32_t>(packed.size()));
  append_value<std::uint32_t>(body, static_cast<std::uint32_t>(fields.size()));
  body += packed;
  expect_pcd_points(read("a.pcd", pcd_header("binary_compressed") + body));
  EXPECT_THAT(refusal("a.pcd", pcd_header("binary_compressed") + body.substr(0, body.size() - 1)),
              HasSubstr("cut short"));
  body[8] = '\xFF';
  EXPECT_THAT(refusal("a.pcd", pcd_header("binary_compressed") + body), HasSubstr("cannot be unpacked"));
}

TEST_F(CloudFile, DamagedCompressionNeverRunsOver) {
  std::string unpacked;
  EXPECT_FALSE(unpack_lzf(std::string("\x20\x00", 2), 3, unpacked));
  EXPECT_FALSE(unpack_lzf(std::string("\xE0", 1), 300, unpacked));
  EXPECT_FALSE(unpack_lzf(std::string("\x05"
                                      "ab",
                                      3),
                          6, unpacked));
  EXPECT_TRUE(unpack_lzf(std::string("\x00"
                                     "a\x40\x00",
                                     4),
                         5, unpacked));
  EXPECT_EQ(unpacked, "aaaaa");
}

TEST_F(CloudFile, BadPcdHeaderIsRefusedWithItsLine) {
  const std::string good = pcd_header("binary");
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(refusal("a.pcd", changed("SIZE 4 4 4 8", "SIZE 4 4")), HasSubstr("a.pcd:4: PCD header line"));
  EXPECT_THAT(refusal("a.pcd", changed("TYPE F F F F", "TYPE F F F X")), HasSubstr("a.pcd:5: "));
  EXPECT_THAT(refusal("a.pcd", changed("FIELDS x y normal z", "FIELDS x y normal w")),
              HasSubstr("no fields x, y and z"));
  EXPECT_THAT(refusal("a.pcd", changed("TYPE F F F F", "TYPE F F F U")), HasSubstr("must be of TYPE F"));
  EXPECT_THAT(refusal("a.pcd", changed("POINTS 6", "POINTS 7")), HasSubstr("POINTS is not WIDTH times HEIGHT"));
  EXPECT_THAT(refusal("a.pcd", changed("WIDTH 3", "WIDTH 99999999999")), HasSubstr("too many"));
  EXPECT_THAT(refusal("a.pcd", changed("DATA binary", "DATA zip")), HasSubstr("a.pcd:11: "));
  EXPECT_THAT(refusal("a.pcd", "VERSION 0.7\n"), HasSubstr("no DATA line"));
  EXPECT_THAT(refusal("a.xyz", "0 0 0\n"), HasSubstr("neither a PLY nor a PCD"));
}

constexpr const char* ply_cloud =
    "ply\nformat ascii 1.0\nobj_info num_cols 2\nobj_info num_rows 2\nelement vertex 3\nproperty float x\n"
    "property float y\nproperty float z\nelement range_grid 4\nproperty list uchar int vertex_indices\nend_header\n"
    "1 2 -500\n0 0 0\nnan 0 0\n1 2\n0\n1 0\n1 1\n";

TEST_F(CloudFile, PlyOfUnitsAxesAndGrid) {
  const Result<Cloud> cloud = read("a.ply", ply_cloud, LengthUnit::millimetres, CameraAxes::opengl);
  ASSERT_TRUE(cloud.ok()) << cloud.status().message();
  EXPECT_TRUE(cloud.value().organised());
  ASSERT_EQ(cloud.value().points.size(), 4U);
  EXPECT_TRUE(cloud.value().points[2].isApprox(Vector3(0.001F, -0.002F, 0.5F)));
  for (const std::size_t missing : {0U, 1U, 3U}) EXPECT_TRUE(std::isnan(cloud.value().points[missing].x()));
}

TEST_F(CloudFile, PlyWithWidthAndHeightInComments) {
  const std::string text =
      "ply\nformat ascii 1.0\ncomment width 2\ncomment height 3\nelement vertex 6\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n0 2 1\n1 2 1\n";
  const Result<Cloud> cloud = read("a.ply", text);
  ASSERT_TRUE(cloud.ok());
  EXPECT_EQ(cloud.value().width, 2);
  EXPECT_EQ(cloud.value().height, 3);
}

TEST_F(CloudFile, CloudWithoutPointsIsRefused) {
  EXPECT_THAT(refusal("a.ply",
                      "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
                      "property float z\nend_header\n"),
              HasSubstr("without points"));
}

TEST(Conventions, WordsOfTheCommandLine) {
  EXPECT_EQ(parse_length_unit("m").value(), LengthUnit::metres);
  EXPECT_EQ(parse_length_unit("mm").value(), LengthUnit::millimetres);
  EXPECT_EQ(parse_length_unit("in").value(), LengthUnit::inches);
  EXPECT_EQ(parse_length_unit("inch").status().code(), StatusCode::bad_configuration);
  EXPECT_EQ(parse_camera_axes("opengl").value(), CameraAxes::opengl);
  EXPECT_THAT(std::string(parse_camera_axes("up").status().message()), HasSubstr("'up': use opencv"));
}

}  // namespace
}  // namespace graspd
