#include "core/mesh/load_report.h"

#include <algorithm>
#include <string_view>

#include <nlohmann/json.hpp>

namespace arris {

namespace {

/// "3,638"
std::string with_commas(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, 1, ',');
  return text;
}

std::string counted(std::uint64_t number, std::string_view one, std::string_view many) {
  return with_commas(number) + " " + std::string(number == 1 ? one : many);
}

std::string name(std::uint32_t id) { return std::to_string(id); }
std::string name(const EdgeVertices& edge) {
  return std::to_string(edge[0]) + "-" + std::to_string(edge[1]);
}

template <class T>
std::string first_of(const std::vector<T>& list) {
  return list.size() == 1 ? " (" + name(list[0]) + ")" : " (first: " + name(list[0]) + ")";
}

template <class T>
nlohmann::json list_to_json(const std::vector<T>& list) {
  constexpr std::size_t most = 1000;
  const auto end = list.begin() + static_cast<std::ptrdiff_t>(std::min(most, list.size()));
  return {{"count", list.size()}, {"first", std::vector<T>(list.begin(), end)}};
}

/// File names need not be UTF-8, JSON must be.
nlohmann::json text_to_json(const std::string& text) {
  using nlohmann::json;
  return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace));
}

}  // namespace

bool LoadReport::clean() const { return sentences().empty(); }

std::vector<std::string> LoadReport::sentences() const {
  std::vector<std::string> result;
  /// "24 edges had ... and were cut open (first: 123-456)."
  const auto tell = [&](const auto& list, std::string_view one, std::string_view many) {
    if (list.empty()) return;
    result.push_back(counted(list.size(), one, many) + first_of(list) + ".");
  };
  tell(left_out_faces, "face could not be held by the mesh and was left out",
       "faces could not be held by the mesh and were left out");
  if (!non_finite_vertices.empty()) {
    std::string text =
        counted(non_finite_vertices.size(), "vertex has a coordinate that is not a finite number",
                "vertices have coordinates that are not finite numbers") +
        first_of(non_finite_vertices);
    if (!non_finite_faces.empty())
      text += "; " +
              counted(non_finite_faces.size(), "face that uses them was left out",
                      "faces that use them were left out") +
              first_of(non_finite_faces);
    result.push_back(text + ".");
  }
  tell(non_manifold_edges, "edge had more than two faces and was cut open",
       "edges had more than two faces and were cut open");
  tell(unorientable_edges,
       "edge closed a one-sided surface, which cannot be oriented, and was cut open",
       "edges closed a one-sided surface, which cannot be oriented, and were cut open");
  if (!non_manifold_vertices.empty())
    result.push_back(counted(non_manifold_vertices.size(),
                             "vertex joined more than one fan of faces and was split",
                             "vertices joined more than one fan of faces and were split") +
                     first_of(non_manifold_vertices) + "; " +
                     counted(copies.size(), "copy was", "copies were") +
                     " added at the end of the list of vertices.");
  tell(turned_faces, "face ran against its neighbours and was turned round",
       "faces ran against their neighbours and were turned round");
  tell(degenerate_faces, "face had a repeated vertex or fewer than three corners and was left out",
       "faces had a repeated vertex or fewer than three corners and were left out");
  tell(duplicate_faces, "face had the same vertices as an earlier one and was left out",
       "faces had the same vertices as an earlier one and were left out");
  if (looks_inside_out)
    result.push_back(
        "The surface looks inside out: what it encloses has a negative volume; flip the "
        "orientation if the outside should face outwards.");
  tell(zero_area_faces, "face has no area, its three vertices lie in a line; it was kept",
       "faces have no area, their three vertices lie in a line; they were kept");
  tell(split_polygons, "polygon had more than three corners and was cut into triangles",
       "polygons had more than three corners and were cut into triangles");
  tell(isolated_vertices, "vertex belongs to no face; it was kept and has no quantities",
       "vertices belong to no face; they were kept and have no quantities");
  return result;
}

nlohmann::json LoadReport::to_json() const {
  return {
      {"file", text_to_json(file)},
      {"format", format},
      {"content_hash", content_hash},
      {"file_bytes", file_bytes},
      {"file_vertices", file_vertices},
      {"file_faces", file_faces},
      {"welded_corners", welded_corners},
      {"vertices", vertices},
      {"faces", faces},
      {"edges", edges},
      {"border_edges", border_edges},
      {"border_loops", border_loops},
      {"components", components},
      {"euler_number", euler_number},
      {"split_polygons", list_to_json(split_polygons)},
      {"degenerate_faces", list_to_json(degenerate_faces)},
      {"zero_area_faces", list_to_json(zero_area_faces)},
      {"duplicate_faces", list_to_json(duplicate_faces)},
      {"non_finite_vertices", list_to_json(non_finite_vertices)},
      {"non_finite_faces", list_to_json(non_finite_faces)},
      {"isolated_vertices", list_to_json(isolated_vertices)},
      {"non_manifold_edges", list_to_json(non_manifold_edges)},
      {"unorientable_edges", list_to_json(unorientable_edges)},
      {"non_manifold_vertices", list_to_json(non_manifold_vertices)},
      {"turned_faces", list_to_json(turned_faces)},
      {"left_out_faces", list_to_json(left_out_faces)},
      {"copies", list_to_json(copies)},
      {"looks_inside_out", looks_inside_out},
  };
}

}  // namespace arris
