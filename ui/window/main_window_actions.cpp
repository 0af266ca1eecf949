// The actions of the main window: its menus and tool bars, and when each of them is to be had.

#include <algorithm>

#include <QAction>
#include <QActionGroup>
#include <QApplication>
#include <QClipboard>
#include <QDockWidget>
#include <QMenu>
#include <QMenuBar>
#include <QSettings>
#include <QStackedWidget>
#include <QToolBar>

#include "ui/panels/controls.h"
#include "ui/panels/section_bar.h"
#include "ui/panels/start_page.h"
#include "ui/window/actions.h"
#include "ui/window/main_window.h"
#include "ui/window/named_views_presenter.h"
#include "ui/window/report_presenter.h"
#include "ui/window/theme.h"

namespace arris::ui {

void MainWindow::make_actions() {
  make_file_menu();
  make_edit_menu();
  make_part_menu();
  treatments_->add_line_actions(menuBar()->addMenu(tr("Li&nes")));
  treatments_->add_partition_actions(menuBar()->addMenu(tr("Part&itions")));
  make_view_menu();
  view_presenter_->add_tool_actions(menuBar()->addMenu(tr("&Tools")));
  QMenu* check = menuBar()->addMenu(tr("Chec&k"));
  worklist_->add_actions(check);
  check->addSeparator();
  explanations_->add_actions(check);
  stability_->add_actions(check);
  make_help_menu();
  for (QAction* a : {save_session_, save_session_as_, save_picture_, copy_picture_, export_,
                     write_report_, report_, show_field_, show_partitions_, fit_, zoom_})
    part_actions_.push_back(a);
  for (QMenu* menu : findChildren<QMenu*>()) menu->setToolTipsVisible(true);
  make_tool_bars();
}

void MainWindow::make_file_menu() {
  QMenu* file = menuBar()->addMenu(tr("&File"));
  connect(action(file, tr("&Open scan…"), QKeySequence::Open,
                 tr("Open an STL, PLY, OBJ, OFF or 3MF file, or a session")),
          &QAction::triggered, this, &MainWindow::choose_file);
  connect(action(file, tr("Open the sample &mould"), QKeySequence("Ctrl+Shift+O"),
                 tr("Open the mould part that Arris makes itself")),
          &QAction::triggered, this, &MainWindow::open_sample);
  recent_menu_ = file->addMenu(tr("Open &recent"));
  save_session_ = action(file, tr("&Save session"), QKeySequence::Save,
                         tr("Save scan, operations and view in one file; open it to go on"));
  connect(save_session_, &QAction::triggered, this, &MainWindow::save);
  save_session_as_ = action(file, tr("Save session &as…"), QKeySequence("Ctrl+Shift+S"),
                            tr("Save the session in another file and go on with that"));
  connect(save_session_as_, &QAction::triggered, this, &MainWindow::save_as);
  file->addSeparator();
  save_picture_ = action(file, tr("Save &picture…"), QKeySequence("Ctrl+P"),
                         tr("Save the view at a size in pixels, with its scalar bar"));
  save_picture_->setObjectName("save_picture");
  connect(save_picture_, &QAction::triggered, this, &MainWindow::choose_picture);
  copy_picture_ = action(file, tr("&Copy picture"), QKeySequence("Ctrl+Shift+C"),
                         tr("Copy the view to the clipboard"));
  connect(copy_picture_, &QAction::triggered, this, [this] {
    PictureOptions options = picture_options_;
    options.size = stack_->size() * view_->devicePixelRatioF();
    options.dots_per_inch = options.height = 0.0;  // as on the screen
    QApplication::clipboard()->setImage(picture(options));
  });
  export_ = action(file, tr("&Export results…"), QKeySequence("Ctrl+E"),
                   tr("Write lines, boundaries, labelled scan and operations into a folder"));
  connect(export_, &QAction::triggered, this, &MainWindow::export_results);
  write_report_ = action(file, tr("Write repor&t…"), QKeySequence("Ctrl+Shift+P"),
                         tr("Pictures, steps, tables and what is left, as a page and as PDF"));
  write_report_->setObjectName("write_report");
  connect(write_report_, &QAction::triggered, reports_, &ReportPresenter::ask);
  file->addSeparator();
  connect(action(file, tr("&Quit"), QKeySequence::Quit, tr("Close Arris")), &QAction::triggered,
          this, &QWidget::close);
}

void MainWindow::make_edit_menu() {
  QMenu* edit = menuBar()->addMenu(tr("&Edit"));
  undo_ = action(edit, tr("&Undo"), QKeySequence::Undo, tr("Take back the last operation"));
  connect(undo_, &QAction::triggered, session_, &Session::undo);
  redo_ = action(edit, tr("&Redo"), QKeySequence::Redo, tr("Do it again"));
  connect(redo_, &QAction::triggered, session_, &Session::redo);
  edit->addSeparator();
  QAction* clear =
      action(edit, tr("&Clear selection"), QKeySequence("Ctrl+Shift+A"), tr("Select nothing"));
  connect(clear, &QAction::triggered, elements_, &ElementsPresenter::clear_selection);
  edit->addSeparator();
  comparison_->add_actions(edit);
}

void MainWindow::make_part_menu() {
  QMenu* part = menuBar()->addMenu(tr("&Part"));
  run_lines_ = action(part, tr("Find sharp &lines"), QKeySequence("Ctrl+L"),
                      tr("Run the step with the parameters of its card"));
  connect(run_lines_, &QAction::triggered, this, [this] { steps_->run("find_sharp_lines"); });
  run_partitions_ = action(part, tr("Find &partitions"), QKeySequence("Ctrl+R"),
                           tr("Run the step with the parameters of its card"));
  connect(run_partitions_, &QAction::triggered, this, [this] { steps_->run("find_partitions"); });
  run_all_ = action(part, tr("&Run all that is out of date"), QKeySequence("F5"),
                    tr("On a fresh part: find sharp lines and partitions on the scan's own mesh. "
                       "Later: run again the steps that an earlier one has put out of date"));
  connect(run_all_, &QAction::triggered, steps_, &StepsPresenter::run_out_of_date);
  connect(steps_, &StepsPresenter::edited, this, &MainWindow::refresh_actions);
  run_paper_ = action(part, tr("Run the paper's fl&ow"), QKeySequence("Shift+F5"),
                      tr("Figure 2 of the paper, from the scan on: simplify inside error zones, "
                         "find sharp lines by the walk along edges, equilateralise, find "
                         "partitions. Each step can be undone"));
  connect(run_paper_, &QAction::triggered, steps_, &StepsPresenter::run_paper_flow);
  part->addSeparator();
  flip_ =
      action(part, tr("&Flip orientation"), {}, tr("Turn all faces round: convex becomes concave"));
  connect(flip_, &QAction::triggered, this, [this] {
    session_->run({Operation{"flip_orientation", nlohmann::json::object()}});
  });
  drop_ = action(part, tr("&Drop small pieces"), {},
                 tr("Delete loose pieces with fewer than a hundredth of the faces"));
  connect(drop_, &QAction::triggered, this, [this] {
    const std::size_t faces = session_->current().document.mesh->face_count();
    session_->run(
        {Operation{"delete_faces", {{"components_under", std::max<std::size_t>(faces / 100, 2)}}}});
  });
  part->addSeparator();
  units_->add_actions(part->addMenu(tr("&Unit of lengths")));
  report_ = action(part, tr("Load r&eport…"), {}, tr("What the file held and what was mended"));
  connect(report_, &QAction::triggered, this, &MainWindow::show_load_report);
}

void MainWindow::make_view_menu() {
  QMenu* look = menuBar()->addMenu(tr("&View"));
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
    elements_->set_partitions_shown(shown);
    if (view_->is_fitted()) view_->fit();  // the scalar bar comes or goes
  });
  make_field_menu(look->addMenu(tr("&Field")));
  view_presenter_->add_surface_actions(look->addMenu(tr("S&urface")));
  section_->add_actions(look->addMenu(tr("Se&ction")));
  look->addSeparator();
  view_presenter_->add_visibility_actions(look);
  look->addSeparator();
  add_toggles(look);
  look->addSeparator();
  fit_ = action(look, tr("&Fit"), QKeySequence("F"), tr("The whole part in the view"));
  connect(fit_, &QAction::triggered, view_, &MeshView::fit);
  zoom_ = action(look, tr("&Zoom to selection"), QKeySequence("Z"),
                 tr("The selected lines and partitions in the view"));
  connect(zoom_, &QAction::triggered, elements_, &ElementsPresenter::zoom_to_selection);
  make_standard_views(look->addMenu(tr("S&tandard views")));
  named_views_->add_actions(look->addMenu(tr("Na&med views")));
  look->addSeparator();
  panels_menu_ = look->addMenu(tr("Pa&nels"));
  for (QDockWidget* dock : findChildren<QDockWidget*>())
    panels_menu_->addAction(dock->toggleViewAction());
  panels_menu_->addSeparator();
  connect(action(panels_menu_, tr("&Reset layout"), {},
                 tr("All panels where they were at first, the window inside the screen")),
          &QAction::triggered, this, &MainWindow::reset_layout);
}

