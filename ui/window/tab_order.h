#pragma once

#include <QMainWindow>
#include <QPointer>
#include <QWidget>

namespace arris::ui {

/// The widget that Tab (or, backwards, Shift+Tab) goes to from `from` (null: from before the
/// first): the next that takes the focus and is on the screen. Panels from left to right, in each
/// panel from top to bottom; what is behind a tab or closed is passed over, what is scrolled out of
/// view is not. Null: there is none.
QWidget* beside_in_tab_order(const QMainWindow& window, const QWidget* from, bool next);

/// A frame round what got the focus by Tab, until the focus goes elsewhere by another way.
class FocusRing : public QWidget {
  Q_OBJECT
 public:
  explicit FocusRing(QWidget* window);
  /// Scrolls it into view, too.
  void show_round(QWidget* widget);
  QWidget* widget() const { return widget_; }  ///< Null: there is no frame.

 protected:
  void paintEvent(QPaintEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void leave();
  void place();

  QPointer<QWidget> widget_;
};

}  // namespace arris::ui
