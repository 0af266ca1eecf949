#include "ui/window/main_window.h"

#include <algorithm>
#include <numeric>

#include <QAbstractEventDispatcher>
#include <QCloseEvent>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QGuiApplication>
#include <QMessageBox>
#include <QMimeData>
#include <QScreen>
#include <QSettings>
#include <QStackedWidget>
#include <QStatusBar>
#include <QTabBar>
#include <QToolBar>

#include "core/base/vector_state.h"
#include "ui/panels/section_bar.h"
#include "ui/panels/start_page.h"
#include "ui/panels/unit_bar.h"
#include "ui/view/space_mouse.h"
#include "ui/window/comparison_presenter.h"
#include "ui/window/corrections_presenter.h"
#include "ui/window/docks.h"
#include "ui/window/elements_presenter.h"
#include "ui/window/explanation_presenter.h"
#include "ui/window/field_presenter.h"
#include "ui/window/files_presenter.h"
#include "ui/window/history_presenter.h"
#include "ui/window/main_menus.h"
#include "ui/window/named_views_presenter.h"
#include "ui/window/pictures_presenter.h"
#include "ui/window/report_presenter.h"
#include "ui/window/results_presenter.h"
#include "ui/window/section_presenter.h"
#include "ui/window/session.h"
#include "ui/window/stability_presenter.h"
#include "ui/window/status_presenter.h"
#include "ui/window/steps_presenter.h"
#include "ui/window/tab_order.h"
#include "ui/window/threshold_presenter.h"
#include "ui/window/tour_presenter.h"
#include "ui/window/treatments_presenter.h"
#include "ui/window/unit_presenter.h"
#include "ui/window/view_memory.h"
#include "ui/window/view_presenter.h"
#include "ui/window/worklist_presenter.h"

