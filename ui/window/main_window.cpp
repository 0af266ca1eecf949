#include "ui/window/main_window.h"

#include <algorithm>

#include <QAbstractEventDispatcher>
#include <QAction>
#include <QActionGroup>
#include <QApplication>
#include <QCloseEvent>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QGuiApplication>
#include <QLabel>
#include <QMessageBox>
#include <QMimeData>
#include <QProgressBar>
#include <QPushButton>
#include <QScreen>
#include <QSettings>
#include <QStackedWidget>
#include <QStatusBar>
#include <QTimer>
#include <QToolBar>

#include "core/base/vector_state.h"
#include "ui/panels/controls.h"
#include "ui/panels/history_panel.h"
#include "ui/panels/section_bar.h"
#include "ui/panels/start_page.h"
#include "ui/panels/unit_bar.h"
#include "ui/window/about_dialog.h"
#include "ui/window/hover_text.h"
#include "ui/window/latest_work.h"
#include "ui/window/named_views_presenter.h"
#include "ui/window/report_presenter.h"
#include "ui/window/tab_order.h"

namespace arris::ui {

namespace {

constexpr int progress_delay = 300;  // ms: shorter work shows no progress
constexpr int view_rest = 2000;      // ms without a change until a view is kept

}  // namespace

MainWindow::MainWindow(QWidget* parent) : QMainWindow(parent) {
  setWindowTitle("Arris[*]");
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
  auto* unit_bar = new UnitBar(side_by_side_);
  side_by_side_->set_strip(unit_bar);
  units_ = new UnitPresenter(session_, unit_bar, this);
  make_guidance();
  export_work_ = new LatestWork(this);
  named_views_ = new NamedViewsPresenter([this] { return view_keepers(); }, this);
  reports_ = new ReportPresenter(
      session_, [this] { return view_keepers(); }, [this](bool shown) { show_partitions(shown); },
      named_views_, this);
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
      refresh_title();
    }
  });
  connect(session_, &Session::opened, this, &MainWindow::take_opened);
  // Once the session is no longer busy: the answer opens it again.
  connect(session_, &Session::scan_lost, this, &MainWindow::ask_for_scan, Qt::QueuedConnection);
  connect(session_, &Session::saved, this, &MainWindow::refresh_title);
  connect(session_, &Session::names_changed, this, &MainWindow::refresh_title);
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
  connect(reports_, &ReportPresenter::writing_changed, this, [this] {
    show_working();
    refresh_actions();
  });
  connect(reports_, &ReportPresenter::progress, this, show_progress);
  connect(reports_, &ReportPresenter::message, this,
          [this](const QString& text) { statusBar()->showMessage(text, 8000); });
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

  // The view of after a crash is the last one that rested for a moment.
  view_rest_ = new QTimer(this);
  view_rest_->setSingleShot(true);
  connect(view_rest_, &QTimer::timeout, this, [this] {
    if (!session_->current().document.empty()) session_->keep_view(views_to_keep());
  });
  const auto view_changed = [this] { view_rest_->start(view_rest); };
  connect(view_, &MeshView::look_changed, this, view_changed);
  connect(fields_, &FieldPresenter::changed, this, view_changed);
  connect(elements_, &ElementsPresenter::visibility_changed, this, view_changed);
  connect(elements_, &ElementsPresenter::partitions_shown_changed, this, view_changed);
  for (QAction* toggle : toggles_) connect(toggle, &QAction::toggled, this, view_changed);
  connect(named_views_, &NamedViewsPresenter::edited, this, [this] {
    session_->keep_view(views_to_keep());
    session_->edit_extras();
  });
  connect(named_views_, &NamedViewsPresenter::message, this,
          [this](const QString& text) { statusBar()->showMessage(text, 4000); });

  first_layout_ = saveState();
  const QSettings settings;
  restoreGeometry(settings.value("window/geometry").toByteArray());
  restoreState(settings.value("window/state").toByteArray());
  fit_screen();
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
  connect(cancel_, &QPushButton::clicked, this, [this] {
    if (session_->busy())
      session_->cancel();
    else
      reports_->cancel();
  });
  progress_delay_ = new QTimer(this);
  progress_delay_->setSingleShot(true);
  connect(progress_delay_, &QTimer::timeout, this, [this] {
    progress_->show();
    // A field stops where another one is chosen.
    cancel_->setVisible(session_->busy() || reports_->writing());
  });
}

void MainWindow::fit_screen() {
  const QScreen* on = QGuiApplication::screenAt(geometry().center());
  if (!on) on = QGuiApplication::primaryScreen();
  if (!on) return;
  // With the frame, of which nothing is known before the window was shown.
  constexpr int frame = 32;
  const QRect room = on->availableGeometry();
  resize(size().boundedTo(room.size() - QSize(0, frame)));
  const QRect here(pos(), size());
  if (!room.contains(here))
    move(std::clamp(here.left(), room.left(), std::max(room.left(), room.right() - width() + 1)),
         std::clamp(here.top(), room.top(),
                    std::max(room.top(), room.bottom() - height() - frame + 1)));
}

void MainWindow::reset_layout() {
  // Bars that come and go by themselves stay as they are.
  const bool treatment = treatment_bar_->isVisible(), section = section_bar_->isVisible();
  restoreState(first_layout_);
  treatment_bar_->setVisible(treatment);
  section_bar_->setVisible(section);
  fit_screen();
}

void MainWindow::show_working() {
  if (!session_->busy() && !fields_->working() && !reports_->writing()) {
    progress_delay_->stop();
    progress_->hide();
    cancel_->hide();
  } else if (progress_->isHidden() && !progress_delay_->isActive()) {
    progress_->setValue(0);
    progress_->setFormat(QString());
    progress_delay_->start(progress_delay);
  } else if (!progress_->isHidden()) {
    cancel_->setVisible(session_->busy() || reports_->writing());
  }
}

void MainWindow::set_field(Field field) {
  show_field_->setChecked(true);
  fields_->set_field(field);
}

void MainWindow::show_partitions(bool shown) {
  (shown ? show_partitions_ : show_field_)->setChecked(true);
}

bool MainWindow::exporting() const { return export_work_->running(); }

void MainWindow::show_about() { AboutDialog(*session_, this).exec(); }

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
  QString text = shown_count(document.mesh->face_count(), tr("face"), tr("faces"));
  if (document.step("find_sharp_lines"))
    text += "  ·  " + shown_count(document.lines.lines.size(), tr("line"), tr("lines"));
  if (document.step("find_partitions"))
    text += "  ·  " +
            shown_count(document.partitions.partitions.size(), tr("partition"), tr("partitions")) +
            (document.step("find_partitions")->out_of_date ? tr(" (out of date)") : QString());
  if (elements_->hides_any()) text += "  ·  " + tr("some hidden (Shift+H shows all)");
  counts_label_->setText(text);
}

void MainWindow::show_hover(const Document& document, const std::optional<Pick>& pick) {
  hover_label_->setText(pick ? hover_text(document, *pick) : QString());
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
  export_work_->wait();
  session_->wait_until_saved();
  QSettings settings;
  settings.setValue("window/geometry", saveGeometry());
  settings.setValue("window/state", saveState());
  session_->cancel();
  session_->close();
  event->accept();
}

}  // namespace arris::ui
