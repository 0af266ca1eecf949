#include "ui/panels/tour_card.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPainter>
#include <QPainterPath>
#include <QPushButton>
#include <QStackedLayout>
#include <QStyle>
#include <QTextDocumentFragment>
#include <QVBoxLayout>

#include "ui/panels/controls.h"

namespace arris::ui {

namespace {

// All in pixels.
constexpr std::array body_widths{330, 290, 258, 226};  // the first that finds a place
constexpr int pointer = 13;       // how far it stands out; the margin on all sides
constexpr int pointer_half = 11;  // half of its width where it leaves the card
constexpr int radius = 9;
constexpr int reach = radius + pointer_half + 6;  // its least distance from a corner
constexpr int ring_width = 3;
constexpr int quiet_sides = 8;  // beside the text of a button without edges

/// Text and ticks on the accent, whichever of the palette's light and dark is legible there.
QColor text_on_accent(const QPalette& palette) {
  const QColor accent = palette.color(QPalette::Highlight);
  const QColor light = palette.color(QPalette::HighlightedText);
  const QColor dark = mix(palette.color(QPalette::Base), Qt::black, 0.4);
  const auto luminance = [](const QColor& c) {
    return 0.2126 * c.redF() + 0.7152 * c.greenF() + 0.0722 * c.blueF();
  };
  return luminance(accent) > 0.5 && luminance(dark) < 0.3 ? dark : light;
}

/// With a little more room between the lines.
QString spaced(const QString& html) {
  return QStringLiteral("<div style='line-height:112%'>%1</div>").arg(html);
}

struct Interval {
  int low, high;
  int length() const { return high - low; }
};

Interval across(const QRect& r, bool vertical) {
  return vertical ? Interval{r.left(), r.left() + r.width()}
                  : Interval{r.top(), r.top() + r.height()};
}

struct Berth {
  QRect body;
  QPoint tip;
};

/// The place beside `target`, inside `room`, that hides least of `clear`; at equal cost the first
/// of left, right, above, below and of middle, begin, end along that side.
std::optional<Berth> berth_beside(const QSize& size, const QRect& target, const QRect& room,
                                  const std::vector<QRect>& clear) {
  std::optional<Berth> best;
  qint64 least = std::numeric_limits<qint64>::max();
  const int gap = ring_width + pointer;
  enum Side { left, right, above, below };
  for (const Side side : {left, right, above, below}) {
    const bool vertical = side == above || side == below;
    const Interval aim = across(target, vertical), space = across(room, vertical);
    const int length = vertical ? size.width() : size.height();
    if (space.length() < length) continue;
    const int middle = (aim.low + aim.high) / 2;
    const std::array<int, 5> starts{middle - length / 2, aim.low, aim.high - length,
                                    std::min(aim.low + reach, middle) + reach - length,
                                    std::max(aim.high - reach, middle) - reach};
    for (const int wanted : starts) {
      const int start = std::clamp(wanted, space.low, space.high - length);
      const int from = std::max(aim.low, start + reach);
      const int to = std::min(aim.high, start + length - reach);
      if (from > to) continue;  // the pointer would not meet it
      const int at = aim.length() < length ? std::clamp(middle, from, to) : (from + to) / 2;
      Berth berth;
      switch (side) {
        case left:
          berth = {{target.left() - gap - size.width(), start, size.width(), size.height()},
                   {target.left() - ring_width, at}};
          break;
        case right:
          berth = {{target.right() + 1 + gap, start, size.width(), size.height()},
                   {target.right() + 1 + ring_width, at}};
          break;
        case above:
          berth = {{start, target.top() - gap - size.height(), size.width(), size.height()},
                   {at, target.top() - ring_width}};
          break;
        case below:
          berth = {{start, target.bottom() + 1 + gap, size.width(), size.height()},
                   {at, target.bottom() + 1 + ring_width}};
          break;
      }
      if (!room.contains(berth.body)) continue;
      qint64 hidden = 0;
      for (const QRect& kept : clear) {
        const QRect common = kept & berth.body;
        hidden += qint64(common.width()) * common.height();
      }
      if (hidden >= least) continue;
      least = hidden;
      best = berth;
    }
  }
  return best;
}

}  // namespace

/// Round what the card points at; clicks go through it.
class TourRing : public QWidget {
 public:
  explicit TourRing(QWidget* window) : QWidget(window) {
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
    hide();
  }

