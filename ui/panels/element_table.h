#pragma once

#include <cstdint>
#include <memory>
#include <unordered_set>
#include <vector>

#include <QColor>
#include <QStringList>
#include <QVariant>
#include <QWidget>

namespace arris::ui {

/// One row of a table of lines, partitions or boundaries.
struct ElementRow {
  std::uint32_t id = 0;
  std::vector<QVariant> cells;  ///< Numbers stay numbers, so that sorting is right.
  QColor swatch;                ///< Colour shown in the first cell; invalid: none.
};

/// Sortable table with a filter line and a count, that selects and follows a selection.
class ElementTable : public QWidget {
  Q_OBJECT
 public:
  /// `what`: "lines"; used in the count ("137 lines, 2 selected") and the empty text.
  ElementTable(const QString& what, const QStringList& headers, const QStringList& tooltips,
               QWidget* parent = nullptr);
  ~ElementTable() override;

  void set_headers(const QStringList& headers);  ///< As many as before.
  void set_rows(std::vector<ElementRow> rows);   ///< Keeps sorting, selection and scroll position.
  void set_selected(const std::unordered_set<std::uint32_t>& ids);  ///< Scrolls to the first.
  std::unordered_set<std::uint32_t> selected() const;
  void set_empty_text(const QString& text);  ///< Shown instead of an empty table.

 signals:
  void selection_changed(const std::unordered_set<std::uint32_t>& ids);  ///< By the user only.
  void activated(std::uint32_t id);                ///< Double click or Enter: zoom to it.
  void context_menu_wanted(const QPoint& global);  ///< On what is selected.

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void showEvent(QShowEvent* event) override;

 private:
  class Private;
  std::unique_ptr<Private> p_;
};

}  // namespace arris::ui
