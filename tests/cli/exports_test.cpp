// What arris-cli export hands to other programs, read again by code that shares nothing with it.

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/cli/cli_fixture.h"
#include "tests/cli/written_results.h"

namespace arris {
namespace {

using namespace testing;

/// A cylinder with two closed lines and three partitions, as a session.
class Exports : public Cli {
 protected:
  void SetUp() override {
    expect_done({"segment", write_mesh(folder, "part.ply", capped_cylinder(5.0, 12.0, 48, 24, 10)),
                 "-o", folder.file("results"), "--session", folder.file("part.arris")});
  }
  std::string exported(const std::string& what, const std::string& ending) {
    expect_done_saying(
        {"export", folder.file("part.arris"), "--what", what, "-o", folder.file(what + ending)},
        "written to");
    return folder.read(what + ending);
  }
  void expect_done_saying(const std::vector<std::string>& arguments, const std::string& said) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find(said), std::string::npos) << outcome.out;
  }
  /// Lengths as lines.obj and boundaries.obj have them, in their order of size.
  std::vector<double> lengths_in(const std::string& what) {
    std::vector<double> lengths;
    for (const auto& [name, path] : parse_lines_obj(folder.read("results/" + what + ".obj")))
      lengths.push_back(length_of(path));
    std::ranges::sort(lengths);
    return lengths;
  }
};

void expect_near(std::vector<double> found, const std::vector<double>& expected) {
  std::ranges::sort(found);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-6);
}

std::vector<std::vector<std::string>> cells_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::string cell;
    for (const char c : line + ",") {
      if (c == ',')
        rows.back().push_back(std::move(cell)), cell.clear();
      else
        cell += c;
    }
  }
  return rows;
}

TEST_F(Exports, DxfHasEachCurveOnItsLayer) {
  for (const std::string what : {"lines", "boundaries"}) {
    std::istringstream dxf(exported(what, ".dxf"));
    // Pairs of lines: a code and its value.
    std::vector<double> lengths;
    std::set<std::string> layers, used;
    std::vector<Point> path;
    bool closed = false;
    std::string entity, section, code, value;
    while (std::getline(dxf, code) && std::getline(dxf, value)) {
      const int number = std::stoi(code);
      if (number == 0) {
        if (value == "SEQEND") {
          if (closed) path.push_back(path.front());
          lengths.push_back(length_of(path));
        }
        if (value == "POLYLINE") path.clear();
        if (value == "VERTEX") path.emplace_back(Point::Zero());
        entity = value;
      } else if (number == 2 && entity == "LAYER") {
        layers.insert(value);
      } else if (number == 8) {
        used.insert(value);
      } else if (number == 70 && entity == "POLYLINE") {
        EXPECT_TRUE(std::stoi(value) & 8) << "not in space";
        closed = std::stoi(value) & 1;
      } else if (entity == "VERTEX" && (number == 10 || number == 20 || number == 30)) {
        path.back()[number / 10 - 1] = std::stod(value);
      }
    }
    EXPECT_EQ(entity, "EOF");
    EXPECT_EQ(layers, used);
    expect_near(lengths, lengths_in(what));
  }
}

TEST_F(Exports, StepHasEachCurveInMillimetresAndSharesPoints) {
  for (const std::string what : {"lines", "boundaries"}) {
    const std::string step = exported(what, ".step");
    EXPECT_EQ(step.rfind("ISO-10303-21;", 0), 0u);
    EXPECT_NE(step.find("SI_UNIT(.MILLI.,.METRE.)"), std::string::npos);
    std::map<int, std::string> entities;
    const std::regex row("#(\\d+)=([^;]*);");
    for (std::sregex_iterator it(step.begin(), step.end(), row), end; it != end; ++it)
      EXPECT_TRUE(entities.emplace(std::stoi((*it)[1]), (*it)[2]).second) << (*it)[1];
    std::map<int, Point> points;
    std::set<std::vector<double>> places;
    std::vector<double> lengths;
    const std::regex reference("#(\\d+)"), number("-?\\d+\\.\\d*(E[-+]?\\d+)?");
    for (const auto& [id, entity] : entities) {
      std::vector<int> named;
      for (std::sregex_iterator it(entity.begin(), entity.end(), reference), end; it != end; ++it) {
        named.push_back(std::stoi((*it)[1]));
        EXPECT_TRUE(entities.contains(named.back())) << entity;
      }
      if (entity.rfind("CARTESIAN_POINT", 0) == 0) {
        std::vector<double> place;
        for (std::sregex_iterator it(entity.begin(), entity.end(), number), end; it != end; ++it)
          place.push_back(std::stod(it->str()));
        ASSERT_EQ(place.size(), 3u) << entity;
        points[id] = Point(place[0], place[1], place[2]);
        EXPECT_TRUE(places.insert(place).second || points[id].isZero()) << entity;
      }
      if (entity.rfind("POLYLINE", 0) == 0) {
        std::vector<Point> path;
        for (const int k : named) path.push_back(points.at(k));
        lengths.push_back(length_of(path));
      }
    }
    expect_near(lengths, lengths_in(what));
  }
}

