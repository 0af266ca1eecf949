#pragma once

#include <memory>

#include <QStringList>
#include <QWidget>

#include "ui/view/colour_scale.h"

namespace arris::ui {

/// Range and colour controls of the shown field.
struct ColourMapState {
  int field = 0;      ///< Index into the list of fields.
  ColourScale scale;  ///< As shown (range resolved).
  enum class Range { percentile, typed } range = Range::percentile;
  double low_percentile = 2.0, high_percentile = 98.0;  ///< Of the area.
  bool locked = false;                                  ///< The range stays when the part changes.
  bool operator==(const ColourMapState&) const = default;
};

class ColourMapPanel : public QWidget {
  Q_OBJECT
 public:
  explicit ColourMapPanel(QWidget* parent = nullptr);
  ~ColourMapPanel() override;

  /// Names of the fields, in the order of ColourMapState::field ("Kabs (1/mm²)", ..., "Shape").
  void set_fields(const QStringList& names, const QStringList& tooltips);
  /// Other names for the same fields.
  void set_field_names(const QStringList& names);
  /// A field that cannot be shown now is grey in the list; `reason` is its tooltip then.
  void set_field_available(int field, bool available, const QString& reason);
  void set_state(const ColourMapState& state);
  ColourMapState state() const;

 signals:
  /// The user changed something. For a percentile range min and max of `scale` are to be worked out
  /// by the receiver, who answers with set_state().
  void changed(const arris::ui::ColourMapState& state);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  class Private;
  std::unique_ptr<Private> p_;
};

}  // namespace arris::ui