  void lie_round(const QRect& target) {
    setGeometry(target.adjusted(-ring_width, -ring_width, ring_width, ring_width) &
                parentWidget()->rect());
    // Only the frame: what it surrounds is drawn as if it were not there.
    constexpr int frame = 2 * ring_width;
    setMask(QRegion(rect()) - QRegion(rect().adjusted(frame, frame, -frame, -frame)));
    show();
    raise();
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(palette().color(QPalette::Highlight), ring_width));
    constexpr double inset = ring_width / 2.0;
    painter.drawRoundedRect(QRectF(rect()).adjusted(inset, inset, -inset, -inset), 5, 5);
  }
};

/// One dot for each step; the one shown is long.
class TourDots : public QWidget {
 public:
  explicit TourDots(QWidget* parent) : QWidget(parent) { setFixedHeight(dot); }

  void set(int number, int count) {
    number_ = number;
    count_ = count;
    setFixedWidth(count > 0 ? count * (dot + space) - space + longer : 0);
    update();
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    const QColor accent = palette().color(QPalette::Highlight);
    const QColor later = mix(card_ground(palette()), palette().color(QPalette::WindowText), 0.25);
    double x = 0.0;
    for (int k = 1; k <= count_; ++k) {
      const double width = k == number_ ? dot + longer : dot;
      painter.setBrush(k <= number_ ? accent : later);
      painter.drawRoundedRect(QRectF(x, 0, width, dot), dot / 2.0, dot / 2.0);
      x += width + space;
    }
  }

 private:
  static constexpr int dot = 7, space = 5, longer = 10;
  int number_ = 0, count_ = 0;
};

/// What to do now, or that it is done; as high as the longer of the two.
class TourTask : public QWidget {
 public:
  explicit TourTask(QWidget* parent) : QWidget(parent), words_(new QStackedLayout) {
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(38, 8, 12, 8);
    row->addLayout(words_);
    for (QLabel*& label : labels_) {
      label = new QLabel(this);
      label->setWordWrap(true);
      label->setTextFormat(Qt::RichText);
      label->setAlignment(Qt::AlignLeft | Qt::AlignVCenter);
      words_->addWidget(label);
    }
  }

