#pragma once

#include <cstdint>
#include <unordered_set>

#include <QObject>

#include "ui/panels/element_table.h"
#include "ui/view/mesh_view.h"
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

  using Ids = std::unordered_set<std::uint32_t>;
  const Ids& selected_lines() const { return lines_; }
  const Ids& selected_partitions() const { return partitions_; }
  const Ids& selected_boundaries() const { return boundaries_; }  ///< Numbers from 1.
  void clear_selection();
  void zoom_to_selection();

  /// What a table of lines and partitions needs made, in place.
  static ElementTable* make_lines_table(QWidget* parent);
  static ElementTable* make_partitions_table(QWidget* parent);
  static ElementTable* make_boundaries_table(QWidget* parent);

 signals:
  /// By the user, in the view or a table.
  void selection_changed();

 private:
  void refresh();
  void show_selection();
  void clicked(const std::optional<Pick>& pick, bool toggle);

  Session* session_;
  MeshView* view_;
  Tables tables_;
  bool partitions_shown_ = false;
  Ids lines_, partitions_, boundaries_;  // selected
};

}  // namespace arris::ui
