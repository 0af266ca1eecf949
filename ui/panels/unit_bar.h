#pragma once

#include <QFrame>
#include <QStringList>

class QBoxLayout;
class QLabel;
class QToolButton;

namespace arris::ui {

/// Asks once what the lengths of a scan are in, over the view and without standing in the way: the
/// part is there to be worked on, and the answer can wait. Hidden until asked.
class UnitBar : public QFrame {
  Q_OBJECT
 public:
  explicit UnitBar(QWidget* parent = nullptr);

  /// `question`: "0.18 × 0.33 × 0.03: metres?"; `likely`: names of units, the likeliest first, each
  /// a button; `others`: those of a menu.
  void ask(const QString& question, const QStringList& likely, const QStringList& others);
  /// While something else runs nothing can be answered.
  void set_answerable(bool answerable);

 signals:
  void answered(const QString& name);  ///< One of the names.
  void dismissed();                    ///< The unit may stay unknown.

 private:
  QLabel* question_;
  QBoxLayout* answers_;
  QToolButton* other_;
};

}  // namespace arris::ui
