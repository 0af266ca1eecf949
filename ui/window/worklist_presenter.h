#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include <QMenu>
#include <QObject>
#include <QTimer>

#include "core/guidance/worklist.h"
#include "ui/panels/worklist_panel.h"
#include "ui/view/mesh_view.h"
#include "ui/window/elements_presenter.h"
#include "ui/window/latest_work.h"
#include "ui/window/session.h"

namespace arris::ui {

/// What is left to do, gone through one by one: zooms to each, shows the ways to settle it, and
/// runs the one that is accepted. The list is worked out beside the UI thread once the document has
/// settled, only while it is shown.
class WorklistPresenter : public QObject {
  Q_OBJECT
 public:
  WorklistPresenter(Session* session, MeshView* view, ElementsPresenter* elements,
                    WorklistPanel* panel, QObject* parent);

  void add_actions(QMenu* menu);
  /// Whether anybody sees the list.
  void set_shown(bool shown);
  /// What is on the list; while is_current() is false, what was on it a moment ago.
  const std::vector<WorkItem>& items() const { return items_; }
  bool is_current() const { return current_; }

  void next() { step(1); }
  void previous() { step(-1); }
  void accept();
  void dismiss();
  /// All that is left and changes less than `extent`, mm.
  void dismiss_under(double extent);
  /// What was dismissed is on the list again.
  void bring_back();

 signals:
  /// The user wants to see the list.
  void wanted();

 private:
  void outdate(bool other_mesh);
  void look();
  void take(std::vector<WorkItem> items);
  void list();
  void refresh_summary();
  void step(int by);
  void show(int row, int choice, bool zoom);
  void plan_cuts(int row);
  void clear_marks();
  void refresh_buttons();
  bool can_accept() const;
  bool partitions_out_of_date() const;

  Session* session_;
  MeshView* view_;
  ElementsPresenter* elements_;
  WorklistPanel* panel_;
  LatestWork* work_;
  LatestWork* cuts_;
  QTimer settle_;
  QAction* accept_action_ = nullptr;
  QAction* dismiss_action_ = nullptr;
  QAction* bring_back_ = nullptr;
  bool shown_ = false;
  bool current_ = false;  // the list is that of the current document
  bool marked_ = false;   // paths and points in the view are ours
  int go_to_ = -1;        // the row to go to once the list is there
  std::vector<WorkItem> items_;
  std::vector<WorkItem>
      leaks_;  // of when the partitions were last up to date, but for those closed
  std::optional<Step> leaks_lines_;  // as the lines were found then
  std::set<std::string> dismissed_;
  std::size_t dismissed_here_ = 0;  // of them, those that would be on the list now
  std::set<std::string> planned_;   // items whose cuts were worked out
};

}  // namespace arris::ui