  void set(const QString& task, const QString& result, bool done) {
    labels_[0]->setText(spaced("<b>" + QObject::tr("Do:") + "</b> " + task));
    labels_[1]->setText(spaced("<b>" + QObject::tr("Done:") + "</b> " + result));
    words_->setCurrentIndex(done ? 1 : 0);
    update();
  }
  QString plain() const {
    return QTextDocumentFragment::fromHtml(labels_[words_->currentIndex()]->text()).toPlainText();
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QColor accent = palette().color(QPalette::Highlight);
    painter.setPen(Qt::NoPen);
    painter.setBrush(mix(card_ground(palette()), accent, 0.14));
    painter.drawRoundedRect(rect(), 6, 6);
    const QPointF c(20.0, height() / 2.0);
    if (words_->currentIndex() == 0) {
      painter.setBrush(Qt::NoBrush);
      painter.setPen(QPen(accent, 2.0));
      painter.drawEllipse(c, 8.0, 8.0);
      return;
    }
    painter.setBrush(accent);
    painter.drawEllipse(c, 9.0, 9.0);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(
        QPen(text_on_accent(palette()), 2.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolyline(
        QPolygonF{c + QPointF(-4, 0.5), c + QPointF(-1, 3.5), c + QPointF(4.5, -3)});
  }

 private:
  QStackedLayout* words_;
  std::array<QLabel*, 2> labels_;  // what to do, what is done
};

/// Flat, as the card is. The main one is filled with the accent, the quiet one has no edge.
class TourButton : public QPushButton {
 public:
  enum class Look { plain, main, quiet };

  TourButton(Look look, QWidget* parent) : QPushButton(parent), look_(look) {
    setAutoDefault(false);
    setFocusPolicy(Qt::TabFocus);  // a click leaves the focus in the view
  }

  void set_look(Look look) {
    look_ = look;
    update();
  }
  QSize sizeHint() const override {
    const QFontMetrics metrics(font());
    const int sides = look_ == Look::quiet ? quiet_sides : 16;
    const int least = look_ == Look::quiet ? 0 : 80;
    return {std::max(metrics.horizontalAdvance(text()) + 2 * sides, least), metrics.height() + 12};
  }
  QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QColor accent = palette().color(QPalette::Highlight);
    const QColor text = palette().color(QPalette::Active, QPalette::WindowText);
    const QColor card = card_ground(palette());
    const bool main = look_ == Look::main && isEnabled();
    const double pressed = !isEnabled() ? 0.0 : isDown() ? 0.2 : underMouse() ? 0.1 : 0.0;
    const QRectF face = QRectF(rect()).adjusted(1, 1, -1, -1);
    painter.setPen(look_ == Look::quiet
                       ? QPen(Qt::NoPen)
                       : QPen(main ? accent : mix(card, text, isEnabled() ? 0.35 : 0.2), 1.0));
    painter.setBrush(main ? mix(accent, Qt::black, pressed) : mix(card, text, pressed));
    painter.drawRoundedRect(face, 5, 5);
    if (hasFocus()) {
      painter.setBrush(Qt::NoBrush);
      painter.setPen(QPen(main ? text_on_accent(palette()) : accent, 2.0));
      const double inset = main ? 2.5 : 0.5;
      painter.drawRoundedRect(face.adjusted(inset, inset, -inset, -inset), 4, 4);
    }
    painter.setPen(!isEnabled()           ? mix(card, text, 0.4)
                   : main                 ? text_on_accent(palette())
                   : look_ == Look::quiet ? muted_text(palette())
                                          : text);
    painter.drawText(rect(), Qt::AlignCenter, this->text());
  }

 private:
  Look look_;
};

TourCard::TourCard(QWidget* window)
    : QWidget(window),
      body_width_(body_widths.front()),
      ring_(new TourRing(window)),
      dots_(new TourDots(this)),
      task_(new TourTask(this)),
      number_(new MutedLabel({}, this)),
      title_(new QLabel(this)),
      text_(new QLabel(this)) {
  setContextMenuPolicy(Qt::PreventContextMenu);
  setCursor(Qt::ArrowCursor);
  QFont large = title_->font();
  large.setPointSizeF(large.pointSizeF() * 1.3);
  large.setBold(true);
  title_->setFont(large);
  title_->setTextFormat(Qt::PlainText);
  for (QLabel* label : {title_, text_}) label->setWordWrap(true);
  text_->setTextFormat(Qt::RichText);
  back_ = new TourButton(TourButton::Look::plain, this);
  next_ = new TourButton(TourButton::Look::main, this);
  end_ = new TourButton(TourButton::Look::quiet, this);
  end_->setToolTip(tr("Everything stays as it is; Help ▸ Take the tour starts it again."));

  auto* head = new QHBoxLayout;
  head->setSpacing(9);
  head->setContentsMargins(0, 0, -quiet_sides, 0);  // its text ends where the others do
  head->addWidget(dots_);
  head->addWidget(number_);
  head->addStretch(1);
  head->addWidget(end_);
  auto* foot = new QHBoxLayout;
  foot->setSpacing(8);
  foot->addStretch(1);
  foot->addWidget(back_);
  foot->addWidget(next_);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(pointer + 16, pointer + 10, pointer + 16, pointer + 14);
  column->setSpacing(7);
  column->addLayout(head);
  column->addWidget(title_);
  column->addWidget(text_);
  column->addSpacing(3);
  column->addWidget(task_);
  column->addSpacing(3);
  column->addLayout(foot);
  hide();

  connect(back_, &QPushButton::clicked, this, &TourCard::back_wanted);
  connect(next_, &QPushButton::clicked, this, &TourCard::next_wanted);
  connect(end_, &QPushButton::clicked, this, &TourCard::end_wanted);
}

TourCard::~TourCard() = default;

void TourCard::come_after(QWidget* widget) {
  setTabOrder(widget, next_);
  setTabOrder(next_, back_);
  setTabOrder(back_, end_);
}

const QWidget* TourCard::ring() const { return ring_; }

void TourCard::set_page(const TourPage& page) {
  page_ = page;
  const QString step = page.count > 0 ? tr("%1 of %2").arg(page.number).arg(page.count) : QString();
  dots_->set(page.number, page.count);
  dots_->setVisible(page.count > 0);
  number_->setText(step);
  number_->setVisible(page.count > 0);
  title_->setText(page.title);
  text_->setText(spaced(page.text));
  task_->setVisible(!page.task.isEmpty());
  task_->set(page.task, page.result, page.done);
  back_->setText(page.back);
  back_->setVisible(!page.back.isEmpty());
  back_->setEnabled(page.can_go_back);
  next_->setText(page.next);
  end_->setText(page.end);
  end_->setVisible(!page.end.isEmpty());
  setAccessibleName(step.isEmpty() ? page.title : tr("Tour, %1: %2").arg(step, page.title));
  setAccessibleDescription(QTextDocumentFragment::fromHtml(page.text).toPlainText() +
                           (page.task.isEmpty() ? QString() : " " + task_->plain()));
  for (QPushButton* button : {back_, next_, end_})
    button->setAccessibleName(button->text() + ", " + accessibleName());
  // The one to press now; where something is to be done first, it is not that one.
  const bool now = page.done || page.task.isEmpty() || page.number == page.count;
  next_->set_look(now ? TourButton::Look::main : TourButton::Look::plain);
  fit_to_text();
}

void TourCard::fit_to_text() {
  const int width = body_width_ + 2 * pointer;
  layout()->activate();
  resize(width, layout()->totalHeightForWidth(width));
}

bool TourCard::lie_beside(const QRect& target, const QRect& room, const std::vector<QRect>& clear) {
  std::optional<Berth> berth;
  for (const int width : body_widths) {
    body_width_ = width;
    fit_to_text();
    berth = berth_beside(size() - QSize(2 * pointer, 2 * pointer), target, room, clear);
    if (berth) break;
  }
  if (!berth) return false;
  ring_->lie_round(target);
  lie_at(berth->body.topLeft(), berth->tip);
  return true;
}

void TourCard::lie_in(const QRect& area, Qt::Alignment alignment) {
  fit_to_text();
  ring_->hide();
  const QSize body = size() - QSize(2 * pointer, 2 * pointer);
  lie_at(QStyle::alignedRect(Qt::LeftToRight, alignment, body, area).topLeft(), {});
}

void TourCard::lie_at(const QPoint& corner, const QPoint& tip) {
  tip_ = tip;
  move(corner - QPoint(pointer, pointer));
  // A pixel more than what is painted, for its soft edge. What is not card is not there at all:
  // clicks there go to what lies behind it.
  QPainterPathStroker rim;
  rim.setWidth(3.0);
  setMask(QRegion(
      outline().united(rim.createStroke(outline())).simplified().toFillPolygon().toPolygon()));
  update();
  show();
  raise();
}

void TourCard::leave() {
  ring_->hide();
  hide();
}

QRect TourCard::body() const { return geometry().adjusted(pointer, pointer, -pointer, -pointer); }

QPainterPath TourCard::outline() const {
  const QRectF body = QRectF(rect()).adjusted(pointer, pointer, -pointer, -pointer);
  QPainterPath path;
  path.addRoundedRect(body, radius, radius);
  if (tip_.isNull()) return path;
  const QPointF tip = tip_ - pos();
  // Its foot lies on the side of the card that looks there.
  QPointF foot(std::clamp(tip.x(), body.left() + 1.0, body.right() - 1.0),
               std::clamp(tip.y(), body.top() + 1.0, body.bottom() - 1.0));
  const bool sideways = tip.x() < body.left() || tip.x() > body.right();
  const QPointF half = sideways ? QPointF(0, pointer_half) : QPointF(pointer_half, 0);
  QPainterPath arrow;
  arrow.addPolygon(QPolygonF{foot - half, tip, foot + half});
  arrow.closeSubpath();
  return path.united(arrow);
}

void TourCard::keyPressEvent(QKeyEvent* event) {
  const int key = event->key();
  auto* focused = qobject_cast<QPushButton*>(focusWidget());
  if (key == Qt::Key_Escape)
    emit end_wanted();
  else if ((key == Qt::Key_Return || key == Qt::Key_Enter) && focused)
    focused->click();
  else
    QWidget::keyPressEvent(event);
}

void TourCard::mousePressEvent(QMouseEvent* event) { event->accept(); }

void TourCard::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(palette().color(QPalette::Highlight), 1.5));
  painter.setBrush(card_ground(palette()));
  painter.drawPath(outline());
}

}  // namespace arris::ui
