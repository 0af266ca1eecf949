// arris-cli as a user runs it: exit codes, what stands on standard error, what the files hold.

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/support/documents.h"

namespace arris {
namespace {

using namespace arris::testing;
using nlohmann::json;
namespace fs = std::filesystem;

const std::vector<std::string> result_files{"lines.obj", "boundaries.obj", "scan_partitions.ply",
                                            "operations.jsonl", "summary.json"};

struct Outcome {
  int code = -1;  // 128 + signal where it was killed
  std::string out, err;
};

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// Each test has a folder of its own.
class Cli : public ::testing::Test {
 protected:
  TempFolder folder;

  Outcome run(const std::vector<std::string>& arguments, const std::string& before = "") const {
    std::string command = before + (before.empty() ? "" : " ") + quoted(ARRIS_CLI);
    for (const std::string& argument : arguments) command += " " + quoted(argument);
    command += " > " + quoted(folder.file("out.txt")) + " 2> " + quoted(folder.file("err.txt"));
    const int status = std::system(command.c_str());
    Outcome outcome;
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    outcome.out = folder.read("out.txt");
    outcome.err = folder.read("err.txt");
    return outcome;
  }

  void expect_done(const std::vector<std::string>& arguments) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
  }

  /// Exit code 1 and one sentence that names what is wrong.
  void expect_bad_input(const std::vector<std::string>& arguments, const std::string& shown) const {
    const Outcome outcome = run(arguments);
    SCOPED_TRACE(::testing::PrintToString(arguments));
    EXPECT_EQ(outcome.code, 1);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("arris-cli: ")) << outcome.err;
    EXPECT_TRUE(outcome.err.ends_with(".\n")) << outcome.err;
    EXPECT_NE(outcome.err.find(shown), std::string::npos) << outcome.err;
  }

  void expect_bad_usage(const std::vector<std::string>& arguments) const {
    const Outcome outcome = run(arguments);
    SCOPED_TRACE(::testing::PrintToString(arguments));
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err, "");
  }

  json summary(const std::string& results) const {
    return json::parse(folder.read(results + "/summary.json"));
  }

  std::string small_part() const {
    return write_mesh(folder, "part.ply", stepped_plate(10.0, 20.0, 4.0, 1.0));
  }
};

/// An OBJ of polylines: its groups with the points each passes. Fails where it is not one.
std::map<std::string, std::vector<Point>> parse_lines_obj(const std::string& text) {
  std::map<std::string, std::vector<Point>> groups;
  std::vector<Point> points;
  std::istringstream lines(text);
  std::string group;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "v") {
      Point p;
      EXPECT_TRUE(words >> p.x() >> p.y() >> p.z()) << line;
      points.push_back(p);
    } else if (key == "g") {
      EXPECT_TRUE(words >> group) << line;
      EXPECT_FALSE(groups.contains(group)) << "group " << group << " twice";
      groups[group] = {};
    } else if (key == "l") {
      EXPECT_TRUE(groups.contains(group)) << "a line outside a group";
      EXPECT_TRUE(groups[group].empty()) << "two lines in group " << group;
      for (std::size_t index; words >> index;) {
        EXPECT_TRUE(index >= 1 && index <= points.size()) << line;
        if (index >= 1 && index <= points.size()) groups[group].push_back(points[index - 1]);
      }
      EXPECT_GE(groups[group].size(), 2u) << line;
    } else {
      EXPECT_TRUE(key.empty() || key.starts_with('#')) << line;
    }
  }
  return groups;
}

/// A binary little-endian PLY as arris-cli writes it.
struct Ply {
  std::string header;
  std::vector<std::string> vertex_properties, face_properties;
  std::vector<std::map<std::string, double>> vertices;
  std::vector<std::vector<std::uint32_t>> faces;
  std::vector<std::int32_t> labels;
};

template <class T>
T take(const std::string& bytes, std::size_t& at) {
  T value{};
  if (at + sizeof(T) > bytes.size()) throw std::runtime_error("the PLY is too short");
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  at += sizeof(T);
  return value;
}

