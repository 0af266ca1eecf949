#include "ui/window/shown_elements.h"

#include <array>

#include "ui/panels/controls.h"
#include "ui/view/colour_scale.h"

namespace arris::ui {

namespace {

LineType type_of(const Boundary& boundary) {
  switch (boundary.type) {
    case BoundaryType::c0:
      return boundary.mean_angle >= 0.0 ? LineType::c0_convex : LineType::c0_concave;
    case BoundaryType::gn:
      return LineType::gn;
    case BoundaryType::undefined:
      return LineType::undefined;
    case BoundaryType::border:
      break;
  }
  return LineType::border;
}

}  // namespace

std::vector<ViewLine> view_lines(const Document& document,
                                 const std::unordered_set<std::size_t>& tangent) {
  std::vector<ViewLine> lines;
  if (!document.boundaries) return lines;
  lines.reserve(document.boundaries->size());
  for (std::uint32_t k = 0; k < document.boundaries->size(); ++k) {
    const Boundary& boundary = *(*document.boundaries)[k];
    lines.push_back({boundary.type == BoundaryType::c0 ? boundary.line : first_boundary + k,
                     tangent.contains(k) ? LineType::tangent : type_of(boundary),
                     boundary.vertices});
  }
  return lines;
}

std::vector<std::uint32_t> places_of_partitions(const Document& document) {
  std::vector<std::uint32_t> place(document.next_id, 0);
  const std::vector<PartitionPtr>& partitions = document.partitions.partitions;
  for (std::uint32_t k = 0; k < partitions.size(); ++k) place[partitions[k]->id] = k + 1;
  return place;
}

std::vector<QColor> colours_of_partitions(const Document& document,
                                          const std::vector<std::optional<QColor>>& given) {
  if (!document.boundaries) return {};
  const std::vector<std::uint32_t> place = places_of_partitions(document);
  std::vector<std::array<std::uint32_t, 2>> neighbours;
  for (const BoundaryPtr& boundary : *document.boundaries)
    if (boundary->left != 0 && boundary->right != 0 && boundary->left != boundary->right)
      neighbours.push_back({place[boundary->left] - 1, place[boundary->right] - 1});
  return partition_colours(document.partitions.partitions.size(), neighbours, given);
}

void show_partitions_in(MeshView& view, const Document& document,
                        const std::vector<QColor>& colours) {
  if (document.partitions.labels.empty()) {
    view.set_face_labels({}, {});
    return;
  }
  const std::vector<std::uint32_t> place = places_of_partitions(document);
  std::vector<std::uint32_t> labels(document.mesh->face_count());
  for (FaceId f = 0; f < labels.size(); ++f) labels[f] = place[document.partitions.labels[f]];
  std::vector<QColor> by_label{QColor(205, 205, 205)};
  by_label.insert(by_label.end(), colours.begin(), colours.end());
  // Found before an earlier step changed: still there, but greyed.
  if (document.step("find_partitions") && document.step("find_partitions")->out_of_date)
    for (QColor& colour : by_label) colour = mix(colour, QColor(205, 205, 205), 0.6);
  view.set_face_labels(std::move(labels), std::move(by_label));
}

}  // namespace arris::ui
