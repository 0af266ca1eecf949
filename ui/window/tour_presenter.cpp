#include "ui/window/tour_presenter.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include <QAction>
#include <QApplication>
#include <QDockWidget>
#include <QEvent>
#include <QMainWindow>
#include <QMenuBar>
#include <QSettings>
#include <QStatusBar>
#include <QTabBar>
#include <QToolBar>

#include "core/document/operation.h"
#include "ui/window/threshold_presenter.h"

namespace arris::ui {

namespace {

constexpr int linger = 1500;  // ms that a step is shown as done
constexpr int again = 200;    // ms, where the user is busy with something just then
constexpr int margin = 8;     // pixels between the card and the ends of its room
constexpr const char* offered = "tour/offered";
constexpr const char* picture_button = "save_picture";

QRect in_window(const QWidget* widget, const QWidget* window) {
  return {widget->mapTo(window, QPoint(0, 0)), widget->size()};
}

/// The same; a dock's tabs are part of it.
QRect with_tabs(const QWidget* widget, const QWidget* window) {
  const QRect inner = in_window(widget, window);
  QRect whole = inner;
  for (const QTabBar* bar : window->findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly)) {
    const QRect tabs = in_window(bar, window);
    const bool above = std::abs(tabs.bottom() + 1 - inner.top()) < tabs.height() / 2;
    if (bar->isVisible() && above && tabs.left() < inner.right() && tabs.right() > inner.left())
      whole.setTop(std::min(whole.top(), tabs.top()));
  }
  return whole;
}

}  // namespace

const std::vector<TourStep>& TourPresenter::steps() {
  static const std::vector<TourStep> table{
      {tr("Look"),
       tr("Curvature shows in colours what the eye misses in the shape."),
       tr("%1 to turn the part; the wheel zooms to the pointer."),
       tr("press <b>Alt+J</b> for the normal jump, which shows sharp lines, or choose another "
          "field here."),
       tr("another field is shown, and its histogram below."),
       "colour_map",
       {},
       &TourPresenter::has_looked},
      {tr("Find"),
       tr("One key goes from the scan to sharp lines and partitions."),
       tr("It finds the sharp lines of the scan and the partitions between them. Each step keeps "
          "its numbers on its card here."),
       tr("press <b>F5</b>, and watch the cards."),
       tr("lines and partitions are found."),
       "steps",
       {},
       &TourPresenter::has_found},
      {tr("Tune"),
       tr("Drag a threshold: the lines follow while the mouse moves."),
       tr("Where the surface turns at once by more than TV_IH it is sharp. Letting go makes one "
          "entry in the history; Esc while you drag restores. F5 then brings the partitions up to "
          "date."),
       tr("drag the handle <b>TV_IH</b> on the histogram, and let go."),
       tr("the lines are found anew, and the history has one more entry."),
       "histogram",
       {},
       &TourPresenter::has_tuned},
      {tr("Correct"),
       tr("Mend by hand what no threshold gets right."),
       tr("What you correct stays corrected when thresholds move; Ctrl+Z takes it back. F7 goes "
          "through what is left to do, place by place."),
       tr("click a line on the part, then press&nbsp;<b>Del</b>."),
       tr("your correction is kept, whatever the thresholds."),
       "view",
       {"lines", "partitions", "boundaries", "steps", "worklist"},
       &TourPresenter::has_corrected},
      {tr("Take away"),
       tr("Save the picture, the results and the session."),
       tr("<b>Ctrl+P</b> saves the picture, <b>Ctrl+E</b> lines, boundaries and the labelled scan, "
          "<b>Ctrl+S</b> the session with its whole history. <i>Help&nbsp;▸&nbsp;Take the tour</i> "
          "leads here again."),
       tr("save what you want to keep, then finish. The part stays as you made it."),
       {},
       picture_button,
       {},
       nullptr},
  };
  return table;
}

