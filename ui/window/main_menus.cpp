#include "ui/window/main_menus.h"

#include <algorithm>

#include <QAction>
#include <QActionGroup>
#include <QApplication>
#include <QDockWidget>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QSettings>
#include <QToolBar>

#include "ui/panels/controls.h"
#include "ui/panels/section_bar.h"
#include "ui/panels/start_page.h"
#include "ui/panels/treatment_bar.h"
#include "ui/window/about_dialog.h"
#include "ui/window/actions.h"
#include "ui/window/comparison_presenter.h"
#include "ui/window/elements_presenter.h"
#include "ui/window/explanation_presenter.h"
#include "ui/window/field_presenter.h"
#include "ui/window/files_presenter.h"
#include "ui/window/help_window.h"
#include "ui/window/history_presenter.h"
#include "ui/window/load_report_box.h"
#include "ui/window/named_views_presenter.h"
#include "ui/window/pictures_presenter.h"
#include "ui/window/report_presenter.h"
#include "ui/window/results_presenter.h"
#include "ui/window/section_presenter.h"
#include "ui/window/session.h"
#include "ui/window/stability_presenter.h"
#include "ui/window/steps_presenter.h"
#include "ui/window/theme.h"
#include "ui/window/tour_presenter.h"
#include "ui/window/treatments_presenter.h"
#include "ui/window/unit_presenter.h"
#include "ui/window/view_presenter.h"
#include "ui/window/worklist_presenter.h"

