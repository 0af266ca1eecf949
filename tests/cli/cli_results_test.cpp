// What arris-cli finds and writes: segment, replay, compare.

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/cli/cli_fixture.h"
#include "tests/cli/written_results.h"
#include "tests/support/documents.h"
#include "tests/support/test_name.h"

namespace arris {
namespace {

using namespace testing;
namespace fs = std::filesystem;

TEST_F(Cli, SegmentOfAStepFindsItsLinesAndLevels) {
  const std::string part = small_part();
  const Outcome outcome =
      run({"segment", part, "-o", folder.file("results"), "--interval", "0:0.001"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("2 lines, 3 partitions"), std::string::npos) << outcome.out;
  expect_valid_results(folder, "results", stepped_plate(10.0, 20.0, 4.0, 1.0).triangles.size());
  const json result = summary("results");
  EXPECT_EQ(result["lines"]["count"], 2);
  EXPECT_EQ(result["lines"]["convex"], 1);
  EXPECT_NEAR(result["lines"]["length"], 40.0, 1e-4);
  EXPECT_EQ(result["partitions"]["count"], 3);
  EXPECT_NEAR(result["partitions"]["assigned_area_share"], 1.0, 1e-9);
  EXPECT_NEAR(result["partitions"]["four_sided_share"], 1.0, 1e-9);
  for (const json& sides : result["partitions"]["sides"]) EXPECT_EQ(sides, 4);
  EXPECT_EQ(result["boundaries"], (json{{"C0", 2}, {"border", 4}}));
  for (const char* step : {"open", "find_sharp_lines", "find_partitions"})
    EXPECT_TRUE(result["seconds"][step].is_number()) << step;
}

TEST_F(Cli, SegmentTellsTheRimsOfAFilletAndItsRadius) {
  expect_done({"segment",
               write_mesh(folder, "part.ply", noisy(filleted_edge(18.0, 5.0, 0.7), 0.05, 5)), "-o",
               folder.file("results")});
  const json result = summary("results");
  EXPECT_EQ(result["partitions"]["count"], 3);
  ASSERT_EQ(result["tangent_lines"].size(), 2u);
  for (const json& line : result["tangent_lines"]) EXPECT_NEAR(line["radius"], 5.0, 0.1);
  const json fillet = result["partitions"]["surfaces"][result["tangent_lines"][0]["fillet"].dump()];
  EXPECT_EQ(fillet["type"], "cylinder");
  EXPECT_LT(fillet["mean_deviation"], 0.1);
}

TEST_F(Cli, SegmentTakesItsOptions) {
  expect_done({"segment", small_part(), "-o", folder.file("results"), "--sharp-angle", "33.5",
               "--method", "walk", "--candidates", "5", "--min-length", "1.25", "--criterion",
               "ikabs", "--min-faces", "7"});
  const json thresholds = summary("results")["thresholds"];
  EXPECT_EQ(thresholds["find_sharp_lines"]["angle"], 33.5);
  EXPECT_EQ(thresholds["find_sharp_lines"]["candidates"], 5);
  EXPECT_EQ(thresholds["find_sharp_lines"]["min_length"], 1.25);
  EXPECT_EQ(thresholds["find_partitions"]["criterion"], "ikabs");
  EXPECT_EQ(thresholds["find_partitions"]["min_faces"], 7);
}

TEST_F(Cli, SegmentTakesTheScanAsItIsOrThePapersFlow) {
  const auto steps = [&](const std::string& results) {
    std::vector<std::string> names;
    std::istringstream rows(folder.read(results + "/operations.jsonl"));
    for (std::string row; std::getline(rows, row);)
      names.push_back(json::parse(row)["operation"]["operation"]);
    return names;
  };
  const std::string part = small_part();
  expect_done({"segment", part, "-o", folder.file("default")});
  EXPECT_EQ(steps("default"),
            (std::vector<std::string>{"open", "find_sharp_lines", "find_partitions"}));
  EXPECT_EQ(summary("default")["thresholds"]["find_sharp_lines"]["method"], "normal_jump");
  expect_done({"segment", part, "-o", folder.file("paper"), "--flow", "paper"});
  EXPECT_EQ(steps("paper"), (std::vector<std::string>{"open", "simplify", "find_sharp_lines",
                                                      "equilateralize", "find_partitions"}));
  EXPECT_EQ(summary("paper")["thresholds"]["find_sharp_lines"]["method"], "walk");
  expect_done({"segment", part, "-o", folder.file("walk"), "--method", "walk", "--smooth", "1"});
  EXPECT_EQ(steps("walk"), (std::vector<std::string>{"open", "find_sharp_lines", "smooth_curvature",
                                                     "find_partitions"}));
  EXPECT_EQ(summary("walk")["thresholds"]["find_sharp_lines"]["method"], "walk");
  expect_done(
      {"segment", part, "-o", folder.file("mixed"), "--flow", "paper", "--method", "normal_jump"});
  EXPECT_EQ(summary("mixed")["thresholds"]["find_sharp_lines"]["method"], "normal_jump");
  expect_done({"segment", part, "-o", folder.file("all"), "--flow", "paper", "--error-zone", "0.02",
               "--max-edge", "2.5", "--swap", "--smooth", "1"});
  EXPECT_EQ(steps("all"),
            (std::vector<std::string>{"open", "simplify", "swap_edges", "find_sharp_lines",
                                      "equilateralize", "smooth_curvature", "find_partitions"}));
  const json thresholds = summary("all")["thresholds"];
  EXPECT_EQ(thresholds["simplify"]["error_zone"], 0.02);
  EXPECT_EQ(thresholds["simplify"]["max_edge_length"], 2.5);
  for (const auto& same : {std::vector<std::string>{"--no-prepare"}, {"--flow", "scan"}}) {
    std::vector<std::string> arguments{"segment", part, "-o", folder.file("bare")};
    arguments.insert(arguments.end(), same.begin(), same.end());
    expect_done(arguments);
    EXPECT_EQ(steps("bare"),
              (std::vector<std::string>{"open", "find_sharp_lines", "find_partitions"}));
  }
}

TEST_F(Cli, OptionsOfTheOtherFlowOrMethodAreRefusedInASentence) {
  const std::string part = small_part(), out = folder.file("results");
  const auto refused = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"segment", part, "-o", out});
    const Outcome outcome = run(options);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_FALSE(fs::exists(out)) << "nothing is written";
    return outcome.err;
  };
  for (const auto& options : {std::vector<std::string>{"--error-zone", "0.02"},
                              {"--max-edge", "2"},
                              {"--swap"},
                              {"--no-prepare", "--swap"},
                              {"--flow", "scan", "--swap"}}) {
    const std::string said = refused(options);
    EXPECT_NE(said.find("--flow paper"), std::string::npos) << said;
    EXPECT_NE(
        said.find(options[0] == "--no-prepare" || options[0] == "--flow" ? "--swap" : options[0]),
        std::string::npos)
        << said;
  }
  EXPECT_NE(refused({"--candidates", "4"}).find("--method walk"), std::string::npos);
  EXPECT_NE(refused({"--flow", "paper", "--method", "normal_jump", "--candidates", "4"})
                .find("--method walk"),
            std::string::npos);
  EXPECT_NE(refused({"--criterion", "ikabs", "--detail", "2"}).find("--partitions surfaces"),
            std::string::npos)
      << "no method has both";
  EXPECT_NE(refused({"--flow", "paper", "--detail", "2"}).find("--partitions surfaces"),
            std::string::npos);
  EXPECT_NE(refused({"--no-prepare", "--flow", "paper"}).find("contradicts"), std::string::npos);
  refused({"--flow", "both"});
  refused({"--method", "magic"});
}

