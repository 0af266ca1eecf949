#pragma once

#include <optional>

#include <QMenu>
#include <QObject>

#include "core/document/comparison.h"
#include "ui/panels/side_by_side.h"
#include "ui/view/mesh_view.h"
#include "ui/window/elements_presenter.h"
#include "ui/window/field_presenter.h"
#include "ui/window/latest_work.h"
#include "ui/window/session.h"

namespace arris::ui {

/// Named versions of the document, and one of them beside the part as it is now: same camera, same
/// colours, with what only one of the two has marked, live while thresholds are tuned.
class ComparisonPresenter : public QObject {
  Q_OBJECT
 public:
  ComparisonPresenter(Session* session, MeshView* view, SideBySide* side_by_side,
                      FieldPresenter* fields, ElementsPresenter* elements, QObject* parent);

  void add_actions(QMenu* menu);
  /// Asks for the name of a row of the history.
  void ask_name(std::uint32_t sequence);
  /// Shows the state after a row beside the part.
  void compare_with(std::uint32_t sequence);
  void stop();
  bool active() const { return other_ != nullptr; }
  /// The view of the other version; null while there is none.
  MeshView* other_view() { return other_; }
  /// What was found last; absent while it is being worked out.
  const std::optional<Comparison>& comparison() const { return comparison_; }

  /// Both views as on the screen, with their headers as captions.
  QImage picture(const PictureOptions& options);

 signals:
  /// Something lies under the pointer in the other view, and the document it belongs to.
  void hovered(const arris::Document& document, const std::optional<arris::ui::Pick>& pick);

 private:
  void begin(std::uint32_t sequence, Document version);
  void make_view();
  void take_change(bool other_mesh);
  void compare_anew();
  void take(const MeshPtr& mesh, const Comparison& comparison);
  void show_marks();
  void show_field();
  bool plain_wanted() const;
  void show_partitions();
  void show_visibility();
  void show_headers();
  void select_line(const std::optional<Pick>& pick);
  void take_line();
  void swap();
  void refresh();
  /// The row that Ctrl+K compares with; 0: there is none.
  std::uint32_t likely_row() const;
  QString row_text(std::uint32_t sequence) const;
  QString now_text() const;

  Session* session_;
  MeshView* view_;
  SideBySide* side_by_side_;
  FieldPresenter* fields_;
  ElementsPresenter* elements_;
  QAction* name_ = nullptr;
  QAction* compare_ = nullptr;

  MeshView* other_ = nullptr;
  std::uint32_t row_ = 0;  // of the other version, now or last
  Document version_;
  std::uint32_t line_ = 0;  // selected in the other view
  bool marks_shown_ = true;
  bool plain_ = false;  // no field in the other view
  /// Of its partitions, as shown.
  std::vector<QColor> colours_;
  std::optional<std::pair<std::uint32_t, Document>> left_behind_;  // while swapping

  LatestWork work_;
  bool outdated_ = false;  // by a change while work_ ran
  std::optional<Comparison> comparison_;
  MeshPtr compared_mesh_;  // of the part, when comparison_ was worked out
};

}  // namespace arris::ui
