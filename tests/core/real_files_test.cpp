// Real scans, where they are there.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "core/mesh/polygon_file.h"
#include "core/mesh/scan.h"
#include "tests/support/test_name.h"

namespace arris {
namespace {

std::filesystem::path shared_data() {
  const char* const variable = std::getenv("ARRIS_SHARED_DATA");
  return variable ? std::filesystem::path(variable)
                  : std::filesystem::path(ARRIS_SOURCE_DIR) / ".." / "shared" / "data";
}

struct RealMesh {
  const char* name;
  std::uint64_t vertices, faces;  // as in the file
};

void PrintTo(const RealMesh& mesh, std::ostream* out) { *out << mesh.name; }

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
                         [](const auto& mesh) { return testing::test_name(mesh.param.name); });

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
