// arris-cli as a user runs it: exit codes, what stands on standard error, what it tells of a scan.

#include <unistd.h>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/cli/cli_fixture.h"
#include "tests/cli/written_results.h"

namespace arris {
namespace {

using namespace testing;
namespace fs = std::filesystem;

// ---- usage ----

TEST_F(Cli, HelpAndVersionAreNoErrors) {
  for (const char* command : {"", "info", "curvature", "segment", "replay", "sample"}) {
    std::vector<std::string> arguments;
    if (*command) arguments.push_back(command);
    arguments.push_back("--help");
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << command;
    EXPECT_NE(outcome.out.find("arris-cli"), std::string::npos);
    EXPECT_EQ(outcome.err, "");
  }
  const Outcome version = run({"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_TRUE(std::regex_match(version.out, std::regex("arris-cli \\d+\\.\\d+\\.\\d+\n")));
}

TEST_F(Cli, BadUsageIsTwo) {
  const std::string part = small_part(), out = folder.file("results");
  expect_bad_usage({});
  expect_bad_usage({"polish"});
  expect_bad_usage({"info"});
  expect_bad_usage({"info", part, "--loud"});
  expect_bad_usage({"curvature", part});
  expect_bad_usage({"segment", part});
  expect_bad_usage({"segment", "-o", out});
  expect_bad_usage({"replay", part});
  expect_bad_usage({"sample"});
  const std::vector<std::vector<std::string>> wrong{
      {"--sharp-angle", "0"},   {"--sharp-angle", "steep"}, {"--sharp-angle", "180"},
      {"--sharp-angle", "nan"}, {"--candidates", "0"},      {"--candidates", "2.5"},
      {"--min-length", "-1"},   {"--criterion", "gauss"},   {"--min-faces", "0"},
      {"--min-faces", "-3"},    {"--min-faces", "many"},    {"--fill-holes", "-1"}};
  for (const auto& option : wrong)
    expect_bad_usage({"segment", part, "-o", out, option[0], option[1]});
  EXPECT_FALSE(fs::exists(out)) << "nothing is written";
}

TEST_F(Cli, IntervalThatIsNoneIsBadUsage) {
  const std::string part = small_part(), out = folder.file("results");
  for (const std::string interval : {"5", "a:b", "2:1", "1:1", "-1:2", "1:-2", "1:2:3", "1,2",
                                     "0x1:2", "1 :2", "", "nan:1", "0:nan", "inf:", "1e999:"})
    expect_bad_usage({"segment", part, "-o", out, "--interval", interval});
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(Cli, IntervalsAreReadAsTheyStand) {
  const std::string part = small_part();
  expect_done({"segment", part, "-o", folder.file("a"), "--interval", "0:0.1", "--interval",
               "0.1:2e-1", "--interval", "0.2:"});
  EXPECT_EQ(summary("a")["thresholds"]["find_partitions"]["intervals"],
            json::parse("[[0.0, 0.1], [0.1, 0.2], [0.2, null]]"));
  expect_done({"segment", part, "-o", folder.file("b"), "--interval", ":0.5"});
  EXPECT_EQ(summary("b")["thresholds"]["find_partitions"]["intervals"],
            json::parse("[[0.0, 0.5]]"));
}

TEST_F(Cli, OptionsMayStandBeforeTheScan) {
  const std::string part = small_part();
  expect_done({"segment", "--sharp-angle", "30", "-o", folder.file("a"), part});
  expect_done({"segment", "--interval", "0:0.1", part, "-o", folder.file("b")});
}

// ---- bad input ----

TEST_F(Cli, ScanThatCannotBeReadIsOneSentence) {
  const std::string part = small_part();
  const std::string whole = folder.read("part.ply");
  const std::vector<std::pair<std::string, std::string>> scans{
      {folder.file("none.ply"), "none.ply"},
      {folder.path().string(), folder.path().string()},
      {folder.write("empty.stl", ""), "empty.stl"},
      {folder.write("noise.ply", "hello there\n"), "noise.ply"},
      {folder.write("picture.png", "\x89PNG\r\n\x1a\n0000000000000000000000"), "picture.png"},
      {folder.write("torn.ply", whole.substr(0, whole.size() / 2)), "torn.ply"},
      {folder.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "points.obj"},
      {folder.write("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"), "index.obj"},
      {folder.write("flat.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 1\n"), ""},
  };
  for (const auto& [scan, shown] : scans) {
    expect_bad_input({"info", scan}, shown);
    expect_bad_input({"info", scan, "--json"}, shown);
    expect_bad_input({"curvature", scan, "-o", folder.file("k.ply")}, shown);
    expect_bad_input({"segment", scan, "-o", folder.file("results")}, shown);
  }
  EXPECT_FALSE(fs::exists(folder.file("k.ply")));
  EXPECT_FALSE(fs::exists(folder.file("results")));
}

TEST_F(Cli, PlaceThatCannotBeWrittenIsOneSentence) {
  const std::string part = small_part();
  expect_bad_input({"curvature", part, "-o", folder.file("no/such/k.ply")}, "no/such/k.ply");
  expect_bad_input({"sample", "-o", folder.file("no/such/s.ply")}, "no/such/s.ply");
  expect_bad_input({"sample", "-o", folder.path().string()}, folder.path().string());
  expect_bad_input({"segment", part, "-o", part}, "part.ply");
  expect_bad_input({"segment", part, "-o", part + "/results"}, "part.ply");
}

TEST_F(Cli, OperationsThatCannotBeRunAreOneSentence) {
  small_part();
  const std::string out = folder.file("results");
  expect_bad_input({"replay", folder.file("none.jsonl"), "-o", out}, "none.jsonl");
  expect_bad_input({"replay", folder.write("e.jsonl", ""), "-o", out}, "e.jsonl");
  expect_bad_input({"replay", folder.write("x.jsonl", "what?\n"), "-o", out}, "line 1");
  expect_bad_input(
      {"replay", folder.write("y.jsonl", "{\"operation\": \"find_partitions\"}\n"), "-o", out},
      "no part is open");
  expect_bad_input({"replay",
                    folder.write("z.jsonl", "{\"operation\": \"open\", \"file\": \"" +
                                                folder.file("gone.stl") + "\"}\n"),
                    "-o", out},
                   "gone.stl");
  expect_bad_input({"replay",
                    folder.write("h.jsonl", "{\"operation\": \"open\", \"file\": \"" +
                                                folder.file("part.ply") + "\"}\n{\"head\": 0}\n"),
                    "-o", out},
                   "h.jsonl");
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(Cli, PlacesAreLookedAtBeforeTheWork) {
  // Nothing is there to work on, and still it is the place that is complained of.
  const std::string none = folder.file("none.ply"), file = folder.write("file", "");
  expect_bad_input({"curvature", none, "-o", folder.file("no/k.ply")}, "No such file or directory");
  expect_bad_input({"simplify", none, "-o", folder.file("no/k.ply")}, "No such file or directory");
  expect_bad_input({"curvature", none, "-o", folder.path().string()}, "it is a directory");
  expect_bad_input({"segment", none, "-o", file}, "file is a file, not a folder");
  expect_bad_input({"segment", none, "-o", file + "/a/b"}, "cannot be made");
  expect_bad_input({"replay", none, "-o", file}, "file is a file, not a folder");
  fs::create_directories(folder.file("results/lines.obj"));
  expect_bad_input({"segment", none, "-o", folder.file("results")}, "lines.obj cannot be written");
  // Asking leaves nothing behind.
  expect_bad_input({"segment", none, "-o", folder.file("new/folder")}, "none.ply");
  EXPECT_FALSE(fs::exists(folder.file("new")));
  expect_bad_input({"curvature", none, "-o", folder.file("k.ply")}, "none.ply");
  EXPECT_FALSE(fs::exists(folder.file("k.ply")));
  if (::geteuid() != 0) {  // whom nothing keeps from writing
    fs::create_directory(folder.file("locked"));
    fs::permissions(folder.file("locked"), fs::perms::owner_read | fs::perms::owner_exec);
    expect_bad_input({"segment", none, "-o", folder.file("locked")}, "locked: Permission denied");
    expect_bad_input({"segment", none, "-o", folder.file("locked/a")}, "Permission denied");
  }
}

TEST_F(Cli, FileNamesMayBeInAnyEncoding) {
  const std::string part = small_part();
  for (const std::string name :
       {"caf\xe9", "\xc3\xa4\xe6\xa8\xa1\xe5\x85\xb7", "\xff\xfe\x80", "a\nb"}) {
    SCOPED_TRACE(name);
    const std::string odd = folder.file(name + ".ply"), results = folder.file(name + " results");
    fs::copy_file(part, odd);
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"info", odd},
             {"info", odd, "--json"},
             {"curvature", odd, "-o", folder.file(name + "k.ply")},
             {"segment", odd, "-o", results},
             {"replay", results + "/operations.jsonl", "-o", folder.file(name + " again")}})
      expect_done(arguments);
    EXPECT_EQ(folder.read(name + " again/lines.obj"), folder.read(name + " results/lines.obj"));
    fs::rename(odd, folder.file("moved" + name));
    expect_done({"replay", results + "/operations.jsonl", "--scan", folder.file("moved" + name),
                 "-o", folder.file("third")});
  }
}

TEST_F(Cli, FileNamesMayHoldSpacesAndQuotes) {
  const std::string odd = folder.file("a \"new\" part's scan.ply");
  fs::copy_file(small_part(), odd);
  expect_done({"segment", odd, "-o", folder.file("the results")});
  expect_done({"replay", folder.file("the results/operations.jsonl"), "-o", folder.file("b")});
}

// ---- info, curvature, sample ----

TEST_F(Cli, InfoTellsWhatTheScanHolds) {
  const std::string part = small_part();
  const Outcome text = run({"info", part});
  EXPECT_EQ(text.code, 0);
  EXPECT_NE(text.out.find("PLY"), std::string::npos);
  EXPECT_NE(text.out.find("nothing had to be mended"), std::string::npos);
  const Outcome as_json = run({"info", "--json", part});
  ASSERT_EQ(as_json.code, 0);
  const json report = json::parse(as_json.out);
  const MeshPtr mesh = mesh_of(stepped_plate(10.0, 20.0, 4.0, 1.0));
  EXPECT_EQ(report["faces"], mesh->face_count());
  EXPECT_EQ(report["vertices"], mesh->vertex_count());
  EXPECT_EQ(report["edges"], mesh->edge_count());
  EXPECT_EQ(report["border_edges"], mesh->border_edge_count());
  EXPECT_EQ(report["components"], 1);
  EXPECT_EQ(report["euler_number"], 1);
  EXPECT_EQ(report["size"], (json{20.0, 20.0, 4.0}));
  EXPECT_EQ(report["sentences"], json::array());
  EXPECT_GT(report["default_sharp_angle"], 0.0);
  EXPECT_EQ(report["content_hash"].get<std::string>().size(), 32u);
}

// As little memory as this process may have: refused before it is tried.
TEST_F(Cli, APartThatNeedsMoreMemoryThanThereIsIsRefused) {
  const std::string part = write_mesh(folder, "part.ply", random_terrain(1100, 3));
  const Outcome outcome = run({"info", part}, "ulimit -v 500000;");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("triangles needs about 0.6 GB of memory; this computer has 0.5 GB."),
            std::string::npos)
      << outcome.err;
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
}

// Said by nobody, it is not said; and there is a way to say it.
TEST_F(Cli, AUnitIsToldWhereItIsKnownAndAskedForWhereItIsNot) {
  const std::string part = small_part();
  const Outcome none = run({"info", part});
  EXPECT_EQ(none.code, 0);
  EXPECT_EQ(none.out.find(" mm\n"), std::string::npos) << none.out;
  EXPECT_NE(none.out.find("size: 20 x 20 x 4, mean edge"), std::string::npos) << none.out;
  EXPECT_NE(none.out.find("the file names no unit"), std::string::npos) << none.out;
  EXPECT_NE(none.out.find("millimetres"), std::string::npos) << none.out;
  EXPECT_NE(none.out.find("--unit mm"), std::string::npos) << none.out;
  const json guessed = json::parse(run({"info", part, "--json"}).out);
  EXPECT_EQ(guessed["length_unit"], "unknown");
  EXPECT_EQ(guessed["likely_units"][0], "mm");
  const Outcome inches = run({"info", part, "--unit", "Inch"});
  EXPECT_EQ(inches.code, 0);
  EXPECT_NE(inches.out.find("size: 20 x 20 x 4 in, mean edge"), std::string::npos) << inches.out;
  EXPECT_EQ(inches.out.find("no unit"), std::string::npos) << inches.out;
  const json said = json::parse(run({"info", part, "--json", "--unit", "cm"}).out);
  EXPECT_EQ(said["length_unit"], "cm");
  EXPECT_FALSE(said.contains("likely_units"));
  expect_bad_usage({"info", part, "--unit", "furlong"});
  expect_bad_usage({"segment", part, "-o", folder.file("none"), "--unit", ""});
}

TEST_F(Cli, InfoTellsWhatWasMended) {
  // A square, a face of no extent, and a third face on one edge.
  const std::string scan = folder.write(
      "broken.obj",
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 1\nf 1 2 3 4\nf 1 1 2\nf 1 2 5\nf 2 1 4\n");
  const Outcome text = run({"info", scan});
  EXPECT_EQ(text.code, 0);
  EXPECT_EQ(text.out.find("nothing had to be mended"), std::string::npos);
  const json report = json::parse(run({"info", scan, "--json"}).out);
  EXPECT_EQ(report["file_faces"], 4);
  EXPECT_EQ(report["degenerate_faces"]["count"], 1);
  EXPECT_EQ(report["non_manifold_edges"]["count"], 1);
  ASSERT_FALSE(report["sentences"].empty());
  for (const json& sentence : report["sentences"])
    EXPECT_NE(text.out.find(sentence.get<std::string>()), std::string::npos);
}

/// Each face with vertices of its own.
std::string soup_obj(const Triangles& mesh) {
  std::string vertices, faces;
  std::size_t count = 0;
  for (const Triangle& t : mesh.triangles) {
    for (const VertexId v : t)
      vertices += "v " + std::to_string(mesh.points[v].x()) + " " +
                  std::to_string(mesh.points[v].y()) + " " + std::to_string(mesh.points[v].z()) +
                  "\n";
    faces += "f " + std::to_string(count + 1) + " " + std::to_string(count + 2) + " " +
             std::to_string(count + 3) + "\n";
    count += 3;
  }
  return vertices + faces;
}

TEST_F(Cli, VerticesOnOnePlaceAreJoinedUnlessNotWished) {
  const std::string scan = folder.write("soup.obj", soup_obj(divided_cube(20.0, 6)));
  const json joined = json::parse(run({"info", scan, "--json"}).out);
  EXPECT_EQ(joined["vertices"], 218);
  EXPECT_EQ(joined["border_edges"], 0);
  EXPECT_EQ(joined["coincident_vertices"], 1296 - 218);
  const Outcome apart = run({"info", "--no-weld", scan});
  EXPECT_NE(apart.out.find("432 components"), std::string::npos) << apart.out;
  EXPECT_NE(
      apart.out.find("lie on 218 places and were kept apart as wished, which cuts the surface "
                     "along 648 edges."),
      std::string::npos)
      << apart.out;
  expect_done({"segment", scan, "-o", folder.file("a")});
  EXPECT_EQ(summary("a")["lines"]["count"], 12);
  EXPECT_EQ(summary("a")["partitions"]["count"], 6);
  expect_done({"replay", folder.file("a/operations.jsonl"), "-o", folder.file("b")});
  EXPECT_EQ(summary("b")["document_hash"], summary("a")["document_hash"]);
  EXPECT_EQ(run({"segment", scan, "--no-weld", "-o", folder.file("c")}).code, 0);
  EXPECT_EQ(summary("c")["scan"]["components"], 432);
}

TEST_F(Cli, BlocksThatTouchAlongAnEdgeKeepAllTheirLines) {
  Triangles blocks = divided_cube(20.0, 4);
  const std::size_t first = blocks.points.size();
  for (std::size_t v = 0; v < first; ++v)
    blocks.points.push_back(blocks.points[v] + Point(20, 20, 0));
  for (std::size_t f = 0, count = blocks.triangles.size(); f < count; ++f) {
    Triangle t = blocks.triangles[f];
    for (VertexId& v : t) v += static_cast<VertexId>(first);
    blocks.triangles.push_back(t);
  }
  expect_done({"segment", folder.write("blocks.obj", soup_obj(blocks)), "-o", folder.file("r")});
  EXPECT_EQ(summary("r")["scan"]["border_edges"], 0);
  EXPECT_EQ(summary("r")["scan"]["paired_edges"]["count"], 4);
  EXPECT_EQ(summary("r")["lines"]["count"], 24);
  EXPECT_EQ(summary("r")["partitions"]["count"], 12);
}

TEST_F(Cli, CurvatureWritesSixProperties) {
  const double radius = 10.0;
  const std::string ball = write_mesh(folder, "ball.ply", icosphere(radius, 4));
  expect_done({"curvature", ball, "-o", folder.file("k.ply")});
  const Ply ply = parse_ply(folder.read("k.ply"));
  EXPECT_EQ(ply.vertex_properties,
            (std::vector<std::string>{"x", "y", "z", "K", "H", "Kabs", "IK", "IH", "IKabs"}));
  EXPECT_EQ(ply.face_properties, std::vector<std::string>{"vertex_indices"});
  EXPECT_EQ(ply.vertices.size(), icosphere(radius, 4).points.size());
  for (const auto& vertex : ply.vertices) {  // of a sphere, within the mesh's own error
    EXPECT_NEAR(vertex.at("K"), 1.0 / (radius * radius), 2e-4);
    EXPECT_NEAR(vertex.at("H"), 1.0 / radius, 2e-3);
    EXPECT_NEAR(vertex.at("Kabs"), 2.0 / (radius * radius), 4e-4);
  }
}

TEST_F(Cli, SampleIsTheSameEachTimeAndReadable) {
  expect_done({"sample", "-o", folder.file("a.ply")});
  expect_done({"sample", "-o", folder.file("b.ply")});
  EXPECT_EQ(folder.read("a.ply"), folder.read("b.ply"));
  const json report = json::parse(run({"info", folder.file("a.ply"), "--json"}).out);
  EXPECT_EQ(report["sentences"], json::array()) << "nothing to mend";
  EXPECT_EQ(report["components"], 1);
  EXPECT_GT(report["faces"], 20000);
}

}  // namespace
}  // namespace arris
