#pragma once

#include <array>
#include <optional>

#include <QObject>

#include "core/curvature/distribution.h"
#include "core/curvature/fields.h"
#include "core/document/document.h"
#include "ui/panels/colour_map_panel.h"
#include "ui/panels/histogram_panel.h"
#include "ui/view/mesh_view.h"

namespace arris::ui {

/// Keeps view, colour map panel and histogram on one field: which one, in what colours and range.
class FieldPresenter : public QObject {
  Q_OBJECT
 public:
  FieldPresenter(MeshView* view, ColourMapPanel* panel, HistogramPanel* histogram, QObject* parent);

  /// The document shown is another one; does nothing where mesh, curvatures and zones are the same.
  /// A field that it does not have gives way to Kabs.
  void show(const Document& document);
  /// Whether the document shown has the field: Deviation needs error zones.
  bool is_available(Field field) const { return field != Field::deviation || zones_; }
  static QString why_not_available();  ///< One sentence, for tooltips.
  void set_field(Field field);
  Field field() const { return field_; }
  const Distribution& distribution() const { return distribution_; }
  /// The field shown, in the same colours and range, of another document; absent where it has not
  /// got it.
  std::optional<ViewField> of(const Document& document) const;
  const ColourScale& scale() const { return states_[static_cast<std::size_t>(field_)].scale; }

 signals:
  /// Another field, or another range or colours.
  void changed();

 private:
  ColourMapState& state() { return states_[static_cast<std::size_t>(field_)]; }
  void take(const ColourMapState& state);
  void load();  // values and distribution of the field
  ViewField view_field(std::shared_ptr<const std::vector<double>> values) const;
  void refresh();  // range, view, panel, histogram

  MeshView* view_;
  ColourMapPanel* panel_;
  HistogramPanel* histogram_;
  Field field_ = Field::kabs;
  std::array<ColourMapState, 10> states_;  // of each field
  MeshPtr mesh_;
  CurvaturesPtr curvatures_;
  ErrorZonesPtr zones_;
  std::shared_ptr<const std::vector<double>> values_;
  std::optional<ViewMark> mark_;
  Distribution distribution_;
};

/// "Kabs (1/mm²)".
QString title_of(Field field);

}  // namespace arris::ui
