#include <algorithm>
#include <array>
#include <bit>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <random>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "core/mesh/polygon_file.h"
#include "core/mesh/scan.h"
#include "tests/support/meshes.h"
#include "tests/support/packing.h"
#include "tests/support/temp_folder.h"

namespace arris {
namespace {

using testing::TempFolder;
using ::testing::Test;

template <class T>
void put(std::string& out, T value, bool big_endian = false) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (big_endian == (std::endian::native == std::endian::little))
    std::reverse(raw.begin(), raw.end());
  out.append(raw.data(), raw.size());
}

/// A pyramid over the unit square: 5 points, 4 triangles and a base of 2 triangles or 1 square.
const std::vector<Point> pyramid_points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
const std::vector<Triangle> pyramid{{0, 1, 4}, {1, 2, 4}, {2, 3, 4},
                                    {3, 0, 4}, {0, 2, 1}, {0, 3, 2}};

std::string binary_stl(const std::vector<Point>& points, const std::vector<Triangle>& triangles,
                       std::string header = "a scan") {
  header.resize(80, ' ');
  std::string out = header;
  put(out, static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) put(out, 0.0f);
    for (const VertexId v : t)
      for (const double x : points[v]) put(out, static_cast<float>(x));
    put(out, std::uint16_t{0});
  }
  return out;
}

std::string ascii_stl(const std::vector<Point>& points, const std::vector<Triangle>& triangles,
                      const std::string& line_end = "\n") {
  std::string out = "solid part of 3 words" + line_end;
  for (const Triangle& t : triangles) {
    out += " facet normal 0 0 1" + line_end + "  outer loop" + line_end;
    for (const VertexId v : t)
      out += "   vertex " + std::to_string(points[v].x()) + " " + std::to_string(points[v].y()) +
             "\t" + std::to_string(points[v].z()) + line_end;
    out += "  endloop" + line_end + " endfacet" + line_end;
  }
  return out + "endsolid part of 3 words" + line_end;
}

/// Vertices with a colour, faces with a list and a flag besides, an element that nobody knows, in
/// the order element, face, vertex.
std::string rich_binary_ply(bool big_endian) {
  std::string out = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
                    "_endian 1.0\ncomment made by hand\nobj_info num_cols 512\n"
                    "element camera 2\nproperty list uchar float view\nproperty double focus\n"
                    "element face 5\nproperty uchar flag\nproperty list ushort short vertex_index\n"
                    "property list uchar float texcoord\n"
                    "element vertex 5\nproperty uchar red\nproperty double z\nproperty float x\n"
                    "property float y\nproperty short quality\nend_header\n";
  for (int camera = 0; camera < 2; ++camera) {
    put(out, static_cast<std::uint8_t>(camera), big_endian);
    for (int k = 0; k < camera; ++k) put(out, 1.5f, big_endian);
    put(out, 35.0, big_endian);
  }
  const auto face = [&](std::initializer_list<std::int16_t> corners) {
    put(out, std::uint8_t{7}, big_endian);
    put(out, static_cast<std::uint16_t>(corners.size()), big_endian);
    for (const std::int16_t v : corners) put(out, v, big_endian);
    put(out, std::uint8_t{2}, big_endian);
    put(out, 0.25f, big_endian);
    put(out, 0.75f, big_endian);
  };
  face({0, 3, 2, 1});
  for (int k = 0; k < 4; ++k)
    face({static_cast<std::int16_t>(k), static_cast<std::int16_t>((k + 1) % 4), 4});
  for (const Point& p : pyramid_points) {
    put(out, std::uint8_t{200}, big_endian);
    put(out, p.z(), big_endian);
    put(out, static_cast<float>(p.x()), big_endian);
    put(out, static_cast<float>(p.y()), big_endian);
    put(out, std::int16_t{-3}, big_endian);
  }
  return out;
}

const std::string ascii_ply =
    "ply\nformat ascii 1.0\ncomment with all that is rare\nobj_info by hand\n"
    "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
    "property list uchar int more\nproperty uchar red\n"
    "element face 5\nproperty int flag\nproperty list uchar int vertex_indices\n"
    "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n"
    "0 0 0 0 255\n1 0 0 2 7 8 255\n1 1 0 0 255\n0 1 0 1 9 255\n.5 +5e-1 1 0 255\n"
    "-1 4 0 3 2 1\n0 3 0 1 4\n0 3 1 2 4\n0 3 2 3 4\n0 3 3 0 4\n0 1\n";

const std::string obj =
    "# by hand\nmtllib part.mtl\no part\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0 1.0\nv 0 1 0\n"
    "vn 0 0 1\nvt 0 0\ns off\nf 1 4 3 2 # the base\nv 0.5 0.5 1\ng sides\nusemtl steel\n"
    "f 1/1 2/1 5/1\nf 2//1 \\\n  3//1 5//1\nf 3/1/1 4/1/1 5/1/1\nf -2 -5 -1\n";