TEST_F(Cli, TheNormalNoiseIsToldWithTheThresholdThatFollowsFromIt) {
  const std::string scan = write_mesh(folder, "scan.ply", sample_mould(2.5));
  const Outcome text = run({"info", scan});
  EXPECT_NE(text.out.find("noise turns normals by "), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("sharp lines are looked for where normals jump by more than"),
            std::string::npos);
  const json report = json::parse(run({"info", "--json", scan}).out);
  EXPECT_GT(report["normal_noise_degrees"], 0.5);
  EXPECT_LT(report["normal_noise_degrees"], 20.0);
  expect_done({"segment", scan, "-o", folder.file("results")});
  const json result = summary("results");
  EXPECT_EQ(result["normal_noise_degrees"], report["normal_noise_degrees"]);
  EXPECT_EQ(result["default_sharp_angle"], report["default_sharp_angle"]);
  EXPECT_EQ(result["thresholds"]["find_sharp_lines"]["angle"], report["default_sharp_angle"]);
}

TEST_F(Cli, SimplifySaysTheErrorZoneInThreeDigits) {
  const std::string scan = write_mesh(folder, "scan.ply", sample_mould(2.5));
  const Outcome outcome = run({"simplify", scan, "-o", folder.file("out.ply")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::size_t start = outcome.out.find("within ") + 7, end = outcome.out.find(" of the scan");
  ASSERT_LT(start, end);
  const std::string zone = outcome.out.substr(start, end - start);
  EXPECT_GT(std::stod(zone), 0.0);
  EXPECT_LE(zone.size(), std::string("0.00123").size()) << zone;
}

TEST_F(Cli, ReplayTakesTreatmentsByHand) {
  const std::string part = small_part();
  expect_done({"segment", part, "-o", folder.file("first"), "--no-prepare"});
  const json before = summary("first");
  ASSERT_GE(before["lines"]["count"], 1);
  // The lowest id is that of the line found first.
  std::string text = json{{"operation", "open"}, {"file", part}}.dump() + "\n" +
                     json{{"operation", "find_sharp_lines"}}.dump() + "\n" +
                     json{{"operation", "delete_lines"}, {"lines", {1}}}.dump() + "\n" +
                     json{{"operation", "find_sharp_lines"}}.dump() + "\n";
  const std::string operations = folder.write("treated.jsonl", text);
  expect_done({"replay", operations, "-o", folder.file("second")});
  EXPECT_EQ(summary("second")["lines"]["count"].get<int>(),
            before["lines"]["count"].get<int>() - 1);
  // What it wrote replays to the same document.
  expect_done({"replay", folder.file("second/operations.jsonl"), "-o", folder.file("third")});
  EXPECT_EQ(summary("third")["document_hash"], summary("second")["document_hash"]);
  text += json{{"operation", "delete_lines"}, {"lines", {1}}}.dump() + "\n";
  expect_bad_input({"replay", folder.write("wrong.jsonl", text), "-o", folder.file("fourth")},
                   "there is no line 1");
}

TEST_F(Cli, NamedVersionsAreComparedAndWritten) {
  const std::string part = small_part();
  std::string text = json{{"operation", "open"}, {"file", part}}.dump() + "\n" +
                     json{{"operation", "find_sharp_lines"}}.dump() + "\n";
  expect_done({"replay", folder.write("plain.jsonl", text), "-o", folder.file("plain")});
  text = folder.read("plain/operations.jsonl") + json{{"name", "as found"}, {"row", 2}}.dump() +
         "\n" + json{{"operation", "delete_lines"}, {"lines", {1}}}.dump() + "\n";
  const std::string session = folder.write("session.jsonl", text);

  expect_done({"replay", session, "--at", "as found", "-o", folder.file("version")});
  EXPECT_EQ(summary("version")["document_hash"], summary("plain")["document_hash"]);
  EXPECT_EQ(summary("version")["versions"], (json{{"as found", 2}}));
  EXPECT_EQ(folder.read("version/lines.obj"), folder.read("plain/lines.obj"));

  const Outcome told = run({"compare", session, "as found", "--json"});
  ASSERT_EQ(told.code, 0) << told.err;
  const json found = json::parse(told.out);
  const double deleted = summary("plain")["lines"]["length"].get<double>() -
                         found["versions"][1]["length"].get<double>();
  EXPECT_NEAR(found["versions"][0]["only_here"]["sharp_length"].get<double>(), deleted,
              1e-9 + 2.0 * found["tolerance"].get<double>());
  EXPECT_EQ(found["versions"][1]["only_here"]["sharp_length"], 0.0);
  expect_done({"compare", session, "as found", "as found"});
  expect_bad_input({"compare", session, "tight"}, "as found");
  expect_bad_input({"replay", session, "--at", "tight", "-o", folder.file("no")}, "tight");
  expect_bad_usage({"compare", session});
}

TEST_F(Cli, ASessionIsOneFileThatNeedsNothingElse) {
  const std::string part = small_part(), session = folder.file("one.arris");
  expect_bad_input(
      {"segment", part, "-o", folder.file("no"), "--session", folder.file("a/b.arris")}, "b.arris");
  EXPECT_FALSE(fs::exists(folder.file("no"))) << "known before the work";
  ASSERT_EQ(run({"segment", part, "-o", folder.file("one"), "--session", session}).code, 0);
  fs::remove(part);
  const Outcome replayed = run({"replay", session, "-o", folder.file("two"), "--session", session});
  ASSERT_EQ(replayed.code, 0) << replayed.err;
  EXPECT_EQ(replayed.err, "");
  expect_same_files(folder, "one", "two");

  // Under a name that says nothing, with a version named in between.
  const std::string text = folder.read("two/operations.jsonl") +
                           json{{"name", "as found"}, {"row", 2}}.dump() + "\n" +
                           json{{"operation", "delete_lines"}, {"lines", {1}}}.dump() + "\n";
  expect_bad_input({"replay", folder.write("edited.jsonl", text), "-o", folder.file("three")},
                   "part.ply");
  std::ofstream(part) << "another part";
  expect_bad_input({"replay", folder.file("edited.jsonl"), "-o", folder.file("three")}, "changed");
  fs::rename(session, folder.file("one.dat"));
  expect_done({"replay", folder.file("one.dat"), "-o", folder.file("four")});
  EXPECT_EQ(summary("four")["document_hash"], summary("one")["document_hash"]);

  folder.write("cut.arris", folder.read("one.dat").substr(0, 20000));
  expect_bad_input({"replay", folder.file("cut.arris"), "-o", folder.file("five")}, "cut.arris");
  expect_bad_input({"compare", folder.file("cut.arris"), "as found"}, "cut.arris");
  EXPECT_FALSE(fs::exists(folder.file("five")));
}

TEST_F(Cli, VersionsInASessionAreCompared) {
  const std::string part = small_part(), session = folder.file("versions.arris");
  ASSERT_EQ(run({"segment", part, "-o", folder.file("found")}).code, 0);
  const std::string text = folder.read("found/operations.jsonl") +
                           json{{"name", "as found"}, {"row", 3}}.dump() + "\n" +
                           json{{"operation", "delete_lines"}, {"lines", {1}}}.dump() + "\n";
  expect_done({"replay", folder.write("edited.jsonl", text), "-o", folder.file("edited"),
               "--session", session});
  fs::remove(part);
  const Outcome told = run({"compare", session, "as found", "--json"});
  ASSERT_EQ(told.code, 0) << told.err;
  EXPECT_GT(json::parse(told.out)["versions"][0]["only_here"]["sharp_length"], 0.0);
  expect_done({"replay", session, "--at", "as found", "-o", folder.file("version")});
  EXPECT_EQ(folder.read("version/lines.obj"), folder.read("found/lines.obj"));
}

// Wherever results have a place for it; the results themselves are the same.
TEST_F(Cli, TheUnitStandsInResultsAndSessions) {
  const std::string part = small_part();
  ASSERT_EQ(run({"segment", part, "-o", folder.file("plain")}).code, 0);
  ASSERT_EQ(run({"segment", part, "-o", folder.file("cm"), "--unit", "cm", "--session",
                 folder.file("cm.arris")})
                .code,
            0);
  EXPECT_EQ(summary("plain")["unit"], "unknown");
  EXPECT_EQ(summary("cm")["unit"], "cm");
  EXPECT_EQ(folder.read("plain/operations.jsonl").find("unit"), std::string::npos);
  const auto head = [&](const std::string& name) {
    const std::string text = folder.read(name);
    return text.substr(0, text.find('\n'));
  };
  const auto rest = [&](const std::string& name) {
    const std::string text = folder.read(name);
    return text.substr(text.find('\n'));
  };
  for (const std::string name : {"lines.obj", "boundaries.obj"}) {
    EXPECT_EQ(head("plain/" + name), "# Arris; lengths in the unit of the scan");
    EXPECT_EQ(head("cm/" + name), "# Arris; lengths in centimetres");
    EXPECT_EQ(rest("cm/" + name), rest("plain/" + name));
  }
  std::string ply = folder.read("cm/scan_partitions.ply");
  const std::string comment = "comment lengths in centimetres\n";
  ASSERT_NE(ply.find(comment), std::string::npos);
  EXPECT_EQ(ply.erase(ply.find(comment), comment.size()), folder.read("plain/scan_partitions.ply"));
  // The session has it, and so has what is made of that.
  ASSERT_EQ(run({"replay", folder.file("cm.arris"), "-o", folder.file("again")}).code, 0);
  EXPECT_EQ(summary("again")["unit"], "cm");
  expect_same_files(folder, "cm", "again");
  // It can be said afterwards; a second time it changes nothing.
  ASSERT_EQ(run({"replay", folder.file("plain/operations.jsonl"), "-o", folder.file("said"),
                 "--unit", "in"})
                .code,
            0);
  EXPECT_EQ(summary("said")["unit"], "in");
  const Outcome twice = run(
      {"replay", folder.file("said/operations.jsonl"), "-o", folder.file("twice"), "--unit", "in"});
  EXPECT_EQ(twice.code, 0) << twice.err;
  EXPECT_EQ(folder.read("twice/operations.jsonl"), folder.read("said/operations.jsonl"));
  // What Arris wrote keeps its unit.
  EXPECT_EQ(json::parse(
                run({"info", "--json", folder.file("cm/scan_partitions.ply")}).out)["length_unit"],
            "cm");
}

TEST_F(Cli, SampleMouldThereAndBack) {
  const std::string mould = folder.file("mould.ply");
  expect_done({"sample", "-o", mould});
  const json report = json::parse(run({"info", mould, "--json"}).out);
  ASSERT_EQ(run({"segment", mould, "-o", folder.file("one")}).code, 0);
  expect_valid_results(folder, "one", report["file_faces"]);
  EXPECT_GT(summary("one")["lines"]["count"], 3);
  EXPECT_GT(summary("one")["partitions"]["count"], 3);
  // The polygons are those of the file, in its order.
  const Ply in = parse_ply(folder.read("mould.ply"));
  const Ply out = parse_ply(folder.read("one/scan_partitions.ply"));
  EXPECT_EQ(out.faces, in.faces);
  ASSERT_EQ(out.vertices.size(), in.vertices.size());
  EXPECT_EQ(out.vertices, in.vertices);

  // Replayed: the same bytes.
  const Outcome replayed =
      run({"replay", folder.file("one/operations.jsonl"), "-o", folder.file("two")});
  ASSERT_EQ(replayed.code, 0) << replayed.err;
  EXPECT_EQ(replayed.err, "");
  expect_valid_results(folder, "two", report["file_faces"]);
  expect_same_files(folder, "one", "two");
  EXPECT_EQ(summary("two")["warnings"], json::array());
  EXPECT_TRUE(summary("two")["seconds"]["replay"].is_number());

  // On one processor: the same bytes.
  if (std::system("taskset -c 0 true 2> /dev/null") == 0) {
    ASSERT_EQ(run({"segment", mould, "-o", folder.file("three")}, "taskset -c 0").code, 0);
    expect_same_files(folder, "one", "three");
  }

  // Moved elsewhere: named anew.
  fs::rename(mould, folder.file("moved.ply"));
  expect_bad_input({"replay", folder.file("one/operations.jsonl"), "-o", folder.file("four")},
                   "mould.ply");
  expect_done({"replay", folder.file("one/operations.jsonl"), "-o", folder.file("four"), "--scan",
               folder.file("moved.ply")});
  EXPECT_EQ(summary("four")["document_hash"], summary("one")["document_hash"]);

  // Another part under the old name: refused.
  write_mesh(folder, "mould.ply", stepped_plate(10.0, 20.0, 4.0, 1.0));
  expect_bad_input({"replay", folder.file("one/operations.jsonl"), "-o", folder.file("five")},
                   "changed");
}

TEST_F(Cli, PolygonsAndFacesLeftOutKeepTheirPlaces) {
  // Quads of two levels and a wall, with a face of no extent and a doubled one among them.
  std::string obj;
  const int across = 12, along = 8;
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i <= across; ++i)
      obj += "v " + std::to_string(i < 6 ? i : i - 1) + " " + std::to_string(j) + " " +
             (i < 6 ? "0" : "1") + "\n";
  std::vector<std::vector<std::uint32_t>> polygons;
  std::set<std::size_t> left_out;
  for (std::uint32_t j = 0; j < along; ++j)
    for (std::uint32_t i = 0; i < across; ++i) {
      const std::uint32_t a = j * (across + 1) + i;
      polygons.push_back({a, a + 1, a + across + 2, a + across + 1});
      if (i == 3 && j == 2) {
        left_out.insert(polygons.size());
        polygons.push_back({a, a, a + 1});
      }
      if (i == 9 && j == 5) {
        left_out.insert(polygons.size());
        polygons.push_back(polygons.back());
      }
    }
  for (const auto& polygon : polygons) {
    obj += "f";
    for (const std::uint32_t v : polygon) obj += " " + std::to_string(v + 1);
    obj += "\n";
  }
  ASSERT_EQ(run({"segment", folder.write("quads.obj", obj), "-o", folder.file("results"),
                 "--interval", "0:0.001"})
                .code,
            0);
  expect_valid_results(folder, "results", polygons.size());
  const Ply ply = parse_ply(folder.read("results/scan_partitions.ply"));
  EXPECT_EQ(ply.faces, polygons);
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    if (left_out.contains(k)) {
      EXPECT_EQ(ply.labels[k], 0) << "polygon " << k;
      continue;
    }
    const bool low = polygons[k][1] % (across + 1) <= 5, high = polygons[k][0] % (across + 1) >= 6;
    const std::int32_t label = ply.labels[k];
    EXPECT_TRUE(!low || label == ply.labels.front()) << "polygon " << k;
    EXPECT_TRUE(!high || label == ply.labels.back()) << "polygon " << k;
  }
  EXPECT_NE(ply.labels.front(), 0);
  EXPECT_NE(ply.labels.front(), ply.labels.back());
}

