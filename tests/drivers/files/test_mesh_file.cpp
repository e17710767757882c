#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "drivers/files/mesh_file.hpp"
#include "tests/drivers/files/bytes.hpp"
#include "tests/drivers/files/temporary_folder.hpp"

namespace graspd {
namespace {

using ::testing::HasSubstr;

class MeshFile : public ::testing::Test {
 protected:
  Result<Mesh> read(const std::string& name, std::string_view content, LengthUnit unit = LengthUnit::millimetres) {
    return read_mesh(folder_.write(name, content), unit);
  }
  /// The message with which a file is refused.
  std::string refusal(const std::string& name, std::string_view content) {
    const Result<Mesh> mesh = read(name, content);
    EXPECT_EQ(mesh.status().code(), StatusCode::bad_file);
    return std::string(mesh.status().message());
  }

  TemporaryFolder folder_;
};

float area_of(const Mesh& mesh) {
  float area = 0;
  for (const Triangle& t : mesh.triangles) {
    area += 0.5F * (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]).norm();
  }
  return area;
}

constexpr const char* ascii_ply =
    "ply\nformat ascii 1.0\ncomment a square\nelement vertex 4\nproperty float z\nproperty uchar red\n"
    "property double x\nproperty float y\nelement face 1\nproperty list uchar int vertex_index\nend_header\n"
    "1 255 0 0\n1 255 2000 0\n1 255 2000 1000\n1 255 0 1000\n4 0 1 2 3\n";

TEST_F(MeshFile, AsciiPlyInAnyPropertyOrderWithPolygons) {
  const Result<Mesh> mesh = read("a.ply", ascii_ply);
  ASSERT_TRUE(mesh.ok()) << mesh.status().message();
  ASSERT_EQ(mesh.value().vertices.size(), 4U);
  EXPECT_TRUE(mesh.value().vertices[2].isApprox(Vector3(2.0F, 1.0F, 0.001F)));
  EXPECT_EQ(mesh.value().triangles.size(), 2U);
  EXPECT_NEAR(area_of(mesh.value()), 2.0F, 1e-6F);
  EXPECT_TRUE(read("b.PLY", ascii_ply).ok());
}

TEST_F(MeshFile, BinaryPlyOfBothByteOrders) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    std::string bytes = "ply\nformat binary_";
    bytes += order == std::endian::little ? "little" : "big";
    bytes +=
        "_endian 1.0\nelement material 1\nproperty list uchar ushort ids\nelement vertex 3\nproperty float x\n"
        "property float y\nproperty short z\nelement face 1\nproperty uchar flags\n"
        "property list uint uint vertex_indices\nend_header\n";
    append_value<std::uint8_t>(bytes, 2, order);
    append_value<std::uint16_t>(bytes, 7, order);
    append_value<std::uint16_t>(bytes, 8, order);
    for (int i = 0; i < 3; ++i) {
      append_value<float>(bytes, i == 1 ? 3000.0F : 0.0F, order);
      append_value<float>(bytes, i == 2 ? 4000.0F : 0.0F, order);
      append_value<std::int16_t>(bytes, -5, order);
    }
    append_value<std::uint8_t>(bytes, 1, order);
    append_value<std::uint32_t>(bytes, 3, order);
    for (std::uint32_t i = 0; i < 3; ++i) append_value<std::uint32_t>(bytes, i, order);
    const Result<Mesh> mesh = read("a.ply", bytes);
    ASSERT_TRUE(mesh.ok()) << mesh.status().message();
    EXPECT_TRUE(mesh.value().vertices[1].isApprox(Vector3(3.0F, 0.0F, -0.005F)));
    EXPECT_NEAR(area_of(mesh.value()), 6.0F, 1e-5F);
    for (std::size_t cut = 1; cut < 40; cut += 6) {
      EXPECT_THAT(refusal("cut.ply", bytes.substr(0, bytes.size() - cut)), HasSubstr("cut short"));
    }
  }
}

