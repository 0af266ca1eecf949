#include "core/report/summary.h"

#include <map>
#include <string>

#include "core/base/number_text.h"
#include "core/document/document.h"
#include "core/partitions/partition_surfaces.h"
#include "core/partitions/sides.h"
#include "core/partitions/tangent_lines.h"
#include "core/sharp_lines/face_table.h"
#include "core/sharp_lines/normal_noise.h"
#include "core/sharp_lines/sharp_lines.h"

namespace arris {

namespace {

/// The surface of each partition by its id, and the boundaries along which surfaces touch.
void add_surfaces(const Document& document, nlohmann::json& summary) {
  const auto surfaces = fit_partition_surfaces(*document.mesh, document.lines, document.partitions);
  if (!surfaces) return;
  nlohmann::json listed = nlohmann::json::object(), tangent = nlohmann::json::array();
  for (std::size_t k = 0; k < surfaces->size(); ++k) {
    const PartitionSurface& fit = (*surfaces)[k];
    nlohmann::json& one = listed[std::to_string(document.partitions.partitions[k]->id)];
    one["type"] = name_of(fit.surface.type);
    if (!fit.fitted) continue;
    one["size"] = size_text(fit.surface, length_unit_of(document));
    one["mean_deviation"] = rounded(fit.mean_deviation, 4);
    one["max_deviation"] = rounded(fit.max_deviation, 4);
    one["within"] = rounded(fit.within, 4);
  }
  const auto lines =
      find_tangent_lines(*document.mesh, document.partitions, *document.boundaries, *surfaces);
  if (!lines) return;
  for (const TangentLine& line : *lines)
    tangent.push_back({{"boundary", line.boundary + 1},
                       {"fillet", line.fillet},
                       {"radius", rounded(line.radius, 4)},
                       {"kink", rounded(line.kink, 3)}});
  summary["partitions"]["surfaces"] = listed;
  summary["tangent_lines"] = tangent;
}

}  // namespace

double normal_noise_of(const Document& document) {
  const Mesh& scan = *document.opened.mesh;
  return normal_noise(scan, FaceTable(scan));
}

double default_angle_of(const Document& document) {
  return default_sharp_angle(*document.opened.mesh, *document.opened.curvatures,
                             LineMethod::normal_jump);
}

nlohmann::json summary_of(const History& history) {
  const Document& document = history.current();
  nlohmann::json summary;
  summary["scan"] = document.scan->report.to_json();
  summary["unit"] = info_of(length_unit_of(document)).key;
  summary["mean_edge_length"] = document.mesh->mean_edge_length();
  summary["angle_noise_degrees"] = angle_noise(*document.curvatures);
  summary["normal_noise_degrees"] = rounded(normal_noise_of(document), 4);
  summary["default_sharp_angle"] = default_angle_of(document);
  summary["mixed_area_vertices"] = document.curvatures->mixed_area_vertices;
  nlohmann::json thresholds = nlohmann::json::object();
  for (std::size_t k = 0; k < chain_steps.size(); ++k)
    if (document.steps[k])
      thresholds[std::string(chain_steps[k].name)] = document.steps[k]->parameters;
  summary["thresholds"] = thresholds;

  double length = 0.0;
  std::size_t edges = 0, convex = 0, closed = 0;
  for (const LinePtr& line : document.lines.lines) {
    length += line->length;
    edges += line->vertices.size() - 1;
    convex += line->convex();
    closed += line->closed;
  }
  summary["lines"] = {{"count", document.lines.lines.size()},
                      {"edges", edges},
                      {"length", length},
                      {"convex", convex},
                      {"concave", document.lines.lines.size() - convex},
                      {"closed", closed}};
  const std::vector<PartitionPtr>& partitions = document.partitions.partitions;
  const std::vector<Outline> outlines =
      outlines_of(*document.mesh, document.lines, document.partitions);
  std::size_t four_sided = 0;
  nlohmann::json sides = nlohmann::json::object();
  for (std::size_t k = 0; k < outlines.size(); ++k) {
    four_sided += outlines[k].is_four_sided();
    sides[std::to_string(partitions[k]->id)] = outlines[k].sides();
  }
  summary["partitions"] = {{"count", partitions.size()},
                           {"assigned_area_share", assigned_share(document)},
                           {"four_sided", four_sided},
                           {"four_sided_share", four_sided_share(document.partitions, outlines)},
                           {"sides", sides}};
  std::map<std::string, std::size_t> types;
  for (const BoundaryPtr& boundary : *document.boundaries)
    ++types[std::string(name_of(boundary->type))];
  summary["boundaries"] = types;
  add_surfaces(document, summary);
  summary["document_hash"] = hash_of(document);
  nlohmann::json versions = nlohmann::json::object();
  for (const auto& [sequence, name] : history.names()) versions[name] = sequence;
  summary["versions"] = versions;
  return summary;
}

}  // namespace arris
