#include "ui/window/main_window.h"

#include <algorithm>

#include <QAbstractEventDispatcher>
#include <QAction>
#include <QActionGroup>
#include <QApplication>
#include <QClipboard>
#include <QCloseEvent>
#include <QDateTime>
#include <QDir>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QProgressBar>
#include <QPushButton>
#include <QSettings>
#include <QStackedWidget>
#include <QStandardPaths>
#include <QStatusBar>
#include <QTimer>
#include <QToolBar>

#include "core/base/number_text.h"
#include "core/base/vector_state.h"
#include "core/base/write_file.h"
#include "core/document/export.h"
#include "core/document/journal.h"
#include "core/mesh/write_ply.h"
#include "core/samples/mould.h"
#include "ui/panels/controls.h"
#include "ui/panels/history_panel.h"
#include "ui/panels/section_bar.h"
#include "ui/panels/start_page.h"
#include "ui/window/actions.h"
#include "ui/window/hover_text.h"
#include "ui/window/picture_dialog.h"
#include "ui/window/tab_order.h"
#include "ui/window/theme.h"

namespace arris::ui {

namespace {

constexpr int most_recent = 10;
constexpr int progress_delay = 300;  // ms: shorter work shows no progress

QString counted(std::size_t count, const QString& what) {
  return count_text(static_cast<qint64>(count)) + " " + what;
}

}  // namespace

MainWindow::MainWindow(QWidget* parent) : QMainWindow(parent) {
  setWindowTitle("Arris");
  setAcceptDrops(true);
  // Drawing in between may leave them dirty.
  connect(QAbstractEventDispatcher::instance(), &QAbstractEventDispatcher::awake, this,
          [] { clear_vector_state(); });
  setDockNestingEnabled(true);
  resize(1440, 900);

  session_ = new Session(this);
  stack_ = new QStackedWidget(this);
  start_page_ = new StartPage(stack_);
  view_ = new MeshView(stack_);
  stack_->addWidget(start_page_);
  focus_ring_ = new FocusRing(this);
  side_by_side_ = new SideBySide(view_, marked_colour(), stack_);
  stack_->addWidget(side_by_side_);
  setCentralWidget(stack_);

  make_docks();
  fields_ = new FieldPresenter(view_, colour_map_, histogram_, this);
  // The view takes the new mesh before anything else shows on it.
  connect(session_, &Session::changed, this, [this](bool other_mesh) {
    const Document& document = session_->shown().document;
    if (other_mesh) {
      view_->set_mesh(document.mesh, false);
      stack_->setCurrentWidget(document.empty() ? static_cast<QWidget*>(start_page_)
                                                : side_by_side_);
    }
    fields_->show(document);
  });
  elements_ = new ElementsPresenter(session_, view_,
                                    {lines_table_, partitions_table_, boundaries_table_}, this);
  section_bar_ = new SectionBar(this);
  section_ = new SectionPresenter(session_, view_, section_bar_, this);
  comparison_ = new ComparisonPresenter(session_, view_, side_by_side_, fields_, elements_, this);
  view_presenter_ = new ViewPresenter(session_, view_, elements_, this);
  treatment_bar_ = new TreatmentBar(this);
  treatments_ = new TreatmentsPresenter(session_, view_, elements_, treatment_bar_, this);
  const auto tell = [this](const QString& text) { statusBar()->showMessage(text, 10000); };
  connect(section_, &SectionPresenter::message, this, tell);
  connect(view_presenter_, &ViewPresenter::message, this, tell);
  thresholds_ = new ThresholdPresenter(session_, fields_, histogram_, this);
  steps_ = new StepsPresenter(session_, steps_panel_, this);
  make_guidance();
  make_status_bar();
  make_actions();
  tour_ = new TourPresenter(session_, fields_, histogram_, view_, this);

  connect(start_page_, &StartPage::open_wanted, this, &MainWindow::choose_file);
  connect(start_page_, &StartPage::sample_wanted, this, &MainWindow::open_sample);
  connect(start_page_, &StartPage::recent_wanted, this, &MainWindow::open);
  connect(start_page_, &StartPage::tour_wanted, tour_, &TourPresenter::take_on_sample);
  connect(tour_, &TourPresenter::sample_wanted, this, &MainWindow::open_sample);
  connect(tour_, &TourPresenter::field_wanted, this, &MainWindow::set_field);
  for (const TourStep& step : TourPresenter::steps()) start_page_->add_step(step.title, step.gist);
  connect(history_panel_, &HistoryPanel::travel, session_, &Session::travel);
  connect(history_panel_, &HistoryPanel::name_wanted, comparison_, &ComparisonPresenter::ask_name);
  connect(history_panel_, &HistoryPanel::compare_wanted, comparison_,
          &ComparisonPresenter::compare_with);
  connect(session_, &Session::names_changed, this, &MainWindow::refresh_history);
  connect(session_, &Session::changed, this, [this] {
    refresh_counts();
    if (!session_->is_previewing()) {
      refresh_history();
      refresh_actions();
    }
  });
  connect(session_, &Session::opened, this, [this] {
    const Document& document = session_->current().document;
    const QString path = QString::fromStdString(document.scan_path);
    setWindowTitle(QFileInfo(path).fileName() + " – Arris");
    // An open scan is shown from the side it was scanned from, a closed part from a corner.
    const Point side = mean_normal(*document.mesh);
    constexpr double open_scan = 0.15;
    if (side.norm() > open_scan)
      view_->look_against(side);
    else
      view_->look_from(MeshView::StandardView::isometric);
    show_partitions(false);
    view_->setFocus();
    remember_recent(path);
    if (!document.scan->report.clean())
      statusBar()->showMessage(
          tr("The scan was mended where a mesh cannot hold it: see Part ▸ Load report."), 10000);
  });
  connect(session_, &Session::done, this, [this](const QString& operation) {
    if (operation != "find_partitions") return;
    show_partitions(true);
    if (view_->is_fitted()) view_->fit();  // the legend is there now
  });
  connect(session_, &Session::failed, this, [this](const QString& message) {
    QMessageBox box(QMessageBox::Warning, "Arris", message, QMessageBox::Ok, this);
    box.exec();
  });
  connect(session_, &Session::busy_changed, this, [this] {
    show_working();
    refresh_actions();
  });
  connect(fields_, &FieldPresenter::working_changed, this, &MainWindow::show_working);
  const auto show_progress = [this](double fraction, const QString& what) {
    progress_->setValue(static_cast<int>(100.0 * fraction));
    progress_->setFormat(what + " %p %");
  };
  connect(session_, &Session::progress, this, show_progress);
  connect(fields_, &FieldPresenter::progress, this, show_progress);
  // A selection made in the view brings its table to the front.
  connect(elements_, &ElementsPresenter::selection_changed, this, [this] {
    const char* name = !elements_->selected_lines().empty()        ? "lines"
                       : !elements_->selected_partitions().empty() ? "partitions"
                       : !elements_->selected_boundaries().empty() ? "boundaries"
                                                                   : nullptr;
    if (name) findChild<QDockWidget*>(name)->raise();
  });
  connect(elements_, &ElementsPresenter::visibility_changed, this, &MainWindow::refresh_counts);
  connect(view_, &MeshView::hovered, this, [this](const std::optional<Pick>& pick) {
    show_hover(session_->shown().document, pick);
  });
  connect(comparison_, &ComparisonPresenter::hovered, this, &MainWindow::show_hover);
  connect(view_, &MeshView::context_menu_wanted, this, &MainWindow::context_menu);
  for (ElementTable* table : {lines_table_, partitions_table_, boundaries_table_})
    connect(table, &ElementTable::context_menu_wanted, this, &MainWindow::table_menu);
  connect(fields_, &FieldPresenter::changed, this, [this] {
    for (QAction* a : field_actions_->actions())
      a->setChecked(a->data().toInt() == static_cast<int>(fields_->field()));
  });

  const QSettings settings;
  restoreGeometry(settings.value("window/geometry").toByteArray());
  restoreState(settings.value("window/state").toByteArray());
  treatment_bar_->hide();  // even where the window was closed during a treatment
  findChild<QToolBar*>("tools")->show();
  section_bar_->hide();
  refresh_recent();
  refresh_actions();
  refresh_counts();
}

MainWindow::~MainWindow() = default;

QDockWidget* MainWindow::add_dock(const QString& name, const QString& title, QWidget* content,
                                  Qt::DockWidgetArea area) {
  auto* dock = new QDockWidget(title, this);
  dock->setObjectName(name);
  dock->setWidget(content);
  addDockWidget(area, dock);
  return dock;
}

void MainWindow::make_docks() {
  setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
  setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
  steps_panel_ = new StepsPanel(this);
  colour_map_ = new ColourMapPanel(this);
  lines_table_ = ElementsPresenter::make_lines_table(this);
  partitions_table_ = ElementsPresenter::make_partitions_table(this);
  boundaries_table_ = ElementsPresenter::make_boundaries_table(this);
  history_panel_ = new HistoryPanel(this);
  histogram_ = new HistogramPanel(this);

  add_dock("steps", tr("Steps"), steps_panel_, Qt::LeftDockWidgetArea);
  // Tables above, colours and history below; tabs only after the split.
  QDockWidget* lines = add_dock("lines", tr("Lines"), lines_table_, Qt::RightDockWidgetArea);
  QDockWidget* colours =
      add_dock("colour_map", tr("Colour map"), colour_map_, Qt::RightDockWidgetArea);
  QDockWidget* partitions =
      add_dock("partitions", tr("Partitions"), partitions_table_, Qt::RightDockWidgetArea);
  QDockWidget* boundaries =
      add_dock("boundaries", tr("Boundaries"), boundaries_table_, Qt::RightDockWidgetArea);
  QDockWidget* history =
      add_dock("history", tr("History"), history_panel_, Qt::RightDockWidgetArea);
  tabifyDockWidget(lines, partitions);
  tabifyDockWidget(partitions, boundaries);
  tabifyDockWidget(colours, history);
  lines->raise();
  colours->raise();
  setTabPosition(Qt::RightDockWidgetArea, QTabWidget::North);
  QDockWidget* histogram =
      add_dock("histogram", tr("Histogram and thresholds"), histogram_, Qt::BottomDockWidgetArea);
  resizeDocks({findChild<QDockWidget*>("steps"), lines}, {290, 370}, Qt::Horizontal);
  resizeDocks({histogram}, {190}, Qt::Vertical);
}

void MainWindow::make_guidance() {
  auto* worklist = new WorklistPanel(this);
  auto* explanation = new ExplanationPanel(this);
  auto* corrections = new CorrectionsPanel(this);
  QDockWidget* worklist_dock =
      add_dock("worklist", tr("Worklist"), worklist, Qt::LeftDockWidgetArea);
  QDockWidget* explanation_dock =
      add_dock("explanation", tr("Explain"), explanation, Qt::RightDockWidgetArea);
  QDockWidget* corrections_dock =
      add_dock("corrections", tr("Corrections"), corrections, Qt::RightDockWidgetArea);
  auto* steps = findChild<QDockWidget*>("steps");
  auto* colours = findChild<QDockWidget*>("colour_map");
  tabifyDockWidget(steps, worklist_dock);
  tabifyDockWidget(findChild<QDockWidget*>("history"), explanation_dock);
  tabifyDockWidget(explanation_dock, corrections_dock);
  setTabPosition(Qt::LeftDockWidgetArea, QTabWidget::North);
  steps->raise();
  colours->raise();
  const auto bring_up = [](QDockWidget* dock) {
    dock->show();
    dock->raise();
  };

  worklist_ = new WorklistPresenter(session_, view_, elements_, worklist, this);
  connect(worklist_dock, &QDockWidget::visibilityChanged, worklist_, &WorklistPresenter::set_shown);
  connect(worklist_, &WorklistPresenter::wanted, worklist_dock,
          [bring_up, worklist_dock] { bring_up(worklist_dock); });
  explanations_ = new ExplanationPresenter(session_, view_, explanation, this);
  connect(explanation_dock, &QDockWidget::visibilityChanged, explanations_,
          &ExplanationPresenter::set_shown);
  connect(explanations_, &ExplanationPresenter::wanted, explanation_dock,
          [bring_up, explanation_dock] { bring_up(explanation_dock); });
  corrections_ = new CorrectionsPresenter(session_, view_, elements_, corrections, this);
  connect(corrections_dock, &QDockWidget::visibilityChanged, corrections_,
          &CorrectionsPresenter::set_shown);
  connect(corrections_, &CorrectionsPresenter::title_changed, corrections_dock,
          &QDockWidget::setWindowTitle);
  stability_ = new StabilityPresenter(session_, fields_, histogram_, this);
}

void MainWindow::make_status_bar() {
  hover_label_ = new QLabel(this);
  counts_label_ = new QLabel(this);
  progress_ = new QProgressBar(this);
  // Not the bar that runs to and fro: where the processor draws, its every step costs the work
  // that it stands for.
  progress_->setRange(0, 100);
  progress_->setFixedWidth(240);
  progress_->hide();
  cancel_ = new QPushButton(tr("Cancel"), this);
  cancel_->setToolTip(tr("Stops the running work; nothing of it is kept."));
  cancel_->hide();
  statusBar()->addWidget(hover_label_, 1);
  statusBar()->addPermanentWidget(progress_);
  statusBar()->addPermanentWidget(cancel_);
  statusBar()->addPermanentWidget(counts_label_);
  connect(cancel_, &QPushButton::clicked, session_, &Session::cancel);
  progress_delay_ = new QTimer(this);
  progress_delay_->setSingleShot(true);
  connect(progress_delay_, &QTimer::timeout, this, [this] {
    progress_->show();
    cancel_->setVisible(session_->busy());  // a field stops where another one is chosen
  });
}

void MainWindow::show_working() {
  if (!session_->busy() && !fields_->working()) {
    progress_delay_->stop();
    progress_->hide();
    cancel_->hide();
  } else if (progress_->isHidden() && !progress_delay_->isActive()) {
    progress_->setValue(0);
    progress_->setFormat(QString());
    progress_delay_->start(progress_delay);
  } else if (!progress_->isHidden()) {
    cancel_->setVisible(session_->busy());
  }
}

void MainWindow::make_actions() {
  QMenu* file = menuBar()->addMenu(tr("&File"));
  connect(
      action(file, tr("&Open scan…"), QKeySequence::Open, tr("Open an STL, PLY, OBJ or OFF file")),
      &QAction::triggered, this, &MainWindow::choose_file);
  connect(action(file, tr("Open the sample &mould"), QKeySequence("Ctrl+Shift+O"),
                 tr("Open the mould part that Arris makes itself")),
          &QAction::triggered, this, &MainWindow::open_sample);
  recent_menu_ = file->addMenu(tr("Open &recent"));
  save_session_ = action(file, tr("&Save session…"), QKeySequence::Save,
                         tr("Save the operations of this session; open them again to go on"));
  connect(save_session_, &QAction::triggered, this, &MainWindow::choose_session);
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
    QApplication::clipboard()->setImage(picture(options));
  });
  export_ = action(file, tr("&Export results…"), QKeySequence("Ctrl+E"),
                   tr("Write lines, boundaries, labelled scan and operations into a folder"));
  connect(export_, &QAction::triggered, this, &MainWindow::choose_results_folder);
  file->addSeparator();
  connect(action(file, tr("&Quit"), QKeySequence::Quit, tr("Close Arris")), &QAction::triggered,
          this, &QWidget::close);

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
  report_ = action(part, tr("Load r&eport…"), {}, tr("What the file held and what was mended"));
  connect(report_, &QAction::triggered, this, &MainWindow::show_load_report);

  treatments_->add_line_actions(menuBar()->addMenu(tr("Li&nes")));
  treatments_->add_partition_actions(menuBar()->addMenu(tr("Part&itions")));

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

  QMenu* field_menu = look->addMenu(tr("&Field"));
  field_actions_ = new QActionGroup(this);
  for (const FieldInfo& info : field_table()) {
    QAction* a = action(field_menu, title_of(info.field),
                        QKeySequence(QString("Alt+%1").arg(QLatin1Char(info.key))),
                        QString::fromUtf8(info.meaning.data(), qsizetype(info.meaning.size())));
    a->setCheckable(true);
    a->setData(static_cast<int>(info.field));
    a->setChecked(info.field == fields_->field());
    field_actions_->addAction(a);
    connect(a, &QAction::triggered, this, [this, field = info.field] { set_field(field); });
  }
  view_presenter_->add_surface_actions(look->addMenu(tr("S&urface")));
  section_->add_actions(look->addMenu(tr("Se&ction")));
  look->addSeparator();
  view_presenter_->add_visibility_actions(look);
  look->addSeparator();
  struct Toggle {
    QString text, shortcut, tooltip;
    bool on;
    void (MeshView::*set)(bool);
  };
  for (const Toggle& t :
       {Toggle{tr("&Lines"), "L", tr("Show lines and boundaries"), true,
               &MeshView::set_lines_visible},
        Toggle{tr("Mesh &edges"), "E", tr("Show the edges of the mesh"), false,
               &MeshView::set_edges_visible},
        Toggle{tr("Flat s&hading"), "Shift+N",
               tr("Shade each face by itself, as it is, instead of smooth between "
                  "sharp edges"),
               false, &MeshView::set_flat_shading},
        Toggle{tr("Li&ght on field colours"), "Shift+L",
               tr("Shade the colours of a field as the surface is lit; without "
                  "light they are exactly those of the scalar bar"),
               false, &MeshView::set_fields_lit},
        Toggle{tr("&Scalar bar"), "B", tr("Show the scalar bar"), true,
               &MeshView::set_scalar_bar_visible}}) {
    QAction* a = action(look, t.text, QKeySequence(t.shortcut), t.tooltip);
    a->setCheckable(true);
    a->setChecked(t.on);
    connect(a, &QAction::toggled, view_, t.set);
  }
  QAction* tangent = action(look, tr("Tan&gent lines"), QKeySequence("Ctrl+T"),
                            tr("Set off the Gn boundaries along which two surfaces touch, as at "
                               "both rims of a fillet"));
  tangent->setCheckable(true);
  connect(tangent, &QAction::toggled, elements_, &ElementsPresenter::set_tangent_lines_shown);
  QAction* dark = action(look, tr("&Dark"), QKeySequence("Ctrl+D"), tr("Light or dark window"));
  dark->setCheckable(true);
  connect(dark, &QAction::toggled, this, [this](bool on) {
    set_theme(*qApp, on);
    view_->set_dark(on);
    QSettings().setValue("window/dark", on);
  });
  dark->setChecked(QSettings().value("window/dark", false).toBool());
  look->addSeparator();
  QAction* fit = action(look, tr("&Fit"), QKeySequence("F"), tr("The whole part in the view"));
  connect(fit, &QAction::triggered, view_, &MeshView::fit);
  QAction* zoom = action(look, tr("&Zoom to selection"), QKeySequence("Z"),
                         tr("The selected lines and partitions in the view"));
  connect(zoom, &QAction::triggered, elements_, &ElementsPresenter::zoom_to_selection);
  QMenu* standard = look->addMenu(tr("S&tandard views"));
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
  look->addSeparator();
  panels_menu_ = look->addMenu(tr("Pa&nels"));
  for (QDockWidget* dock : findChildren<QDockWidget*>())
    panels_menu_->addAction(dock->toggleViewAction());

  view_presenter_->add_tool_actions(menuBar()->addMenu(tr("&Tools")));
  QMenu* check = menuBar()->addMenu(tr("Chec&k"));
  worklist_->add_actions(check);
  check->addSeparator();
  explanations_->add_actions(check);
  stability_->add_actions(check);

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
  connect(action(help, tr("&About Arris"), {}, tr("What Arris is")), &QAction::triggered, this,
          &MainWindow::show_about);

  for (QAction* a : {save_session_, save_picture_, copy_picture_, export_, report_, show_field_,
                     show_partitions_, fit, zoom})
    part_actions_.push_back(a);
  for (QMenu* menu : findChildren<QMenu*>()) menu->setToolTipsVisible(true);

  QToolBar* bar = addToolBar(tr("Tools"));
  bar->setObjectName("tools");
  bar->setMovable(false);
  bar->addActions({undo_, redo_});
  bar->addSeparator();
  bar->addActions({show_field_, show_partitions_});
  bar->addSeparator();
  bar->addActions({run_all_, fit, save_picture_});
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

