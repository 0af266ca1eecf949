#include "tests/bench/accuracy/save.h"

#include <filesystem>

#include <nlohmann/json.hpp>

#include "core/base/number_text.h"
#include "core/base/write_file.h"
#include "core/mesh/write_ply.h"

namespace arris::accuracy {

namespace {

namespace fs = std::filesystem;

Result<void> make_folder(const std::string& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) return fail("The folder " + folder + " cannot be made: " + code.message() + ".");
  return {};
}

std::string path_in(const std::string& folder, const char* name) {
  return (fs::path(folder) / name).string();
}

std::string obj_of(const std::vector<Polyline>& lines) {
  std::string text;
  std::size_t vertices = 0;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    std::string indices;
    for (const Point& p : lines[k]) {
      text += "v " + number_text(p.x(), 12) + " " + number_text(p.y(), 12) + " " +
              number_text(p.z(), 12) + "\n";
      indices += " " + std::to_string(++vertices);
    }
    text += "g line_" + std::to_string(k + 1) + "\nl" + indices + "\n";
  }
  return text;
}

/// The classes are those that a demand comes from; see read_curves() in truth_folder.cpp.
std::string curves_of(const Truth& truth) {
  nlohmann::json curves = nlohmann::json::array();
  for (const TrueCurve& curve : truth.curves) {
    nlohmann::json points = nlohmann::json::array();
    for (const Point& p : curve.points) points.push_back({p.x(), p.y(), p.z()});
    const bool must = curve.demand == Demand::must;
    curves.push_back({{"class", must ? "sharp_convex" : "boundary"},
                      {"angle", curve.angle},
                      {"pts", std::move(points)}});
  }
  return nlohmann::json{{"curves", std::move(curves)}}.dump() + "\n";
}

}  // namespace

Result<void> save_part(const std::string& folder, const Part& part) {
  if (auto made = make_folder(folder); !made) return made;
  if (auto r = write_ply(path_in(folder, "scan.ply"), *part.scan->mesh, {}); !r) return r;
  const Truth& truth = part.truth;
  if (auto r = write_file_whole(path_in(folder, "scan_curves.json"), curves_of(truth)); !r)
    return r;
  if (truth.patches.empty()) return {};
  std::string labels;
  for (std::size_t f = 0; f < truth.patches.size(); ++f) {
    const std::string patch = std::to_string(truth.patches[f]);
    labels += (truth.surfaces.empty() ? patch : std::to_string(truth.surfaces[f])) + " " + patch +
              " " + patch + "\n";
  }
  return write_file_whole(path_in(folder, "scan.labels"), labels);
}

Result<void> save_found(const std::string& folder, const Part& part, const Found& found) {
  if (auto made = make_folder(folder); !made) return made;
  if (auto r = write_file_whole(path_in(folder, "lines.obj"), obj_of(found.lines)); !r) return r;
  if (found.labels.empty()) return {};
  return write_labelled_scan(path_in(folder, "scan_partitions.ply"), *part.scan, found.labels);
}

}  // namespace arris::accuracy
