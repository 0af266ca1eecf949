#include "core/mesh/load_report.h"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "core/base/json.h"
#include "core/base/number_text.h"

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

nlohmann::json notes_to_json(const std::vector<std::string>& notes) {
  nlohmann::json json = nlohmann::json::array();
  for (const std::string& note : notes) json.push_back(text_to_json(note));
  return json;
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
  std::vector<EdgeVertices> cut;
  std::set_difference(non_manifold_edges.begin(), non_manifold_edges.end(), paired_edges.begin(),
                      paired_edges.end(), std::back_inserter(cut));
  tell(cut, "edge had more than two faces and was cut open",
       "edges had more than two faces and were cut open");
  tell(crossed_polygons, "polygon has an outline that crosses itself; its triangles overlap",
       "polygons have outlines that cross themselves; their triangles overlap");
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
  tell(paired_edges,
       "edge had more than two faces, where bodies touch; each body kept its own two faces there",
       "edges had more than two faces, where bodies touch; each body kept its own two faces there");
  tell(turned_faces, "face ran against its neighbours and was turned round",
       "faces ran against their neighbours and were turned round");
  if (step_is_coarse())
    result.push_back("The part lies " + number_text(distance_in_sizes, 3) +
                     " times its size from the origin, where its file tells coordinates apart only "
                     "in steps of " +
                     number_text(coordinate_step, 2) + " (" +
                     number_text(100.0 * step_over_edge, 2) +
                     " % of the mean edge); moved near the origin before it is exported, it keeps "
                     "those digits.");
  const std::string of_the_file = counted(file_vertices, "vertex", "vertices") + " of the file";
  const std::string places = counted(file_vertices - joined.coincident, "place", "places");
  if (joined.coincident > 0 && !joined.kept_apart)
    result.push_back("The " + of_the_file + " lie on " + places + "; " +
                     counted(joined.coincident, "was", "were") +
                     " joined with an earlier one that has the same coordinates.");
  if (joined.coincident > 0 && joined.kept_apart)
    result.push_back("The " + of_the_file + " lie on " + places + " and were kept apart as wished" +
                     (joined.coincident_edges > 0
                          ? ", which cuts the surface along " +
                                counted(joined.coincident_edges, "edge", "edges") + "."
                          : "."));
  if (joined.near > 0)
    result.push_back(counted(joined.near, "vertex", "vertices") + " of the border lay within " +
                     number_text(joined.tolerance, 2) +
                     " of another, which the last digits of the file hardly tell apart, and " +
                     (joined.near == 1 ? "was" : "were") + " joined with it; that closed " +
                     counted(joined.near_edges, "edge", "edges") + " of the border.");
  tell(degenerate_faces,
       "face has fewer than three different corners, so that it covers nothing; it was dropped",
       "faces have fewer than three different corners, so that they cover nothing; they were "
       "dropped");
  tell(duplicate_faces, "face had the same vertices as an earlier one and was left out",
       "faces had the same vertices as an earlier one and were left out");
  if (looks_inside_out)
    result.push_back(
        "The surface looks inside out: what it encloses has a negative volume; flip the "
        "orientation if the outside should face outwards.");
  tell(zero_area_faces, "face has no area, its three vertices lie in a line; it was kept",
       "faces have no area, their three vertices lie in a line; they were kept");
  tell(repeated_corners, "face names a corner twice in a row; it counts once",
       "faces name a corner twice in a row; it counts once");
  tell(split_polygons, "polygon had more than three corners and was cut into triangles",
       "polygons had more than three corners and were cut into triangles");
  tell(isolated_vertices, "vertex belongs to no face; it was kept and has no quantities",
       "vertices belong to no face; they were kept and have no quantities");
  result.insert(result.begin(), notes.begin(), notes.end());
  return result;
}

bool LoadReport::step_is_coarse() const {
  return distance_in_sizes >= 10.0 && step_over_edge >= 1e-4;
}

nlohmann::json LoadReport::to_json() const {
  return {
      {"file", text_to_json(file)},
      {"format", format},
      {"content_hash", content_hash},
      {"file_bytes", file_bytes},
      {"unit", text_to_json(unit)},
      {"notes", notes_to_json(notes)},
      {"file_vertices", file_vertices},
      {"file_faces", file_faces},
      {"welded_corners", welded_corners},
      {"coincident_vertices", joined.coincident},
      {"coincident_edges", joined.coincident_edges},
      {"coincident_kept_apart", joined.kept_apart},
      {"near_vertices_joined", joined.near},
      {"near_edges_closed", joined.near_edges},
      {"near_tolerance", joined.tolerance},
      {"coordinate_step", coordinate_step},
      {"distance_in_sizes", distance_in_sizes},
      {"step_over_edge", step_over_edge},
      {"vertices", vertices},
      {"faces", faces},
      {"edges", edges},
      {"border_edges", border_edges},
      {"border_loops", border_loops},
      {"components", components},
      {"euler_number", euler_number},
      {"split_polygons", list_to_json(split_polygons)},
      {"crossed_polygons", list_to_json(crossed_polygons)},
      {"repeated_corners", list_to_json(repeated_corners)},
      {"degenerate_faces", list_to_json(degenerate_faces)},
      {"zero_area_faces", list_to_json(zero_area_faces)},
      {"duplicate_faces", list_to_json(duplicate_faces)},
      {"non_finite_vertices", list_to_json(non_finite_vertices)},
      {"non_finite_faces", list_to_json(non_finite_faces)},
      {"isolated_vertices", list_to_json(isolated_vertices)},
      {"non_manifold_edges", list_to_json(non_manifold_edges)},
      {"paired_edges", list_to_json(paired_edges)},
      {"unorientable_edges", list_to_json(unorientable_edges)},
      {"non_manifold_vertices", list_to_json(non_manifold_vertices)},
      {"turned_faces", list_to_json(turned_faces)},
      {"left_out_faces", list_to_json(left_out_faces)},
      {"copies", list_to_json(copies)},
      {"looks_inside_out", looks_inside_out},
  };
}

}  // namespace arris