void MainWindow::open(const QString& path) {
  if (may_leave_session()) session_->open(path);
}

bool MainWindow::may_leave_session() {
  if (!session_->has_unsaved_edits()) return true;
  QMessageBox box(QMessageBox::Question, "Arris", tr("Save the edits of this session?"),
                  QMessageBox::NoButton, this);
  box.setInformativeText(
      tr("A saved session opens again with its whole history. Discarded edits are lost."));
  QPushButton* save = box.addButton(tr("Save session…"), QMessageBox::AcceptRole);
  QPushButton* discard = box.addButton(tr("Discard"), QMessageBox::DestructiveRole);
  box.addButton(QMessageBox::Cancel);
  box.setDefaultButton(save);
  box.exec();
  if (box.clickedButton() == discard) return true;
  if (box.clickedButton() != save) return false;
  choose_session();
  return !session_->has_unsaved_edits();
}

void MainWindow::choose_session() {
  QSettings settings;
  const QString name =
      QFileInfo(QString::fromStdString(session_->current().document.scan_path)).completeBaseName() +
      ".jsonl";
  QString path = QFileDialog::getSaveFileName(
      this, tr("Save session"), QDir(settings.value("folders/sessions").toString()).filePath(name),
      tr("Arris session (*.jsonl)"));
  if (path.isEmpty()) return;
  if (QFileInfo(path).suffix().isEmpty()) path += ".jsonl";
  settings.setValue("folders/sessions", QFileInfo(path).absolutePath());
  const Result<void> written =
      write_file_whole(path.toStdString(), journal_text(session_->history()));
  if (!written) {
    QMessageBox::warning(this, "Arris", QString::fromStdString(written.error().message));
    return;
  }
  session_->mark_saved();
  statusBar()->showMessage(tr("Saved %1").arg(path), 5000);
}

