#include "core/mesh/write_ply.h"

#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <limits>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "core/base/write_file.h"
#include "core/mesh/polygon_file.h"
#include "core/mesh/scan.h"
#include "tests/support/meshes.h"
#include "tests/support/temp_folder.h"

namespace arris {
namespace {

using testing::TempFolder;

/// Bytes after the header.
std::string body(const std::string& ply) { return ply.substr(ply.find("end_header\n") + 11); }

std::size_t file_count(const TempFolder& folder) {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator(folder.path()), {}));
}

template <class T>
T value_at(const std::string& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

PolygonFile file_of(const std::vector<Point>& points,
                    const std::vector<std::vector<VertexId>>& polygons) {
  PolygonFile file;
  file.points = points;
  file.starts.push_back(0);
  for (const auto& polygon : polygons) {
    file.corners.insert(file.corners.end(), polygon.begin(), polygon.end());
    file.starts.push_back(file.corners.size());
  }
  return file;
}

/// The face property `partition` of a file whose polygons have the given sizes.
std::vector<std::int32_t> partitions_of(const std::string& ply, const PolygonFile& file,
                                        std::size_t bytes_per_point, std::size_t count_size = 1) {
  const std::string bytes = body(ply);
  std::size_t at = file.points.size() * bytes_per_point;
  std::vector<std::int32_t> result;
  for (std::size_t k = 0; k < file.polygon_count(); ++k) {
    at += count_size + 4 * (file.starts[k + 1] - file.starts[k]);
    result.push_back(value_at<std::int32_t>(bytes, at));
    at += 4;
  }
  EXPECT_EQ(at, bytes.size());
  return result;
}

const std::vector<Point> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TEST(WriteFileWhole, ReplacesAndLeavesNothingBeside) {
  const TempFolder folder;
  const std::string path = folder.file("a.txt");
  ASSERT_TRUE(write_file_whole(path, "first"));
  EXPECT_EQ(folder.read("a.txt"), "first");
  ASSERT_TRUE(write_file_whole(path, std::string("sec\0nd", 6)));
  EXPECT_EQ(folder.read("a.txt"), std::string("sec\0nd", 6));
  ASSERT_TRUE(write_file_whole(path, ""));
  EXPECT_EQ(folder.read("a.txt"), "");
  EXPECT_EQ(file_count(folder), 1u);
}

TEST(WriteFileWhole, KeepsPermissionsAndLinks) {
  namespace fs = std::filesystem;
  const TempFolder folder;
  const std::string path = folder.write("a.txt", "old");
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("a.txt", folder.path() / "link");
  ASSERT_TRUE(write_file_whole(folder.file("link"), "new"));
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
  EXPECT_EQ(folder.read("a.txt"), "new");
  EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(WriteFileWhole, FailsWithPathAndReason) {
  const TempFolder folder;
  std::filesystem::create_directory(folder.path() / "sub");
  const auto message = [](const std::string& path) {
    const Result<void> result = write_file_whole(path, "x");
    EXPECT_FALSE(result) << path;
    return result ? std::string() : result.error().message;
  };
  const std::string missing = folder.file("none") + "/a.txt";
  EXPECT_EQ(message(missing), missing + " cannot be created: No such file or directory.");
  EXPECT_NE(message(folder.file("sub")).find("directory"), std::string::npos);
  EXPECT_NE(message("/dev/null").find("not an ordinary file"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  message("");
  message(folder.file("sub") + "/");
  EXPECT_EQ(file_count(folder), 1u);
}

TEST(WriteFileWhole, AFailedWriteLeavesTheOldFile) {
  const TempFolder folder;
  const std::string path = folder.write("a.txt", "old");
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit full = before;
  full.rlim_cur = 4096;  // stands for a full disk
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &full);
  const Result<void> result = write_file_whole(path, std::string(10000, 'x'));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, path + " cannot be written: File too large.");
  EXPECT_EQ(folder.read("a.txt"), "old");
  EXPECT_EQ(file_count(folder), 1u);
}

TEST(WritePly, ComesBackAsItWas) {
  const TempFolder folder;
  const testing::Triangles sphere = testing::irregular_sphere(2.0, 300, 5);
  const MeshPtr mesh = testing::mesh_of(sphere);
  std::vector<double> values(mesh->vertex_count(), 0.5);
  values[3] = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(write_ply(folder.file("a.ply"), *mesh, {{"kabs", &values}, {"h", &values}}));
  const Result<ScanPtr> scan = load_scan(folder.file("a.ply"));
  ASSERT_TRUE(scan) << scan.error().message;
  EXPECT_EQ((*scan)->mesh->hash(), mesh->hash()) << "doubles stay doubles";
  const std::string ply = folder.read("a.ply");
  EXPECT_NE(ply.find("property float kabs\nproperty float h\n"), std::string::npos);
  EXPECT_EQ(value_at<float>(body(ply), 24), 0.5f);
  EXPECT_TRUE(std::isnan(value_at<float>(body(ply), 3 * 32 + 24)));
}

TEST(WritePly, FloatsStayFloats) {
  const TempFolder folder;
  const MeshPtr mesh = testing::mesh_of({square, {{0, 1, 2}, {0, 2, 3}}});
  ASSERT_TRUE(write_ply(folder.file("a.ply"), *mesh, {}));
  const std::string ply = folder.read("a.ply");
  EXPECT_NE(ply.find("property float x"), std::string::npos);
  EXPECT_EQ(body(ply).size(), 4 * 12 + 2 * 13u);
  std::vector<Point> finer = square;
  finer[2].x() = 0.1;
  ASSERT_TRUE(write_ply(folder.file("b.ply"), *testing::mesh_of({finer, {{0, 1, 2}}}), {}));
  EXPECT_NE(folder.read("b.ply").find("property double x"), std::string::npos);
  finer[2].x() = 1e300;
  ASSERT_TRUE(write_ply(folder.file("c.ply"), *testing::mesh_of({finer, {{0, 1, 2}}}), {}));
  EXPECT_NE(folder.read("c.ply").find("property double x"), std::string::npos);
}

TEST(WritePly, RefusesPropertiesThatDoNotFit) {
  const TempFolder folder;
  const MeshPtr mesh = testing::mesh_of({square, {{0, 1, 2}, {0, 2, 3}}});
  const std::vector<double> three(3, 0.0), four(4, 0.0);
  EXPECT_FALSE(write_ply(folder.file("a.ply"), *mesh, {{"k", &three}}));
  EXPECT_FALSE(write_ply(folder.file("a.ply"), *mesh, {{"a name", &four}}));
  EXPECT_EQ(file_count(folder), 0u);
}

TEST(WriteLabelledScan, AMeshWithoutFaults) {
  const TempFolder folder;
  const testing::Triangles cube = testing::cube();
  const Result<ScanPtr> scan = make_scan(
      [&] {
        std::vector<std::vector<VertexId>> polygons;
        for (const Triangle& t : cube.triangles) polygons.push_back({t[0], t[1], t[2]});
        return file_of(cube.points, polygons);
      }(),
      "cube");
  ASSERT_TRUE(scan);
  std::vector<std::uint32_t> labels;
  for (std::uint32_t f = 0; f < cube.triangles.size(); ++f) labels.push_back(f / 2);
  ASSERT_TRUE(write_labelled_scan(folder.file("a.ply"), **scan, labels));
  const std::string ply = folder.read("a.ply");
  EXPECT_NE(ply.find("property list uchar int vertex_indices\nproperty int partition\nend_header"),
            std::string::npos);
  const Result<PolygonFile> again = read_polygon_file(folder.file("a.ply"));
  ASSERT_TRUE(again);
  EXPECT_EQ(again->points, cube.points);
  for (std::size_t f = 0; f < cube.triangles.size(); ++f)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(again->corners[3 * f + k], cube.triangles[f][k]);
  EXPECT_EQ(partitions_of(ply, *again, 12),
            (std::vector<std::int32_t>{0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5}));
}

TEST(WriteLabelledScan, PolygonsInTheOrderOfTheFile) {
  const TempFolder folder;
  std::vector<Point> points = square;
  points.push_back({3, 0, 0});
  points.push_back({3, 1, 0});
  points.push_back({0, 0, 5});
  // degenerate, square, repeated face, lopsided quadrilateral, bow tie at 0, turned face
  const PolygonFile file =
      file_of(points, {{0, 0, 1}, {0, 1, 2, 3}, {3, 2, 1, 0}, {1, 4, 5, 2}, {0, 6, 3}, {4, 5, 6}});
  const Result<ScanPtr> scan = make_scan(file, "polygons");
  ASSERT_TRUE(scan) << scan.error().message;
  ASSERT_NE((*scan)->file, nullptr);
  ASSERT_EQ((*scan)->source_faces, (std::vector<std::uint32_t>{1, 1, 3, 3, 4, 5}));
  // The halves of the square tie.
  ASSERT_TRUE(write_labelled_scan(folder.file("a.ply"), **scan, {9, 4, 7, 7, 5, 6}));
  const Result<PolygonFile> again = read_polygon_file(folder.file("a.ply"));
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->points, file.points) << "without the copies";
  EXPECT_EQ(again->starts, file.starts);
  EXPECT_EQ(again->corners, file.corners);
  EXPECT_EQ(partitions_of(folder.read("a.ply"), *again, 12),
            (std::vector<std::int32_t>{0, 4, 0, 7, 5, 6}));
}

TEST(WriteLabelledScan, TheLargerAreaWins) {
  const TempFolder folder;
  // A fan from the first corner: areas 1 and 2.
  const PolygonFile file = file_of({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 2, 0}}, {{0, 1, 2, 3}});
  const Result<ScanPtr> scan = make_scan(file, "test");
  ASSERT_TRUE(scan);
  const auto label = [&](std::uint32_t first, std::uint32_t second) {
    EXPECT_TRUE(write_labelled_scan(folder.file("a.ply"), **scan, {first, second}));
    return partitions_of(folder.read("a.ply"), file, 12)[0];
  };
  EXPECT_EQ(label(1, 2), 2);
  EXPECT_EQ(label(2, 1), 1);
  EXPECT_EQ(label(3, 0), 0);
}