TEST_F(Cli, ResultsOverwriteOlderOnes) {
  const std::string part = small_part();
  expect_done({"segment", part, "-o", folder.file("results"), "--sharp-angle", "179"});
  EXPECT_EQ(summary("results")["lines"]["count"], 0);
  expect_done({"segment", part, "-o", folder.file("results")});
  EXPECT_EQ(summary("results")["lines"]["count"], 2);
  expect_valid_results(folder, "results", stepped_plate(10.0, 20.0, 4.0, 1.0).triangles.size());
}

TEST_F(Cli, CoreToolNeedsNeitherQtNorVtk) {
  const std::string command =
      "ldd " + quoted(ARRIS_CLI) + " > " + quoted(folder.file("libraries.txt"));
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string libraries = folder.read("libraries.txt");
  EXPECT_NE(libraries.find("libc"), std::string::npos);
  EXPECT_FALSE(std::regex_search(libraries, std::regex("libQt|libvtk"))) << libraries;
}

// ---- scans: made, and real ones where they are at hand ----

class ResultsOfScans : public Cli {
 protected:
  void expect_segmented_and_replayed(const std::string& scan) {
    const Outcome info = run({"info", scan, "--json"});
    ASSERT_EQ(info.code, 0) << info.err;
    const json report = json::parse(info.out);
    const Outcome outcome = run({"segment", scan, "-o", folder.file("one")});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    expect_valid_results(folder, "one", report["file_faces"]);
    expect_done({"replay", folder.file("one/operations.jsonl"), "-o", folder.file("two")});
    expect_same_files(folder, "one", "two");
  }
};

