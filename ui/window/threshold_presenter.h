#pragma once

#include <vector>

#include <QObject>

#include "ui/panels/histogram_panel.h"
#include "ui/window/field_presenter.h"
#include "ui/window/session.h"

namespace arris::ui {

/// The field over which TV_IH is dragged: what lines are found by, or would be.
Field line_field(const Session& session);

/// The thresholds as handles on the histogram: TV_IH over the normal jump where lines are found by
/// it; by the walk TV_IH over IHe, the same as TV_IK over IKabs; and
/// the ends of the curvature intervals over the criterion. Dragging one previews the operation it
/// belongs to, letting go commits it.
class ThresholdPresenter : public QObject {
  Q_OBJECT
 public:
  ThresholdPresenter(Session* session, FieldPresenter* fields, HistogramPanel* histogram,
                     QObject* parent);

  /// Handles anew, from the document shown and the field shown.
  void refresh();

 private:
  /// What a handle moves.
  struct Target {
    enum class Kind { sharp_angle, sharp_ikabs, interval_bound } kind;
    double bound = 0.0;  // interval_bound: the value at mouse down
  };
  void add_sharp_angle(std::vector<ThresholdHandle>& handles, std::vector<Target>& targets) const;
  void add_interval_bounds(std::vector<ThresholdHandle>& handles,
                           std::vector<Target>& targets) const;
  Operation operation_for(const Target& target, double value) const;

  Session* session_;
  FieldPresenter* fields_;
  HistogramPanel* histogram_;
  std::vector<Target> targets_;  // of each handle
  bool dragging_ = false;
};

}  // namespace arris::ui