TEST_F(MeshFile, BadPlyIsRefusedWithItsLine) {
  const std::string good = ascii_ply;
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(refusal("a.ply", changed("ply", "plx")), HasSubstr("a.ply:1: not a PLY"));
  EXPECT_THAT(refusal("a.ply", changed("property double x", "property wide x")), HasSubstr("a.ply:7: "));
  EXPECT_THAT(refusal("a.ply", changed("property double x", "property double q")),
              HasSubstr("no properties x, y and z"));
  EXPECT_THAT(refusal("a.ply", changed("format ascii 1.0\n", "")), HasSubstr("no format line"));
  EXPECT_THAT(refusal("a.ply", changed("end_header\n", "")), HasSubstr("a.ply:11: "));
  EXPECT_THAT(refusal("a.ply", changed("2000 1000", "nan 1000")), HasSubstr("a.ply:14: vertex 2 has coordinates"));
  EXPECT_THAT(refusal("a.ply", changed("4 0 1 2 3", "4 0 1 2 4")), HasSubstr("a.ply:16: face 0 names vertex 4"));
  EXPECT_THAT(refusal("a.ply", changed("4 0 1 2 3", "4 0 1 2 -1")), HasSubstr("a.ply:16: face 0 names vertex -1"));
  EXPECT_THAT(refusal("a.ply", changed("4 0 1 2 3\n", "")), HasSubstr("face 0 of 1 cannot be read"));
  EXPECT_THAT(refusal("a.ply", changed("element face 1", "element face 0")), HasSubstr("no faces"));
  EXPECT_THAT(refusal("a.ply", changed("vertex 4", "vertex 4000000000")), HasSubstr("cut short"));
  EXPECT_THAT(refusal("a.ply", changed("vertex 4", "vertex 99999999999999")), HasSubstr("more vertices than"));
  EXPECT_THAT(refusal("a.ply", ""), HasSubstr("not a PLY"));
}

TEST_F(MeshFile, WrongUnitIsTold) {
  const std::string_view triangle = "v 0 0 0\nv 0.03 0 0\nv 0 0.04 0\nf 1 2 3\n";
  EXPECT_TRUE(read("a.obj", triangle, LengthUnit::metres).ok());
  const Result<Mesh> inches = read("a.obj", triangle, LengthUnit::inches);
  ASSERT_TRUE(inches.ok()) << inches.status().message();
  EXPECT_NEAR(area_of(inches.value()), 0.0254F * 0.0254F * area_of(read("a.obj", triangle, LengthUnit::metres).value()),
              1e-9F);
  EXPECT_THAT(refusal("a.obj", triangle), HasSubstr("a.obj: 0.05 mm across when it is read in millimetres"));
  const Result<Mesh> large = read("b.obj", "v 0 0 0\nv 30 0 0\nv 0 40 0\nf 1 2 3\n", LengthUnit::metres);
  EXPECT_THAT(std::string(large.status().message()), HasSubstr("b.obj: 50000 mm across when it is read in metres"));
}

std::string binary_stl(int triangles, float corner = 1000.0F) {
  std::string bytes = "solid but binary all the same";
  bytes.resize(80, ' ');
  append_value<std::uint32_t>(bytes, static_cast<std::uint32_t>(triangles));
  for (int i = 0; i < triangles; ++i) {
    for (int j = 0; j < 12; ++j) append_value<float>(bytes, j == 6 || j == 10 ? corner : (j == 3 ? -0.0F : 0.0F));
    append_value<std::uint16_t>(bytes, 0);
  }
  return bytes;
}

TEST_F(MeshFile, BinaryStlMergesCorners) {
  const Result<Mesh> mesh = read("a.stl", binary_stl(2));
  ASSERT_TRUE(mesh.ok()) << mesh.status().message();
  EXPECT_EQ(mesh.value().vertices.size(), 3U);
  EXPECT_EQ(mesh.value().triangles.size(), 2U);
  EXPECT_NEAR(area_of(mesh.value()), 1.0F, 1e-6F);
}

TEST_F(MeshFile, BadBinaryStlIsRefused) {
  EXPECT_THAT(refusal("a.stl", binary_stl(2).substr(0, 180)), HasSubstr("a.stl: byte 180: the file ends here"));
  EXPECT_THAT(refusal("a.stl", "short"), HasSubstr("too short"));
  EXPECT_THAT(refusal("a.stl", binary_stl(1, std::numeric_limits<float>::quiet_NaN())),
              HasSubstr("a.stl: byte 84: coordinates that are not numbers"));
  EXPECT_THAT(refusal("a.stl", binary_stl(0)), HasSubstr("no faces"));
}

constexpr const char* ascii_stl =
    "solid part\r\n facet normal 0 0 1\r\n  outer loop\r\n   vertex 0 0 0\r\n   vertex 1e3 0 0\r\n"
    "   vertex 0 +1000.0 0\r\n  endloop\r\n endfacet\r\nendsolid part\r\n";

TEST_F(MeshFile, AsciiStl) {
  const Result<Mesh> mesh = read("a.stl", ascii_stl);
  ASSERT_TRUE(mesh.ok()) << mesh.status().message();
  EXPECT_NEAR(area_of(mesh.value()), 0.5F, 1e-6F);
}

TEST_F(MeshFile, AsciiStlInCapitals) {
  std::string capitals = ascii_stl;
  std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  const Result<Mesh> mesh = read("a.stl", capitals);
  ASSERT_TRUE(mesh.ok()) << mesh.status().message();
  EXPECT_NEAR(area_of(mesh.value()), 0.5F, 1e-6F);
}