void MainWindow::offer_recovery() {
  for (const QString& journal : Session::abandoned_journals()) {
    QMessageBox box(
        QMessageBox::Question, "Arris",
        tr("A session of %1 was not closed.")
            .arg(QLocale::c().toString(QFileInfo(journal).lastModified(), "yyyy-MM-dd hh:mm")),
        QMessageBox::NoButton, this);
    box.setInformativeText(tr("It is complete up to its last edit. Go on with it?"));
    QPushButton* go_on = box.addButton(tr("Go on"), QMessageBox::AcceptRole);
    QPushButton* discard = box.addButton(tr("Discard it"), QMessageBox::DestructiveRole);
    box.addButton(tr("Later"), QMessageBox::RejectRole);
    box.setDefaultButton(go_on);
    box.exec();
    if (box.clickedButton() == discard) {
      Session::discard_journal(journal);
    } else if (box.clickedButton() == go_on) {
      session_->recover(journal);
      return;
    }
  }
}

void MainWindow::open_sample() {
  if (!may_leave_session()) return;
  const QString folder = QStandardPaths::writableLocation(QStandardPaths::AppDataLocation);
  QDir().mkpath(folder);
  const QString path = folder + "/sample_mould.ply";
  session_->open_made(path, [file = path.toStdString()]() -> Result<void> {
    SampleMould mould = make_mould();
    const Result<MeshPtr> mesh = Mesh::create(std::move(mould.points), std::move(mould.triangles));
    if (!mesh) return tl::unexpected<Error>(mesh.error());
    return write_ply(file, **mesh, {});
  });
}

