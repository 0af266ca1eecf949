#pragma once

#include <optional>

#include <QMenu>
#include <QObject>

#include "ui/panels/histogram_panel.h"
#include "ui/window/field_presenter.h"
#include "ui/window/latest_work.h"
#include "ui/window/session.h"

namespace arris::ui {

/// The stability curve over the histogram: lines per TV_IH over the measure that lines are found by
/// (normal jump, or IHe and IKabs by the walk), partitions per Kmax over the
/// criterion. Worked out beside the UI thread, for the mesh, curvatures and lines shown.
class StabilityPresenter : public QObject {
  Q_OBJECT
 public:
  StabilityPresenter(Session* session, FieldPresenter* fields, HistogramPanel* histogram,
                     QObject* parent);

  /// The switch, in this menu and in the context menu of the histogram.
  void add_actions(QMenu* menu);

 private:
  enum class Kind { none, lines_by_angle, lines_by_ikabs, partitions };
  /// What a curve is worked out from; the same: it is still right.
  struct Basis {
    Kind kind = Kind::none;
    MeshPtr mesh;
    CurvaturesPtr curvatures;
    SharedLineEvidencePtr evidence;  // lines by the normal jump only
    std::vector<LinePtr> lines;      // partitions only
    nlohmann::json parameters;
    bool operator==(const Basis&) const = default;
  };

  bool is_on() const;
  Basis basis() const;
  void refresh();

  Session* session_;
  FieldPresenter* fields_;
  HistogramPanel* histogram_;
  LatestWork* work_;
  QAction* toggle_ = nullptr;
  std::optional<bool> chosen_;  // by the user
  Basis basis_;
};

}  // namespace arris::ui
