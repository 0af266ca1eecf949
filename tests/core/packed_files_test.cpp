// Files inside files: gzip, and 3MF, which is XML in ZIP.

#include <map>
#include <string>

#include <gtest/gtest.h>

#include "core/mesh/polygon_file.h"
#include "core/mesh/scan.h"
#include "tests/support/packing.h"
#include "tests/support/temp_folder.h"

namespace arris {
namespace {

using testing::gzipped;
using testing::model_3mf;
using testing::TempFolder;
using testing::zipped;

const std::string square_off = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
const std::string square_obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
const std::string square_ply =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
const std::string square_stl =
    "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\n"
    "endfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\n"
    "endfacet\nendsolid\n";

const std::vector<Point> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<VertexId> square_corners{0, 1, 2, 0, 2, 3};

/// A triangle (0 0 0), (1 0 0), (0 1 0) as the mesh of an object.
const std::string triangle_mesh =
    "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>"
    "<vertex x=\"0\" y=\"1\" z=\"0\"/></vertices><triangles><triangle v1=\"0\" v2=\"1\" v3=\"2\"/>"
    "</triangles></mesh>";

class PackedFiles : public ::testing::Test {
 protected:
  Result<PolygonFile> read(const std::string& name, const std::string& content) const {
    return read_polygon_file(folder_.write(name, content));
  }
  std::string error(const std::string& name, const std::string& content) const {
    const Result<PolygonFile> file = read(name, content);
    EXPECT_FALSE(file) << name;
    if (file) return "";
    const std::string& message = file.error().message;
    EXPECT_TRUE(message.starts_with(folder_.file(name))) << message;
    EXPECT_TRUE(message.ends_with(".")) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  TempFolder folder_;
};

// ---- gzip

TEST_F(PackedFiles, GzipIsUnpackedWhateverTheName) {
  const std::map<std::string, std::string> contents{
      {"OFF", square_off}, {"OBJ", square_obj}, {"PLY", square_ply}, {"STL (ASCII)", square_stl}};
  for (const auto& [format, content] : contents)
    for (const std::string name : {"a.gz", "a.ply", "a", "part.stl.gz"}) {
      const Result<PolygonFile> file = read(name, gzipped(content));
      ASSERT_TRUE(file) << file.error().message;
      EXPECT_EQ(file->format, format + ", gzip");
      EXPECT_EQ(file->points, square);
      EXPECT_EQ(file->corners, square_corners);
      EXPECT_EQ(file->bytes, gzipped(content).size());
    }
  // Parts one after the other are one file, as gzip has it.
  const Result<PolygonFile> parts =
      read("b.gz", gzipped(square_obj.substr(0, 30)) + gzipped(square_obj.substr(30)));
  ASSERT_TRUE(parts) << parts.error().message;
  EXPECT_EQ(parts->corners, square_corners);
}

TEST_F(PackedFiles, TheNameInsideAGzipNameCountsWhereTheContentCannotTell) {
  const std::string bare = square_off.substr(4);  // OFF without its keyword
  EXPECT_TRUE(read("a.off.gz", gzipped(bare)));
  EXPECT_NE(error("a.gz", gzipped(bare)).find("not a mesh file"), std::string::npos);
}

TEST_F(PackedFiles, DamagedGzipIsSaidToBe) {
  const std::string whole = gzipped(square_ply);
  for (std::size_t size = 3; size < whole.size(); size += 5)
    EXPECT_NE(error("a.ply", whole.substr(0, size)).find("truncated"), std::string::npos);
  std::string damaged = whole;
  damaged[whole.size() - 6] ^= 1;  // the checksum
  EXPECT_NE(error("a.ply", damaged).find("damaged"), std::string::npos);
  EXPECT_NE(error("a.ply", gzipped("")).find("is empty"), std::string::npos);
  EXPECT_NE(error("a.ply", gzipped("%PDF-1.4")).find("a PDF document"), std::string::npos);
}

TEST_F(PackedFiles, GzipThatGrowsBeyondAllMeasureIsRefused) {
  const std::string bomb = gzipped(std::string(std::size_t{1} << 26, '\n'));
  EXPECT_LT(bomb.size(), 100'000u);
  EXPECT_NE(error("a.stl", bomb).find("more than 200 times its size"), std::string::npos);
}

// ---- 3MF

TEST_F(PackedFiles, ThreeMfPutsObjectsWhereTheBuildWantsThem) {
  // A component moved along x, mirrored at the plane x = 0 by the item that holds it.
  const std::string model =
      model_3mf("unit=\"inch\"",
                "<object id=\"1\" type=\"model\">" + triangle_mesh +
                    "</object><object id=\"2\" type=\"model\"><components>"
                    "<component objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 10 0 0\"/>"
                    "<component objectid=\"1\"/></components></object>"
                    "<object id=\"3\" type=\"model\">" +
                    triangle_mesh + "</object>",
                "<item objectid=\"2\" transform=\"-1 0 0 0 1 0 0 0 1 0 0 5\"/>"
                "<item objectid=\"1\" transform=\"0 1 0 -1 0 0 0 0 1 0 0 0\"/>");
  const Result<PolygonFile> file = read("a.3mf", zipped({{"3D/3dmodel.model", model}}));
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->format, "3MF");
  EXPECT_EQ(file->unit, "inch");
  EXPECT_EQ(file->points, (std::vector<Point>{{-10, 0, 5},
                                              {-11, 0, 5},
                                              {-10, 1, 5},
                                              {0, 0, 5},
                                              {-1, 0, 5},
                                              {0, 1, 5},
                                              {0, 0, 0},
                                              {0, 1, 0},
                                              {-1, 0, 0}}))
      << "object 3 is not built";
  // Mirrored triangles are turned, so that the outside stays outside.
  EXPECT_EQ(file->corners, (std::vector<VertexId>{0, 2, 1, 3, 5, 4, 6, 7, 8}));
  const Result<ScanPtr> scan = load_scan(folder_.file("a.3mf"));
  ASSERT_TRUE(scan);
  EXPECT_EQ((*scan)->report.unit, "inch");
}

TEST_F(PackedFiles, ThreeMfNamesItsModelAndOtherParts) {
  const std::string relations =
      "<?xml version=\"1.0\"?><Relationships "
      "xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"><Relationship "
      "Target=\"/3D/part one.model\" Id=\"r\" "
      "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";
  const std::string main = model_3mf(
      "",
      "<object id=\"7\"><components><component p:path=\"/3D/Objects/o.model\" objectid=\"1\"/>"
      "</components></object>",
      "<item objectid=\"7\"/>");
  const std::string other = model_3mf("", "<object id=\"1\">" + triangle_mesh + "</object>", "");
  const Result<PolygonFile> file = read("a.3mf", zipped({{"_rels/.rels", relations},
                                                         {"3D/part one.model", main},
                                                         {"3D/Objects/o.model", other}}));
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->polygon_count(), 1u);
  EXPECT_EQ(file->unit, "millimeter") << "what a file means that says nothing";
}

TEST_F(PackedFiles, ThreeMfWithoutABuildIsReadAndTold) {
  const std::string model = model_3mf("", "<object id=\"1\">" + triangle_mesh + "</object>", "");
  const Result<PolygonFile> file = read("a", zipped({{"3D/3dmodel.model", model}}));
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->polygon_count(), 1u);
  ASSERT_EQ(file->notes.size(), 1u);
  EXPECT_NE(file->notes[0].find("which of its objects are to be built"), std::string::npos);
}

TEST_F(PackedFiles, ThreeMfWithFaultsIsOneSentence) {
  const auto message = [&](const std::string& resources, const std::string& build) {
    return error("a.3mf", zipped({{"3D/3dmodel.model", model_3mf("", resources, build)}}));
  };
  const std::string object = "<object id=\"1\">" + triangle_mesh + "</object>";
  const auto has = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(message(object, "<item objectid=\"2\"/>"), "names object 2");
  has(message(object, "<item objectid=\"1\" transform=\"1 0\"/>"), "twelve numbers");
  std::string wrong = object;
  wrong.replace(wrong.find("v3=\"2\""), 6, "v3=\"3\"");
  has(message(wrong, "<item objectid=\"1\"/>"), "names vertex 3, but there are only 3");
  wrong = object;
  wrong.replace(wrong.find("x=\"1\""), 5, "x=\"1,5\"");
  has(message(wrong, "<item objectid=\"1\"/>"), "a decimal comma");
  has(message("<object id=\"1\"><components><component objectid=\"1\"/></components></object>",
              "<item objectid=\"1\"/>"),
      "part of itself");
  has(message(object + object, "<item objectid=\"1\"/>"), "there twice");
  has(message("", ""), "holds no faces");
  has(error("b.3mf", zipped({{"3D/3dmodel.model", "<model><resources>"}})), "no valid XML");
  has(error("c.3mf",
            zipped({{"3D/3dmodel.model", "<!DOCTYPE m [<!ENTITY a \"aaa\">]><model>&a;</model>"}})),
      "document type");
  has(error("d.3mf", zipped({{"word/document.xml", "<w/>"}})), "ZIP archive without a 3D model");
  const std::string whole = zipped({{"3D/3dmodel.model", model_3mf("", object, "")}});
  has(error("e.3mf", whole.substr(0, whole.size() / 2)), "damaged or cut off");
}

TEST_F(PackedFiles, ThreeMfOfCopiesOfCopiesIsRefusedBeforeTheyAreMade) {
  std::string objects = "<object id=\"1\">" + triangle_mesh + "</object>";
  for (int k = 2; k <= 60; ++k) {
    const std::string below = "<component objectid=\"" + std::to_string(k - 1) + "\"/>";
    objects += "<object id=\"" + std::to_string(k) + "\"><components>" + below + below +
               "</components></object>";
  }
  EXPECT_NE(error("a.3mf",
                  zipped({{"3D/3dmodel.model", model_3mf("", objects, "<item objectid=\"60\"/>")}}))
                .find("copies of its objects"),
            std::string::npos);
}

}  // namespace
}  // namespace arris