TEST_F(ResultsOfScans, ANoisyOneIsSegmentedAndReplayed) {
  expect_segmented_and_replayed(write_mesh(folder, "scan.ply", noisy(sample_mould(4.0), 0.15, 5)));
}

TEST_F(ResultsOfScans, ABrokenOneIsSegmentedAndReplayed) {
  Triangles scan = noisy(sample_mould(4.0), 0.1, 6);
  // A hole, faces there twice and turned over, one that is a line, and a third fan on an edge.
  scan.triangles.erase(scan.triangles.begin() + 200, scan.triangles.begin() + 260);
  for (std::size_t f = 0; f < 20; ++f) {
    Triangle face = scan.triangles[10 * f];
    if (f % 2) std::swap(face[0], face[1]);
    scan.triangles.push_back(face);
  }
  const Triangle edge = scan.triangles[500];
  scan.triangles.push_back({edge[0], edge[1], edge[1]});
  scan.triangles.push_back({edge[0], edge[1], scan.triangles[900][2]});
  std::ostringstream off;
  off << "OFF\n" << scan.points.size() << " " << scan.triangles.size() << " 0\n";
  for (const Point& p : scan.points) off << p.transpose() << "\n";
  for (const Triangle& t : scan.triangles)
    off << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
  expect_segmented_and_replayed(folder.write("scan.off", off.str()));
}