TEST_F(MeshFile, BadAsciiStlIsRefusedWithItsLine) {
  const std::string good = ascii_stl;
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(refusal("a.stl", changed("1e3", "abc")), HasSubstr("a.stl:5: a vertex must have three numbers"));
  EXPECT_THAT(refusal("a.stl", changed("1e3", "inf")), HasSubstr("a.stl:5: coordinates"));
  EXPECT_THAT(refusal("a.stl", changed("   vertex 0 0 0\r\n", "")), HasSubstr("a.stl:6: a facet with fewer"));
  EXPECT_THAT(refusal("a.stl", changed("endsolid part\r\n", "")), HasSubstr("a.stl:8: the file ends without endsolid"));
  EXPECT_THAT(refusal("a.stl", changed("endloop", "rubbish")), HasSubstr("a.stl:7: not a line of an STL"));
  EXPECT_THAT(refusal("a.stl", "solid nothing\nendsolid nothing\n"), HasSubstr("no faces"));
}

TEST_F(MeshFile, ObjLinesGoOnBehindABackslash) {
  const Result<Mesh> mesh = read("a.obj",
                                 "# C:\\parts\\\nv 0 0 0\nv 1000 \\\r\n 0 0\r\nv 1000 1000 0\nv 0 1000 0\n"
                                 "f 1/1/1\\\n2/1/1 3/1/1\\\n4//1\nf 1 2 3\\");
  ASSERT_TRUE(mesh.ok()) << mesh.status().message();
  EXPECT_NEAR(area_of(mesh.value()), 1.5F, 1e-5F);
  EXPECT_THAT(refusal("b.obj", "v 0 0 0\nv 1 0 0\nf 1 \\\n2 \\\n3\n"), HasSubstr("b.obj:3: a face names a vertex"));
}

TEST_F(MeshFile, ObjWithAllKindsOfCorners) {
  const Result<Mesh> mesh = read("a.obj",
                                 "# a house's front\nmtllib x.mtl\nv 0 0 0\nv 1000 0 0 1.0\nv 1000 1000 0\n"
                                 "vt 0 0\nvn 0 0 1\nv 0 1000 0\nv 500 1500 0\n"
                                 "f 1/1/1 2/1/1 3/1/1 4//1\nf -3 -1 -2 # the gable\n");
  ASSERT_TRUE(mesh.ok()) << mesh.status().message();
  EXPECT_EQ(mesh.value().triangles.size(), 3U);
  EXPECT_NEAR(area_of(mesh.value()), 1.25F, 1e-5F);
  EXPECT_EQ(mesh.value().triangles[2], (Triangle{2, 4, 3}));
}

TEST_F(MeshFile, ConcavePolygonIsNotOverfilled) {
  // An L of three unit squares, started at its tip, so that a fan would reach outside.
  const Result<Mesh> mesh =
      read("a.obj", "v 0 2 0\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nf 3 4 5 6 1 2\n", LengthUnit::metres);
  ASSERT_TRUE(mesh.ok());
  EXPECT_EQ(mesh.value().triangles.size(), 4U);
  EXPECT_NEAR(area_of(mesh.value()), 3.0F, 1e-5F);
}

TEST_F(MeshFile, BadObjIsRefusedWithItsLine) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_THAT(refusal("a.obj", corners + "f 1 2 4\n"), HasSubstr("a.obj:4: a face names a vertex that there is not"));
  EXPECT_THAT(refusal("a.obj", corners + "f 1 2 0\n"), HasSubstr("a.obj:4: "));
  EXPECT_THAT(refusal("a.obj", corners + "f 1 2 -4\n"), HasSubstr("a.obj:4: "));
  EXPECT_THAT(refusal("a.obj", corners + "f 1 2\n"), HasSubstr("a.obj:4: a face with fewer than three"));
  EXPECT_THAT(refusal("a.obj", corners + "f 1 2 x\n"), HasSubstr("a.obj:4: a face must name"));
  EXPECT_THAT(refusal("a.obj", "v 0 0\n"), HasSubstr("a.obj:1: a vertex must have three numbers"));
  EXPECT_THAT(refusal("a.obj", "v 0 0 nan\n"), HasSubstr("a.obj:1: coordinates that are not numbers"));
  EXPECT_THAT(refusal("a.obj", corners), HasSubstr("a.obj: no faces"));
}

TEST_F(MeshFile, UnknownKindAndMissingFile) {
  EXPECT_THAT(refusal("part.step", "ISO-10303-21;"), HasSubstr("use .ply, .stl or .obj"));
  const Result<Mesh> missing = read_mesh(folder_.path() / "none.ply", LengthUnit::metres);
  EXPECT_EQ(missing.status().code(), StatusCode::bad_file);
  EXPECT_THAT(std::string(missing.status().message()), HasSubstr("No such file"));
}

}  // namespace
}  // namespace graspd
