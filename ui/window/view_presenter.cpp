#include "ui/window/view_presenter.h"

#include <QActionGroup>
#include <QApplication>
#include <QClipboard>

#include "ui/window/actions.h"

namespace arris::ui {

ViewPresenter::ViewPresenter(Session* session, MeshView* view, ElementsPresenter* elements,
                             QObject* parent)
    : QObject(parent), session_(session), view_(view), elements_(elements) {
  connect(session_, &Session::changed, this, &ViewPresenter::take_document);
  connect(elements_, &ElementsPresenter::selection_changed, this, &ViewPresenter::refresh);
  connect(elements_, &ElementsPresenter::visibility_changed, this, &ViewPresenter::refresh);
  connect(view_, &MeshView::tool_changed, this, &ViewPresenter::refresh);
  connect(view_, &MeshView::measured, this, [this](const QString& text) {
    measured_ = text;
    refresh();
    emit message(tr("%1   (Ctrl+C copies)").arg(text));
  });
}

void ViewPresenter::take_document(bool other_mesh) {
  const Document& document = session_->shown().document;
  const MeshPtr scan = document.mesh == document.opened.mesh ? nullptr : document.opened.mesh;
  if (other_mesh || scan != reference_) {
    reference_ = scan;
    view_->set_reference(scan, document.zones ? document.zones->largest_radius() : 0.0);
    if (!scan) view_->set_surface(ShownSurface::mesh);
  }
  refresh();
}

void ViewPresenter::add_surface_actions(QMenu* menu) {
  struct Row {
    ShownSurface surface;
    QString text, tooltip;
  };
  surfaces_ = new QActionGroup(this);
  for (const Row& row :
       {Row{ShownSurface::mesh, tr("&Working mesh"),
            tr("Show the mesh as simplified and swapped, coloured by field or partitions")},
        Row{ShownSurface::reference, tr("S&can"),
            tr("Show the scan, plain; lines and picks stay those of the working mesh")},
        Row{ShownSurface::both, tr("&Both, blended"),
            tr("Show the scan translucent over the working mesh")}}) {
    QAction* a = action(menu, row.text, {}, row.tooltip);
    a->setCheckable(true);
    a->setData(static_cast<int>(row.surface));
    surfaces_->addAction(a);
    connect(a, &QAction::triggered, this, [this, s = row.surface] { set_surface(s); });
  }
  menu->addSeparator();
  switch_ = action(menu, tr("&Switch between mesh and scan"), QKeySequence("W"),
                   tr("Show the scan, or the working mesh again"));
  connect(switch_, &QAction::triggered, this, [this] {
    set_surface(view_->surface() == ShownSurface::reference ? ShownSurface::mesh
                                                            : ShownSurface::reference);
  });
}

void ViewPresenter::add_visibility_actions(QMenu* menu) {
  hide_ = action(menu, tr("&Hide selected partitions"), QKeySequence("H"),
                 tr("Take the selected partitions out of the view"));
  connect(hide_, &QAction::triggered, elements_, &ElementsPresenter::hide_selected);
  isolate_ = action(menu, tr("&Isolate selected partitions"), QKeySequence("I"),
                    tr("Show only the selected partitions"));
  connect(isolate_, &QAction::triggered, elements_, &ElementsPresenter::isolate_selected);
  show_all_ = action(menu, tr("Show &all partitions"), QKeySequence("Shift+H"),
                     tr("Show hidden partitions again"));
  connect(show_all_, &QAction::triggered, elements_, &ElementsPresenter::show_all);
}

void ViewPresenter::add_tool_actions(QMenu* menu) {
  struct Row {
    Tool tool;
    QString text, shortcut, tooltip;
  };
  tools_ = new QActionGroup(this);
  for (const Row& row :
       {Row{Tool::select, tr("&Select"), "S", tr("Clicks select, drags turn the part")},
        Row{Tool::band, tr("Select by &rectangle"), "R",
            tr("Drag a rectangle to select the lines in it; Shift and drag does so at any time")},
        Row{Tool::measure, tr("&Measure"), "M",
            tr("Click two points: distance, dx, dy, dz and the angle between the faces")}}) {
    QAction* a = action(menu, row.text, QKeySequence(row.shortcut), row.tooltip);
    a->setCheckable(true);
    a->setData(static_cast<int>(row.tool));
    tools_->addAction(a);
    connect(a, &QAction::triggered, this, [this, t = row.tool] { view_->set_tool(t); });
  }
  menu->addSeparator();
  copy_measurement_ = action(menu, tr("&Copy measurement"), QKeySequence::Copy,
                             tr("Copy the numbers of the last measurement as text"));
  connect(copy_measurement_, &QAction::triggered, this,
          [this] { QApplication::clipboard()->setText(measured_); });
  refresh();
}

void ViewPresenter::set_surface(ShownSurface surface) {
  view_->set_surface(reference_ ? surface : ShownSurface::mesh);
  refresh();
}

void ViewPresenter::refresh() {
  if (!tools_) return;
  const Document& document = session_->shown().document;
  const QString no_part = tr("Open a part first.");
  const QString same = document.empty()
                           ? no_part
                           : tr("The working mesh is the scan: nothing was simplified or swapped.");
  for (QAction* a : surfaces_->actions()) {
    set_available(a, reference_ != nullptr, same);
    a->setChecked(a->data().toInt() == static_cast<int>(view_->surface()));
  }
  set_available(switch_, reference_ != nullptr, same);
  const bool selected = !elements_->selected_partitions().empty();
  const QString none = tr("Select partitions first, in the view or in their table.");
  for (QAction* a : {hide_, isolate_}) set_available(a, selected, none);
  set_available(show_all_, elements_->hides_any(), tr("Nothing is hidden."));
  for (QAction* a : tools_->actions()) {
    a->setChecked(a->data().toInt() == static_cast<int>(view_->tool()));
    set_available(a, !document.empty(), no_part);
  }
  set_available(copy_measurement_, !measured_.isEmpty(), tr("Nothing was measured yet."));
}

}  // namespace arris::ui
