#include "ui/panels/histogram_panel.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <QFocusEvent>
#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QTimer>
#include <QToolTip>
#include <QWheelEvent>

#include "ui/panels/controls.h"

namespace arris::ui {

namespace {

constexpr int dead_zone = 3;      // a click or double click that trembles is no drag
constexpr int settle_time = 500;  // ms after the last key or turn of the wheel
constexpr double fine = 0.1;      // dragging with Shift

}  // namespace

class HistogramPanel::Private : public HistogramChart {
 public:
  explicit Private(HistogramPanel* panel) : HistogramChart(panel), q(panel) {}

  struct Move {
    enum class By { mouse, steps } by = By::mouse;
    int handle = 0;
    double original = 0.0;
    double x = 0.0;  // Where the line would be without any limit; mouse only.
    QPoint press, last;
    bool begun = false;  // Something was emitted.
  };

  HistogramPanel* q;
  std::optional<Move> move;
  int wheel_rest = 0;
  QTimer* settle = nullptr;
  NumberEdit* editor = nullptr;
  int edited = -1;

  // ---- moving ----

  /// The value as it may be: rounded to what the label shows, and within the handle's range.
  double allowed(int i, double value) const {
    const ThresholdHandle& handle = handles[i];
    return std::clamp(round_significant(value), handle.least, handle.most);
  }

  void change(double value) {
    const int handle = move->handle;
    if (value == handles[handle].value) return;
    move->begun = true;
    handles[handle].value = value;
    q->update();
    emit q->threshold_dragged(handle, value);
  }

  void finish() {
    settle->stop();
    if (!move) return;
    const Move done = *move;
    move.reset();
    q->update();
    if (done.begun) emit q->threshold_finished(done.handle, handles[done.handle].value);
  }

  bool cancel() {
    settle->stop();
    if (!move) return false;
    const Move done = *move;
    move.reset();
    handles[done.handle].value = done.original;
    q->update();
    if (done.begun) emit q->threshold_cancelled(done.handle);
    return done.begun || done.by == Move::By::mouse;
  }

  void drag_to(const QPoint& point, bool finer) {
    const int dx = point.x() - move->last.x();
    if (!move->begun && std::abs(point.x() - move->press.x()) < dead_zone) return;
    move->last = point;
    move->x += finer ? fine * dx : dx;
    const QRect plot = layout().plot;
    const double x = std::clamp<double>(move->x, plot.left(), plot.right());
    const double least = handles[move->handle].least;
    const bool lowest = axis.logarithmic && least <= 0.0 && move->x <= plot.left();
    change(lowest ? least : allowed(move->handle, value_at(x, plot)));
  }

  /// One step of the keyboard or the wheel is a 200th of the axis, a large one a 20th.
  void step(int i, int direction, bool large) {
    if (move && (move->by == Move::By::mouse || move->handle != i)) finish();
    if (!move) move = Move{Move::By::steps, i, handles[i].value, 0.0, {}, {}, false};
    const double now = handles[i].value;
    const double span = axis.warp(axis.max) - axis.warp(axis.min);
    double next = now;
    if (axis.logarithmic) {
      const double from = std::max(now, axis.min);
      const bool lowest = direction < 0 && now <= axis.min;
      next = lowest ? handles[i].least
                    : from * std::pow(10.0, direction * span / (large ? 20.0 : 200.0));
    } else {
      const double size = nice_step(span / (large ? 20.0 : 200.0));
      next = now + direction * size;
    }
    const double rounded = allowed(i, next);
    // A step finer than four digits is still a step.
    change(rounded != now ? rounded : std::clamp(next, handles[i].least, handles[i].most));
    if (move) settle->start(settle_time);
  }

  // ---- typing ----

  void edit(int i, const QString& start) {
    finish();
    if (!valid(i)) return;
    edited = i;
    focused = i;
    QRect box = layout().labels[i];
    const int width = std::max(box.width(), QFontMetrics(q->font()).averageCharWidth() * 14);
    box.setWidth(width);
    box.moveLeft(std::clamp(box.left(), margin, std::max(margin, q->width() - margin - width)));
    editor->setGeometry(box.adjusted(0, -2, 0, 2));
    editor->set_mistake({});
    editor->set_help(
        QObject::tr("%1 from %2 to %3; Enter sets it, Esc leaves it as it was.")
            .arg(handles[i].name, shown_number(handles[i].least), shown_number(handles[i].most)));
    editor->setAccessibleName(handles[i].name);
    if (start.isEmpty()) {
      editor->setText(edit_text(handles[i].value, 10));
      editor->selectAll();
    } else {
      editor->setText(start);
    }
    editor->show();
    editor->setFocus();
    if (!start.isEmpty()) editor->end(false);
    q->update();
  }