TourPresenter::TourPresenter(Session* session, FieldPresenter* fields, HistogramPanel* histogram,
                             MeshView* view, QMainWindow* window)
    : QObject(window),
      session_(session),
      fields_(fields),
      view_(view),
      window_(window),
      card_(new TourCard(window)) {
  card_->come_after(view);
  for (QTimer* timer : {&advance_, &follow_}) timer->setSingleShot(true);
  connect(&advance_, &QTimer::timeout, this, &TourPresenter::go_on);
  connect(&follow_, &QTimer::timeout, this, &TourPresenter::place);

  connect(card_, &TourCard::back_wanted, this, [this] {
    if (state_ == State::offering)
      end();
    else
      begin(step_ - 1);
  });
  connect(card_, &TourCard::next_wanted, this, [this] {
    if (state_ == State::offering)
      start();
    else if (step_ + 1 == steps().size()) {
      end();
    } else {
      begin(step_ + 1);
    }
  });
  connect(card_, &TourCard::end_wanted, this, &TourPresenter::end);

  connect(histogram, &HistogramPanel::threshold_dragged, this, [this] { dragged_ = true; });
  connect(histogram, &HistogramPanel::threshold_cancelled, this, [this] { dragged_ = false; });
  connect(session_, &Session::done, this, [this](const QString& operation) {
    // Whoever sets to work does so without the tour.
    if (state_ == State::offering && operation != "open") end();
    if (operation == "find_sharp_lines" && std::exchange(dragged_, false)) tuned_ = true;
    if (const OperationKind* kind = find_operation(operation.toStdString());
        kind && kind->is_treatment())
      corrected_ = true;
    refresh();
  });
  connect(session_, &Session::opened, this, &TourPresenter::take_opened);
  connect(session_, &Session::busy_changed, this, [this](bool busy) {
    if (!busy) start_when_open_ = false;  // it could not be opened
  });
  connect(session_, &Session::changed, this, [this] {
    if (session_->current().document.empty()) end();
    refresh();
  });
  connect(fields_, &FieldPresenter::changed, this, &TourPresenter::refresh);

  window_->installEventFilter(this);
  window_->centralWidget()->installEventFilter(this);
  view_->installEventFilter(this);
  for (QDockWidget* dock : window_->findChildren<QDockWidget*>()) dock->installEventFilter(this);
  for (QToolBar* bar : window_->findChildren<QToolBar*>()) bar->installEventFilter(this);
}

void TourPresenter::offer() { offer_wanted_ = !QSettings().value(offered).toBool(); }

void TourPresenter::answer_offer() {
  offer_wanted_ = false;
  QSettings().setValue(offered, true);
}

void TourPresenter::take() {
  if (session_->current().document.empty())
    take_on_sample();
  else
    start();
}

void TourPresenter::take_on_sample() {
  start_when_open_ = true;
  emit sample_wanted();
  if (!session_->busy()) start_when_open_ = false;  // the open part was not to be left
}

void TourPresenter::start() {
  answer_offer();
  state_ = State::running;
  dragged_ = tuned_ = corrected_ = false;
  begin(0);
}

void TourPresenter::end() {
  if (state_ == State::off) return;
  if (state_ == State::offering) {
    answer_offer();
    window_->statusBar()->showMessage(tr("Help ▸ Take the tour starts it at any time."), 5000);
  }
  state_ = State::off;
  advance_.stop();
  if (card_->isAncestorOf(QApplication::focusWidget())) view_->setFocus();
  card_->leave();
}

void TourPresenter::take_opened() {
  if (start_when_open_) {
    start_when_open_ = false;
    start();
  } else if (state_ == State::running) {
    dragged_ = tuned_ = corrected_ = false;
    // What comes after Find needs what it finds.
    constexpr std::size_t find = 1;
    begin(has_found() ? step_ : std::min(step_, find));
  } else if (offer_wanted_ && session_->history().entries().size() <= 1) {
    // Not over work that is taken up again.
    offer_wanted_ = false;
    state_ = State::offering;
    show_page();
    follow_.start();
  }
}

void TourPresenter::begin(std::size_t step) {
  advance_.stop();
  step_ = step;
  field_at_begin_ = fields_->field();
  if (auto* dock = qobject_cast<QDockWidget*>(target())) {
    dock->show();
    dock->raise();
  }
  // Its handle is on the histogram of what the lines are found by.
  if (steps()[step].is_done == &TourPresenter::has_tuned &&
      fields_->field() != line_field(*session_))
    emit field_wanted(line_field(*session_));
  const auto is_done = steps()[step].is_done;
  done_ = is_done && (this->*is_done)();
  show_page();
  follow_.start();
}

void TourPresenter::go_on() {
  // Not while something is held, asked or chosen.
  if (QApplication::mouseButtons() != Qt::NoButton || QApplication::activeModalWidget() ||
      QApplication::activePopupWidget())
    advance_.start(again);
  else
    begin(step_ + 1);
}