Ply parse_ply(const std::string& bytes) {
  Ply ply;
  const std::string end = "end_header\n";
  std::size_t at = bytes.find(end);
  if (at == std::string::npos) throw std::runtime_error("the PLY has no header");
  at += end.size();
  ply.header = bytes.substr(0, at);
  EXPECT_TRUE(ply.header.starts_with("ply\nformat binary_little_endian 1.0\n")) << ply.header;
  std::size_t vertex_count = 0, face_count = 0;
  std::vector<std::string> vertex_types;
  std::string count_type;
  bool in_faces = false;
  std::istringstream lines(ply.header);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key, type, name;
    words >> key >> type;
    if (key == "element") {
      in_faces = type == "face";
      words >> (in_faces ? face_count : vertex_count);
    } else if (key == "property" && !in_faces) {
      words >> name;
      vertex_types.push_back(type);
      ply.vertex_properties.push_back(name);
    } else if (key == "property" && type == "list") {
      words >> count_type;
      ply.face_properties.push_back("vertex_indices");
    } else if (key == "property") {
      words >> name;
      EXPECT_EQ(type, "int");
      ply.face_properties.push_back(name);
    }
  }
  for (std::size_t k = 0; k < vertex_count; ++k) {
    ply.vertices.emplace_back();
    for (std::size_t j = 0; j < vertex_types.size(); ++j)
      ply.vertices.back()[ply.vertex_properties[j]] =
          vertex_types[j] == "double" ? take<double>(bytes, at) : take<float>(bytes, at);
  }
  for (std::size_t k = 0; k < face_count; ++k) {
    const std::size_t corners =
        count_type == "uchar" ? take<std::uint8_t>(bytes, at) : take<std::uint32_t>(bytes, at);
    ply.faces.emplace_back();
    for (std::size_t j = 0; j < corners; ++j) {
      ply.faces.back().push_back(take<std::uint32_t>(bytes, at));
      EXPECT_LT(ply.faces.back().back(), vertex_count);
    }
    if (ply.face_properties.size() > 1) ply.labels.push_back(take<std::int32_t>(bytes, at));
  }
  EXPECT_EQ(at, bytes.size()) << "bytes after the last face";
  return ply;
}

double length_of(const std::vector<Point>& path) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) sum += (path[i + 1] - path[i]).norm();
  return sum;
}

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

// ---- segment and replay ----