namespace arris::ui {

MainWindow::MainWindow(QWidget* parent) : QMainWindow(parent) {
  setWindowTitle("Arris[*]");
  setAcceptDrops(true);
  // Drawing in between may leave them dirty.
  connect(QAbstractEventDispatcher::instance(), &QAbstractEventDispatcher::awake, this,
          [] { clear_vector_state(); });
  setDockNestingEnabled(true);
  resize(1440, 900);
  parts_.session = new Session(this);
  make_centre();
  make_panels();
  make_keepers();
  menus_ = new MainMenus(parts_, this);
  parts_.tour =
      new TourPresenter(parts_.session, parts_.fields, parts_.histogram, parts_.view, this);
  parts_.view_memory->follow();
  follow();
  follow_start_page();
  restore_layout();
}

MainWindow::~MainWindow() = default;

void MainWindow::make_centre() {
  stack_ = new QStackedWidget(this);
  parts_.start_page = new StartPage(stack_);
  parts_.view = new MeshView(stack_);
  stack_->addWidget(parts_.start_page);
  focus_ring_ = new FocusRing(this);
  parts_.side_by_side = new SideBySide(parts_.view, marked_colour(), stack_);
  stack_->addWidget(parts_.side_by_side);
  setCentralWidget(stack_);
  parts_.section_bar = new SectionBar(this);
  parts_.treatment_bar = new TreatmentBar(this);
}

void MainWindow::make_panels() {
  Session* session = parts_.session;
  MeshView* view = parts_.view;
  setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
  setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
  auto* steps = new StepsPanel(this);
  auto* worklist = new WorklistPanel(this);
  const ElementsPresenter::Tables tables{ElementsPresenter::make_lines_table(this),
                                         ElementsPresenter::make_partitions_table(this),
                                         ElementsPresenter::make_boundaries_table(this)};
  auto* history = new HistoryPanel(this);
  auto* explanation = new ExplanationPanel(this);
  auto* corrections = new CorrectionsPanel(this);
  parts_.colour_map = new ColourMapPanel(this);
  parts_.histogram = new HistogramPanel(this);
  constexpr auto left = Qt::LeftDockWidgetArea, right = Qt::RightDockWidgetArea;
  add_docks(*this, {{"steps", tr("Steps"), steps, left},
                    {"worklist", tr("Worklist"), worklist, left, "steps"},
                    {"lines", tr("Lines"), tables.lines, right},
                    {"colour_map", tr("Colour map"), parts_.colour_map, right},
                    {"partitions", tr("Partitions"), tables.partitions, right, "lines"},
                    {"boundaries", tr("Boundaries"), tables.boundaries, right, "partitions"},
                    {"history", tr("History"), history, right, "colour_map"},
                    {"explanation", tr("Explain"), explanation, right, "history"},
                    {"corrections", tr("Corrections"), corrections, right, "explanation"},
                    {"histogram", tr("Histogram and thresholds"), parts_.histogram,
                     Qt::BottomDockWidgetArea}});
  resizeDocks({find_dock(*this, "steps"), find_dock(*this, "lines")}, {290, 370}, Qt::Horizontal);
  resizeDocks({find_dock(*this, "histogram")}, {190}, Qt::Vertical);

  parts_.fields = new FieldPresenter(view, parts_.colour_map, parts_.histogram, this);
  connect(session, &Session::mesh_changed, this, [this] {
    const Document& document = parts_.session->shown().document;
    parts_.view->set_mesh(document.mesh, false);
    stack_->setCurrentWidget(document.empty() ? static_cast<QWidget*>(parts_.start_page)
                                              : parts_.side_by_side);
  });
  connect(session, &Session::surface_changed, parts_.fields,
          [this] { parts_.fields->show(parts_.session->shown().document); });
  parts_.elements = new ElementsPresenter(session, view, tables, this);
  parts_.section = new SectionPresenter(session, view, parts_.section_bar, this);
  parts_.comparison = new ComparisonPresenter(session, view, parts_.side_by_side, parts_.fields,
                                              parts_.elements, this);
  parts_.surface = new ViewPresenter(session, view, parts_.elements, this);
  parts_.treatments =
      new TreatmentsPresenter(session, view, parts_.elements, parts_.treatment_bar, this);
  parts_.thresholds = new ThresholdPresenter(session, parts_.fields, parts_.histogram, this);
  parts_.steps = new StepsPresenter(session, steps, this);
  auto* unit_bar = new UnitBar(parts_.side_by_side);
  parts_.side_by_side->set_strip(unit_bar);
  parts_.units = new UnitPresenter(session, unit_bar, this);
  parts_.worklist = new WorklistPresenter(session, view, parts_.elements, worklist, this);
  parts_.explanations = new ExplanationPresenter(session, view, explanation, this);
  parts_.corrections = new CorrectionsPresenter(session, view, parts_.elements, corrections, this);
  parts_.stability = new StabilityPresenter(session, parts_.fields, parts_.histogram, this);
  parts_.history = new HistoryPresenter(session, history, parts_.comparison, this);
  // What is in no panel that is seen need not be worked out.
  connect(find_dock(*this, "worklist"), &QDockWidget::visibilityChanged, parts_.worklist,
          &WorklistPresenter::set_shown);
  connect(find_dock(*this, "explanation"), &QDockWidget::visibilityChanged, parts_.explanations,
          &ExplanationPresenter::set_shown);
  connect(find_dock(*this, "corrections"), &QDockWidget::visibilityChanged, parts_.corrections,
          &CorrectionsPresenter::set_shown);
}

void MainWindow::make_keepers() {
  const auto keepers = [this] { return view_keepers(); };
  const auto partitions = [this](bool shown) { show_partitions(shown); };
  parts_.named_views = new NamedViewsPresenter(keepers, this);
  parts_.pictures = new PicturesPresenter(parts_.session, keepers, parts_.comparison,
                                          parts_.named_views, stack_, this);
  parts_.reports =
      new ReportPresenter(parts_.session, keepers, partitions, parts_.named_views, this);
  parts_.results = new ResultsPresenter(parts_.session, this);
  parts_.view_memory =
      new ViewMemory(parts_.session, keepers, partitions, parts_.named_views, this);
  parts_.files = new FilesPresenter(
      parts_.session, [this] { return parts_.view_memory->extras(); }, this);
  parts_.status = new StatusPresenter(parts_.session, parts_.fields, parts_.elements,
                                      parts_.reports, statusBar());
}

ViewKeepers MainWindow::view_keepers() const {
  return {parts_.view,      parts_.fields,  parts_.elements,
          parts_.section,   parts_.surface, menus_->partitions_action(),
          menus_->toggles()};
}

void MainWindow::follow() {
  StatusPresenter* status = parts_.status;
  const auto tell_for = [status](int milliseconds) {
    return [status, milliseconds](const QString& text) { status->tell(text, milliseconds); };
  };
  connect(parts_.section, &SectionPresenter::message, status, tell_for(10000));
  connect(parts_.surface, &ViewPresenter::message, status, tell_for(10000));
  connect(parts_.reports, &ReportPresenter::message, status, tell_for(8000));
  connect(parts_.named_views, &NamedViewsPresenter::message, status, tell_for(4000));
  connect(parts_.files, &FilesPresenter::message, status, &StatusPresenter::tell);
  connect(parts_.pictures, &PicturesPresenter::message, status, &StatusPresenter::tell);
  connect(parts_.results, &ResultsPresenter::message, status, &StatusPresenter::tell);
  auto* space_mouse = new SpaceMouse(this);
  connect(space_mouse, &SpaceMouse::moved, parts_.view,
          [this](double right, double up, double towards, double about_right, double about_up,
                 double seconds) {
            if (isActiveWindow())
              parts_.view->fly(right, up, towards, about_right, about_up, seconds);
          });
  connect(space_mouse, &SpaceMouse::pressed, parts_.view, [this](int) {
    if (isActiveWindow()) parts_.view->fit();
  });
  connect(parts_.view, &MeshView::hovered, this, [this](const std::optional<Pick>& pick) {
    parts_.status->show_hover(parts_.session->shown().document, pick);
  });
  connect(parts_.comparison, &ComparisonPresenter::hovered, status, &StatusPresenter::show_hover);

  connect(parts_.session, &Session::changed, this, [this] {
    if (!parts_.session->is_previewing()) refresh_title();
  });
  connect(parts_.session, &Session::opened, this, &MainWindow::refresh_title);
  connect(parts_.session, &Session::saved, this, &MainWindow::refresh_title);
  connect(parts_.session, &Session::names_changed, this, &MainWindow::refresh_title);
  connect(parts_.session, &Session::failed, this, [this](const QString& message) {
    QMessageBox box(QMessageBox::Warning, "Arris", message, QMessageBox::Ok, this);
    box.exec();
  });

  connect(parts_.worklist, &WorklistPresenter::wanted, this,
          [this] { bring_up(*this, "worklist"); });
  connect(parts_.explanations, &ExplanationPresenter::wanted, this,
          [this] { bring_up(*this, "explanation"); });
  connect(parts_.corrections, &CorrectionsPresenter::title_changed, find_dock(*this, "corrections"),
          &QDockWidget::setWindowTitle);
  // A selection made in the view brings its table to the front.
  connect(parts_.elements, &ElementsPresenter::selection_changed, this, [this] {
    const char* name = !parts_.elements->selected_lines().empty()        ? "lines"
                       : !parts_.elements->selected_partitions().empty() ? "partitions"
                       : !parts_.elements->selected_boundaries().empty() ? "boundaries"
                                                                         : nullptr;
    if (name) find_dock(*this, name)->raise();
  });
  connect(menus_, &MainMenus::layout_reset_wanted, this, &MainWindow::reset_layout);
}

void MainWindow::follow_start_page() {
  StartPage* page = parts_.start_page;
  connect(menus_, &MainMenus::start_page_wanted, this, [this](bool shown) {
    stack_->setCurrentWidget(shown ? static_cast<QWidget*>(parts_.start_page)
                                   : parts_.side_by_side);
  });
  connect(page, &StartPage::open_wanted, parts_.files, &FilesPresenter::choose_file);
  connect(page, &StartPage::sample_wanted, parts_.files, &FilesPresenter::open_sample);
  connect(page, &StartPage::recent_wanted, parts_.files, &FilesPresenter::open);
  connect(page, &StartPage::tour_wanted, parts_.tour, &TourPresenter::take_on_sample);
  connect(parts_.files, &FilesPresenter::recent_changed, page, &StartPage::set_recent);
  connect(parts_.tour, &TourPresenter::sample_wanted, parts_.files, &FilesPresenter::open_sample);
  connect(parts_.tour, &TourPresenter::field_wanted, menus_, &MainMenus::set_field);
  for (const TourStep& step : TourPresenter::steps()) page->add_step(step.title, step.gist);
  parts_.files->refresh_recent();
}

void MainWindow::restore_layout() {
  first_layout_ = saveState();
  const QSettings settings;
  restoreGeometry(settings.value("window/geometry").toByteArray());
  restoreState(settings.value("window/state").toByteArray());
  fit_screen();
  parts_.treatment_bar->hide();  // even where the window was closed during a treatment
  findChild<QToolBar*>("tools")->show();
  parts_.section_bar->hide();
}

void MainWindow::reset_layout() {
  // Bars that come and go by themselves stay as they are.
  const bool treatment = parts_.treatment_bar->isVisible(),
             section = parts_.section_bar->isVisible();
  restoreState(first_layout_);
  parts_.treatment_bar->setVisible(treatment);
  parts_.section_bar->setVisible(section);
  fit_screen();
}

void MainWindow::resizeEvent(QResizeEvent* event) {
  QMainWindow::resizeEvent(event);
  // Once the panels have got their places in the new size. A round or two more: what one of them
  // cannot give another has to.
  constexpr int rounds = 3;
  QMetaObject::invokeMethod(
      this, [this] { give_view_room(rounds); }, Qt::QueuedConnection);
}

void MainWindow::give_view_room(int rounds) {
  QList<QDockWidget*> docks;  // one of each side: the others there go with it
  QList<int> widths, spare;
  for (const Qt::DockWidgetArea area : {Qt::LeftDockWidgetArea, Qt::RightDockWidgetArea}) {
    QDockWidget* seen = nullptr;
    QStringList titles;
    int least = 0;
    for (QDockWidget* dock : findChildren<QDockWidget*>()) {
      if (dockWidgetArea(dock) != area || dock->isFloating() || dock->isHidden()) continue;
      titles << dock->windowTitle();
      least = std::max(least, dock->minimumSizeHint().width());
      if (!seen && !dock->visibleRegion().isEmpty()) seen = dock;
    }
    if (!seen) continue;
    // The names of tabs stay legible.
    for (const QTabBar* bar : findChildren<QTabBar*>(Qt::FindDirectChildrenOnly))
      if (bar->count() > 0 && titles.contains(bar->tabText(0)))
        least = std::max(least, bar->sizeHint().width());
    docks << seen;
    widths << seen->width();
    spare << std::max(0, seen->width() - least);
  }
  const int all = std::accumulate(spare.begin(), spare.end(), 0);
  const int missing = (width() + 1) / 2 - centralWidget()->width();
  if (missing <= 0 || all == 0) return;
  for (qsizetype k = 0; k < widths.size(); ++k)
    widths[k] -= std::min(spare[k], missing * spare[k] / all + 1);
  resizeDocks(docks, widths, Qt::Horizontal);
  if (rounds > 1)
    QMetaObject::invokeMethod(
        this, [this, rounds] { give_view_room(rounds - 1); }, Qt::QueuedConnection);
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

void MainWindow::refresh_title() {
  if (parts_.session->current().document.empty()) return;
  const QString name = parts_.session->file().isEmpty()
                           ? parts_.session->part_name()
                           : QFileInfo(parts_.session->file()).fileName();
  setWindowTitle(name + (parts_.session->is_read_only() ? tr(" (read-only)") : QString()) +
                 "[*] – Arris");
  setWindowModified(parts_.session->has_unsaved_edits());
}

void MainWindow::open(const QString& path) { parts_.files->open(path); }
void MainWindow::open_sample() { parts_.files->open_sample(); }
bool MainWindow::offer_recovery() { return parts_.files->offer_recovery(); }
void MainWindow::set_field(Field field) { menus_->set_field(field); }
void MainWindow::show_partitions(bool shown) { menus_->show_partitions(shown); }
bool MainWindow::exporting() const { return parts_.results->writing(); }

bool MainWindow::save_picture(const QString& path, const PictureOptions& options, QString* error) {
  return parts_.pictures->save(path, options, error);
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
  if (!parts_.files->may_leave()) {
    event->ignore();
    return;
  }
  parts_.results->wait();
  parts_.session->wait_until_saved();
  QSettings settings;
  settings.setValue("window/geometry", saveGeometry());
  settings.setValue("window/state", saveState());
  parts_.session->cancel();
  parts_.session->close();
  event->accept();
}

}  // namespace arris::ui
