#include "ui/window/hover_text.h"

#include <cmath>
#include <numbers>

#include <QCoreApplication>

#include "core/base/number_text.h"
#include "core/guidance/explain_jump.h"
#include "core/mesh/face_quality.h"
#include "core/simplification/occupancy.h"
#include "ui/window/unit_suffix.h"

namespace arris::ui {

namespace {

QString tr(const char* text) { return QCoreApplication::translate("arris::ui::HoverText", text); }

QString number(double value, int digits = 3) {
  return std::isnan(value) ? QString("–") : QString::fromStdString(number_text(value, digits));
}

}  // namespace

QString hover_text(const Document& document, const Pick& pick) {
  if (document.empty() || pick.vertex >= document.mesh->vertex_count()) return {};
  const Curvatures& c = *document.shown_curvatures();
  const VertexId v = pick.vertex;
  const QString suffix = unit_suffix(document);
  QString text = tr("vertex %1   K %2   H %3   Kabs %4")
                     .arg(v)
                     .arg(number(c.k[v]), number(c.h[v]), number(c.kabs[v]));
  if (c.kabs[v] > 0.0) text += tr(" (r %1)").arg(number(cylinder_radius(c.kabs[v]), 3) + suffix);
  text += tr("   IKabs %1").arg(number(c.ikabs[v]));
  if (pick.edge < document.mesh->edge_count()) {
    const double angle = std::abs(c.beta[pick.edge]) * 180.0 / std::numbers::pi;
    text += tr("   |IHe| %1°").arg(number(angle, 3));
    // Only what is there already: the pointer does not wait.
    if (const LineEvidencePtr evidence = document.evidence ? document.evidence->known() : nullptr)
      text += tr("   jump %1°").arg(number(std::abs(jump_that_counts(*evidence, pick.edge)), 3));
  }
  if (pick.face < document.mesh->face_count()) {
    text += tr("   quality %1").arg(number(face_quality(*document.mesh, pick.face), 2));
    if (document.zones) {
      const FaceOccupancy use = occupancy_of_face(*document.mesh, *document.zones, pick.face);
      text += tr("   deviation %1, %2 %")
                  .arg(number(use.distance, 2) + suffix, number(100.0 * use.share, 2));
    }
  }
  if (pick.line != 0 && document.lines.find(pick.line)) text += tr("   line %1").arg(pick.line);
  if (const std::uint32_t label = document.partitions.label(pick.face); label != 0)
    text += tr("   partition %1").arg(label);
  return text;
}

}  // namespace arris::ui
