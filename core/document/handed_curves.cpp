#include "core/document/handed_curves.h"

#include <array>

namespace arris {

namespace {

std::string_view layer_of(BoundaryType type) {
  switch (type) {
    case BoundaryType::c0:
      return "C0";
    case BoundaryType::gn:
      return "GN";
    case BoundaryType::border:
      return "BORDER";
    case BoundaryType::undefined:
      break;
  }
  return "UNDEFINED";
}

}  // namespace

std::string lengths_in(LengthUnit unit) {
  return unit == LengthUnit::unknown ? "the unit of the scan" : std::string(info_of(unit).name);
}

HandedCurves handed_lines(const Document& document) {
  HandedCurves handed{*document.mesh,
                      length_unit_of(document),
                      "lines",
                      {"line", "convex", "angle_degrees", "length", "closed"},
                      {}};
  for (const LinePtr& line : document.lines.lines)
    handed.curves.push_back(
        {"line_" + std::to_string(line->id) + (line->convex() ? "_convex" : "_concave"),
         line->convex() ? "CONVEX" : "CONCAVE",
         &line->vertices,
         line->closed,
         {static_cast<double>(line->id), line->convex() ? 1.0 : 0.0, line->mean_angle, line->length,
          line->closed ? 1.0 : 0.0}});
  return handed;
}

HandedCurves handed_boundaries(const Document& document) {
  HandedCurves handed{*document.mesh,
                      length_unit_of(document),
                      "boundaries",
                      {"boundary", "left_partition", "right_partition", "line", "angle_degrees",
                       "length", "closed"},
                      {}};
  std::size_t number = 0;
  for (const BoundaryPtr& boundary : *document.boundaries) {
    std::string name = "boundary_" + std::to_string(++number) + "_";
    name += name_of(boundary->type);
    if (boundary->type == BoundaryType::c0) name += "_line" + std::to_string(boundary->line);
    for (const std::uint32_t id : {boundary->left, boundary->right})
      if (id != 0) name += "_p" + std::to_string(id);
    handed.curves.push_back(
        {std::move(name),
         layer_of(boundary->type),
         &boundary->vertices,
         boundary->closed,
         {static_cast<double>(number), static_cast<double>(boundary->left),
          static_cast<double>(boundary->right), static_cast<double>(boundary->line),
          boundary->mean_angle, boundary->length, boundary->closed ? 1.0 : 0.0}});
  }
  return handed;
}

}  // namespace arris