const std::string off =
    "OFF # a comment\n# another\n5 5 8\n0 0 0\n1 0 0\n\n1 1 0 # corner\n0 1 0\n0.5 0.5 1\n"
    "4 0 3 2 1 255 0 0\n3 0 1 4\n3 1 2 4 0.5 0.5 0.5 1\n3 2 3 4\n3 3 0 4";

class ReadMesh : public Test {
 protected:
  Result<PolygonFile> read(const std::string& name, const std::string& content) {
    return read_polygon_file(folder_.write(name, content));
  }
  /// The message of the error, which must be one sentence that names the file.
  std::string error(const std::string& name, const std::string& content) {
    const Result<PolygonFile> file = read(name, content);
    if (file) {
      ADD_FAILURE() << name << " was read without an error";
      return "";
    }
    expect_sentence(file.error().message, folder_.file(name));
    return file.error().message;
  }
  static bool says(const PolygonFile& file, const std::string& text) {
    for (const std::string& note : file.notes)
      if (note.find(text) != std::string::npos) return true;
    return false;
  }
  static void expect_sentence(const std::string& message, const std::string& path) {
    EXPECT_TRUE(message.starts_with(path)) << message;
    EXPECT_TRUE(message.ends_with(".")) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  static void expect_pyramid_with_square(const Result<PolygonFile>& file) {
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->points, pyramid_points);
    EXPECT_EQ(file->starts, (std::vector<std::uint64_t>{0, 4, 7, 10, 13, 16}));
    EXPECT_EQ(file->corners,
              (std::vector<VertexId>{0, 3, 2, 1, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4}));
  }
  static void expect_welded_pyramid(const Result<PolygonFile>& file) {
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_EQ(file->polygon_count(), pyramid.size());
    EXPECT_EQ(file->points.size(), pyramid_points.size());
    EXPECT_EQ(file->welded_corners, 3 * pyramid.size() - pyramid_points.size());
    for (std::size_t k = 0; k < pyramid.size(); ++k) {
      EXPECT_EQ(file->starts[k], 3 * k);
      for (int c = 0; c < 3; ++c)
        EXPECT_EQ(file->points[file->corners[3 * k + c]], pyramid_points[pyramid[k][c]]);
    }
  }

  TempFolder folder_;
};

// ---- what is read

TEST_F(ReadMesh, BinaryStl) {
  const std::string content = binary_stl(pyramid_points, pyramid);
  const Result<PolygonFile> file = read("a.stl", content);
  expect_welded_pyramid(file);
  EXPECT_EQ(file->format, "STL (binary)");
  EXPECT_EQ(file->bytes, content.size());
  EXPECT_EQ(file->content_hash.size(), 32u);
}

TEST_F(ReadMesh, BinaryStlThatBeginsWithSolid) {
  const Result<PolygonFile> file =
      read("a.stl", binary_stl(pyramid_points, pyramid, "solid facet normal"));
  expect_welded_pyramid(file);
  EXPECT_EQ(file->format, "STL (binary)");
}

TEST_F(ReadMesh, TruncatedBinaryStlThatBeginsWithSolidIsNotTakenForText) {
  std::string content = binary_stl(pyramid_points, pyramid, "solid part");
  content.resize(content.size() - 60);
  EXPECT_NE(error("a.stl", content).find("ends in triangle 4"), std::string::npos);
}

TEST_F(ReadMesh, AsciiStl) {
  for (const std::string line_end : {"\n", "\r\n", "\r"}) {
    const Result<PolygonFile> file = read("a.stl", ascii_stl(pyramid_points, pyramid, line_end));
    expect_welded_pyramid(file);
    EXPECT_EQ(file->format, "STL (ASCII)");
  }
  const std::string upper_case =
      "SOLID\nFACET NORMAL 0 0 1 OUTER LOOP VERTEX 0 0 0 VERTEX 1 0 0 VERTEX 0 1 0 ENDLOOP "
      "ENDFACET\n"
      "ENDSOLID\n";
  ASSERT_TRUE(read("b.stl", upper_case));
  EXPECT_EQ(read("b.stl", upper_case + upper_case)->points.size(), 3u) << "two solids, one file";
}

TEST_F(ReadMesh, StlWeldsMinusZeroAndNanOnly) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const double tiny = 1e-30;
  const std::vector<Point> points{{0.0, 0, 0},     {1, 0, 0},    {0, 1, 0},
                                  {-0.0, 0, -0.0}, {tiny, 0, 0}, {nan, 0, 0}};
  const Result<PolygonFile> file =
      read("a.stl", binary_stl(points, {{0, 1, 2}, {3, 1, 4}, {5, 5, 0}}));
  ASSERT_TRUE(file);
  EXPECT_EQ(file->corners, (std::vector<VertexId>{0, 1, 2, 0, 1, 3, 4, 4, 0}));
}