void MainWindow::set_field(Field field) {
  show_field_->setChecked(true);
  fields_->set_field(field);
}

void MainWindow::show_partitions(bool shown) {
  (shown ? show_partitions_ : show_field_)->setChecked(true);
}

void MainWindow::choose_file() {
  QSettings settings;
  const QString path = QFileDialog::getOpenFileName(
      this, tr("Open scan"), settings.value("folders/open").toString(),
      tr("Scans and sessions (*.stl *.ply *.obj *.off *.3mf *.gz *.jsonl);;All files (*)"));
  if (path.isEmpty()) return;
  settings.setValue("folders/open", QFileInfo(path).absolutePath());
  open(path);
}

bool MainWindow::save_picture(const QString& path, const PictureOptions& options, QString* error) {
  const QImage image = picture(options);
  QString message;
  if (image.isNull())
    message =
        tr("The picture could not be drawn at %1 × %2 pixels: the graphics driver refused it. "
           "Choose a smaller size.")
            .arg(options.size.width())
            .arg(options.size.height());
  else if (!image.save(path))
    message = tr("%1 could not be written. Is the folder there, and does the name end in .png or "
                 ".jpg?")
                  .arg(path);
  if (error) *error = message;
  return message.isEmpty();
}

QImage MainWindow::picture(const PictureOptions& options) {
  return comparison_->active() ? comparison_->picture(options) : view_->picture(options);
}

