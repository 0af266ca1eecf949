#pragma once

#include <QObject>

#include "ui/view/mesh_view.h"
#include "ui/window/elements_presenter.h"
#include "ui/window/session.h"

class QAction;
class QActionGroup;
class QMenu;

namespace arris::ui {

/// What of the part is shown (working mesh or scan, hidden partitions), and the tools of the view.
class ViewPresenter : public QObject {
  Q_OBJECT
 public:
  ViewPresenter(Session* session, MeshView* view, ElementsPresenter* elements, QObject* parent);

  void add_surface_actions(QMenu* menu);
  void add_visibility_actions(QMenu* menu);
  void add_tool_actions(QMenu* menu);
  /// Hide, isolate, show all: for the context menu.
  QList<QAction*> visibility_actions() const { return {hide_, isolate_, show_all_}; }

  /// Means the mesh where nothing was simplified or swapped.
  void set_surface(ShownSurface surface);

 signals:
  void message(const QString& text);

 private:
  void take_document(bool other_mesh);
  void refresh();

  Session* session_;
  MeshView* view_;
  ElementsPresenter* elements_;
  MeshPtr reference_;  // as the view has it
  QActionGroup* surfaces_ = nullptr;
  QAction* switch_ = nullptr;
  QAction* hide_ = nullptr;
  QAction* isolate_ = nullptr;
  QAction* show_all_ = nullptr;
  QActionGroup* tools_ = nullptr;
  QAction* copy_measurement_ = nullptr;
  QString measured_;
};

}  // namespace arris::ui