TEST(WriteLabelledScan, PolygonsLongerThanAByteCounts) {
  const TempFolder folder;
  std::vector<Point> points;
  std::vector<VertexId> polygon;
  for (VertexId k = 0; k < 300; ++k) {
    points.push_back({std::cos(0.02 * k), std::sin(0.02 * k), 0});
    polygon.push_back(k);
  }
  const PolygonFile file = file_of(points, {polygon});
  const Result<ScanPtr> scan = make_scan(file, "disc");
  ASSERT_TRUE(scan);
  ASSERT_TRUE(write_labelled_scan(folder.file("a.ply"), **scan,
                                  std::vector<std::uint32_t>((*scan)->mesh->face_count(), 8)));
  const Result<PolygonFile> again = read_polygon_file(folder.file("a.ply"));
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->corners, file.corners);
  EXPECT_EQ(partitions_of(folder.read("a.ply"), file, 24, 4), (std::vector<std::int32_t>{8}));
}

TEST(WriteLabelledScan, RefusesLabelsThatDoNotFit) {
  const TempFolder folder;
  const Result<ScanPtr> scan = make_scan(file_of(square, {{0, 1, 2}, {0, 2, 3}}), "test");
  ASSERT_TRUE(scan);
  EXPECT_FALSE(write_labelled_scan(folder.file("a.ply"), **scan, {1}));
  EXPECT_FALSE(write_labelled_scan(folder.file("a.ply"), **scan, {1, 0xFFFFFFFF}));
  EXPECT_EQ(file_count(folder), 0u);
}

}  // namespace
}  // namespace arris
