// Files as people and programs write them, off the letter of their formats.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/mesh/scan.h"
#include "tests/core/read_mesh_fixture.h"
#include "tests/support/meshes.h"
#include "tests/support/packing.h"

namespace arris {
namespace {

using namespace testing;

TEST_F(ReadMesh, AsciiStlWithKeywordsInTwoWordsOrGlued) {
  const std::string plain = ascii_stl(pyramid_points, pyramid);
  const auto with = [&](std::initializer_list<std::pair<std::string, std::string>> changes) {
    std::string text = plain;
    for (const auto& [from, to] : changes)
      for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
  };
  for (const std::string& text :
       {with({{"endloop", "end loop"}}), with({{"endfacet", "end facet"}}),
        with({{"endsolid part", "end solid part"}}), with({{"endsolid part", "endsolidpart"}}),
        with({{"outer loop", "outerloop"}}), with({{"facet normal 0 0 1", "facet 0 0 1"}}),
        with({{"facet normal 0 0 1", "facet"}}),
        with({{"facet normal 0 0 1", "facet normal -nan(ind) -nan(ind) nan"}}),
        with({{"endloop", "END LOOP"}, {"facet normal", "Facet Normal"}}),
        with({{"solid part of 3 words", "solid"}}), "\n\n  " + plain, "solid first\n" + plain,
        "solid empty\nendsolid\n" + plain + "solid\nendsolid empty\n",
        with({{"solid part", "solidpart"}}), "facet" + plain.substr(plain.find(" normal"))}) {
    const Result<PolygonFile> file = read("a.stl", text);
    expect_welded_pyramid(file);
    EXPECT_EQ(file->format, "STL (ASCII)");
    if (!text.starts_with("facet")) {
      EXPECT_TRUE(file->notes.empty()) << file->notes.front();
    }
  }
}

TEST_F(ReadMesh, AsciiStlWithSeveralSolids) {
  const std::vector<Triangle> low(pyramid.begin(), pyramid.begin() + 3),
      high(pyramid.begin() + 3, pyramid.end());
  const std::string a = ascii_stl(pyramid_points, low), b = ascii_stl(pyramid_points, high);
  expect_welded_pyramid(read("a.stl", a + b));
  expect_welded_pyramid(read("b.stl", a + "\n\n" + b + "\n"));
  std::string one_line = a + b;
  std::replace(one_line.begin(), one_line.end(), '\n', ' ');
  expect_welded_pyramid(read("c.stl", one_line));
  const Result<PolygonFile> file = read("d.stl", a + "; made by hand\n" + b + "; two parts\n");
  expect_welded_pyramid(file);
  EXPECT_TRUE(says(*file, "something else, first in line 24"));
}

TEST_F(ReadMesh, AsciiStlWithoutItsEndsIsReadAndTold) {
  std::string text = ascii_stl(pyramid_points, pyramid);
  const std::string all = text;
  text.resize(text.find("endsolid"));
  const Result<PolygonFile> file = read("a.stl", text);
  expect_welded_pyramid(file);
  EXPECT_TRUE(says(*file, "ends without \"endsolid\" after triangle 6"));
  for (const std::string end : {" endfacet\n", "  endloop\n"}) {
    text = all;
    text.erase(text.find(end), end.size());
    const Result<PolygonFile> short_of_one = read("b.stl", text);
    expect_welded_pyramid(short_of_one);
    EXPECT_TRUE(says(*short_of_one, "1 triangle lacks its \"endfacet\" or \"endloop\""));
  }
  // Two vertices, or four, are no triangle, whatever stands round them.
  text = all;
  text.erase(text.find("   vertex"),
             text.find('\n', text.find("   vertex")) + 1 - text.find("   vertex"));
  EXPECT_NE(error("c.stl", text).find("line 6: expected \"vertex\""), std::string::npos);
}

TEST_F(ReadMesh, DecimalCommasAreNamed) {
  const std::string comma = "a decimal comma: numbers need a decimal point.";
  EXPECT_NE(error("a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1,5 0 0\n")
                .find("line 5: expected a coordinate, found \"1,5\", " + comma),
            std::string::npos);
  EXPECT_NE(error("a.obj", "v 0 0 0\nv 1 -2,5e1 0\n").find("line 2: vertex 1 needs"),
            std::string::npos);
  EXPECT_NE(error("a.obj", "v 0 0 0\nv 1 -2,5e1 0\n").find(comma), std::string::npos);
  EXPECT_NE(error("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 ,5 0\n3 0 1 2\n").find(comma),
            std::string::npos);
  std::string ply = ascii_ply;
  ply.replace(ply.find(".5 +5e-1"), 2, "0,5");
  EXPECT_NE(error("a.ply", ply).find(comma), std::string::npos);
  // Commas between numbers are no decimal commas.
  const std::string listed =
      "solid\nfacet normal 0.0, 0.0, 1.0\nouter loop\nvertex 0.0, 0.0, 0.5\nvertex 1.5, 0, 0\n"
      "vertex 0, 1, 0\nendloop\nendfacet\nendsolid\n";
  const Result<PolygonFile> file = read("b.stl", listed);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->points, (std::vector<Point>{{0, 0, 0.5}, {1.5, 0, 0}, {0, 1, 0}}));
}

TEST_F(ReadMesh, TheLengthOfABinaryStlDecides) {
  const std::string right = binary_stl(pyramid_points, pyramid);
  const auto with_count = [&](std::uint32_t count) {
    std::string count_bytes;
    put(count_bytes, count);
    return right.substr(0, 80) + count_bytes + right.substr(84);
  };
  for (const std::uint32_t count : {0u, 1u, 5u, 7u, 0xFFFFFFFFu}) {
    const Result<PolygonFile> file = read("a.stl", with_count(count));
    expect_welded_pyramid(file);
    EXPECT_TRUE(says(*file, "announces " + std::to_string(count) + " triangles"));
    EXPECT_TRUE(says(*file, "the length of 6"));
  }
  // What follows the triangles is no triangle, even where it has the length of some.
  for (const std::size_t size : {38u, 100u, 138u}) {
    const Result<PolygonFile> file = read("b.stl", right + std::string(size, 'x'));
    expect_welded_pyramid(file);
    EXPECT_TRUE(says(*file, std::to_string(size) + " more bytes follow"));
  }
  EXPECT_TRUE(read("c.stl", right)->notes.empty());
  EXPECT_TRUE(read("d.stl", right + std::string(3, '\0'))->notes.empty()) << "padding";
  EXPECT_NE(error("e.stl", right.substr(0, 80) + right.substr(84)).find("is damaged"),
            std::string::npos)
      << "no count at all";
}

TEST_F(ReadMesh, OffAsGeomviewReadsIt) {
  const std::string vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n.5 .5 1\n";
  const std::string faces = "4 0 3 2 1\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";
  const auto flat = [](std::string text, char instead) {
    std::replace(text.begin(), text.end(), '\n', instead);
    return text;
  };
  const std::string spread = flat(vertices + faces, ' ');
  std::string one_a_line = "OFF 5 5 8 " + spread;
  std::replace(one_a_line.begin(), one_a_line.end(), ' ', '\n');
  std::string coloured_faces, coloured_vertices, commented;
  for (const char c : faces)
    coloured_faces += c == '\n' ? std::string(" 0.5 0.5 0.5 1\n") : std::string(1, c);
  for (const char c : vertices)
    coloured_vertices += c == '\n' ? std::string(" 9 8 7 255\n") : std::string(1, c);
  for (const char c : vertices + faces)
    commented += c == '\n' ? std::string("# 3 0 1 2\n#\n") : std::string(1, c);
  for (const std::string& text :
       {"OFF5 5 8\n" + vertices + faces, "OFF5 5 8\r\n" + vertices + faces,
        "COFF5 5 8\n" + coloured_vertices + faces, "OFF\n5\n5\n8\n" + vertices + faces,
        "OFF\n5 5\n8\n" + vertices + faces, "OFF\n5\n5 8 0 0 0\n" + vertices.substr(6) + faces,
        "OFF\n5\n5\n" + vertices + faces, one_a_line, "OFF 5 5 8 " + spread,
        "OFF\n5 5 8\n" + flat(vertices, ' ') + "\n" + flat(faces, ' '),
        "OFF\n5 5 8\n" + flat(vertices, ' ') + "\n" + coloured_faces,
        "OFF\n5 5 8\n" + coloured_vertices + coloured_faces,
        "COFF\n5 5 8\n" + flat(coloured_vertices, ' ') + "\n" + flat(faces, ' '),
        "# first\nOFF# here\n# there\n5 5# 7\n" + commented, "nOFF\n3\n5 5 8\n" + vertices + faces,
        "OFF\n5 5 8\n" + vertices + flat(faces.substr(0, 20), ' ') + faces.substr(20)}) {
    SCOPED_TRACE(text);
    expect_pyramid_with_square(read("a.off", text));
    expect_pyramid_with_square(read("unnamed", text));
  }
  // Counts that do not fit are an error and never another mesh.
  error("b.off", "OFF\n5\n6\n8\n" + vertices + faces);
  error("c.off", "OFF\n4\n5\n8\n" + vertices + faces);
  error("d.off", one_a_line.substr(0, one_a_line.size() - 2));
}

TEST_F(ReadMesh, PlyStripsOfTriangles) {
  // Two strips in one list, the second of which uses a repeated vertex to turn.
  const auto ply = [](const std::string& format, const std::string& type) {
    return "ply\nformat " + format +
           " 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
           "property float z\nelement tristrips 1\nproperty list int " +
           type + " vertex_indices\nend_header\n";
  };
  const std::vector<Point> points{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  const std::vector<int> list{0, 2, 1, 3, -1, 2, 4, 3, 3, 5};
  const std::vector<VertexId> expected{0, 2, 1, 1, 2, 3, 2, 4, 3};
  std::string text = ply("ascii", "int");
  for (const Point& p : points)
    text += std::to_string(p.x()) + " " + std::to_string(p.y()) + " 0\n";
  text += std::to_string(list.size());
  for (const int v : list) text += " " + std::to_string(v);
  const auto expect_strips = [&](const std::string& name, const std::string& content) {
    const Result<PolygonFile> file = read(name, content);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->points, points);
    EXPECT_EQ(file->corners, expected);
    EXPECT_EQ(file->starts, (std::vector<std::uint64_t>{0, 3, 6, 9}));
  };
  expect_strips("a.ply", text + "\n");
  for (const bool big : {false, true})
    for (const std::string type : {"int", "uint", "short", "char"}) {
      std::string binary = ply(big ? "binary_big_endian" : "binary_little_endian", type);
      for (const Point& p : points)
        for (const double x : p) put(binary, static_cast<float>(x), big);
      put(binary, static_cast<std::int32_t>(list.size()), big);
      for (const int v : list) {
        if (type == "char")
          put(binary, static_cast<std::int8_t>(v), big);
        else if (type == "short")
          put(binary, static_cast<std::int16_t>(v), big);
        else
          put(binary, static_cast<std::int32_t>(v), big);
      }
      expect_strips("b.ply", binary);
    }
  text.replace(text.rfind("5"), 1, "6");
  EXPECT_NE(error("c.ply", text).find("names vertex 6"), std::string::npos);
}

TEST_F(ReadMesh, PlyOfEveryType) {
  // A triangle whose coordinates, indices and lengths are of each type there is, by either name.
  const std::vector<std::pair<std::string, std::string>> types{
      {"char", "int8"}, {"uchar", "uint8"}, {"short", "int16"},   {"ushort", "uint16"},
      {"int", "int32"}, {"uint", "uint32"}, {"float", "float32"}, {"double", "float64"}};
  const auto put_as = [](std::string& out, std::size_t type, int value, bool big) {
    switch (type) {
      case 0:
        return put(out, static_cast<std::int8_t>(value), big);
      case 1:
        return put(out, static_cast<std::uint8_t>(value), big);
      case 2:
        return put(out, static_cast<std::int16_t>(value), big);
      case 3:
        return put(out, static_cast<std::uint16_t>(value), big);
      case 4:
        return put(out, static_cast<std::int32_t>(value), big);
      case 5:
        return put(out, static_cast<std::uint32_t>(value), big);
      case 6:
        return put(out, static_cast<float>(value), big);
      default:
        return put(out, static_cast<double>(value), big);
    }
  };
  for (const bool second_name : {false, true})
    for (const bool big : {false, true})
      for (std::size_t coordinate = 0; coordinate < 8; ++coordinate)
        for (std::size_t count = 0; count < 6; ++count)
          for (std::size_t index = 0; index < 6; ++index) {
            const auto name = [&](std::size_t k) {
              return second_name ? types[k].second : types[k].first;
            };
            std::string content = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                                  "_endian 1.0\nelement face 1\nproperty list " + name(count) +
                                  " " + name(index) + " vertex_index\nelement vertex 3\nproperty " +
                                  name(coordinate) + " z\nproperty " + name(coordinate) +
                                  " x\nproperty " + name(coordinate) + " y\nend_header\n";
            put_as(content, count, 3, big);
            for (int v = 0; v < 3; ++v) put_as(content, index, v, big);
            for (const int x : {7, 0, 0, 7, 100, 0, 7, 0, 50}) put_as(content, coordinate, x, big);
            const Result<PolygonFile> file = read("a.ply", content);
            ASSERT_TRUE(file) << file.error().message;
            EXPECT_EQ(file->points, (std::vector<Point>{{0, 0, 7}, {100, 0, 7}, {0, 50, 7}}));
            EXPECT_EQ(file->corners, (std::vector<VertexId>{0, 1, 2}));
          }
}

}  // namespace
}  // namespace arris