TEST_F(ReadMesh, PlyInEveryEncoding) {
  expect_pyramid_with_square(read("little.ply", rich_binary_ply(false)));
  expect_pyramid_with_square(read("big.ply", rich_binary_ply(true)));
  expect_pyramid_with_square(read("text.ply", ascii_ply));
  std::string with_cr;
  for (const char c : ascii_ply) with_cr += c == '\n' ? std::string("\r\n") : std::string(1, c);
  expect_pyramid_with_square(read("crlf.ply", with_cr));
  std::string old_mac = ascii_ply;
  std::replace(old_mac.begin(), old_mac.end(), '\n', '\r');
  expect_pyramid_with_square(read("cr.ply", old_mac));
  std::string crlf_header = rich_binary_ply(false);
  const std::size_t header_end = crlf_header.find("end_header\n") + 11;
  for (std::size_t at = header_end; at-- > 0;)
    if (crlf_header[at] == '\n') crlf_header.insert(at, 1, '\r');
  expect_pyramid_with_square(read("crlf-binary.ply", crlf_header));
}

TEST_F(ReadMesh, BinaryPlyWhoseDataBeginsWithALineEnd) {
  // 0x0A in the first byte must not be taken for the rest of CR LF.
  std::string content =
      "ply\rformat binary_little_endian 1.0\relement vertex 3\rproperty uchar x\rproperty uchar y\r"
      "property uchar z\relement face 1\rproperty list uchar uchar vertex_indices\rend_header\r";
  content += std::string("\n\0\0\1\0\0\0\1\0\3\0\1\2", 13);
  const Result<PolygonFile> file = read("a.ply", content);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->points[0], Point(10, 0, 0));
}

TEST_F(ReadMesh, ObjWithEveryFormOfFace) {
  expect_pyramid_with_square(read("a.obj", obj));
  std::string with_cr;
  for (const char c : obj) with_cr += c == '\n' ? std::string("\r\n") : std::string(1, c);
  expect_pyramid_with_square(read("b.obj", with_cr));
}