void MainWindow::make_field_menu(QMenu* menu) {
  field_actions_ = new QActionGroup(this);
  for (const FieldInfo& info : field_table()) {
    QAction* a = action(menu, title_of(info.field),
                        QKeySequence(QString("Alt+%1").arg(QLatin1Char(info.key))),
                        shown_text(info.meaning));
    a->setCheckable(true);
    a->setData(static_cast<int>(info.field));
    a->setChecked(info.field == fields_->field());
    field_actions_->addAction(a);
    connect(a, &QAction::triggered, this, [this, field = info.field] { set_field(field); });
  }
}

void MainWindow::add_toggles(QMenu* look) {
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
    connect(a, &QAction::toggled, view_, t.set);
  }
  QAction* tangent = action(look, tr("Tan&gent lines"), QKeySequence("Ctrl+T"),
                            tr("Set off the Gn boundaries along which two surfaces touch, as at "
                               "both rims of a fillet"));
  tangent->setCheckable(true);
  tangent->setObjectName("tangent_lines");
  toggles_.push_back(tangent);
  connect(tangent, &QAction::toggled, elements_, &ElementsPresenter::set_tangent_lines_shown);
  QAction* dark = action(look, tr("&Dark"), QKeySequence("Ctrl+D"), tr("Light or dark window"));
  dark->setCheckable(true);
  connect(dark, &QAction::toggled, this, [this](bool on) {
    set_theme(*qApp, on);
    view_->set_dark(on);
    QSettings().setValue("window/dark", on);
  });
  dark->setChecked(QSettings().value("window/dark", false).toBool());
}

