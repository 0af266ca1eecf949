#include "core/curvature/fields.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <limits>
#include <numbers>

#include "core/base/parallel.h"
#include "core/mesh/geometry.h"

namespace arris {

namespace {

constexpr Element vertex = Element::vertex, edge = Element::edge, face = Element::face;
constexpr FieldInfo fields[] = {
    {Field::k, '1', "K", "", "Gaussian curvature (eq. 2)", vertex, true, false, -2},
    {Field::h, '2', "H", "", "Mean curvature (eq. 6); positive where convex", vertex, true, false,
     -1},
    {Field::kabs, '3', "Kabs", "", "Absolute curvature k1² + k2² (eq. 8); 1/r² on a cylinder",
     vertex, false, false, -2},
    {Field::ih, '4', "IH", "", "Invariant of the mean curvature at a vertex (eq. 12)", vertex,
     true},
    {Field::ik, '5', "IK", "", "Invariant of the Gaussian curvature (eq. 13)", vertex, true},
    {Field::ikabs, '6', "IKabs", "", "Invariant of the absolute curvature (eq. 14)"},
    {Field::ihe, '7', "IHe", "°", "Exterior angle at an edge (eq. 11); positive where convex", edge,
     true},
    {Field::normal_jump, 'J', "Normal jump", "°",
     "How far the mean normal turns at once across an edge, above what the surface beside it "
     "turns; positive where convex",
     edge, true},
    {Field::shape, '8', "Shape", "", "Local form from the signs of K and H (figures 4 and 8)",
     vertex, false, true},
    {Field::deviation, '9', "Deviation", "% of zone",
     "How much of the error zones of the scan's vertices each face uses up (section 4.1)", face},
    {Field::face_quality, '0', "Face quality", "",
     "Twice the inscribed over the circumscribed radius: 1 for equilateral faces, 0 for slivers",
     face},
};

/// One row for each field, in the order of the enumeration, each with a key of its own.
constexpr bool is_whole() {
  for (std::size_t k = 0; k < std::size(fields); ++k) {
    if (static_cast<std::size_t>(fields[k].field) != k) return false;
    for (std::size_t j = 0; j < k; ++j)
      if (fields[j].key == fields[k].key) return false;
  }
  return std::size(fields) == field_count;
}
static_assert(is_whole());

}  // namespace

std::span<const FieldInfo, field_count> field_table() { return fields; }

const FieldInfo& info_of(Field field) { return fields[static_cast<std::size_t>(field)]; }

std::string unit_of(Field field, LengthUnit lengths) {
  const FieldInfo& info = info_of(field);
  return info.length_power != 0 ? unit_text(lengths, info.length_power)
                                : std::string(info.own_unit);
}

std::optional<Field> find_field(std::string_view name) {
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) ==
           std::tolower(static_cast<unsigned char>(b));
  };
  for (const FieldInfo& info : field_table())
    if (std::equal(name.begin(), name.end(), info.name.begin(), info.name.end(), same))
      return info.field;
  return std::nullopt;
}

const std::array<std::string_view, 6>& shape_names() {
  static constexpr std::array<std::string_view, 6> names{
      "flat", "elliptic convex", "elliptic concave", "ridge", "valley", "saddle"};
  return names;
}

std::vector<double> field_values(const Curvatures& c, Field field) {
  const bool h2 =
      c.options.pairing == InvariantPairing::h2_k1 || c.options.pairing == InvariantPairing::h2_k2;
  const bool k2 =
      c.options.pairing == InvariantPairing::h1_k2 || c.options.pairing == InvariantPairing::h2_k2;
  switch (field) {
    case Field::k:
      return c.k;
    case Field::h:
      return c.h;
    case Field::kabs:
      return c.kabs;
    case Field::ih:
      return h2 ? c.ih2 : c.ih1;
    case Field::ik:
      return k2 ? c.ik2 : c.ik1;
    case Field::ikabs:
      return c.ikabs;
    case Field::ihe: {
      std::vector<double> degrees(c.beta.size());
      std::transform(c.beta.begin(), c.beta.end(), degrees.begin(),
                     [](float b) { return b * 180.0 / std::numbers::pi; });
      return degrees;
    }
    case Field::shape:
      break;
    case Field::normal_jump:
    case Field::deviation:
    case Field::face_quality:
      return {};
  }
  std::vector<double> classes(c.shape.size());
  std::transform(c.shape.begin(), c.shape.end(), classes.begin(), [](Shape s) {
    return s == Shape::undefined ? std::numeric_limits<double>::quiet_NaN()
                                 : static_cast<double>(s) - 1.0;
  });
  return classes;
}

std::vector<double> field_weights(const Mesh& mesh, Field field) {
  std::vector<double> areas(mesh.face_count());
  parallel_for(areas.size(),
               [&](std::size_t f) { areas[f] = face_area(mesh, static_cast<FaceId>(f)); });
  const Element element = info_of(field).element;
  if (element == Element::face) return areas;
  const bool on_edges = element == Element::edge;
  std::vector<double> weights(on_edges ? mesh.edge_count() : mesh.vertex_count(), 0.0);
  parallel_for(weights.size(), [&](std::size_t i) {
    if (on_edges) {
      for (const FaceId f : mesh.edge_faces(static_cast<EdgeId>(i)))
        if (f != no_id) weights[i] += areas[f] / 3.0;
    } else {
      mesh.for_ring(static_cast<VertexId>(i), [&](HalfEdgeId h) {
        if (mesh.face(h) != no_id) weights[i] += areas[mesh.face(h)] / 3.0;
      });
    }
  });
  return weights;
}

}  // namespace arris
