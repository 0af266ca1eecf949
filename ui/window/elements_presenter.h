#pragma once

#include <cstdint>
#include <unordered_map>
#include <unordered_set>

#include <QObject>
#include <QVariant>

#include "core/partitions/partition_surfaces.h"
#include "core/partitions/sides.h"
#include "core/partitions/tangent_lines.h"
#include "ui/panels/element_table.h"
#include "ui/view/mesh_view.h"
#include "ui/window/latest_work.h"
#include "ui/window/session.h"

namespace arris::ui {

/// Lines, partitions and boundaries in the view and in their tables, and one selection for both.
class ElementsPresenter : public QObject {
  Q_OBJECT
 public:
  struct Tables {
    ElementTable* lines;
    ElementTable* partitions;
    ElementTable* boundaries;
  };
  ElementsPresenter(Session* session, MeshView* view, Tables tables, QObject* parent);

  /// The partitions as colours on the surface, or the field.
  void set_partitions_shown(bool shown);
  bool partitions_shown() const { return partitions_shown_; }

  /// Tangent lines, thin and in a colour of their own, or like other Gn boundaries.
  void set_tangent_lines_shown(bool shown);

  using Ids = std::unordered_set<std::uint32_t>;
  const Ids& selected_lines() const { return lines_; }
  const Ids& selected_partitions() const { return partitions_; }
  const Ids& selected_boundaries() const { return boundaries_; }  ///< Numbers from 1.
  void clear_selection();
  /// Those that the document shown does not have are passed over.
  void select(const Ids& lines, const Ids& partitions);
  void zoom_to_selection();
  /// Selects what was picked unless it is selected already, as a context menu wants it.
  void select_at(const std::optional<Pick>& pick);

  /// Takes the selected partitions out of the view, or everything else; picking leaves out what is
  /// not shown. Nothing happens where no partition is selected.
  void hide_selected();
  void isolate_selected();
  void show_all();
  /// What is hidden and isolated, as a session keeps it.
  nlohmann::json saved_visibility() const;
  void restore_visibility(const nlohmann::json& saved);
  bool hides_any() const { return !hidden_.empty() || !isolated_.empty(); }
  bool isolates_any() const { return !isolated_.empty(); }
  /// Whether the faces of a partition (0: those of none) are hidden.
  bool hides(std::uint32_t partition) const {
    return hidden_.contains(partition) || (isolates_any() && !isolated_.contains(partition));
  }

  /// What a table of lines and partitions needs made, in place.
  static ElementTable* make_lines_table(QWidget* parent);
  static ElementTable* make_partitions_table(QWidget* parent);
  static ElementTable* make_boundaries_table(QWidget* parent);

 signals:
  /// On the rows that are selected in a table.
  void table_menu_wanted(const QPoint& global);
  /// By the user, in the view or a table.
  void selection_changed();
  void partitions_shown_changed();
  /// Partitions were hidden, isolated or shown again.
  void visibility_changed();

 private:
  static QString origin_text(const Line& line);
  static QStringList lines_headers(LengthUnit unit);
  static QStringList partitions_headers(LengthUnit unit);
  static QStringList boundaries_headers(LengthUnit unit);
  void refresh();
  void show_selection();
  void clicked(const std::optional<Pick>& pick, bool toggle);
  void banded(const std::vector<std::uint32_t>& line_ids, bool toggle);
  void show_visibility();
  void clear_sets();
  void fill_partitions_table();
  void fill_boundaries_table();
  void show_lines();
  void fit_surfaces();
  std::vector<VertexId> place_of_selection() const;
  /// What was chosen in a table is looked at where nothing of it is seen.
  void bring_into_sight();

  Session* session_;
  MeshView* view_;
  Tables tables_;
  bool partitions_shown_ = false, tangent_lines_shown_ = false;
  Ids lines_, partitions_, boundaries_;  // selected
  Ids hidden_, isolated_;                // partitions; none isolated: all are shown
  struct Fitted {
    PartitionPtr partition;  // kept, so that no other takes its place in memory
    PartitionSurface surface;
  };
  std::unordered_map<const Partition*, Fitted> fitted_;
  std::unordered_map<std::uint32_t, QVariant> sides_;     // by id of the partition
  std::unordered_map<std::size_t, TangentLine> tangent_;  // by place of the boundary
  LatestWork surfaces_work_;                              // which surfaces partitions are of
  LatestWork scan_work_;                                  // which faces of the scan they are
};

}  // namespace arris::ui