void MainWindow::make_standard_views(QMenu* standard) {
  using View = MeshView::StandardView;
  const std::vector<std::pair<QString, View>> views{
      {tr("Front"), View::front},        {tr("Back"), View::back}, {tr("Left"), View::left},
      {tr("Right"), View::right},        {tr("Top"), View::top},   {tr("Bottom"), View::bottom},
      {tr("Isometric"), View::isometric}};
  for (std::size_t k = 0; k < views.size(); ++k) {
    QAction* a = action(standard, views[k].first, QKeySequence(QString::number((k + 1) % 7)),
                        tr("Look from there"));
    connect(a, &QAction::triggered, this, [this, v = views[k].second] { view_->look_from(v); });
    part_actions_.push_back(a);
  }
}

void MainWindow::make_help_menu() {
  QMenu* help = menuBar()->addMenu(tr("&Help"));
  connect(
      action(help, tr("&Start page"), QKeySequence("F1"), tr("The start page and the five steps")),
      &QAction::triggered, this, [this] {
        const bool on_start = stack_->currentWidget() == start_page_;
        if (!on_start || !session_->current().document.empty())
          stack_->setCurrentWidget(on_start ? static_cast<QWidget*>(side_by_side_) : start_page_);
      });
  connect(action(help, tr("Take the &tour"), QKeySequence("Shift+F1"),
                 tr("Five steps on the open part, or on the sample mould, each done by you")),
          &QAction::triggered, this, [this] {
            if (!session_->current().document.empty()) stack_->setCurrentWidget(side_by_side_);
            tour_->take();
          });
  connect(action(help, tr("&About Arris"), {},
                 tr("What Arris is, what it is made of and where its log lies; a report to copy")),
          &QAction::triggered, this, &MainWindow::show_about);
}

