#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/mesh/polygon_file.h"
#include "tests/support/temp_folder.h"

/// One small part as files of every format, and what reading them is to give.
namespace arris::testing {

/// Appends the bytes of a value.
template <class T>
void put(std::string& out, T value, bool big_endian = false) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (big_endian == (std::endian::native == std::endian::little))
    std::reverse(raw.begin(), raw.end());
  out.append(raw.data(), raw.size());
}

/// A pyramid over the unit square: 5 points, 4 triangles and a base of 2 triangles or 1 square.
inline const std::vector<Point> pyramid_points{
    {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
inline const std::vector<Triangle> pyramid{{0, 1, 4}, {1, 2, 4}, {2, 3, 4},
                                           {3, 0, 4}, {0, 2, 1}, {0, 3, 2}};

inline std::string binary_stl(const std::vector<Point>& points,
                              const std::vector<Triangle>& triangles,
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

inline std::string ascii_stl(const std::vector<Point>& points,
                             const std::vector<Triangle>& triangles,
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
inline std::string rich_binary_ply(bool big_endian) {
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

inline const std::string ascii_ply =
    "ply\nformat ascii 1.0\ncomment with all that is rare\nobj_info by hand\n"
    "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
    "property list uchar int more\nproperty uchar red\n"
    "element face 5\nproperty int flag\nproperty list uchar int vertex_indices\n"
    "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n"
    "0 0 0 0 255\n1 0 0 2 7 8 255\n1 1 0 0 255\n0 1 0 1 9 255\n.5 +5e-1 1 0 255\n"
    "-1 4 0 3 2 1\n0 3 0 1 4\n0 3 1 2 4\n0 3 2 3 4\n0 3 3 0 4\n0 1\n";

inline const std::string obj =
    "# by hand\nmtllib part.mtl\no part\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0 1.0\nv 0 1 0\n"
    "vn 0 0 1\nvt 0 0\ns off\nf 1 4 3 2 # the base\nv 0.5 0.5 1\ng sides\nusemtl steel\n"
    "f 1/1 2/1 5/1\nf 2//1 \\\n  3//1 5//1\nf 3/1/1 4/1/1 5/1/1\nf -2 -5 -1\n";

inline const std::string off =
    "OFF # a comment\n# another\n5 5 8\n0 0 0\n1 0 0\n\n1 1 0 # corner\n0 1 0\n0.5 0.5 1\n"
    "4 0 3 2 1 255 0 0\n3 0 1 4\n3 1 2 4 0.5 0.5 0.5 1\n3 2 3 4\n3 3 0 4";

/// Reads files that the tests write into a folder of their own.
class ReadMesh : public ::testing::Test {
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

}  // namespace arris::testing