bool TourPresenter::has_looked() const {
  return fields_->field() == line_field(*session_) || fields_->field() != field_at_begin_;
}

bool TourPresenter::has_found() const {
  const std::optional<Step>& found = session_->current().document.step("find_partitions");
  return found && !found->out_of_date;
}

void TourPresenter::refresh() {
  if (state_ != State::running) return;
  const auto is_done = steps()[step_].is_done;
  const bool done = is_done && (this->*is_done)();
  if (done && !done_) advance_.start(linger);
  if (!done) advance_.stop();
  done_ = done;
  show_page();
}

QString TourPresenter::task() const {
  const TourStep& step = steps()[step_];
  if (step.is_done == &TourPresenter::has_corrected &&
      session_->shown().document.lines.lines.empty())
    return tr("press <b>F5</b> first: there are no lines yet.");
  if (!step.is_done && !has_found())
    return tr(
        "press <b>F5</b>, so that the partitions are up to date; save what you want to keep, "
        "then finish.");
  return step.task;
}

void TourPresenter::show_page() {
  TourPage page;
  if (state_ == State::offering) {
    page.title = tr("New here?");
    page.text = tr("A tour of five steps, two minutes, on this part.");
    page.back = tr("Not now");
    page.next = tr("Start the tour");
  } else {
    const TourStep& step = steps()[step_];
    const bool last = step_ + 1 == steps().size();
    page.number = static_cast<int>(step_) + 1;
    page.count = static_cast<int>(steps().size());
    page.title = step.title;
    page.text = step.gist.toHtmlEscaped() + " " + step.text;
    if (page.text.contains("%1"))
      page.text = page.text.arg(how_to(navigation_info(view_->navigation()), Motion::orbit));
    page.task = task();
    page.result = step.result;
    page.done = done_;
    page.back = tr("Back");
    page.can_go_back = step_ > 0;
    page.next = last ? tr("Finish") : tr("Next");
    page.end = tr("End tour");
  }
  if (page == card_->page()) return;
  card_->set_page(page);
  follow_.start();
}

QWidget* TourPresenter::target() const {
  if (state_ != State::running) return nullptr;
  const QString& name = steps()[step_].target;
  if (name == "view") return view_;
  if (name == picture_button) {
    auto* action = window_->findChild<QAction*>(name);
    return window_->findChild<QToolBar*>("tools")->widgetForAction(action);
  }
  return window_->findChild<QDockWidget*>(name);
}

void TourPresenter::place() {
  if (state_ == State::off) return;
  if (!view_->isVisible()) {  // the start page is shown: it comes back with the view
    card_->leave();
    return;
  }
  const QRect view = in_window(view_, window_);
  const auto is_there = [this](const QWidget* widget) {
    return widget && widget->isVisible() && widget->window() == window_;
  };
  const QWidget* there = target();
  if (is_there(there)) {
    // Menus and status bar stay free: what the task needs may be there.
    const int bottom = window_->statusBar()->isVisible() ? window_->statusBar()->geometry().top()
                                                         : window_->height();
    const int top = window_->menuBar()->geometry().bottom();
    const QRect room =
        QRect(QPoint(margin, top + margin), QPoint(window_->width() - margin - 1, bottom - margin));
    std::vector<QRect> clear{view};
    for (const QToolBar* bar : window_->findChildren<QToolBar*>())
      if (bar->isVisible())
        clear.push_back(bar->childrenRect().translated(in_window(bar, window_).topLeft()));
    for (const QString& name : steps()[step_].clear) {
      const auto* dock = window_->findChild<QDockWidget*>(name);
      if (is_there(dock)) clear.push_back(with_tabs(dock, window_));
    }
    if (card_->lie_beside(with_tabs(there, window_), room, clear)) return;
  }
  card_->lie_in(view.adjusted(margin, margin, -margin, -margin),
                Qt::AlignBottom | Qt::AlignHCenter);
}

bool TourPresenter::eventFilter(QObject* watched, QEvent* event) {
  switch (event->type()) {
    case QEvent::Resize:
    case QEvent::Move:
    case QEvent::Show:
    case QEvent::Hide:
    case QEvent::ZOrderChange:  // a dock that is raised lies over the card
    case QEvent::FontChange:
      if (state_ != State::off) follow_.start();
      break;
    default:
      break;
  }
  return QObject::eventFilter(watched, event);
}

}  // namespace arris::ui
