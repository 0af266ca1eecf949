#pragma once

#include <vector>

#include <QStringList>
#include <QWidget>

class QLabel;
class QPushButton;
class QTreeWidgetItem;

namespace arris::ui {

class MutedLabel;
class NumberBox;
class WrappedTree;

/// One thing that is left to do.
struct WorkRow {
  QString group;        ///< Title of its kind; rows of one kind follow each other.
  QString text;         ///< One sentence.
  QStringList choices;  ///< Ways to settle it, the best first; may be empty.
};

/// What is left to do, by kind, to be gone through one by one. Enter accepts, Delete dismisses, the
/// keys 1 to 9 choose among the ways to settle the current row.
class WorklistPanel : public QWidget {
  Q_OBJECT
 public:
  explicit WorklistPanel(QWidget* parent = nullptr);

  /// Rows are numbered as they come. None is current then.
  void set_rows(std::vector<WorkRow> rows);
  /// Another sentence for a row.
  void set_text(int row, const QString& text);
  /// The rows are those of a moment ago: they stay to be read until the new ones are there.
  void set_stale(bool stale);
  /// How far the work is; and why the list is empty, where it is.
  void set_summary(const QString& summary, const QString& empty_text);
  /// Makes a row and one of its choices current, without a signal. -1: none.
  void set_current(int row, int choice = 0);
  int current_row() const { return row_; }
  int current_choice() const { return choice_; }
  /// Proposed for dismissing all that is smaller, a length; and what follows it: " mm", or nothing.
  void set_small_extent(double extent, const QString& suffix);
  /// Whether there is anything to step through, and whether the current row can be accepted.
  void set_enabled_buttons(bool step, bool accept, bool dismiss);

 signals:
  void current_changed(int row, int choice);  ///< By the user.
  void next_wanted();
  void previous_wanted();
  void accept_wanted();
  void dismiss_wanted();
  void dismiss_under_wanted(double extent);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void take_current();
  QTreeWidgetItem* item_of(int row) const;

  QLabel* summary_;
  WrappedTree* tree_;
  MutedLabel* hint_;
  QPushButton* previous_;
  QPushButton* next_;
  QPushButton* accept_;
  QPushButton* dismiss_;
  QPushButton* dismiss_under_;
  NumberBox* under_;
  std::vector<QTreeWidgetItem*> items_;  // of each row
  std::vector<QStringList> choices_;
  int row_ = -1;
  int choice_ = 0;
  bool stale_focus_ = false;
  bool setting_ = false;  // a change of the current item is not the user's
};

}  // namespace arris::ui
