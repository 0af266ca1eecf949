#pragma once

#include <array>

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

  /// The document shown is another one; does nothing where its curvatures are the same.
  void show(const Document& document);
  void set_field(Field field);
  Field field() const { return field_; }
  const Distribution& distribution() const { return distribution_; }
  const ColourScale& scale() const { return states_[static_cast<std::size_t>(field_)].scale; }

 signals:
  /// Another field, or another range or colours.
  void changed();

 private:
  ColourMapState& state() { return states_[static_cast<std::size_t>(field_)]; }
  void take(const ColourMapState& state);
  void load();     // values and distribution of the field
  void refresh();  // range, view, panel, histogram

  MeshView* view_;
  ColourMapPanel* panel_;
  HistogramPanel* histogram_;
  Field field_ = Field::kabs;
  std::array<ColourMapState, 8> states_;  // of each field
  MeshPtr mesh_;
  CurvaturesPtr curvatures_;
  std::shared_ptr<const std::vector<double>> values_;
  Distribution distribution_;
};

/// "Kabs (1/mm²)".
QString title_of(Field field);

}  // namespace arris::ui
