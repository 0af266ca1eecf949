#pragma once

#include <array>
#include <functional>
#include <optional>

#include <QObject>

#include "core/curvature/distribution.h"
#include "core/curvature/fields.h"
#include "core/document/document.h"
#include "ui/panels/colour_map_panel.h"
#include "ui/panels/histogram_panel.h"
#include "ui/view/mesh_view.h"
#include "ui/window/latest_work.h"

namespace arris::ui {

/// Keeps view, colour map panel and histogram on one field: which one, in what colours and range.
/// The normal jump takes a while on a large mesh where nobody asked for it before: it is worked out
/// beside the UI thread, and until it is there the part is shown plain.
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
  /// The field with its range and colours, as a session keeps it; what cannot be is passed over.
  nlohmann::json saved() const;
  void restore(const nlohmann::json& saved);
  /// The field is still being worked out.
  bool working() const { return work_->running(); }
  /// Returns once the field is there. The window is drawn meanwhile, and takes no input.
  void wait_until_there() const { work_->wait(); }
  const Distribution& distribution() const { return distribution_; }
  /// The field shown, in the same colours and range, of another document; absent where it has not
  /// got it, or not yet: then changed() tells when it has.
  std::optional<ViewField> of(const Document& document);
  const ColourScale& scale() const { return states_[static_cast<std::size_t>(field_)].scale; }

 signals:
  /// Another field, or another range or colours, or its values are there.
  void changed();
  void working_changed(bool working);
  /// Of the work on a field: 0 to 1.
  void progress(double fraction, const QString& what);

 private:
  ColourMapState& state() { return states_[static_cast<std::size_t>(field_)]; }
  void take(const ColourMapState& state);
  /// Works out evidence beside the UI thread, then calls `then`.
  void work_out(LatestWork* work, const SharedLineEvidencePtr& evidence,
                std::function<void(const LineEvidence&)> then);
  void load();  // values and distribution of the field, or starts to work them out
  ViewField view_field(std::shared_ptr<const std::vector<double>> values) const;
  void take_values(std::shared_ptr<const std::vector<double>> values);
  void refresh();  // range, view, panel, histogram

  MeshView* view_;
  ColourMapPanel* panel_;
  HistogramPanel* histogram_;
  Field field_ = Field::kabs;
  LatestWork* work_;
  LatestWork* other_work_;                          // for of()
  std::array<ColourMapState, field_count> states_;  // of each field
  LengthUnit unit_ = LengthUnit::unknown;
  MeshPtr mesh_;
  CurvaturesPtr curvatures_;
  ErrorZonesPtr zones_;
  SharedLineEvidencePtr evidence_;
  SharedLineEvidencePtr other_evidence_;  // that other_work_ works out, or could not
  std::shared_ptr<const std::vector<double>> values_;
  std::optional<ViewMark> mark_;
  Distribution distribution_;
};

/// "Kabs (1/mm²)"; "Kabs" where the unit of lengths is unknown, or does not matter.
QString title_of(Field field, LengthUnit unit = LengthUnit::unknown);

}  // namespace arris::ui