  void close_editor() {
    if (edited < 0) return;
    edited = -1;
    const bool had_focus = editor->hasFocus();
    editor->hide();
    if (had_focus) q->setFocus();
    q->update();
  }

  /// False and the editor stays open, saying why, where the text is not a value of the handle.
  bool enter_text() {
    if (!valid(edited)) return true;
    const ThresholdHandle& handle = handles[edited];
    const auto value = typed_number(editor->text());
    if (!value || *value < handle.least || *value > handle.most) {
      const QString range =
          QObject::tr("from %1 to %2").arg(shown_number(handle.least), shown_number(handle.most));
      editor->set_mistake(
          value ? QObject::tr("%1 goes %2.").arg(handle.name, range)
                : QObject::tr("Type a number %1, with a point for the decimals.").arg(range));
      QToolTip::showText(editor->mapToGlobal(QPoint(0, editor->height())), editor->toolTip(),
                         editor);
      return false;
    }
    const int i = edited;
    const bool changed = *value != handle.value;
    handles[i].value = *value;
    close_editor();
    if (changed) emit q->threshold_finished(i, *value);
    return true;
  }

  void hover(int handle) {
    if (handle == hovered) return;
    hovered = handle;
    if (valid(handle)) {
      q->setCursor(Qt::SizeHorCursor);
    } else {
      q->unsetCursor();
    }
    q->update();
  }

  void announce() {
    if (!valid(focused)) return;
    q->setAccessibleDescription(
        QStringLiteral("%1 %2 %3")
            .arg(handles[focused].name, value_text(focused), reading_text(focused)));
  }
};

HistogramPanel::HistogramPanel(QWidget* parent)
    : QWidget(parent), p_(std::make_unique<Private>(this)) {
  setMouseTracking(true);
  setAccessibleName(tr("Histogram with thresholds"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  p_->settle = new QTimer(this);
  p_->settle->setSingleShot(true);
  connect(p_->settle, &QTimer::timeout, this, [this] { p_->finish(); });
  p_->editor = new NumberEdit(this);
  p_->editor->hide();
  p_->editor->installEventFilter(this);
}

HistogramPanel::~HistogramPanel() = default;

void HistogramPanel::set_histogram(const Histogram& histogram, const ColourScale& scale) {
  p_->take(histogram);
  p_->scale = scale;
  if (p_->move) p_->move->x = p_->line_x(p_->move->handle, p_->layout().plot);
  update();
}

void HistogramPanel::set_curve(HistogramCurve curve) {
  p_->curve = std::move(curve);
  if (p_->move) p_->move->x = p_->line_x(p_->move->handle, p_->layout().plot);
  update();
}

const HistogramCurve& HistogramPanel::curve() const { return p_->curve; }

void HistogramPanel::set_handles(std::vector<ThresholdHandle> handles) {
  const bool same = std::equal(
      handles.begin(), handles.end(), p_->handles.begin(), p_->handles.end(),
      [](const ThresholdHandle& a, const ThresholdHandle& b) { return a.name == b.name; });
  if (!same) {
    p_->settle->stop();
    p_->move.reset();
    p_->close_editor();
    p_->hovered = -1;
    p_->focused = 0;
  } else if (p_->move) {
    handles[p_->move->handle].value = p_->handles[p_->move->handle].value;
  }
  for (ThresholdHandle& handle : handles) handle.most = std::max(handle.least, handle.most);
  p_->handles = std::move(handles);
  setFocusPolicy(p_->handles.empty() ? Qt::NoFocus : Qt::StrongFocus);
  p_->announce();
  update();
}

const std::vector<ThresholdHandle>& HistogramPanel::handles() const { return p_->handles; }

QPoint HistogramPanel::handle_position(int handle) const {
  const QRect plot = p_->layout().plot;
  return p_->valid(handle) ? QPoint(p_->line_x(handle, plot), plot.center().y()) : QPoint();
}

QRect HistogramPanel::label_rectangle(int handle) const {
  return p_->valid(handle) ? p_->layout().labels[handle] : QRect();
}

QSize HistogramPanel::sizeHint() const { return QSize(900, 180); }
QSize HistogramPanel::minimumSizeHint() const {
  return QSize(240, 6 * fontMetrics().height() + 24);
}

bool HistogramPanel::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride) {
    // Keys that mean something here are not to set off a shortcut of the window.
    auto* key = static_cast<QKeyEvent*>(event);
    const bool typed =
        key->text().size() == 1 && QStringLiteral("0123456789.-").contains(key->text());
    const bool steps = key->key() == Qt::Key_Left || key->key() == Qt::Key_Right ||
                       key->key() == Qt::Key_Up || key->key() == Qt::Key_Down;
    const bool plain = !(key->modifiers() & (Qt::ControlModifier | Qt::AltModifier));
    if ((key->key() == Qt::Key_Escape && p_->move) ||
        (p_->valid(p_->focused) && plain && (typed || steps))) {
      event->accept();
      return true;
    }
  }
  if (event->type() == QEvent::ToolTip) {
    const QPoint point = static_cast<QHelpEvent*>(event)->pos();
    const Private::Layout at = p_->layout();
    const int handle = p_->handle_at(point, at);
    const auto bin = p_->bin_at(point.x(), at.plot);
    const bool over = at.plot.united(at.strip).contains(point);
    QString text;
    if (handle >= 0) {
      const ThresholdHandle& h = p_->handles[handle];
      text = tr("<b>%1</b> %2 %3<br>%4<br><i>Drag, or double-click to type. Shift: finer.</i>")
                 .arg(h.name.toHtmlEscaped(), shown_number(h.value),
                      p_->reading_text(handle).toHtmlEscaped(), h.tooltip.toHtmlEscaped());
    } else if (bin && over) {
      text = tr("%1\n%2 of the area")
                 .arg(p_->range_text(*bin), percent_text(p_->histogram.weights[*bin]));
    }
    QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(), text, this,
                       QRect(point - QPoint(2, 2), QSize(5, 5)));
    return true;
  }
  return QWidget::event(event);
}

