#include "ui/window/field_presenter.h"

#include <algorithm>
#include <cmath>

#include "core/base/number_text.h"
#include "core/mesh/face_quality.h"
#include "core/simplification/occupancy.h"
#include "ui/panels/controls.h"
#include "ui/window/saved_view.h"

namespace arris::ui {

namespace {

/// Colours of the classes of Shape, by shape_names() (figures 4 and 8).
const std::vector<QColor>& shape_colours() {
  static const std::vector<QColor> colours{QColor(226, 226, 220), QColor(214, 96, 77),
                                           QColor(67, 120, 190),  QColor(244, 180, 120),
                                           QColor(146, 197, 222), QColor(120, 180, 110)};
  return colours;
}

std::shared_ptr<const std::vector<double>> jump_values(const LineEvidence& evidence) {
  return std::make_shared<const std::vector<double>>(evidence.jump.begin(), evidence.jump.end());
}

/// The values of a field, and the place of its largest where it points that out.
struct FieldOfPart {
  std::shared_ptr<const std::vector<double>> values;
  std::optional<ViewMark> mark;
};

/// Any but the normal jump. `zones`: needed by Deviation alone.
FieldOfPart field_of(Field field, const Mesh& mesh, const Curvatures& curvatures,
                     const ErrorZones* zones, LengthUnit unit) {
  FieldOfPart part;
  std::vector<double> values;
  if (field == Field::deviation) {
    Occupancy occupancy = occupancy_of(mesh, *zones);
    values = std::move(occupancy.shares);
    for (double& value : values) value *= 100.0;
    const FaceOccupancy& worst = occupancy.worst;
    if (worst.worst != no_id)
      part.mark =
          ViewMark{mesh.point(worst.worst),
                   FieldPresenter::tr("worst: %1, %2 % of its zone")
                       .arg(QString::fromStdString(with_unit(number_text(worst.distance, 3), unit)),
                            QString::fromStdString(fixed_text(100.0 * worst.share, 0)))};
  } else if (field == Field::face_quality) {
    values = face_qualities(mesh);
  } else {
    values = field_values(curvatures, field);
  }
  part.values = std::make_shared<const std::vector<double>>(std::move(values));
  return part;
}

/// The greatest value, where the range of a field is known beforehand, from 0.
std::optional<double> most_of(Field field) {
  if (field == Field::deviation) return 100.0;
  if (field == Field::face_quality) return 1.0;
  return std::nullopt;
}

}  // namespace

QString FieldPresenter::why_not_available() {
  return tr("Simplify or swap edges first: the scan's vertices have no error zones yet.");
}

QString title_of(Field field, LengthUnit unit) {
  const FieldInfo& info = info_of(field);
  const std::string in = unit_of(field, unit);
  return in.empty() ? shown_text(info.name)
                    : shown_text(info.name) + " (" + QString::fromStdString(in) + ")";
}

FieldPresenter::FieldPresenter(MeshView* view, ColourMapPanel* panel, HistogramPanel* histogram,
                               QObject* parent)
    : QObject(parent),
      view_(view),
      panel_(panel),
      histogram_(histogram),
      work_(new LatestWork(this)),
      other_work_(new LatestWork(this)) {
  QStringList names, tooltips;
  for (const FieldInfo& info : field_table()) {
    names << title_of(info.field);
    tooltips << shown_text(info.meaning);
    ColourMapState& s = states_[static_cast<std::size_t>(info.field)];
    s.field = static_cast<int>(info.field);
    if (info.is_signed) s.scale.map = ColourMap::diverging;
    if (const std::optional<double> most = most_of(info.field)) {
      s.scale.map = ColourMap::viridis;  // pictures compare without more ado
      s.range = ColourMapState::Range::typed;
      s.scale.max = *most;
    }
  }
  panel_->set_fields(names, tooltips);
  panel_->set_state(state());
  connect(panel_, &ColourMapPanel::changed, this, &FieldPresenter::take);
}

void FieldPresenter::show(const Document& document) {
  const CurvaturesPtr& curvatures = document.shown_curvatures();
  const LengthUnit unit = length_unit_of(document);
  if (unit != unit_) {
    unit_ = unit;
    view_->set_length_unit(unit);
    QStringList names;
    for (const FieldInfo& info : field_table()) names << title_of(info.field, unit);
    panel_->set_field_names(names);
    if (mesh_ == document.mesh && mesh_) {
      load();  // a mark may tell a length
      refresh();
    }
  }
  if (curvatures == curvatures_ && document.mesh == mesh_ && document.zones == zones_) return;
  mesh_ = document.mesh;
  curvatures_ = curvatures;
  zones_ = document.zones;
  evidence_ = document.evidence;
  panel_->set_field_available(static_cast<int>(Field::deviation), is_available(Field::deviation),
                              why_not_available());
  if (!is_available(field_)) field_ = Field::kabs;
  load();
  refresh();
}

void FieldPresenter::set_field(Field field) {
  if (field == field_ || !is_available(field)) return;
  field_ = field;
  load();
  refresh();
}

void FieldPresenter::take(const ColourMapState& wanted) {
  const Field field = static_cast<Field>(wanted.field);
  if (field != field_) {
    set_field(field);  // with the colours it had before
    return;
  }
  state() = wanted;
  refresh();
}

nlohmann::json FieldPresenter::saved() const {
  const ColourMapState& s = states_[static_cast<std::size_t>(field_)];
  const auto colour = [](const QColor& c) { return c.isValid() ? c.name().toStdString() : ""; };
  return {{"name", info_of(field_).name},
          {"map", static_cast<int>(s.scale.map)},
          {"min", s.scale.min},
          {"max", s.scale.max},
          {"logarithmic", s.scale.logarithmic},
          {"reversed", s.scale.reversed},
          {"bands", s.scale.bands},
          {"below", colour(s.scale.below)},
          {"above", colour(s.scale.above)},
          {"undefined", colour(s.scale.undefined)},
          {"typed", s.range == ColourMapState::Range::typed},
          {"low_percentile", s.low_percentile},
          {"high_percentile", s.high_percentile},
          {"locked", s.locked}};
}

void FieldPresenter::restore(const nlohmann::json& saved) {
  const auto name = saved.find("name");
  const std::optional<Field> field = name != saved.end() && name->is_string()
                                         ? find_field(name->get<std::string>())
                                         : std::nullopt;
  if (!field || !is_available(*field)) return;
  set_field(*field);
  ColourMapState wanted = state();
  ColourScale& scale = wanted.scale;
  const double last_map = static_cast<double>(colour_map_names().size() - 1);
  scale.map = static_cast<ColourMap>(
      static_cast<int>(saved_number(saved, "map", static_cast<int>(scale.map), 0.0, last_map)));
  const double min = saved_number(saved, "min", scale.min);
  const double max = saved_number(saved, "max", scale.max);
  if (min < max) {
    scale.min = min;
    scale.max = max;
  }
  scale.logarithmic = saved_flag(saved, "logarithmic", scale.logarithmic);
  scale.reversed = saved_flag(saved, "reversed", scale.reversed);
  constexpr double most_bands = 64.0;
  scale.bands = static_cast<int>(saved_number(saved, "bands", scale.bands, 0.0, most_bands));
  for (const auto& [key, to] : {std::pair{"below", &scale.below},
                                {"above", &scale.above},
                                {"undefined", &scale.undefined}}) {
    const auto colour = saved.find(key);
    if (colour == saved.end() || !colour->is_string()) continue;
    const QColor named(QString::fromStdString(colour->get<std::string>()));
    if (named.isValid() || to != &scale.undefined) *to = named;
  }
  wanted.range = saved_flag(saved, "typed", wanted.range == ColourMapState::Range::typed)
                     ? ColourMapState::Range::typed
                     : ColourMapState::Range::percentile;
  const double low = saved_number(saved, "low_percentile", wanted.low_percentile, 0.0, 100.0);
  const double high = saved_number(saved, "high_percentile", wanted.high_percentile, 0.0, 100.0);
  if (low < high) {
    wanted.low_percentile = low;
    wanted.high_percentile = high;
  }
  wanted.locked = saved_flag(saved, "locked", wanted.locked);
  take(wanted);
}

void FieldPresenter::work_out(LatestWork* work, const SharedLineEvidencePtr& evidence,
                              std::function<void(const LineEvidence&)> then) {
  const auto report = [this](double fraction, std::string_view what) {
    QMetaObject::invokeMethod(this, [this, fraction, what = shown_text(what)] {
      if (working()) emit progress(fraction, what);
    });
  };
  work->start([evidence](const Context& context) { return evidence->get(context); },
              [then = std::move(then)](const Result<LineEvidencePtr>& found) {
                if (found) then(**found);
              },
              report);
}

void FieldPresenter::load() {
  const bool worked = working();
  work_->cancel();
  mark_.reset();
  take_values(nullptr);
  if (curvatures_ && field_ == Field::normal_jump) {
    if (const LineEvidencePtr known = evidence_->known())
      take_values(jump_values(*known));
    else
      work_out(work_, evidence_, [this](const LineEvidence& evidence) {
        emit working_changed(false);
        take_values(jump_values(evidence));
        refresh();
      });
  } else if (curvatures_) {
    const FieldOfPart part = field_of(field_, *mesh_, *curvatures_, zones_.get(), unit_);
    mark_ = part.mark;
    take_values(part.values);
  }
  if (worked != working()) emit working_changed(working());
}

void FieldPresenter::take_values(std::shared_ptr<const std::vector<double>> values) {
  values_ = std::move(values);
  distribution_ = values_ ? Distribution(*values_, field_weights(*mesh_, field_)) : Distribution();
}

ViewField FieldPresenter::view_field(std::shared_ptr<const std::vector<double>> values) const {
  const FieldInfo& info = info_of(field_);
  ViewField shown;
  shown.title = title_of(field_, unit_);
  shown.values = std::move(values);
  shown.element = info.element;
  shown.scale = scale();
  shown.read_as_radius = field_ == Field::kabs;
  if (info.is_class) {
    for (const std::string_view name : shape_names()) shown.class_names << shown_text(name);
    shown.class_colours = shape_colours();
  }
  return shown;
}

std::optional<ViewField> FieldPresenter::of(const Document& document) {
  if (document.empty() || (field_ == Field::deviation && !document.zones)) return std::nullopt;
  if (field_ == Field::normal_jump) {
    if (const LineEvidencePtr known = document.evidence->known())
      return view_field(jump_values(*known));
    if (other_evidence_ != document.evidence) {
      other_evidence_ = document.evidence;
      work_out(other_work_, other_evidence_, [this](const LineEvidence&) { emit changed(); });
    }
    return std::nullopt;
  }
  return view_field(
      field_of(field_, *document.mesh, *document.shown_curvatures(), document.zones.get(), unit_)
          .values);
}

void FieldPresenter::refresh() {
  const FieldInfo& info = info_of(field_);
  ColourMapState& s = state();
  if (s.range == ColourMapState::Range::percentile && !s.locked && !distribution_.empty()) {
    s.scale.min = distribution_.quantile(s.low_percentile / 100.0);
    s.scale.max = distribution_.quantile(s.high_percentile / 100.0);
    if (info.is_signed) {  // zero in the middle of the diverging map
      s.scale.max = std::max(std::abs(s.scale.min), std::abs(s.scale.max));
      s.scale.min = -s.scale.max;
    }
    if (!(s.scale.max > s.scale.min)) s.scale.max = s.scale.min + 1.0;
    s.scale.min = rounded(s.scale.min, 3);
    s.scale.max = rounded(s.scale.max, 3);
  }
  panel_->set_state(s);

  if (!values_) {
    view_->set_field(std::nullopt);
    Histogram none;
    if (working()) none.why_none = tr("Working out the normal jump …");
    histogram_->set_histogram(none, s.scale);
    emit changed();
    return;
  }
  ViewField shown = view_field(values_);
  shown.mark = mark_;
  view_->set_field(shown);

  Histogram histogram;
  histogram.title = shown.title;
  constexpr std::size_t count = 160;
  double low = distribution_.quantile(0.0005), high = distribution_.quantile(0.9995);
  if (info.is_class) {  // nothing to set a threshold on
    histogram_->set_histogram(histogram, s.scale);
    emit changed();
    return;
  }
  if (const std::optional<double> most = most_of(field_)) {
    low = 0.0;
    high = *most;
  } else if (!info.is_signed) {
    histogram.logarithmic = true;
    low = std::max(distribution_.quantile(0.002), high * 1e-6);
  } else if (info.element == Element::edge) {
    high = std::max({std::abs(low), std::abs(high), 60.0});  // room for the angle of any threshold
    low = -high;
  }
  if (!(high > low)) {
    histogram.logarithmic = false;
    low -= 0.5;
    high = low + 1.0;
  }
  const Distribution::Bins bins = distribution_.bins(low, high, count, histogram.logarithmic);
  histogram.edges = bins.edges;
  histogram.weights = bins.shares;
  histogram_->set_histogram(histogram, s.scale);
  emit changed();
}

}  // namespace arris::ui
