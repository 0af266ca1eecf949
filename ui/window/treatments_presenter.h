#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <QList>
#include <QObject>

#include "ui/panels/treatment_bar.h"
#include "ui/view/mesh_view.h"
#include "ui/window/elements_presenter.h"
#include "ui/window/session.h"

class QAction;
class QMenu;
class QShortcut;

namespace arris::ui {

/// The interactive treatments (sections 6.3.2 and 7.2): from the selection, the tools of the view
/// and the treatment bar to operations, previewed while they are tuned.
class TreatmentsPresenter : public QObject {
  Q_OBJECT
 public:
  TreatmentsPresenter(Session* session, MeshView* view, ElementsPresenter* elements,
                      TreatmentBar* bar, QObject* parent);

  void add_line_actions(QMenu* menu);
  void add_partition_actions(QMenu* menu);
  /// For the context menu: those that are available.
  QList<QAction*> available_line_actions() const { return available(line_actions_); }
  QList<QAction*> available_partition_actions() const { return available(partition_actions_); }

  /// The operation that is being tuned, or that a tool in the view is for; empty: none.
  const QString& operation_in_use() const { return in_use_; }

 private:
  struct Entry {
    QAction* action;
    /// Why it cannot be done now; empty: it can.
    std::function<QString()> why_not;
  };

  void add(QMenu* menu, std::vector<Entry>& entries, const QString& text, const QString& shortcut,
           const QString& tooltip, std::function<QString()> why_not, std::function<void()> run);
  QList<QAction*> available(const std::vector<Entry>& entries) const;
  void refresh();

  void run_now(Operation operation);
  void tune(const QString& name, std::function<Operation()> operation,
            const std::optional<TreatmentBar::Number>& number,
            const std::optional<TreatmentBar::Choice>& choice = {});
  TreatmentBar::Number curvature_number(double value) const;
  void preview();
  void accept();
  void stop();
  void show_result();

  void delete_selected();
  void extend_line();
  void extend_partition();
  void merge();
  void draw();
  void split_partition();
  /// Another point of the path that is being clicked; its points as rings in the view.
  void add_point(const Pick& pick);
  void show_points();
  void trim();
  void split_line();
  void reroute();
  void recompute_lines();
  void connect_partitions();
  void restart_partitions();
  void remove_small();
  void fill_unassigned();
  void lock(bool locked);
  /// A tool in the view for an operation begins.
  void use(const char* operation);
  /// The same with the brush: its next stroke goes to `take`.
  void brush(const char* operation, const QString& hint,
             std::function<void(nlohmann::json region)> take);

  double angle_in_force() const;
  std::optional<std::uint32_t> one_line() const;
  std::optional<std::uint32_t> one_partition() const;
  nlohmann::json selected_lines() const;
  nlohmann::json selected_partitions() const;
  QString needs_lines(std::size_t least, std::size_t most) const;
  QString needs_partitions(std::size_t least, std::size_t most) const;
  QString needs_part() const;
  QString needs_found_partitions() const;
  bool any_locked() const;

  Session* session_;
  MeshView* view_;
  ElementsPresenter* elements_;
  TreatmentBar* bar_;
  std::vector<Entry> line_actions_, partition_actions_;
  std::function<Operation()> running_;  // what is being tuned, with the values of the bar
  QString in_use_;                      // its name, or that of what a tool is for
  QShortcut *accept_key_, *cancel_key_;
  // Tools.
  std::vector<VertexId> points_;                     // of the path
  std::function<void(const Pick&)> on_point_;        // a click with the path tool
  std::function<Operation(VertexId)> path_preview_;  // with one more point
  std::function<void()> on_path_done_;
  std::function<void(nlohmann::json)> on_brushed_;
  std::uint32_t grabbed_line_ = 0;
  VertexId grabbed_vertex_ = no_id;
};

}  // namespace arris::ui
