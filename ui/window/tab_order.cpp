#include "ui/window/tab_order.h"

#include <algorithm>
#include <tuple>
#include <unordered_map>
#include <vector>

#include <QApplication>
#include <QDockWidget>
#include <QEvent>
#include <QPainter>
#include <QScrollArea>
#include <QStatusBar>
#include <QTabBar>
#include <QToolBar>

namespace arris::ui {

namespace {

/// What a widget is part of: a panel, a bar, or the middle of the window.
const QWidget* panel_of(const QMainWindow& window, const QWidget* widget) {
  const QWidget* panel = widget;
  for (const QWidget* w = widget; w && w != &window; w = w->parentWidget()) {
    panel = w;
    if (qobject_cast<const QDockWidget*>(w) || qobject_cast<const QToolBar*>(w)) break;
  }
  return panel;
}

struct Stop {
  QWidget* widget = nullptr;
  std::tuple<int, int, int> panel;  // kind, from left to right, from top to bottom
  QRect place;                      // in the panel
};

bool before(const Stop& a, const Stop& b) {
  if (a.panel != b.panel) return a.panel < b.panel;
  // On one line where the middle of one is within the height of the other.
  const bool beside =
      a.place.center().y() >= b.place.top() && a.place.center().y() <= b.place.bottom() &&
      b.place.center().y() >= a.place.top() && b.place.center().y() <= a.place.bottom();
  if (beside && a.place.left() != b.place.left()) return a.place.left() < b.place.left();
  return std::pair(a.place.center().y(), a.place.left()) <
         std::pair(b.place.center().y(), b.place.left());
}

/// Whether a panel lies over the others instead of beside them, as a card does.
bool floats(const QMainWindow& window, const QWidget* panel) {
  return panel != window.centralWidget() && !qobject_cast<const QDockWidget*>(panel) &&
         !qobject_cast<const QToolBar*>(panel) && !qobject_cast<const QTabBar*>(panel) &&
         !qobject_cast<const QStatusBar*>(panel);
}

std::vector<Stop> stops_of(const QMainWindow& window) {
  std::vector<Stop> stops;
  std::unordered_map<const QWidget*, int> in_chain;
  for (const QWidget* w = window.nextInFocusChain(); w && w != &window; w = w->nextInFocusChain())
    if (!in_chain.emplace(w, static_cast<int>(in_chain.size())).second) break;
  for (QWidget* widget : window.findChildren<QWidget*>()) {
    if (widget->window() != &window || !widget->isEnabled() || !widget->isVisibleTo(&window) ||
        (widget->focusPolicy() & Qt::TabFocus) == 0 || widget->focusProxy() != nullptr)
      continue;
    const QWidget* panel = panel_of(window, widget);
    // A panel behind the tab of another is laid out of the window.
    if (panel->visibleRegion().isEmpty()) continue;
    if (floats(window, panel)) {  // after the middle of the window, in its own order
      const QRect under = window.centralWidget()->geometry();
      stops.push_back(
          {widget, {1, under.left(), under.top() + 1}, QRect(in_chain[widget], 0, 1, 1)});
      continue;
    }
    const QRect where(panel->mapTo(&window, QPoint()), panel->size());
    const bool bar = qobject_cast<const QToolBar*>(panel) != nullptr;
    stops.push_back({widget,
                     {bar ? 0 : 1, where.left(), where.top()},
                     QRect(widget->mapTo(panel, QPoint()), widget->size())});
  }
  std::stable_sort(stops.begin(), stops.end(), before);
  return stops;
}

}  // namespace

QWidget* beside_in_tab_order(const QMainWindow& window, const QWidget* from, bool next) {
  const std::vector<Stop> stops = stops_of(window);
  if (stops.empty()) return nullptr;
  const auto count = static_cast<std::ptrdiff_t>(stops.size());
  std::ptrdiff_t at = next ? -1 : count;
  for (std::ptrdiff_t k = 0; k < count; ++k)
    if (from && (stops[static_cast<std::size_t>(k)].widget == from ||
                 stops[static_cast<std::size_t>(k)].widget->isAncestorOf(from)))
      at = k;
  return stops[static_cast<std::size_t>((at + (next ? 1 : -1) + count) % count)].widget;
}

FocusRing::FocusRing(QWidget* window) : QWidget(window) {
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setFocusPolicy(Qt::NoFocus);
  hide();
  connect(qApp, &QApplication::focusChanged, this, [this](QWidget*, QWidget* now) {
    if (now != widget_) leave();
  });
}

void FocusRing::show_round(QWidget* focused) {
  leave();
  for (QWidget* w = focused->parentWidget(); w; w = w->parentWidget())
    if (auto* area = qobject_cast<QScrollArea*>(w)) area->ensureWidgetVisible(focused);
  widget_ = focused;
  for (QWidget* w = focused; w && w != parentWidget(); w = w->parentWidget())
    w->installEventFilter(this);  // it moves as they do
  place();
}

void FocusRing::leave() {
  for (QWidget* w = widget_; w && w != parentWidget(); w = w->parentWidget())
    w->removeEventFilter(this);
  widget_ = nullptr;
  hide();
}

void FocusRing::place() {
  if (!widget_) return;
  // As much of it as its scroll areas show.
  QRect seen(widget_->mapTo(parentWidget(), QPoint()), widget_->size());
  constexpr int room = 2;  // pixels about it
  seen.adjust(-room, -room, room, room);
  for (QWidget* w = widget_->parentWidget(); w && w != parentWidget(); w = w->parentWidget())
    seen &= QRect(w->mapTo(parentWidget(), QPoint()), w->size());
  setVisible(widget_->isVisible() && !seen.isEmpty());
  setGeometry(seen);
  setMask(QRegion(rect()) - QRegion(rect().adjusted(room, room, -room, -room)));
  raise();
}

bool FocusRing::eventFilter(QObject* watched, QEvent* event) {
  switch (event->type()) {
    case QEvent::Move:
    case QEvent::Resize:
    case QEvent::Show:
    case QEvent::Hide:
      place();
      break;
    default:
      break;
  }
  return QWidget::eventFilter(watched, event);
}

void FocusRing::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), palette().color(QPalette::Highlight));
}

}  // namespace arris::ui
