#pragma once

#include <QObject>

#include "ui/panels/corrections_panel.h"
#include "ui/view/mesh_view.h"
#include "ui/window/elements_presenter.h"
#include "ui/window/session.h"

namespace arris::ui {

/// The corrections of the document in their panel: lifts them, and shows where they were made.
class CorrectionsPresenter : public QObject {
  Q_OBJECT
 public:
  CorrectionsPresenter(Session* session, MeshView* view, ElementsPresenter* elements,
                       CorrectionsPanel* panel, QObject* parent);

  void set_shown(bool shown);

 signals:
  /// "Corrections (2 failed)".
  void title_changed(const QString& title);

 private:
  void refresh();
  void show(std::uint32_t id);
  void clear_marks();

  Session* session_;
  MeshView* view_;
  ElementsPresenter* elements_;
  CorrectionsPanel* panel_;
  bool marked_ = false;  // paths and points in the view are ours
};

}  // namespace arris::ui
