#include <clocale>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "core/mesh/scan.h"
#include "tests/core/read_mesh_fixture.h"
#include "tests/support/meshes.h"
#include "tests/support/packing.h"

namespace arris {
namespace {

using namespace testing;

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

}  // namespace
}  // namespace arris