void MainWindow::make_tool_bars() {
  QToolBar* bar = addToolBar(tr("Tools"));
  bar->setObjectName("tools");
  bar->setMovable(false);
  bar->addActions({undo_, redo_});
  bar->addSeparator();
  bar->addActions({show_field_, show_partitions_});
  bar->addSeparator();
  bar->addActions({run_all_, fit_, save_picture_});
  section_bar_->setObjectName("section");
  section_bar_->toggleViewAction()->setVisible(false);
  addToolBar(section_bar_);
  treatment_bar_->setObjectName("treatment");
  // It takes the place of the tools while it is there: nothing moves, and it needs the room.
  connect(treatment_bar_, &QToolBar::visibilityChanged, bar,
          [this, bar] { bar->setVisible(treatment_bar_->isHidden()); });
  treatment_bar_->toggleViewAction()->setVisible(false);
  addToolBar(treatment_bar_);
  bar->setMinimumHeight(section_bar_->sizeHint().height());  // nothing moves when it comes
}

void MainWindow::refresh_actions() {
  const bool busy = session_->busy();
  const bool part = !session_->current().document.empty();
  const QString no_part = tr("Open a part first.");
  const QString wait = part ? tr("Wait until the work that runs is done.") : no_part;
  for (QAction* a : part_actions_) set_available(a, part, no_part);
  for (QAction* a : {run_lines_, run_partitions_, run_paper_, flip_, drop_})
    set_available(a, part && !busy, wait);
  for (QAction* a : field_actions_->actions())
    set_available(a, fields_->is_available(static_cast<Field>(a->data().toInt())),
                  FieldPresenter::why_not_available());
  set_available(run_all_, part && !busy && steps_->anything_out_of_date(),
                part && !busy ? tr("Everything is up to date.") : wait);
  if (!session_->travelling()) {  // else more of them are taken, and done one after the other
    set_available(undo_, false, wait);
    set_available(redo_, false, wait);
  }
  if (busy) return;  // the history belongs to the work that runs
  const History& history = session_->history();
  const auto name = [&](std::uint32_t sequence) {
    return QString::fromStdString(describe(history.entries()[sequence - 1].operation));
  };
  undo_->setStatusTip(part ? tr("Take back the last operation on %1").arg(session_->part_name())
                           : tr("Take back the last operation"));
  // The first row is the opening of the part: there is nothing before it to go back to.
  set_available(undo_, history.head() > 1, part ? tr("There is nothing to undo.") : no_part);
  undo_->setText(history.head() > 1 ? tr("Undo: %1").arg(name(history.head())) : tr("Undo"));
  set_available(redo_, history.can_redo(), part ? tr("There is nothing to redo.") : no_part);
  redo_->setText(tr("Redo"));
  const std::vector<std::uint32_t> rows = history.line_of_travel();
  for (std::size_t k = 0; k + 1 < rows.size(); ++k)
    if (rows[k] == history.head()) redo_->setText(tr("Redo: %1").arg(name(rows[k + 1])));
  undo_->setIconText(tr("Undo"));
  redo_->setIconText(tr("Redo"));
}

void MainWindow::add_selection_actions(QMenu& menu) {
  menu.addAction(zoom_);
  menu.addSeparator();
  menu.addActions(view_presenter_->visibility_actions());
  menu.addSeparator();
  if (!elements_->selected_lines().empty()) menu.addActions(treatments_->available_line_actions());
  if (!elements_->selected_partitions().empty())
    menu.addActions(treatments_->available_partition_actions());
}

void MainWindow::context_menu(const QPoint& global, const std::optional<Pick>& pick) {
  if (session_->current().document.empty()) return;
  elements_->select_at(pick);
  QMenu menu(this);
  menu.addActions({show_field_, show_partitions_});
  menu.addSeparator();
  menu.addAction(fit_);
  add_selection_actions(menu);
  if (pick && (pick->edge != no_id || pick->face != no_id))
    connect(menu.addAction(tr("E&xplain")), &QAction::triggered, this,
            [this, pick] { explanations_->explain(*pick); });
  menu.addSeparator();
  menu.addActions({copy_picture_, save_picture_});
  menu.exec(global);
}

void MainWindow::table_menu(const QPoint& global) {
  QMenu menu(this);
  add_selection_actions(menu);
  menu.exec(global);
}

}  // namespace arris::ui