void MainWindow::choose_picture() {
  picture_options_.scalar_bar = true;
  PictureDialog dialog(picture_options_, stack_->size(), this);
  if (dialog.exec() != QDialog::Accepted) return;
  picture_options_ = dialog.options();
  QSettings settings;
  const QString name =
      QFileInfo(QString::fromStdString(session_->current().document.scan_path)).completeBaseName() +
      ".png";
  QString path = QFileDialog::getSaveFileName(
      this, tr("Save picture"), QDir(settings.value("folders/pictures").toString()).filePath(name),
      tr("PNG (*.png);;JPEG (*.jpg)"));
  if (path.isEmpty()) return;
  if (QFileInfo(path).suffix().isEmpty()) path += ".png";
  settings.setValue("folders/pictures", QFileInfo(path).absolutePath());
  QString error;
  if (save_picture(path, picture_options_, &error))
    statusBar()->showMessage(tr("Saved %1").arg(path), 5000);
  else
    QMessageBox::warning(this, "Arris", error);
}

void MainWindow::choose_results_folder() {
  QSettings settings;
  const QString folder = QFileDialog::getExistingDirectory(
      this, tr("Folder for lines, boundaries, labelled scan and operations"),
      settings.value("folders/results").toString());
  if (folder.isEmpty()) return;
  settings.setValue("folders/results", folder);
  const Document& document = session_->current().document;
  const auto path = [&](const char* name) { return QDir(folder).filePath(name).toStdString(); };
  Result<void> written = write_file_whole(path("lines.obj"), lines_obj(document));
  if (written) written = write_file_whole(path("boundaries.obj"), boundaries_obj(document));
  if (written)
    written =
        write_labelled_scan(path("scan_partitions.ply"), *document.scan, labels_on_scan(document));
  if (written)
    written = write_file_whole(path("operations.jsonl"), journal_text(session_->history()));
  if (written) session_->mark_saved();
  if (written)
    statusBar()->showMessage(
        tr("lines.obj, boundaries.obj, scan_partitions.ply and operations.jsonl written to %1")
            .arg(folder),
        8000);
  else
    QMessageBox::warning(this, "Arris", QString::fromStdString(written.error().message));
}