bool HistogramPanel::eventFilter(QObject* watched, QEvent* event) {
  if (watched != p_->editor || p_->edited < 0) return QWidget::eventFilter(watched, event);
  if (event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    const bool enter = key == Qt::Key_Return || key == Qt::Key_Enter;
    if (enter || key == Qt::Key_Escape) {
      event->accept();
      if (event->type() == QEvent::ShortcutOverride) return true;
      if (enter) {
        p_->enter_text();
      } else {
        p_->close_editor();
      }
      return true;
    }
  }
  if (event->type() == QEvent::FocusOut) {
    // Looking something up in another window is no answer yet.
    const auto reason = static_cast<QFocusEvent*>(event)->reason();
    if (reason != Qt::ActiveWindowFocusReason && reason != Qt::PopupFocusReason &&
        !p_->enter_text()) {
      p_->close_editor();
    }
  }
  return QWidget::eventFilter(watched, event);
}

bool HistogramPanel::focusNextPrevChild(bool next) {
  if (p_->edited >= 0) {
    if (!p_->enter_text()) return true;
    setFocus();
  }
  const int to = p_->focused + (next ? 1 : -1);
  if (!hasFocus() || !p_->valid(to)) return QWidget::focusNextPrevChild(next);
  p_->finish();
  p_->focused = to;
  p_->announce();
  update();
  return true;
}

void HistogramPanel::focusInEvent(QFocusEvent* event) {
  if (event->reason() == Qt::TabFocusReason) p_->focused = 0;
  if (event->reason() == Qt::BacktabFocusReason) {
    p_->focused = std::max(0, static_cast<int>(p_->handles.size()) - 1);
  }
  p_->announce();
  update();
}

void HistogramPanel::focusOutEvent(QFocusEvent*) {
  if (p_->move && p_->move->by == Private::Move::By::steps) p_->finish();
  update();
}

void HistogramPanel::hideEvent(QHideEvent* event) {
  p_->cancel();
  p_->close_editor();
  QWidget::hideEvent(event);
}

