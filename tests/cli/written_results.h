#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/mesh/mesh.h"
#include "tests/support/temp_folder.h"

/// Reads what arris-cli wrote, by code that shares nothing with it.
namespace arris::testing {

/// All that `segment` and `replay` write.
inline const std::vector<std::string> result_files{
    "lines.obj", "boundaries.obj", "scan_partitions.ply", "operations.jsonl", "summary.json"};

/// An OBJ of polylines: its groups with the points each passes. Fails where it is not one.
std::map<std::string, std::vector<Point>> parse_lines_obj(const std::string& text);

/// A binary little-endian PLY as arris-cli writes it.
struct Ply {
  std::string header;
  std::vector<std::string> vertex_properties, face_properties;
  std::vector<std::map<std::string, double>> vertices;
  std::vector<std::vector<std::uint32_t>> faces;
  std::vector<std::int32_t> labels;
};

/// Throws where the bytes end too early.
Ply parse_ply(const std::string& bytes);

double length_of(const std::vector<Point>& path);  ///< mm

/// The files in the folder `results` hold together and agree with their summary; `polygons`: of the
/// scan's file.
void expect_valid_results(const TempFolder& folder, const std::string& results,
                          std::size_t polygons);
/// Two folders of results hold the same, times left aside.
void expect_same_files(const TempFolder& folder, const std::string& a, const std::string& b);

}  // namespace arris::testing