void MainWindow::show_load_report() {
  const LoadReport& report = session_->current().document.scan->report;
  QString text =
      tr("%1: %2 with %3 and %4.")
          .arg(QFileInfo(QString::fromStdString(report.file)).fileName(),
               QString::fromStdString(report.format), counted(report.file_faces, tr("faces")),
               counted(report.file_vertices, tr("vertices")));
  text += "\n" + tr("The mesh has %1, %2, has %3 and Euler number %4.")
                     .arg(counted(report.faces, tr("triangles")),
                          report.components == 1
                              ? tr("hangs together in one piece")
                              : tr("falls into %1 loose pieces")
                                    .arg(count_text(static_cast<qint64>(report.components))),
                          counted(report.border_edges, tr("border edges")))
                     .arg(report.euler_number);
  QMessageBox box(QMessageBox::Information, tr("Load report"), text, QMessageBox::Ok, this);
  QString details;
  for (const std::string& sentence : report.sentences())
    details += "• " + QString::fromStdString(sentence) + "\n";
  box.setInformativeText(details.isEmpty() ? tr("Nothing had to be mended.") : details.trimmed());
  box.exec();
}

void MainWindow::show_about() {
  QMessageBox::about(this, tr("About Arris"),
                     tr("<h3>Arris %1</h3><p>Segments scanned moulds: sharp lines, curvature and "
                        "partitions, after "
                        "Lesage, Léon and Véron, “Discrete curvature approximations and "
                        "segmentation of polyhedral "
                        "surfaces”.</p><p>BSD 3-Clause licence.</p>")
                         .arg(QApplication::applicationVersion()));
}