TEST_F(Exports, CadGetsTheUnit) {
  const auto in_inches = [&](const std::string& ending) {
    expect_done_saying({"export", folder.file("part.arris"), "--what", "lines", "--unit", "in",
                        "-o", folder.file("inches" + ending)},
                       "written to");
    return folder.read("inches" + ending);
  };
  EXPECT_NE(in_inches(".dxf").find("$INSUNITS\n70\n1\n"), std::string::npos);
  EXPECT_NE(exported("lines", ".dxf").find("$INSUNITS\n70\n0\n"), std::string::npos);
  // A cylinder of 5 inches.
  const std::string step = in_inches(".step");
  const std::regex point("CARTESIAN_POINT\\('',\\(([^,]*),([^,]*),");
  double farthest = 0.0;
  for (std::sregex_iterator it(step.begin(), step.end(), point), end; it != end; ++it)
    farthest = std::max(farthest, std::hypot(std::stod((*it)[1]), std::stod((*it)[2])));
  EXPECT_NEAR(farthest, 5.0 * 25.4, 1e-3);
}

TEST_F(Exports, TablesAndPointsHoldWhatTheSummarySays) {
  const json summary = json::parse(folder.read("results/summary.json"));
  const auto lines = cells_of(exported("line_table", ".csv"));
  ASSERT_EQ(lines.size(), summary["lines"]["count"].get<std::size_t>() + 1);
  double length = 0.0;
  for (std::size_t k = 1; k < lines.size(); ++k) {
    ASSERT_EQ(lines[k].size(), lines[0].size());
    EXPECT_EQ(lines[0][5], "length");
    length += std::stod(lines[k][5]);
  }
  EXPECT_NEAR(length, summary["lines"]["length"], 1e-6 * length);
  EXPECT_EQ(cells_of(exported("boundary_table", ".csv")).size(),
            lengths_in("boundaries").size() + 1);

  const auto partitions = cells_of(exported("partition_table", ".csv"));
  ASSERT_EQ(partitions.size(), 4u);
  std::multiset<std::string> types;
  double share = 0.0;
  for (std::size_t k = 1; k < partitions.size(); ++k) {
    ASSERT_EQ(partitions[k].size(), partitions[0].size());
    types.insert(partitions[k][6]);
    share += std::stod(partitions[k][3]);
    if (partitions[k][6] == "cylinder") {
      EXPECT_NEAR(std::stod(partitions[k][7]), 5.0, 0.02);
    }
  }
  EXPECT_EQ(types, (std::multiset<std::string>{"cylinder", "plane", "plane"}));
  EXPECT_NEAR(share, 1.0, 1e-6);

  const auto points = cells_of(exported("lines", ".csv"));
  std::map<std::string, std::vector<Point>> paths;
  for (std::size_t k = 1; k < points.size(); ++k)
    paths[points[k][0]].emplace_back(std::stod(points[k][2]), std::stod(points[k][3]),
                                     std::stod(points[k][4]));
  std::vector<double> lengths;
  for (const auto& [name, path] : paths) lengths.push_back(length_of(path));
  expect_near(lengths, lengths_in("lines"));
}

TEST_F(Exports, PartitionsAreGroupsThatShareTheirBoundaries) {
  std::istringstream obj(exported("partitions", ".obj"));
  std::vector<Point> points;
  std::map<std::string, std::set<std::size_t>> of_group;
  std::size_t faces = 0;
  std::string group;
  for (std::string line; std::getline(obj, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      Point& p = points.emplace_back();
      words >> p.x() >> p.y() >> p.z();
    } else if (word == "g") {
      words >> group;
    } else if (word == "f") {
      ++faces;
      for (std::size_t v; words >> v;) of_group[group].insert(v);
    }
  }
  EXPECT_EQ(faces, capped_cylinder(5.0, 12.0, 48, 24, 10).triangles.size());
  ASSERT_EQ(of_group.size(), 3u);
  // Each point of a boundary belongs to two groups.
  for (const auto& [name, path] : parse_lines_obj(folder.read("results/boundaries.obj")))
    for (const Point& p : path) {
      const auto v = static_cast<std::size_t>(std::ranges::find(points, p) - points.begin()) + 1;
      EXPECT_EQ(
          std::ranges::count_if(of_group, [&](const auto& g) { return g.second.contains(v); }), 2);
    }
}

TEST_F(Exports, WhatCannotBeWrittenIsSaid) {
  const std::string session = folder.file("part.arris");
  expect_bad_input({"export", session, "--what", "lines", "-o", folder.file("lines.stl")},
                   "lines can be written as .obj, .step, .dxf, .vtp, .csv");
  expect_bad_input({"export", session, "--what", "lines", "-o", folder.file("no/folder/l.dxf")},
                   "no/folder");
  expect_bad_input(
      {"export", folder.file("none.arris"), "--what", "lines", "-o", folder.file("lines.dxf")},
      "none.arris");
  EXPECT_EQ(run({"export", session, "--what", "holes", "-o", folder.file("holes.obj")}).code, 2);
}

}  // namespace
}  // namespace arris