void expect_valid_results(const TempFolder& folder, const std::string& results,
                          std::size_t polygons) {
  for (const std::string& name : result_files)
    ASSERT_TRUE(fs::exists(folder.file(results + "/" + name))) << name;
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.file(results)), fs::directory_iterator()),
            static_cast<std::ptrdiff_t>(result_files.size()))
      << "and nothing else";
  const json summary = json::parse(folder.read(results + "/summary.json"));

  // Lines.
  const auto lines = parse_lines_obj(folder.read(results + "/lines.obj"));
  EXPECT_EQ(lines.size(), summary["lines"]["count"]);
  std::size_t convex = 0, edges = 0, closed = 0;
  double length = 0.0;
  for (const auto& [group, path] : lines) {
    EXPECT_TRUE(std::regex_match(group, std::regex("line_[1-9]\\d*_(convex|concave)"))) << group;
    convex += group.ends_with("_convex");
    edges += path.size() - 1;
    closed += path.front() == path.back();
    length += length_of(path);
  }
  EXPECT_EQ(convex, summary["lines"]["convex"]);
  EXPECT_EQ(lines.size() - convex, summary["lines"]["concave"]);
  EXPECT_EQ(edges, summary["lines"]["edges"]);
  EXPECT_GE(closed, summary["lines"]["closed"]);
  EXPECT_NEAR(length, summary["lines"]["length"], 1e-6 * (1.0 + length));

  // Partitions.
  const Ply ply = parse_ply(folder.read(results + "/scan_partitions.ply"));
  EXPECT_EQ(ply.face_properties, (std::vector<std::string>{"vertex_indices", "partition"}));
  EXPECT_EQ(ply.faces.size(), polygons);
  ASSERT_EQ(ply.labels.size(), polygons);
  std::set<std::int32_t> ids(ply.labels.begin(), ply.labels.end());
  ids.erase(0);
  EXPECT_LE(ids.size(), summary["partitions"]["count"]) << "a tiny one may lose its polygons";
  EXPECT_GE(summary["partitions"]["assigned_area_share"], 0.0);
  EXPECT_LE(summary["partitions"]["assigned_area_share"], 1.0 + 1e-12);
  EXPECT_EQ(summary["partitions"]["sides"].size(), summary["partitions"]["count"]);
  EXPECT_LE(summary["partitions"]["four_sided"], summary["partitions"]["count"]);
  EXPECT_GE(summary["partitions"]["four_sided_share"], 0.0);
  EXPECT_LE(summary["partitions"]["four_sided_share"], 1.0 + 1e-12);

  // Boundaries.
  const auto boundaries = parse_lines_obj(folder.read(results + "/boundaries.obj"));
  std::map<std::string, std::size_t> types;
  const std::regex form(
      "boundary_[1-9]\\d*_((C0)_line([1-9]\\d*)|Gn|undefined|border)((_p[1-9]\\d*){0,2})");
  for (const auto& [group, path] : boundaries) {
    std::smatch match;
    ASSERT_TRUE(std::regex_match(group, match, form)) << group;
    const std::string type = match[2].matched ? "C0" : match[1].str();
    ++types[type];
    const auto sides = std::ranges::count(match[4].str(), 'p');
    EXPECT_TRUE(type == "C0" || sides == (type == "Gn" ? 2 : 1)) << group;
    const std::string line = "line_" + match[3].str();
    EXPECT_TRUE(type != "C0" || lines.contains(line + "_convex") ||
                lines.contains(line + "_concave"))
        << group;
  }
  EXPECT_EQ(json(types), summary["boundaries"].is_null() ? json::object() : summary["boundaries"]);

  // The rest of the summary.
  EXPECT_EQ(summary["scan"]["file_faces"], polygons);
  EXPECT_EQ(summary["document_hash"].get<std::string>().size(), 32u);
  EXPECT_GT(summary["peak_memory_mb"], 1.0);
  EXPECT_LT(summary["peak_memory_mb"], 16000.0);
  EXPECT_GT(summary["mean_edge_length"], 0.0);
  EXPECT_GE(summary["angle_noise_degrees"], 0.0);
  for (const char* key : {"angle", "candidates", "min_length", "parallel_distance", "bridge_gap"})
    EXPECT_TRUE(summary["thresholds"]["find_sharp_lines"][key].is_number()) << key;
  EXPECT_TRUE(summary["thresholds"]["find_partitions"]["intervals"].is_array());
  EXPECT_TRUE(summary["thresholds"]["find_partitions"]["criterion"].is_string());
  double seconds = 0.0;
  for (const auto& [name, value] : summary["seconds"].items()) seconds += value.get<double>();
  EXPECT_GE(seconds, 0.0);
}

void expect_same_files(const TempFolder& folder, const std::string& a, const std::string& b) {
  for (const std::string& name : result_files)
    EXPECT_TRUE(name == "summary.json" ||
                folder.read(a + "/" + name) == folder.read(b + "/" + name))
        << name;
  EXPECT_EQ(json::parse(folder.read(a + "/summary.json"))["document_hash"],
            json::parse(folder.read(b + "/summary.json"))["document_hash"]);
}

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

// ---- real data, where it is at hand ----

class RealScan : public Cli, public ::testing::WithParamInterface<const char*> {};

TEST_P(RealScan, IsSegmentedAndReplayed) {
  const fs::path scan = fs::path(ARRIS_SOURCE_DIR) / "../shared/data" / GetParam();
  if (!fs::exists(scan)) GTEST_SKIP() << scan.string() << " is not at hand";
  const Outcome info = run({"info", scan.string(), "--json"});
  ASSERT_EQ(info.code, 0) << info.err;
  const json report = json::parse(info.out);
  const Outcome outcome = run({"segment", scan.string(), "-o", folder.file("one")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expect_valid_results(folder, "one", report["file_faces"]);
  expect_done({"replay", folder.file("one/operations.jsonl"), "-o", folder.file("two")});
  expect_same_files(folder, "one", "two");
}

INSTANTIATE_TEST_SUITE_P(Data, RealScan,
                         ::testing::Values("broken/crank.off", "broken/noisy_iso.off",
                                           "broken/raw_mesh.ply", "controls/rabbit_realscan.obj",
                                           "pairs/block_n1.obj", "real/iron_realscan.ply",
                                           "real/TR12J_OCC64K.stl"));

}  // namespace
}  // namespace arris
