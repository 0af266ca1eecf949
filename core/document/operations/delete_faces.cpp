#include <algorithm>
#include <cmath>

#include "core/base/words.h"
#include "core/document/operations/operations.h"
#include "core/document/operations/stages.h"
#include "core/mesh/build_mesh.h"

namespace arris {

namespace {

bool are_faces_of_scan(nlohmann::json& value, const Document& document) {
  return value.is_array() && std::all_of(value.begin(), value.end(), [&](const auto& face) {
           return face.is_array() && face.size() == 3 &&
                  std::all_of(face.begin(), face.end(),
                              [](const auto& v) {
                                return v.is_number_unsigned() &&
                                       v.template get<std::uint64_t>() < no_id;
                              }) &&
                  document.opened.mesh->find_face({face[0], face[1], face[2]}).has_value();
         });
}

bool is_box(nlohmann::json& value, const Document&) {
  return value.is_array() && value.size() == 6 &&
         std::all_of(value.begin(), value.end(), [](const auto& x) {
           return x.is_number() && std::isfinite(x.template get<double>());
         });
}

std::vector<bool> chosen_faces(const Mesh& mesh, const nlohmann::json& parameters) {
  std::vector<bool> chosen(mesh.face_count(), false);
  if (parameters.contains("faces")) {
    for (const auto& face : parameters["faces"])
      if (const auto f = mesh.find_face({face[0], face[1], face[2]})) chosen[*f] = true;
  } else if (parameters.contains("components_under")) {
    const std::size_t limit = parameters["components_under"];
    std::vector<bool> seen(mesh.face_count(), false);
    std::vector<FaceId> component;
    for (FaceId start = 0; start < mesh.face_count(); ++start) {
      if (seen[start]) continue;
      component.assign(1, start);
      seen[start] = true;
      for (std::size_t k = 0; k < component.size(); ++k) {
        HalfEdgeId h = mesh.face_half_edge(component[k]);
        for (int side = 0; side < 3; ++side, h = mesh.next(h))
          if (const FaceId f = mesh.face(Mesh::opposite(h)); f != no_id && !seen[f]) {
            seen[f] = true;
            component.push_back(f);
          }
      }
      if (component.size() < limit)
        for (const FaceId f : component) chosen[f] = true;
    }
  } else {
    const std::vector<double> box = parameters["box"];
    const bool inside = parameters["side"] == "inside";
    for (FaceId f = 0; f < mesh.face_count(); ++f) {
      const Triangle& t = mesh.triangle(f);
      const Point centre = (mesh.point(t[0]) + mesh.point(t[1]) + mesh.point(t[2])) / 3.0;
      bool in = true;
      for (int k = 0; k < 3; ++k)
        in = in && centre[k] >= std::min(box[k], box[k + 3]) &&
             centre[k] <= std::max(box[k], box[k + 3]);
      chosen[f] = in == inside;
    }
  }
  return chosen;
}

Result<Document> apply_delete(const Document& document, const nlohmann::json& parameters,
                              const Context& context) {
  const Mesh& mesh = *document.opened.mesh;
  const std::vector<bool> chosen = chosen_faces(mesh, parameters);
  const std::size_t count =
      static_cast<std::size_t>(std::count(chosen.begin(), chosen.end(), true));
  if (count == 0) return fail("delete_faces: no face of the part is meant; nothing was deleted.");
  if (count == mesh.face_count()) return fail("delete_faces: this would delete the whole part.");

  std::vector<FaceId> kept;
  std::vector<std::uint64_t> starts{0};
  std::vector<VertexId> corners;
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    if (chosen[f]) continue;
    kept.push_back(f);
    corners.insert(corners.end(), mesh.triangle(f).begin(), mesh.triangle(f).end());
    starts.push_back(corners.size());
  }
  // A vertex that is left with two fans is split, as at load.
  LoadReport report;
  Result<BuiltMesh> built = build_mesh({mesh.points().begin(), mesh.points().end()}, starts,
                                       corners, report, context.part(0.0, 0.5));
  if (!built) return tl::unexpected<Error>(built.error());
  auto scan_faces = std::make_shared<std::vector<FaceId>>();
  for (const std::uint32_t k : built->source_faces) {
    const FaceId f = kept[k];
    scan_faces->push_back(document.scan_faces ? (*document.scan_faces)[f] : f);
  }
  Document result = document;
  outdate_all(result);
  if (const auto changed =
          change_mesh(result, {built->mesh, nullptr, nullptr, nullptr}, context.part(0.5, 1.0));
      !changed)
    return tl::unexpected<Error>(changed.error());
  result.opened = {result.mesh, result.curvatures, nullptr, result.evidence};
  result.scan_faces = std::move(scan_faces);
  return result;
}

std::string words_of_delete(const nlohmann::json& parameters) {
  if (parameters.contains("faces"))
    return "Delete " + counted(parameters["faces"].size(), "face", "faces");
  if (parameters.contains("components_under"))
    return "Drop loose pieces of fewer than " + parameters["components_under"].dump() + " faces";
  return "Delete what is " + parameters.value("side", "inside") + " a box";
}

}  // namespace

std::vector<OperationKind> delete_faces_rows() {
  constexpr std::string_view which = "which faces";
  return {{.name = "delete_faces",
           .title = "Delete faces",
           .help = "Takes faces out of the part: some of them, loose pieces, or what is in a box.",
           .parameters = {{.name = "faces",
                           .help = "The faces themselves, by their vertices.",
                           .one_of = which,
                           .form = "a list of faces of the scan, [a, b, c] by vertex id",
                           .accepts = are_faces_of_scan},
                          {.name = "components_under",
                           .kind = ParameterKind::whole,
                           .help = "Pieces of the part with fewer faces.",
                           .unit = "faces",
                           .least = 1,
                           .most = most_faces,
                           .one_of = which},
                          {.name = "box",
                           .help = "Faces whose centre is in it.",
                           .one_of = which,
                           .form = "six numbers [x0, y0, z0, x1, y1, z1]",
                           .accepts = is_box},
                          {.name = "side",
                           .kind = ParameterKind::choice,
                           .help = "What goes: what is in the box, or all else.",
                           .choices = {{"inside", "Inside"}, {"outside", "Outside"}},
                           .otherwise = "inside",
                           .only_with = "box"}},
           .apply = apply_delete,
           .words = words_of_delete}};
}

}  // namespace arris