namespace arris::ui {

MainMenus::MainMenus(const Workbench& parts, QMainWindow* window)
    : QObject(window), parts_(parts), window_(window) {
  make_file_menu();
  make_edit_menu();
  make_part_menu();
  parts_.treatments->add_line_actions(add_menu(tr("Li&nes")));
  parts_.treatments->add_partition_actions(add_menu(tr("Part&itions")));
  make_view_menu();
  parts_.surface->add_tool_actions(add_menu(tr("&Tools")));
  QMenu* check = add_menu(tr("Chec&k"));
  parts_.worklist->add_actions(check);
  check->addSeparator();
  parts_.explanations->add_actions(check);
  parts_.stability->add_actions(check);
  make_help_menu();
  for (QAction* a : parts_.files->part_actions() + parts_.pictures->actions() +
                        QList<QAction*>{export_, write_report_, load_report_, show_field_,
                                        show_partitions_, fit_, zoom_})
    part_actions_.push_back(a);
  for (QMenu* menu : window_->findChildren<QMenu*>()) menu->setToolTipsVisible(true);
  make_tool_bar();
  follow();
  refresh();
}

QMenu* MainMenus::add_menu(const QString& title) { return window_->menuBar()->addMenu(title); }

void MainMenus::follow() {
  connect(parts_.session, &Session::changed, this, [this] {
    if (!parts_.session->is_previewing()) refresh();
  });
  connect(parts_.session, &Session::busy_changed, this, &MainMenus::refresh);
  connect(parts_.reports, &ReportPresenter::writing_changed, this, &MainMenus::refresh);
  connect(parts_.session, &Session::done, this, [this](const QString& operation) {
    if (operation != "find_partitions") return;
    show_partitions(true);
    if (parts_.view->is_fitted()) parts_.view->fit();  // the legend is there now
  });
  connect(parts_.fields, &FieldPresenter::changed, this, [this] {
    for (QAction* a : field_actions_->actions())
      a->setChecked(a->data().toInt() == static_cast<int>(parts_.fields->field()));
  });
  connect(parts_.view, &MeshView::context_menu_wanted, this, &MainMenus::context_menu);
  connect(parts_.elements, &ElementsPresenter::table_menu_wanted, this, &MainMenus::table_menu);
}

void MainMenus::set_field(Field field) {
  show_field_->setChecked(true);
  parts_.fields->set_field(field);
}

void MainMenus::show_partitions(bool shown) {
  (shown ? show_partitions_ : show_field_)->setChecked(true);
}

void MainMenus::make_file_menu() {
  QMenu* file = add_menu(tr("&File"));
  parts_.files->add_actions(file);
  file->addSeparator();
  parts_.pictures->add_actions(file);
  export_ = action(file, tr("&Export results…"), QKeySequence("Ctrl+E"),
                   tr("Write lines, boundaries, labelled scan and operations into a folder"));
  connect(export_, &QAction::triggered, parts_.results, &ResultsPresenter::ask);
  write_report_ = action(file, tr("Write repor&t…"), QKeySequence("Ctrl+Shift+P"),
                         tr("Pictures, steps, tables and what is left, as a page and as PDF"));
  write_report_->setObjectName("write_report");
  connect(write_report_, &QAction::triggered, parts_.reports, &ReportPresenter::ask);
  file->addSeparator();
  connect(action(file, tr("&Quit"), QKeySequence::Quit, tr("Close Arris")), &QAction::triggered,
          window_, &QWidget::close);
}

void MainMenus::make_edit_menu() {
  QMenu* edit = add_menu(tr("&Edit"));
  parts_.history->add_actions(edit);
  edit->addSeparator();
  QAction* clear =
      action(edit, tr("&Clear selection"), QKeySequence("Ctrl+Shift+A"), tr("Select nothing"));
  connect(clear, &QAction::triggered, parts_.elements, &ElementsPresenter::clear_selection);
  edit->addSeparator();
  parts_.comparison->add_actions(edit);
}

void MainMenus::make_part_menu() {
  QMenu* part = add_menu(tr("&Part"));
  run_lines_ = action(part, tr("Find sharp &lines"), QKeySequence("Ctrl+L"),
                      tr("Run the step with the parameters of its card"));
  connect(run_lines_, &QAction::triggered, this, [this] { parts_.steps->run("find_sharp_lines"); });
  run_partitions_ = action(part, tr("Find &partitions"), QKeySequence("Ctrl+R"),
                           tr("Run the step with the parameters of its card"));
  connect(run_partitions_, &QAction::triggered, this,
          [this] { parts_.steps->run("find_partitions"); });
  run_all_ = action(part, tr("&Run all that is out of date"), QKeySequence("F5"),
                    tr("On a fresh part: find sharp lines and partitions on the scan's own mesh. "
                       "Later: run again the steps that an earlier one has put out of date"));
  connect(run_all_, &QAction::triggered, parts_.steps, &StepsPresenter::run_out_of_date);
  connect(parts_.steps, &StepsPresenter::edited, this, &MainMenus::refresh);
  run_paper_ = action(part, tr("Run the paper's fl&ow"), QKeySequence("Shift+F5"),
                      tr("Figure 2 of the paper, from the scan on: simplify inside error zones, "
                         "find sharp lines by the walk along edges, equilateralise, find "
                         "partitions. Each step can be undone"));
  connect(run_paper_, &QAction::triggered, parts_.steps, &StepsPresenter::run_paper_flow);
  part->addSeparator();
  flip_ =
      action(part, tr("&Flip orientation"), {}, tr("Turn all faces round: convex becomes concave"));
  connect(flip_, &QAction::triggered, this, [this] {
    parts_.session->run({Operation{"flip_orientation", nlohmann::json::object()}});
  });
  drop_ = action(part, tr("&Drop small pieces"), {},
                 tr("Delete loose pieces with fewer than a hundredth of the faces"));
  connect(drop_, &QAction::triggered, this, [this] {
    const std::size_t faces = parts_.session->current().document.mesh->face_count();
    parts_.session->run(
        {Operation{"delete_faces", {{"components_under", std::max<std::size_t>(faces / 100, 2)}}}});
  });
  part->addSeparator();
  parts_.units->add_actions(part->addMenu(tr("&Unit of lengths")));
  load_report_ =
      action(part, tr("Load r&eport…"), {}, tr("What the file held and what was mended"));
  connect(load_report_, &QAction::triggered, this,
          [this] { show_load_report(parts_.session->current().document.scan->report, window_); });
}

void MainMenus::make_view_menu() {
  QMenu* look = add_menu(tr("&View"));
  show_field_ =
      action(look, tr("&Curvature"), QKeySequence("C"), tr("Colour the surface by a field"));
  show_partitions_ =
      action(look, tr("&Partitions"), QKeySequence("P"), tr("Colour the surface by partitions"));
  auto* surface = new QActionGroup(this);
  for (QAction* a : {show_field_, show_partitions_}) {
    a->setCheckable(true);
    surface->addAction(a);
  }
  show_field_->setChecked(true);
  connect(show_partitions_, &QAction::toggled, this, [this](bool shown) {
    parts_.elements->set_partitions_shown(shown);
    if (parts_.view->is_fitted()) parts_.view->fit();  // the scalar bar comes or goes
  });
  make_field_menu(look->addMenu(tr("&Field")));
  parts_.surface->add_surface_actions(look->addMenu(tr("S&urface")));
  parts_.section->add_actions(look->addMenu(tr("Se&ction")));
  look->addSeparator();
  parts_.surface->add_visibility_actions(look);
  look->addSeparator();
  add_toggles(look);
  look->addSeparator();
  fit_ = action(look, tr("&Fit"), QKeySequence("F"), tr("The whole part in the view"));
  connect(fit_, &QAction::triggered, parts_.view, &MeshView::fit);
  zoom_ = action(look, tr("&Zoom to selection"), QKeySequence("Z"),
                 tr("The selected lines and partitions in the view"));
  connect(zoom_, &QAction::triggered, parts_.elements, &ElementsPresenter::zoom_to_selection);
  make_standard_views(look->addMenu(tr("S&tandard views")));
  parts_.named_views->add_actions(look->addMenu(tr("Na&med views")));
  make_navigation(look->addMenu(tr("Mouse na&vigation")));
  look->addSeparator();
  QMenu* panels = look->addMenu(tr("Pa&nels"));
  for (QDockWidget* dock : window_->findChildren<QDockWidget*>())
    panels->addAction(dock->toggleViewAction());
  panels->addSeparator();
  connect(action(panels, tr("&Reset layout"), {},
                 tr("All panels where they were at first, the window inside the screen")),
          &QAction::triggered, this, &MainMenus::layout_reset_wanted);
}

void MainMenus::make_field_menu(QMenu* menu) {
  field_actions_ = new QActionGroup(this);
  for (const FieldInfo& info : field_table()) {
    QAction* a = action(menu, title_of(info.field),
                        QKeySequence(QString("Alt+%1").arg(QLatin1Char(info.key))),
                        shown_text(info.meaning));
    a->setCheckable(true);
    a->setData(static_cast<int>(info.field));
    a->setChecked(info.field == parts_.fields->field());
    field_actions_->addAction(a);
    connect(a, &QAction::triggered, this, [this, field = info.field] { set_field(field); });
  }
}

void MainMenus::add_toggles(QMenu* look) {
  struct Toggle {
    const char* name;  // as sessions keep it
    QString text, shortcut, tooltip;
    bool on;
    void (MeshView::*set)(bool);
  };
  for (const Toggle& t :
       {Toggle{"lines", tr("&Lines"), "L", tr("Show lines and boundaries"), true,
               &MeshView::set_lines_visible},
        Toggle{"edges", tr("Mesh &edges"), "E", tr("Show the edges of the mesh"), false,
               &MeshView::set_edges_visible},
        Toggle{"flat", tr("Flat s&hading"), "Shift+N",
               tr("Shade each face by itself, as it is, instead of smooth between "
                  "sharp edges"),
               false, &MeshView::set_flat_shading},
        Toggle{"lit", tr("Li&ght on field colours"), "Shift+L",
               tr("Shade the colours of a field as the surface is lit; without "
                  "light they are exactly those of the scalar bar"),
               false, &MeshView::set_fields_lit},
        Toggle{"scalar_bar", tr("&Scalar bar"), "B", tr("Show the scalar bar"), true,
               &MeshView::set_scalar_bar_visible}}) {
    QAction* a = action(look, t.text, QKeySequence(t.shortcut), t.tooltip);
    a->setCheckable(true);
    a->setChecked(t.on);
    a->setObjectName(t.name);
    toggles_.push_back(a);
    connect(a, &QAction::toggled, parts_.view, t.set);
  }
  QAction* tangent = action(look, tr("Tan&gent lines"), QKeySequence("Ctrl+T"),
                            tr("Set off the Gn boundaries along which two surfaces touch, as at "
                               "both rims of a fillet"));
  tangent->setCheckable(true);
  tangent->setObjectName("tangent_lines");
  toggles_.push_back(tangent);
  connect(tangent, &QAction::toggled, parts_.elements, &ElementsPresenter::set_tangent_lines_shown);
  QAction* dark = action(look, tr("&Dark"), QKeySequence("Ctrl+D"), tr("Light or dark window"));
  dark->setCheckable(true);
  connect(dark, &QAction::toggled, this, [this](bool on) {
    set_theme(*qApp, on);
    parts_.view->set_dark(on);
    QSettings().setValue("window/dark", on);
  });
  dark->setChecked(QSettings().value("window/dark", false).toBool());
}

void MainMenus::make_standard_views(QMenu* standard) {
  using View = MeshView::StandardView;
  const std::vector<std::pair<QString, View>> views{
      {tr("Front"), View::front},        {tr("Back"), View::back}, {tr("Left"), View::left},
      {tr("Right"), View::right},        {tr("Top"), View::top},   {tr("Bottom"), View::bottom},
      {tr("Isometric"), View::isometric}};
  for (std::size_t k = 0; k < views.size(); ++k) {
    QAction* a = action(standard, views[k].first, QKeySequence(QString::number((k + 1) % 7)),
                        tr("Look from there"));
    connect(a, &QAction::triggered, this,
            [this, v = views[k].second] { parts_.view->look_from(v); });
    part_actions_.push_back(a);
  }
}

void MainMenus::make_navigation(QMenu* menu) {
  auto* styles = new QActionGroup(this);
  const NavigationStyle chosen = navigation_style(QSettings().value("view/navigation").toString());
  for (const NavigationInfo& info : navigation_table()) {
    QAction* a = action(menu, info.name, {}, navigation_summary(info));
    a->setCheckable(true);
    styles->addAction(a);
    connect(a, &QAction::toggled, this, [this, &info](bool on) {
      if (!on) return;
      parts_.view->set_navigation(info.style);
      QSettings().setValue("view/navigation", info.key);
    });
    a->setChecked(info.style == chosen);
  }
}

void MainMenus::make_help_menu() {
  QMenu* help = add_menu(tr("&Help"));
  connect(action(help, tr("&Manual"), QKeySequence("F1"),
                 tr("The page of the tool in use, or of what is under the pointer")),
          &QAction::triggered, this, &MainMenus::show_help);
  connect(
      action(help, tr("S&hortcuts"), QKeySequence("Ctrl+F1"), tr("All commands that have a key")),
      &QAction::triggered, this, [this] { open_help()->show_page("shortcuts"); });
  connect(action(help, tr("&Start page"), QKeySequence("Alt+Home"),
                 tr("The start page and the five steps")),
          &QAction::triggered, this, [this] {
            const bool on_start = parts_.start_page->isVisible();
            if (!on_start || !parts_.session->current().document.empty())
              emit start_page_wanted(!on_start);
          });
  connect(action(help, tr("Take the &tour"), QKeySequence("Shift+F1"),
                 tr("Five steps on the open part, or on the sample mould, each done by you")),
          &QAction::triggered, this, [this] {
            if (!parts_.session->current().document.empty()) emit start_page_wanted(false);
            parts_.tour->take();
          });
  connect(action(help, tr("&About Arris"), {},
                 tr("What Arris is, what it is made of and where its log lies; a report to copy")),
          &QAction::triggered, this, [this] { AboutDialog(*parts_.session, window_).exec(); });
}

HelpWindow* MainMenus::open_help() {
  if (!help_) help_ = new HelpWindow(window_);
  help_->show();
  help_->raise();
  return help_;
}

void MainMenus::show_help() {
  const QString operation = parts_.treatments->operation_in_use();
  const QWidget* under = QApplication::widgetAt(QCursor::pos());
  HelpWindow* help = open_help();
  if (operation.isEmpty() || !help->show_operation(operation)) help->show_place(under);
}

void MainMenus::make_tool_bar() {
  QToolBar* bar = window_->addToolBar(tr("Tools"));
  bar->setObjectName("tools");
  bar->setMovable(false);
  bar->addActions({parts_.history->undo(), parts_.history->redo()});
  bar->addSeparator();
  bar->addActions({show_field_, show_partitions_});
  bar->addSeparator();
  bar->addActions({run_all_, fit_, parts_.pictures->save_action()});
  parts_.section_bar->setObjectName("section");
  parts_.treatment_bar->setObjectName("treatment");
  for (QToolBar* other :
       {static_cast<QToolBar*>(parts_.section_bar), static_cast<QToolBar*>(parts_.treatment_bar)}) {
    other->toggleViewAction()->setVisible(false);
    window_->addToolBar(other);
  }
  // It takes the place of the tools while it is there: nothing moves, and it needs the room.
  connect(parts_.treatment_bar, &QToolBar::visibilityChanged, bar,
          [this, bar] { bar->setVisible(parts_.treatment_bar->isHidden()); });
  // Nothing moves when it comes.
  bar->setMinimumHeight(parts_.section_bar->sizeHint().height());
}

void MainMenus::refresh() {
  const bool busy = parts_.session->busy();
  const bool part = !parts_.session->current().document.empty();
  const QString no_part = tr("Open a part first.");
  const QString wait = part ? tr("Wait until the work that runs is done.") : no_part;
  for (QAction* a : part_actions_) set_available(a, part, no_part);
  for (QAction* a : {run_lines_, run_partitions_, run_paper_, flip_, drop_})
    set_available(a, part && !busy, wait);
  for (QAction* a : field_actions_->actions())
    set_available(a, parts_.fields->is_available(static_cast<Field>(a->data().toInt())),
                  FieldPresenter::why_not_available());
  set_available(run_all_, part && !busy && parts_.steps->anything_out_of_date(),
                part && !busy ? tr("Everything is up to date.") : wait);
}

void MainMenus::add_selection_actions(QMenu& menu) {
  menu.addAction(zoom_);
  menu.addSeparator();
  menu.addActions(parts_.surface->visibility_actions());
  menu.addSeparator();
  if (!parts_.elements->selected_lines().empty())
    menu.addActions(parts_.treatments->available_line_actions());
  if (!parts_.elements->selected_partitions().empty())
    menu.addActions(parts_.treatments->available_partition_actions());
}

void MainMenus::context_menu(const QPoint& global, const std::optional<Pick>& pick) {
  if (parts_.session->current().document.empty()) return;
  parts_.elements->select_at(pick);
  QMenu menu(window_);
  menu.addActions({show_field_, show_partitions_});
  menu.addSeparator();
  menu.addAction(fit_);
  add_selection_actions(menu);
  if (pick && (pick->edge != no_id || pick->face != no_id))
    connect(menu.addAction(tr("E&xplain")), &QAction::triggered, this,
            [this, pick] { parts_.explanations->explain(*pick); });
  menu.addSeparator();
  menu.addActions(parts_.pictures->actions());
  menu.exec(global);
}

void MainMenus::table_menu(const QPoint& global) {
  QMenu menu(window_);
  add_selection_actions(menu);
  menu.exec(global);
}

}  // namespace arris::ui
