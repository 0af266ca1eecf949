#pragma once

#include <optional>

#include <QMenu>
#include <QObject>

#include "ui/panels/explanation_panel.h"
#include "ui/view/mesh_view.h"
#include "ui/window/latest_work.h"
#include "ui/window/session.h"

namespace arris::ui {

/// Explains the edge and the face clicked last: beside the UI thread, since an edge may need
/// identification again, and only while somebody sees it.
class ExplanationPresenter : public QObject {
  Q_OBJECT
 public:
  ExplanationPresenter(Session* session, MeshView* view, ExplanationPanel* panel, QObject* parent);

  void add_actions(QMenu* menu);
  void set_shown(bool shown);
  /// Brings the panel up and explains what was picked.
  void explain(const Pick& pick);

 signals:
  /// The user wants to see the panel.
  void wanted();

 private:
  void refresh();

  Session* session_;
  ExplanationPanel* panel_;
  LatestWork* work_;
  bool shown_ = false;
  bool current_ = false;  // the panel shows what it should
  std::optional<Pick> pick_;
};

}  // namespace arris::ui