class RealScan : public ResultsOfScans, public ::testing::WithParamInterface<const char*> {};

TEST_P(RealScan, IsSegmentedAndReplayed) {
  const fs::path scan = fs::path(ARRIS_SOURCE_DIR) / "../shared/data" / GetParam();
  if (!fs::exists(scan)) GTEST_SKIP() << scan.string() << " is not at hand";
  expect_segmented_and_replayed(scan.string());
}

INSTANTIATE_TEST_SUITE_P(Data, RealScan,
                         ::testing::Values("broken/crank.off", "broken/noisy_iso.off",
                                           "broken/raw_mesh.ply", "controls/rabbit_realscan.obj",
                                           "pairs/block_n1.obj", "real/iron_realscan.ply",
                                           "real/TR12J_OCC64K.stl"),
                         [](const auto& scan) { return test_name(scan.param); });

TEST_F(Cli, ASessionMayLieInTheFolderThatIsMadeForTheResults) {
  const std::string scan = write_mesh(folder, "part.ply", capped_cylinder(5.0, 12.0, 24, 8, 4));
  const std::string place = folder.file("new/results");
  expect_done({"segment", scan, "-o", place, "--session", place + "/part.arris"});
  expect_done({"replay", place + "/part.arris", "-o", folder.file("again")});
  expect_bad_input(
      {"segment", scan, "-o", folder.file("other"), "--session", folder.file("nowhere/part.arris")},
      "nowhere");
}

}  // namespace
}  // namespace arris
