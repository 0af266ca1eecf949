#include "tests/cli/written_results.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace arris::testing {

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

template <class T>
T take(const std::string& bytes, std::size_t& at) {
  T value{};
  if (at + sizeof(T) > bytes.size()) throw std::runtime_error("the PLY is too short");
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  at += sizeof(T);
  return value;
}

}  // namespace

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

  // Surfaces, and where they touch.
  EXPECT_EQ(summary["partitions"]["surfaces"].size(), summary["partitions"]["count"]);
  for (const json& surface : summary["partitions"]["surfaces"])
    // A free one may be a height field, or nothing that can be fitted.
    EXPECT_TRUE(surface.contains("max_deviation") || surface["type"] == "free") << surface;
  std::vector<std::string> groups;
  for (const auto& [group, path] : boundaries) groups.push_back(group);
  for (const json& line : summary["tangent_lines"]) {
    const std::string head = "boundary_" + line["boundary"].dump() + "_Gn_";
    EXPECT_TRUE(std::ranges::any_of(groups, [&](const std::string& group) {
      return group.starts_with(head);
    })) << head;
    EXPECT_TRUE(summary["partitions"]["surfaces"].contains(line["fillet"].dump()));
    EXPECT_GT(line["radius"], 0.0);
  }

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

}  // namespace arris::testing