TEST_F(ReadMesh, ObjFacesMayPrecedeTheirVertices) {
  const Result<PolygonFile> file = read("a.obj", "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->corners, (std::vector<VertexId>{0, 1, 2}));
}

TEST_F(ReadMesh, OffAndItsKin) {
  expect_pyramid_with_square(read("a.off", off));
  const std::string faces = "4 0 3 2 1\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";
  expect_pyramid_with_square(read("coff.off",
                                  "COFF\n5 5 0\n0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n"
                                  "1 1 0 1 0 0\n0 1 0 1 0 0\n0.5 0.5 1 0 0 0 0\n" +
                                      faces));
  expect_pyramid_with_square(read("noff.off",
                                  "NOFF\r\n5 5 0\r\n0 0 0 0 0 1\r\n1 0 0 0 0 1\r\n"
                                  "1 1 0 0 0 1\r\n0 1 0 0 0 1\r\n.5 .5 1 0 0 1\r\n" +
                                      faces));
  expect_pyramid_with_square(read("stoff.off",
                                  "STOFF 5 5 8\n0 0 0 0 0\n1 0 0 0 0\n1 1 0 0 0\n"
                                  "0 1 0 0 0\n0.5 0.5 1 1 1\n" +
                                      faces));
  expect_pyramid_with_square(
      read("same-line.off", "OFF 5 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n.5 .5 1\n" + faces));
  expect_pyramid_with_square(
      read("bare.off", "5 5 8\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n.5 .5 1\n" + faces));
}

TEST_F(ReadMesh, ContentDecidesNotTheName) {
  expect_pyramid_with_square(read("a.stl", off));
  expect_pyramid_with_square(read("b.ply", obj));
  expect_pyramid_with_square(read("c.off", ascii_ply));
  expect_welded_pyramid(read("d.obj", binary_stl(pyramid_points, pyramid)));
  expect_welded_pyramid(read("noending", ascii_stl(pyramid_points, pyramid)));
  expect_pyramid_with_square(read("mark.obj", "\xEF\xBB\xBF" + obj));
}

TEST_F(ReadMesh, NumbersOfEveryKindWhateverTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8");
  const Result<PolygonFile> file =
      read("a.obj", "v 1.5 +2.5e+0 -3E-1\nv nan -inf 1.#QNAN\nv 1e999 -1e999 1e-999\nf 1 2 3\n");
  std::setlocale(LC_ALL, before.c_str());
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->points[0], Point(1.5, 2.5, -0.3));
  EXPECT_TRUE(std::isnan(file->points[1].x()));
  EXPECT_EQ(file->points[1].y(), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(file->points[1].z()));
  EXPECT_EQ(file->points[2].x(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(file->points[2].y(), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(file->points[2].z(), 0.0);
}

TEST_F(ReadMesh, TheHashIsOfTheBytes) {
  EXPECT_EQ(read("a.off", off)->content_hash, read("b.off", off)->content_hash);
  EXPECT_NE(read("a.off", off)->content_hash, read("b.off", off + "\n")->content_hash);
}

// ---- as people write them

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

// ---- what is refused

TEST_F(ReadMesh, ForeignFilesAreNamed) {
  const auto named = [&](const std::string& content, const std::string& what) {
    for (const std::string name : {"a.stl", "b.obj", "c"}) {
      const std::string message = error(name, content);
      EXPECT_NE(message.find(what), std::string::npos) << message;
      EXPECT_NE(message.find("not a mesh file"), std::string::npos) << message;
    }
  };
  named("ISO-10303-21;\nHEADER;\nENDSEC;\n", "a STEP file");
  named(std::string(72, ' ') + "S      1\n", "an IGES file");
  named("  0\r\nSECTION\r\n  2\r\nENTITIES\r\n", "a DXF file");
  named("%PDF-1.7\n", "a PDF document");
  named("<!DOCTYPE html>\n<html><body>Not found</body></html>\n", "a web page");
  named("<?xml version=\"1.0\"?>\n<COLLADA version=\"1.4.1\"/>\n", "a COLLADA scene");
  named("{\"asset\": {\"version\": \"2.0\"}}\n", "a glTF scene");
  named("{\"operation\": \"open\"}\n", "a list of operations");
  named("version https://git-lfs.github.com/spec/v1\noid sha256:0\n", "Git LFS");
  named("# .PCD v0.7\nVERSION 0.7\n", "a point cloud");
  named("Rar!\x1A\x07", "a RAR archive");
  named("1.5 2.5 3.5\n1 2 3\n4 5 6\n7 8 9\n", "a list of points without faces");
  named("3\n1.5 2.5 3.5 255\n1 2 3 255\n4 5 6 255\n", "a list of points without faces");
}

TEST_F(ReadMesh, EmptyFilesAreSaidToBe) {
  for (const std::string name : {"a.stl", "a.ply", "a.obj", "a.off", "a.3mf", "a"})
    for (const std::string& content :
         {std::string(), std::string("\n \t\r\n"), std::string(500, '\0')})
      EXPECT_NE(error(name, content).find("is empty"), std::string::npos);
}

TEST_F(ReadMesh, NoFileNoMesh) {
  const auto message = [&](const std::string& path) {
    const Result<PolygonFile> file = read_polygon_file(path);
    EXPECT_FALSE(file);
    if (!file) expect_sentence(file.error().message, path);
    return file ? "" : file.error().message;
  };
  EXPECT_NE(message(folder_.file("none.stl")).find("no such file"), std::string::npos);
  EXPECT_NE(message(folder_.path().string()).find("directory"), std::string::npos);
  EXPECT_NE(message("/dev/zero").find("ordinary"), std::string::npos);
  EXPECT_NE(error("a.stl", "").find("empty"), std::string::npos);
  EXPECT_NE(error("a.png", "\x89PNG\r\n").find("not a mesh file"), std::string::npos);
  for (const std::string ending : {"stl", "ply", "obj", "off"}) {
    error("blank." + ending, " \n\n");
    error("image." + ending, std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\1\0", 20));
    error("prose." + ending, "Dear reader,\nthis is no mesh.\n");
  }
}

TEST_F(ReadMesh, NoFaces) {
  EXPECT_NE(error("a.obj", "v 0 0 0\nv 1 0 0\n").find("no faces (2 points)"), std::string::npos);
  EXPECT_NE(error("a.off", "OFF\n1 0 0\n0 0 0\n").find("no faces"), std::string::npos);
  EXPECT_NE(error("a.stl", "solid\nendsolid\n").find("no faces"), std::string::npos);
  error("b.stl", binary_stl(pyramid_points, {}));
  const std::string vertices =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
      "property float y\nproperty float z\n";
  EXPECT_NE(error("a.ply", vertices + "end_header\n0 0 0\n").find("no faces"), std::string::npos);
  EXPECT_NE(error("b.ply", vertices + "element face 0\nproperty list uchar int vertex_indices\n"
                                      "end_header\n0 0 0\n")
                .find("no faces"),
            std::string::npos);
  EXPECT_NE(error("c.ply", vertices + "element tristrips 1\nproperty list int int vertex_indices\n"
                                      "end_header\n0 0 0\n0\n")
                .find("strips"),
            std::string::npos);
}

TEST_F(ReadMesh, CountsThatTheFileCannotHold) {
  rusage before{};
  getrusage(RUSAGE_SELF, &before);
  const auto absurd = [&](const std::string& name, const std::string& content) {
    EXPECT_NE(error(name, content).find("announces"), std::string::npos) << name;
  };
  for (const std::string count : {"4000000000", "9000000000000000000"}) {
    absurd("a.off", "OFF\n" + count + " 1 0\n0 0 0\n");
    absurd("b.off", "OFF\n1 " + count + " 0\n0 0 0\n");
    for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
      const auto ply = [&](const std::string& vertices, const std::string& faces) {
        return "ply\nformat " + format + " 1.0\nelement vertex " + vertices +
               "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
               "\nproperty list uint int vertex_indices\nelement nothing 8000000000000000000\n"
               "end_header\n0 0 0 0 0 0 0 0 0 0 0\n";
      };
      absurd("a.ply", ply(count, "1"));
      absurd("b.ply", ply("1", count));
    }
  }
  std::string stl(80, ' ');
  put(stl, std::uint32_t{0xFFFFFFFF});
  absurd("a.stl", stl + std::string(50, '\0'));
  error("c.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2000000000 0 1 2\n");
  error("c.ply",
        "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty char x\n"
        "property char y\nproperty char z\nelement face 1\n"
        "property list uint int vertex_indices\nend_header\n\1\1\1\xF0\xF0\xF0\xF0");
  error("d.off", "OFF\n99999999999999999999999 1 0\n");
  rusage after{};
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 100 * 1024) << "kilobytes";
}

TEST_F(ReadMesh, MessagesNameTheLineOrTheElement) {
  EXPECT_NE(error("a.obj", "v 0 0 0\nv 1 zero 0\n")
                .find("line 2: vertex 1 needs three coordinates, found \"zero\""),
            std::string::npos);
  EXPECT_NE(error("b.obj", "v 0 0 0\nv 1 0\n").find("line 2"), std::string::npos);
  EXPECT_NE(error("c.obj", "v 0 0 0\nf 1 0 1\n").find("line 2"), std::string::npos);
  EXPECT_NE(error("d.obj", "v 0 0 0\nf 1 1 -2\n").find("line 2"), std::string::npos);
  EXPECT_NE(error("e.obj", "v 0 0 0\nf 1 1 1\nf 1 1 9\n").find("face 1 names vertex 8"),
            std::string::npos);
  EXPECT_NE(error("f.obj", "v 0 0 0\nf 1/a 1 1\n").find("line 2"), std::string::npos);
  EXPECT_NE(error("g.obj", "v 0 0 0\nf 1 \\\n 1 x\n").find("line 3"), std::string::npos);
  EXPECT_NE(error("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n")
                .find("line 6: face 0 names vertex 3"),
            std::string::npos);
  EXPECT_NE(error("b.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 x 0\n3 0 1 2\n").find("line 5"),
            std::string::npos);
  EXPECT_NE(error("c.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 -1 2\n").find("line 6"),
            std::string::npos);
  EXPECT_NE(error("d.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n").find("line 6"),
            std::string::npos);
  EXPECT_NE(error("e.off", off + "\n3 0 1 2\n").find("there is more"), std::string::npos);
  EXPECT_NE(error("f.off", "OFF BINARY\n3 1 0\n").find("binary OFF"), std::string::npos);
  EXPECT_NE(error("g.off", "4OFF\n3 1 0\n").find("three dimensions"), std::string::npos);
  EXPECT_NE(error("a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0\nvertex 1 0 0\n")
                .find("line 5"),
            std::string::npos);
  EXPECT_NE(error("b.stl",
                  "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                  "vertex 0 1 0\nvertex 1 1 0\nendloop\n")
                .find("line 7: expected \"endloop\""),
            std::string::npos);
  const auto ply = [&](std::string from, const std::string& to) {
    std::string content = ascii_ply;
    content.replace(content.find(from), from.size(), to);
    return error("a.ply", content);
  };
  EXPECT_NE(ply("format ascii", "format asci").find("line 2"), std::string::npos);
  EXPECT_NE(ply("format ascii 1.0\n", "").find("format"), std::string::npos);
  EXPECT_NE(ply("property float y", "property float u").find("coordinate \"y\""),
            std::string::npos);
  EXPECT_NE(ply("property float y", "property real y").find("line 7"), std::string::npos);
  EXPECT_NE(ply("vertex_indices", "corners").find("vertex_indices"), std::string::npos);
  EXPECT_NE(ply("uchar int vertex_indices", "uchar float vertex_indices").find("whole"),
            std::string::npos);
  EXPECT_NE(ply("list uchar int vertex_indices", "list float int vertex_indices").find("line 13"),
            std::string::npos);
  EXPECT_NE(ply("element vertex 5", "element vertex -5").find("line 5"), std::string::npos);
  EXPECT_NE(ply("element edge 1", "element face 1").find("twice"), std::string::npos);
  EXPECT_NE(ply("end_header", "end_head").find("line 17"), std::string::npos);
  EXPECT_NE(ply("0 3 0 1 4", "0 3 0 1 5").find("line 24: face 1 names vertex 5"),
            std::string::npos);
  EXPECT_NE(
      ply("0 3 0 1 4", "0 3 0 x 4").find("line 24: expected a number in face 1 of 5, found \"x\""),
      std::string::npos);
  EXPECT_NE(ply("0 3 0 1 4", "0 -3 0 1 4").find("line 24"), std::string::npos);
  EXPECT_NE(ply("0 3 3 0 4\n0 1\n", "0 3 3 0").find("ends in face 4 of 5"), std::string::npos);
  const std::string binary = rich_binary_ply(false);
  EXPECT_NE(error("b.ply", binary.substr(0, binary.size() - 1)).find("ends in vertex 4 of 5"),
            std::string::npos);
}

TEST_F(ReadMesh, NothingIsMissedAfterTheLastElement) {
  expect_pyramid_with_square(read("padded.ply", rich_binary_ply(false) + std::string(3, '\0')));
  EXPECT_NE(error("more.ply", rich_binary_ply(false) + "more").find("4 bytes after"),
            std::string::npos);
  EXPECT_NE(error("text.ply", ascii_ply + "7\n").find("there is more"), std::string::npos);
  expect_welded_pyramid(read("padded.stl", binary_stl(pyramid_points, pyramid) + "xyz"));
}

TEST_F(ReadMesh, StopsWhenAskedTo) {
  std::stop_source stop;
  stop.request_stop();
  const Result<PolygonFile> file =
      read_polygon_file(folder_.write("a.off", off), Context({}, stop.get_token()));
  ASSERT_FALSE(file);
  EXPECT_TRUE(file.error().cancelled);
}

// ---- damaged files

class DamagedFiles : public ReadMesh {
 protected:
  static std::map<std::string, std::string> corpus() {
    return {{"a.stl", binary_stl(pyramid_points, pyramid)},
            {"b.stl", ascii_stl(pyramid_points, {{0, 1, 4}, {1, 2, 4}})},
            {"c.stl", binary_stl(pyramid_points, pyramid, "solid")},
            {"a.ply", rich_binary_ply(false)},
            {"b.ply", rich_binary_ply(true)},
            {"c.ply", ascii_ply},
            {"a.obj", obj},
            {"a.off", off},
            {"b.off",
             "COFF 4\n2\n0 0 0 0 1 1 1 1 1 0\n0 1 1 1 1 1 1 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0 1 2 "
             "9\n3 0\n2 3\n"},
            {"d.ply",
             "ply\nformat ascii 1.0\nelement vertex 4\nproperty char x\nproperty uint y\n"
             "property double z\nelement tristrips 1\nproperty list int int "
             "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 -1 2 1 3 -1\n"},
            {"a.gz", testing::gzipped(off)},
            {"a.3mf", testing::zipped({{"3D/3dmodel.model", model}})}};
  }
  inline static const std::string model = testing::model_3mf(
      "unit=\"inch\"",
      "<object id=\"1\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" "
      "z=\"0\"/><vertex x=\"0\" y=\"1\" z=\"0\"/></vertices><triangles><triangle v1=\"0\" v2=\"1\" "
      "v3=\"2\"/></triangles></mesh></object><object id=\"2\"><components><component "
      "objectid=\"1\"/><component objectid=\"1\" transform=\"1 0 0 0 -1 0 0 0 1 5 0 0\"/>"
      "</components></object>",
      "<item objectid=\"2\"/>");

  /// One to four changes: bytes, digits, pieces taken out or doubled, and words that hurt.
  static std::string mutated(std::string content, std::mt19937_64& random) {
    static const std::string words[] = {"-1",
                                        "0",
                                        "255",
                                        "256",
                                        "65536",
                                        "2147483647",
                                        "2147483648",
                                        "4294967295",
                                        "-2147483648",
                                        "9223372036854775807",
                                        "18446744073709551616",
                                        "nan",
                                        "-inf",
                                        "1e999",
                                        "1e-999",
                                        "1,5",
                                        "#",
                                        "\\\n",
                                        "solid",
                                        "endsolid",
                                        "end",
                                        "facet",
                                        "endfacet",
                                        "vertex",
                                        "outer loop",
                                        "OFF",
                                        "nOFF",
                                        "COFF",
                                        "ply\n",
                                        "list uchar int vertex_indices",
                                        "element face 3",
                                        "element tristrips 1",
                                        "f 1 2 3",
                                        "f -1 -2 -3",
                                        "v 1 2 3",
                                        "<object id=\"1\">",
                                        "</object>",
                                        "<component objectid=\"2\"/>",
                                        "<item objectid=\"1\"/>",
                                        "\xFF\xFF\xFF\xFF",
                                        std::string(4, '\0'),
                                        "\x7F\x80\0\0",
                                        "\x1F\x8B\x08",
                                        "PK\3\4"};
    for (std::uint64_t k = 1 + random() % 4; k > 0; --k) {
      if (content.empty()) content.push_back('x');
      const std::size_t at = random() % content.size();
      switch (random() % 6) {
        case 0:
          content[at] = static_cast<char>(random());
          break;
        case 1:
          content[at] ^= static_cast<char>(1u << random() % 8);
          break;
        case 2:  // stays text, and numbers stay numbers
          content[at] = "0123456789-. \n#\\/"[random() % 17];
          break;
        case 3:
          content.erase(at, 1 + random() % 12);
          break;
        case 4:
          content.insert(at, content.substr(random() % content.size(), random() % 60));
          break;
        default:
          content.insert(at, words[random() % std::size(words)]);
      }
    }
    return content.empty() ? "x" : content;
  }

  /// Whatever the bytes, there is a sound value or an error.
  void expect_sound(const std::string& name, const std::string& content) {
    const std::string path = folder_.write(name, content);
    Result<PolygonFile> file = read_polygon_file(path);
    if (!file) {
      expect_sentence(file.error().message, path);
      return;
    }
    for (const std::string& note : file->notes) {
      EXPECT_TRUE(note.ends_with('.')) << note;
      EXPECT_EQ(note.find('\n'), std::string::npos) << note;
    }
    ASSERT_GE(file->starts.size(), 2u);
    ASSERT_EQ(file->starts.front(), 0u);
    ASSERT_EQ(file->starts.back(), file->corners.size());
    ASSERT_TRUE(std::is_sorted(file->starts.begin(), file->starts.end()));
    for (const VertexId v : file->corners) ASSERT_LT(v, file->points.size());
    const Result<ScanPtr> scan = make_scan(std::move(*file), path);
    if (!scan) expect_sentence(scan.error().message, path);
  }
};

TEST_F(DamagedFiles, CutOffAtEveryByte) {
  for (const auto& [name, content] : corpus())
    for (std::size_t size = 0; size < content.size(); ++size)
      expect_sound(name, content.substr(0, size));
}

TEST_F(DamagedFiles, CutOffDataIsNeverTakenForTheWhole) {
  for (const auto& [name, content] : corpus()) {
    if (name == "a.obj") continue;  // A shorter OBJ file is one too.
    const std::size_t whole = read(name, content)->polygon_count();
    for (std::size_t size = 0; size < content.size(); ++size)
      if (const Result<PolygonFile> file = read(name, content.substr(0, size))) {
        // Where an end is often left out, or a count wrong, the file is read and that is said.
        EXPECT_TRUE(file->polygon_count() == whole || says(*file, "cut off"))
            << name << " after " << size << " bytes";
      }
  }
}

TEST_F(DamagedFiles, ChangedBytes) {
  std::mt19937_64 random(20240229);
  for (const auto& [name, content] : corpus())
    for (int round = 0; round < 600; ++round) {
      std::string damaged = content;
      const int changes = 1 + static_cast<int>(random() % 4);
      for (int k = 0; k < changes; ++k) {
        const std::size_t at = random() % damaged.size();
        switch (random() % 4) {
          case 0:
            damaged[at] = static_cast<char>(random());
            break;
          case 1:  // stays text, and numbers stay numbers
            damaged[at] = "0123456789-. \n#\\/"[random() % 17];
            break;
          case 2:
            damaged.erase(at, 1 + random() % 5);
            break;
          default:
            damaged.insert(at, damaged.substr(random() % damaged.size(), random() % 20));
        }
        if (damaged.empty()) damaged.push_back('x');
      }
      expect_sound(name, damaged);
    }
}

/// Thousands of files that began as good ones: never a crash, never a mesh that does not hold
/// together, and never more than 64 MiB for files of a kilobyte.
TEST_F(DamagedFiles, MutatedByTheThousand) {
  std::mt19937_64 random(13);
  rusage before{};
  getrusage(RUSAGE_SELF, &before);
  for (const auto& [name, content] : corpus())
    for (int round = 0; round < 1000; ++round) {
      SCOPED_TRACE(name + ", round " + std::to_string(round));
      expect_sound(name, mutated(content, random));
      if (HasFatalFailure()) return;
    }
  // What is packed is damaged before it is packed, or checksums would find it out.
  for (int round = 0; round < 1500; ++round) {
    SCOPED_TRACE("packed, round " + std::to_string(round));
    expect_sound("b.3mf", testing::zipped({{"3D/3dmodel.model", mutated(model, random)}}));
    expect_sound("b.gz", testing::gzipped(mutated(round % 2 ? obj : ascii_ply, random)));
    if (HasFatalFailure()) return;
  }
#ifndef __SANITIZE_ADDRESS__  // which keeps what was freed for a while
  rusage after{};
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 64 * 1024) << "kilobytes";
#endif
}

// ---- real data

std::filesystem::path shared_data() {
  const char* const variable = std::getenv("ARRIS_SHARED_DATA");
  return variable ? std::filesystem::path(variable)
                  : std::filesystem::path(ARRIS_SOURCE_DIR) / ".." / "shared" / "data";
}

struct RealMesh {
  const char* name;
  std::uint64_t vertices, faces;  // as in the file
};

class RealData : public ::testing::TestWithParam<RealMesh> {};

TEST_P(RealData, LoadsWithTheCountsOfItsIndex) {
  const std::filesystem::path path = shared_data() / GetParam().name;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";
  const Result<ScanPtr> scan = load_scan(path.string());
  ASSERT_TRUE(scan) << scan.error().message;
  const LoadReport& report = (*scan)->report;
  EXPECT_EQ(report.file_vertices, GetParam().vertices);
  EXPECT_EQ(report.file_faces, GetParam().faces);
  EXPECT_EQ(report.vertices, report.original_vertices() + report.copies.size());
  EXPECT_TRUE(report.left_out_faces.empty());
  const bool broken = path.parent_path().filename() == "broken";
  EXPECT_EQ(report.clean(), !broken);
}

INSTANTIATE_TEST_SUITE_P(Files, RealData,
                         ::testing::Values(RealMesh{"real/iron_realscan.ply", 85574, 168285},
                                           RealMesh{"real/daratech.off", 42561, 85146},
                                           RealMesh{"real/TR12J_OCC64K.stl", 33708, 67498},
                                           RealMesh{"real/rockerarm_tri.off", 20776, 41552},
                                           RealMesh{"truth/linkrods1M_scan.ply", 477336, 954676},
                                           RealMesh{"truth/carter_scan.ply", 35348, 70728},
                                           RealMesh{"truth/linkrods_scan.ply", 27706, 55416},
                                           RealMesh{"truth/crankarm_scan.ply", 19146, 38296},
                                           RealMesh{"truth/pumptopcover_scan.ply", 23184, 46368},
                                           RealMesh{"truth/mambo_s34_scan.ply", 49282, 98572},
                                           RealMesh{"truth/carter_cad.ply", 38469, 76970},
                                           RealMesh{"truth/capot_cad.ply", 16053, 31588},
                                           RealMesh{"pairs/Fandisk0.3_Noisy.obj", 6475, 12946},
                                           RealMesh{"pairs/Fandisk0.3_Original.obj", 6475, 12946},
                                           RealMesh{"pairs/SharpSphere0.3_Noisy.obj", 10443, 20882},
                                           RealMesh{"pairs/SharpSphere0.3_Original.obj", 10443,
                                                    20882},
                                           RealMesh{"pairs/block_n1.obj", 8771, 17550},
                                           RealMesh{"pairs/block_gt.obj", 8771, 17550},
                                           RealMesh{"controls/rabbit_realscan.obj", 37394, 73679},
                                           RealMesh{"controls/genus3.off", 6652, 13312},
                                           RealMesh{"broken/crank.off", 49986, 100028},
                                           RealMesh{"broken/noisy_iso.off", 29197, 57838},
                                           RealMesh{"broken/raw_mesh.ply", 29768, 56884}),
                         [](const auto& test) {
                           std::string name = test.param.name;
                           for (char& c : name)
                             if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                           return name;
                         });

Result<ScanPtr> load_shared(const char* name) { return load_scan((shared_data() / name).string()); }

TEST(RealFacts, AreThoseOfTheIndex) {
  if (!std::filesystem::exists(shared_data())) GTEST_SKIP() << shared_data() << " is absent";
  // The index counts vertices as the files have them.
  const auto report = [](const char* name) {
    return (*load_scan((shared_data() / name).string(), {}, {.weld = false}))->report;
  };
  EXPECT_EQ(report("real/iron_realscan.ply").border_edges, 2863u);
  EXPECT_EQ(report("real/TR12J_OCC64K.stl").border_edges, 6u);
  EXPECT_EQ(report("real/daratech.off").border_edges, 0u);
  EXPECT_EQ(report("real/daratech.off").euler_number, 2 - 2 * 7) << "genus 7";
  EXPECT_EQ(report("controls/genus3.off").euler_number, 2 - 2 * 3);
  EXPECT_GT(report("truth/capot_cad.ply").border_edges, 0u) << "a car hood is open";

  const LoadReport crank = report("broken/crank.off");
  EXPECT_EQ(crank.non_manifold_edges.size(), 24u);
  EXPECT_EQ(crank.components, 13u);

  const LoadReport noisy = report("broken/noisy_iso.off");
  EXPECT_EQ(noisy.components, 40u);
  EXPECT_FALSE(noisy.zero_area_faces.empty());

  // The index counts the vertices before those with more than one fan are split.
  const LoadReport raw = report("broken/raw_mesh.ply");
  EXPECT_EQ(raw.border_edges, 3638u);
  EXPECT_EQ(raw.euler_number - static_cast<std::int64_t>(raw.copies.size()), -493);
}

TEST(RealFacts, ScansWithoutFaultsAreKeptToTheLetter) {
  if (!std::filesystem::exists(shared_data())) GTEST_SKIP() << shared_data() << " is absent";
  for (const char* name : {"real/iron_realscan.ply", "truth/carter_scan.ply"}) {
    const Result<PolygonFile> file = read_polygon_file((shared_data() / name).string());
    const Result<ScanPtr> scan = load_shared(name);
    ASSERT_TRUE(file && scan);
    EXPECT_EQ((*scan)->file, nullptr);
    EXPECT_TRUE(std::equal(file->points.begin(), file->points.end(),
                           (*scan)->mesh->points().begin(), (*scan)->mesh->points().end()));
    for (FaceId f = 0; f < (*scan)->mesh->face_count(); ++f)
      for (int k = 0; k < 3; ++k)
        ASSERT_EQ(file->corners[3 * f + k], (*scan)->mesh->triangle(f)[k]);
  }
}

}  // namespace
}  // namespace arris