void MainWindow::remember_recent(const QString& path) {
  QSettings settings;
  QStringList recent = settings.value("recent").toStringList();
  const QString absolute = QFileInfo(path).absoluteFilePath();
  recent.removeAll(absolute);
  recent.prepend(absolute);
  while (recent.size() > most_recent) recent.removeLast();
  settings.setValue("recent", recent);
  refresh_recent();
}

void MainWindow::refresh_recent() {
  const QStringList recent = QSettings().value("recent").toStringList();
  start_page_->set_recent(recent);
  recent_menu_->clear();
  recent_menu_->setEnabled(!recent.isEmpty());
  for (const QString& path : recent)
    connect(recent_menu_->addAction(QFileInfo(path).fileName()), &QAction::triggered, this,
            [this, path] { open(path); });
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

void MainWindow::refresh_history() {
  std::vector<HistoryRow> rows;
  const History& history = session_->history();
  const auto row_of = [&](std::uint32_t sequence) {
    const Operation& operation = history.entries()[sequence - 1].operation;
    HistoryRow row;
    row.sequence = sequence;
    row.text = QString::fromStdString(describe(operation));
    row.tooltip = QString::fromStdString(operation.to_json().dump(1));
    return row;
  };
  bool undone = false;
  for (const std::uint32_t sequence : history.line_of_travel()) {
    HistoryRow row = row_of(sequence);
    row.current = sequence == history.head();
    row.undone = undone;
    undone = undone || row.current;
    rows.push_back(row);
  }
  for (const auto& [sequence, name] : history.names()) {
    auto row = std::ranges::find(rows, sequence, &HistoryRow::sequence);
    if (row == rows.end()) {
      row = rows.insert(rows.end(), row_of(sequence));
      row->elsewhere = true;
    }
    row->name = QString::fromStdString(name);
  }
  history_panel_->set_rows(rows);
}

void MainWindow::refresh_counts() {
  const Document& document = session_->shown().document;
  if (document.empty()) {
    counts_label_->setText({});
    return;
  }
  QString text = counted(document.mesh->face_count(), tr("faces"));
  if (document.find_sharp_lines)
    text += "  ·  " + counted(document.lines.lines.size(), tr("lines"));
  if (document.find_partitions)
    text += "  ·  " + counted(document.partitions.partitions.size(), tr("partitions")) +
            (document.find_partitions->out_of_date ? tr(" (out of date)") : QString());
  if (elements_->hides_any()) text += "  ·  " + tr("some hidden (Shift+H shows all)");
  counts_label_->setText(text);
}

void MainWindow::show_hover(const Document& document, const std::optional<Pick>& pick) {
  hover_label_->setText(pick ? hover_text(document, *pick) : QString());
}

void MainWindow::context_menu(const QPoint& global, const std::optional<Pick>& pick) {
  if (session_->current().document.empty()) return;
  elements_->select_at(pick);
  QMenu menu(this);
  menu.addActions({show_field_, show_partitions_});
  menu.addSeparator();
  for (QAction* a : part_actions_)
    if (a->shortcut() == QKeySequence("F") || a->shortcut() == QKeySequence("Z")) menu.addAction(a);
  menu.addSeparator();
  menu.addActions(view_presenter_->visibility_actions());
  menu.addSeparator();
  if (!elements_->selected_lines().empty()) menu.addActions(treatments_->available_line_actions());
  if (!elements_->selected_partitions().empty())
    menu.addActions(treatments_->available_partition_actions());
  if (pick && (pick->edge != no_id || pick->face != no_id))
    connect(menu.addAction(tr("E&xplain")), &QAction::triggered, this,
            [this, pick] { explanations_->explain(*pick); });
  menu.addSeparator();
  menu.addActions({copy_picture_, save_picture_});
  menu.exec(global);
}

void MainWindow::table_menu(const QPoint& global) {
  QMenu menu(this);
  for (QAction* a : part_actions_)
    if (a->shortcut() == QKeySequence("Z")) menu.addAction(a);
  menu.addSeparator();
  menu.addActions(view_presenter_->visibility_actions());
  menu.addSeparator();
  if (!elements_->selected_lines().empty()) menu.addActions(treatments_->available_line_actions());
  if (!elements_->selected_partitions().empty())
    menu.addActions(treatments_->available_partition_actions());
  menu.exec(global);
}

bool MainWindow::focusNextPrevChild(bool next) {
  QWidget* to = beside_in_tab_order(*this, focusWidget(), next);
  if (!to) return QMainWindow::focusNextPrevChild(next);
  to->setFocus(next ? Qt::TabFocusReason : Qt::BacktabFocusReason);
  focus_ring_->show_round(to);
  return true;
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls() && event->mimeData()->urls().first().isLocalFile())
    event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  event->acceptProposedAction();
  open(event->mimeData()->urls().first().toLocalFile());
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!may_leave_session()) {
    event->ignore();
    return;
  }
  QSettings settings;
  settings.setValue("window/geometry", saveGeometry());
  settings.setValue("window/state", saveState());
  session_->cancel();
  session_->close();
  event->accept();
}

}  // namespace arris::ui
