// Damaged files: whatever the bytes, there is a sound mesh or an error.

#include <algorithm>
#include <map>
#include <random>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "core/mesh/scan.h"
#include "tests/core/read_mesh_fixture.h"
#include "tests/support/packing.h"

namespace arris {
namespace {

using namespace testing;

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

}  // namespace
}  // namespace arris