void HistogramPanel::keyPressEvent(QKeyEvent* event) {
  const int key = event->key();
  if (key == Qt::Key_Escape && p_->cancel()) return;
  const bool dragging = p_->move && p_->move->by == Private::Move::By::mouse;
  if (dragging || !p_->valid(p_->focused)) return QWidget::keyPressEvent(event);
  const bool large = event->modifiers() & Qt::ShiftModifier;
  const bool plain = !(event->modifiers() & (Qt::ControlModifier | Qt::AltModifier));
  if (plain && (key == Qt::Key_Left || key == Qt::Key_Down)) {
    p_->step(p_->focused, -1, large);
  } else if (plain && (key == Qt::Key_Right || key == Qt::Key_Up)) {
    p_->step(p_->focused, 1, large);
  } else if (plain && (key == Qt::Key_PageDown || key == Qt::Key_PageUp)) {
    p_->step(p_->focused, key == Qt::Key_PageUp ? 1 : -1, true);
  } else if (key == Qt::Key_Return || key == Qt::Key_Enter) {
    if (p_->move) {
      p_->finish();
    } else {
      p_->edit(p_->focused, {});
    }
  } else if (key == Qt::Key_F2) {
    p_->edit(p_->focused, {});
  } else if (plain && event->text().size() == 1 &&
             QStringLiteral("0123456789.,-").contains(event->text())) {
    const bool comma = event->text() == QLatin1String(",");
    p_->edit(p_->focused, comma ? QStringLiteral(".") : event->text());
  } else {
    return QWidget::keyPressEvent(event);
  }
  p_->announce();
}

void HistogramPanel::leaveEvent(QEvent*) {
  if (!p_->move) p_->hover(-1);
}

void HistogramPanel::mouseDoubleClickEvent(QMouseEvent* event) {
  const int handle = p_->handle_at(event->pos(), p_->layout());
  if (event->button() != Qt::LeftButton || handle < 0) return;
  p_->move.reset();
  p_->edit(handle, {});
}

void HistogramPanel::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return event->ignore();
  p_->finish();
  const Private::Layout at = p_->layout();
  const int handle = p_->handle_at(event->pos(), at);
  if (handle < 0) return;
  p_->focused = handle;
  setFocus(Qt::MouseFocusReason);
  p_->move = Private::Move{Private::Move::By::mouse,
                           handle,
                           p_->handles[handle].value,
                           static_cast<double>(p_->line_x(handle, at.plot)),
                           event->pos(),
                           event->pos(),
                           false};
  p_->announce();
  update();
}

void HistogramPanel::mouseMoveEvent(QMouseEvent* event) {
  const bool dragging = p_->move && p_->move->by == Private::Move::By::mouse;
  if (dragging && (event->buttons() & Qt::LeftButton)) {
    p_->drag_to(event->pos(), event->modifiers() & Qt::ShiftModifier);
  } else if (!(event->buttons() & Qt::LeftButton)) {
    p_->hover(p_->handle_at(event->pos(), p_->layout()));
  }
}

void HistogramPanel::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !p_->move) return;
  p_->finish();
  p_->announce();
  p_->hover(p_->handle_at(event->pos(), p_->layout()));
}

void HistogramPanel::paintEvent(QPaintEvent*) {
  p_->held = p_->move ? p_->move->handle : -1;
  QPainter painter(this);
  p_->paint(painter);
}

void HistogramPanel::resizeEvent(QResizeEvent*) { p_->close_editor(); }

void HistogramPanel::wheelEvent(QWheelEvent* event) {
  const int handle = p_->handle_at(event->position().toPoint(), p_->layout());
  const bool dragging = p_->move && p_->move->by == Private::Move::By::mouse;
  if (handle < 0 || dragging) return event->ignore();
  p_->wheel_rest +=
      event->angleDelta().y() != 0 ? event->angleDelta().y() : event->angleDelta().x();
  const int notches = p_->wheel_rest / 120;
  p_->wheel_rest -= 120 * notches;
  for (int k = 0; k < std::abs(notches) && p_->valid(handle); ++k) {
    p_->step(handle, notches > 0 ? 1 : -1, event->modifiers() & Qt::ShiftModifier);
  }
  event->accept();
}

}  // namespace arris::ui
