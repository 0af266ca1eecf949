#pragma once

#include <vector>

#include <QRect>
#include <QString>
#include <QWidget>

class QLabel;
class QPainterPath;

namespace arris::ui {

class TourButton;
class TourDots;
class TourRing;
class TourTask;

/// What the card shows. Texts are rich text but for the title and the buttons.
struct TourPage {
  int number = 0, count = 0;  ///< "2 of 5"; a count of 0 leaves it out.
  QString title;
  QString text;
  QString task;             ///< What to do now; empty: nothing.
  QString result;           ///< What is there once it is done.
  bool done = false;        ///< The task is done: the result is shown, not the task.
  QString back, next, end;  ///< Names of the buttons; those without one are left out.
  bool can_go_back = true;
  bool operator==(const TourPage&) const = default;
};

/// A card over the window that explains one thing, with a pointer to it and a ring round it. It
/// lies on the window (its parent) without stopping anything: it is not modal, takes no focus but
/// by Tab, and clicks beside it go where they would without it.
class TourCard : public QWidget {
  Q_OBJECT
 public:
  explicit TourCard(QWidget* window);
  ~TourCard() override;

  void set_page(const TourPage& page);
  const TourPage& page() const { return page_; }
  /// Tab leads from that widget to the card's buttons.
  void come_after(QWidget* widget);

  /// Lies beside `target` in `room`, where it hides least of `clear` (all in the window's pixels),
  /// never over the target. False where there is no room for that; nothing changed then.
  bool lie_beside(const QRect& target, const QRect& room, const std::vector<QRect>& clear);
  /// Lies inside `area`, without pointer and ring.
  void lie_in(const QRect& area, Qt::Alignment alignment);
  /// Hides card and ring.
  void leave();

  /// The card without its pointer, in the window's pixels.
  QRect body() const;
  /// Where the pointer ends, in the window's pixels; null: there is none.
  QPoint tip() const { return tip_; }
  const QWidget* ring() const;

 signals:
  void back_wanted();
  void next_wanted();
  void end_wanted();  ///< The button, or Esc while the card has the focus.

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  void lie_at(const QPoint& corner, const QPoint& tip);
  void fit_to_text();
  QPainterPath outline() const;

  TourPage page_;
  int body_width_;
  QPoint tip_;
  TourRing* ring_;
  TourDots* dots_;
  TourTask* task_;
  QLabel *number_, *title_, *text_;
  TourButton *back_, *next_, *end_;
};

}  // namespace arris::ui
