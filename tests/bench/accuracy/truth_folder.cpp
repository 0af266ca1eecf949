#include "tests/bench/accuracy/truth_folder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/curvature/curvature.h"
#include "tests/bench/accuracy/kd_tree.h"

namespace arris::accuracy {

namespace {

namespace fs = std::filesystem;

constexpr double lines_reach = 1.5;  // mean edges: how far a found line may lie from a true one
constexpr double pair_angle = 35.0;  // degrees; an edge of a clean mesh is sharp from here on

Result<std::vector<TrueCurve>> read_curves(const fs::path& path) {
  std::ifstream file(path);
  const nlohmann::json json = nlohmann::json::parse(file, nullptr, false);
  if (!json.is_object() || !json.contains("curves"))
    return fail(path.string() + " is no JSON object with \"curves\".");
  std::vector<TrueCurve> curves;
  for (const nlohmann::json& item : json["curves"]) {
    const std::string kind = item.at("class");
    if (kind == "seam" || kind == "g2") continue;
    TrueCurve curve;
    if (item.contains("angle") && item["angle"].is_number()) curve.angle = item["angle"];
    if (kind.starts_with("sharp") && curve.angle >= must_angle)
      curve.demand = Demand::must;
    else if (curve.angle >= may_angle || kind == "boundary")
      curve.demand = Demand::may;
    else
      continue;
    for (const nlohmann::json& p : item.at("pts"))
      curve.points.emplace_back(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
    curves.push_back(std::move(curve));
  }
  return curves;
}

Result<void> read_labels(const fs::path& path, const Scan& scan, Truth& truth) {
  std::ifstream file(path);
  std::vector<std::array<std::uint32_t, 2>> rows;  // per polygon of the file
  for (std::array<std::uint32_t, 2> row; file >> row[0] >> row[1];) {
    rows.push_back(row);
    file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  if (rows.size() != scan.report.file_faces)
    return fail(path.string() + " has " + std::to_string(rows.size()) + " lines, its scan " +
                std::to_string(scan.report.file_faces) + " faces.");
  for (const std::uint32_t polygon : scan.source_faces) {
    truth.surfaces.push_back(rows[polygon][0]);
    truth.patches.push_back(rows[polygon][1]);
  }
  return {};
}

/// On a clean tessellation the exterior angles are exact: a curve along which it does not bend was
/// stated wrongly (jumps across trimmed blends are), and counts neither way.
Result<void> check_on_tessellation(const Mesh& mesh, double edge, std::vector<TrueCurve>& curves) {
  const Result<CurvaturesPtr> curvatures = compute_curvatures(mesh);
  if (!curvatures) return tl::unexpected<Error>(curvatures.error());
  constexpr double least_bend = must_angle / 2.0 * std::numbers::pi / 180.0;
  std::vector<Point> bends;
  for (EdgeId e = 0; e < mesh.edge_count(); ++e)
    if (std::abs((*curvatures)->beta[e]) >= least_bend)
      bends.push_back((mesh.point(mesh.edge(e)[0]) + mesh.point(mesh.edge(e)[1])) / 2.0);
  const KdTree tree(std::move(bends));
  for (TrueCurve& curve : curves) {
    const auto seen = std::ranges::count_if(
        curve.points, [&](const Point& p) { return tree.has_within(p, edge); });
    if (2 * seen < std::ssize(curve.points)) curve.demand = Demand::may;
  }
  return {};
}

Result<Part> read_truth(const fs::path& scan_path, const fs::path& curves_path, bool is_clean) {
  Part part;
  Result<ScanPtr> scan = load_scan(scan_path.string());
  if (!scan) return tl::unexpected<Error>(scan.error());
  part.scan = std::move(*scan);
  Result<std::vector<TrueCurve>> curves = read_curves(curves_path);
  if (!curves) return tl::unexpected<Error>(curves.error());
  part.truth.curves = std::move(*curves);
  fs::path labels = scan_path;
  if (const auto read = read_labels(labels.replace_extension(".labels"), *part.scan, part.truth);
      !read)
    return tl::unexpected<Error>(read.error());
  part.edge = mean_inner_edge(*part.scan->mesh);
  part.tolerance = lines_reach * part.edge;
  if (is_clean)
    if (const auto checked = check_on_tessellation(*part.scan->mesh, part.edge, part.truth.curves);
        !checked)
      return tl::unexpected<Error>(checked.error());
  return part;
}

Result<Part> read_pair(const fs::path& noisy, const fs::path& clean) {
  Part part;
  part.scoring = Scoring::pair;
  Result<ScanPtr> scan = load_scan(noisy.string());
  if (!scan) return tl::unexpected<Error>(scan.error());
  const Result<ScanPtr> original = load_scan(clean.string());
  if (!original) return tl::unexpected<Error>(original.error());
  part.scan = std::move(*scan);
  const Mesh& mesh = *(*original)->mesh;
  const Result<CurvaturesPtr> curvatures = compute_curvatures(mesh);
  if (!curvatures) return tl::unexpected<Error>(curvatures.error());
  for (EdgeId e = 0; e < mesh.edge_count(); ++e) {
    const double angle = std::abs((*curvatures)->beta[e]) * 180.0 / std::numbers::pi;
    if (angle <= pair_angle) continue;
    const auto [a, b] = mesh.edge(e);
    part.truth.curves.push_back({{mesh.point(a), mesh.point(b)}, Demand::must, angle});
  }
  part.edge = mean_inner_edge(*part.scan->mesh);
  part.tolerance = part.edge;
  return part;
}

Result<Part> read_control(const fs::path& path) {
  Part part;
  Result<ScanPtr> scan = load_scan(path.string());
  if (!scan) return tl::unexpected<Error>(scan.error());
  part.scan = std::move(*scan);
  part.edge = mean_inner_edge(*part.scan->mesh);
  part.tolerance = lines_reach * part.edge;
  return part;
}

/// The files of a folder by name; none where there is no such folder.
std::vector<fs::path> files_of(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// The name without an ending; absent where it ends otherwise.
std::optional<std::string> without(const std::string& name, const std::string& ending) {
  if (!name.ends_with(ending)) return std::nullopt;
  return name.substr(0, name.size() - ending.size());
}

void add_truth(const fs::path& folder, std::vector<Case>& cases) {
  for (const fs::path& path : files_of(folder)) {
    fs::path labels = path;
    if (path.extension() != ".ply" || !fs::exists(labels.replace_extension(".labels"))) continue;
    const std::string name = path.stem().string();
    std::optional<std::string> of_part = without(name, "_scan");
    std::string group = "scans";
    const bool is_clean = !of_part;
    if (is_clean) {
      of_part = without(name, "_cad");
      group = "CAD tessellations";
    }
    if (!of_part) continue;
    const auto curves = [&] { return folder / (*of_part + "_curves.json"); };
    if (!fs::exists(curves())) {  // PART_KIND_scan
      of_part = of_part->substr(0, of_part->find_last_of('_'));
      group = "other kinds of scan";
    }
    if (!fs::exists(curves())) continue;
    cases.push_back({name, {group}, [path, truth = curves(), is_clean] {
                       return read_truth(path, truth, is_clean);
                     }});
  }
}

void add_pairs(const fs::path& folder, std::vector<Case>& cases) {
  for (const fs::path& path : files_of(folder))
    for (const auto& [noisy, clean] : {std::pair("_Noisy", "_Original"), std::pair("_n1", "_gt")}) {
      const std::optional<std::string> of_part = without(path.stem().string(), noisy);
      if (!of_part) continue;
      const fs::path original = folder / (*of_part + clean + path.extension().string());
      if (!fs::exists(original)) continue;
      cases.push_back({path.stem().string(), {"pairs"}, [path, original] {
                         return read_pair(path, original);
                       }});
    }
}

}  // namespace

Result<std::vector<Case>> folder_cases(const std::string& folder) {
  if (!fs::is_directory(folder)) return fail("There is no folder " + folder + ".");
  std::vector<Case> cases;
  add_truth(fs::path(folder) / "truth", cases);
  add_pairs(fs::path(folder) / "pairs", cases);
  for (const fs::path& path : files_of(fs::path(folder) / "controls"))
    cases.push_back({path.stem().string(), {"controls"}, [path] { return read_control(path); }});
  if (cases.empty())
    return fail(folder + " has no cases in its folders truth, pairs and controls.");
  return cases;
}

}  // namespace arris::accuracy
