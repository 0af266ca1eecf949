#include "ui/window/threshold_presenter.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/base/number_text.h"
#include "core/document/treatments/treatment.h"
#include "ui/window/unit_suffix.h"

namespace arris::ui {

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double least_angle = 1.0, most_angle = 120.0;  // degrees, of the handle

double ikabs_of_angle(double degrees) { return ikabs_of_straight_edge(degrees * degree); }

double angle_of_ikabs(double ikabs) {
  return std::sqrt(ikabs / ikabs_of_straight_edge(1.0)) / degree;
}

QString number(double value, int digits = 3) {
  return QString::fromStdString(number_text(value, digits));
}

}  // namespace

Field line_field(const Session& session) {
  const SharpLineOptions options = line_options_of(session.parameters("find_sharp_lines"));
  return options.method == LineMethod::walk ? Field::ihe : Field::normal_jump;
}

ThresholdPresenter::ThresholdPresenter(Session* session, FieldPresenter* fields,
                                       HistogramPanel* histogram, QObject* parent)
    : QObject(parent), session_(session), fields_(fields), histogram_(histogram) {
  connect(histogram_, &HistogramPanel::threshold_dragged, this, [this](int handle, double value) {
    if (session_->busy()) return;
    dragging_ = true;
    session_->preview(operation_for(targets_[static_cast<std::size_t>(handle)], value));
  });
  connect(histogram_, &HistogramPanel::threshold_finished, this, [this](int handle, double value) {
    const Operation operation = operation_for(targets_[static_cast<std::size_t>(handle)], value);
    dragging_ = false;
    session_->commit_preview(operation);
  });
  connect(histogram_, &HistogramPanel::threshold_cancelled, this, [this](int) {
    dragging_ = false;
    session_->cancel_preview();
    refresh();
  });
  connect(session_, &Session::changed, this, [this] { refresh(); });
  connect(fields_, &FieldPresenter::changed, this, &ThresholdPresenter::refresh);
}

Operation ThresholdPresenter::operation_for(const Target& target, double value) const {
  // From the document at mouse down, not from the preview of a moment ago.
  const bool lines = target.kind != Target::Kind::interval_bound;
  nlohmann::json parameters =
      session_->current_parameters(lines ? "find_sharp_lines" : "find_partitions");
  if (lines) {
    const double angle = target.kind == Target::Kind::sharp_angle ? value : angle_of_ikabs(value);
    parameters["angle"] = std::clamp(rounded(angle, 4), least_angle, most_angle);
    return {"find_sharp_lines", parameters};
  }
  // Intervals are those of fronts.
  parameters["method"] = "fronts";
  // Every end at this bound moves; an interval that would vanish is pushed along.
  nlohmann::json intervals = nlohmann::json::array();
  for (nlohmann::json interval : parameters["intervals"]) {
    for (auto& end : interval)
      if (end.is_number() && end.get<double>() == target.bound) end = rounded(value, 4);
    const double min = interval[0];
    if (interval[1].is_null() || interval[1].get<double>() > min) intervals.push_back(interval);
  }
  if (!intervals.empty()) parameters["intervals"] = intervals;
  return {"find_partitions", parameters};
}

void ThresholdPresenter::add_sharp_angle(std::vector<ThresholdHandle>& handles,
                                         std::vector<Target>& targets) const {
  const Field field = fields_->field();
  const Field of_lines = line_field(*session_);
  if (field != of_lines && (of_lines != Field::ihe || field != Field::ikabs)) return;
  const double angle = session_->parameters("find_sharp_lines")["angle"];
  ThresholdHandle handle;
  if (field == of_lines) {
    handle.name = "TV_IH";
    handle.value = angle;
    handle.least = least_angle;
    handle.most = most_angle;
    if (field == Field::ihe)
      handle.reading = [](double degrees) { return "TV_IK " + number(ikabs_of_angle(degrees)); };
    targets.push_back({Target::Kind::sharp_angle});
  } else {
    handle.name = "TV_IK";
    handle.value = ikabs_of_angle(angle);
    handle.least = ikabs_of_angle(least_angle);
    handle.most = ikabs_of_angle(most_angle);
    handle.reading = [](double ikabs) { return "TV_IH " + number(angle_of_ikabs(ikabs)) + "°"; };
    targets.push_back({Target::Kind::sharp_ikabs});
  }
  handle.tooltip =
      tr("Sharp lines are looked for above this threshold. Drag it: the lines follow.");
  handles.push_back(handle);
}

void ThresholdPresenter::add_interval_bounds(std::vector<ThresholdHandle>& handles,
                                             std::vector<Target>& targets) const {
  const Field field = fields_->field();
  if (field != Field::kabs && field != Field::ikabs) return;
  const nlohmann::json partitions = session_->parameters("find_partitions");
  const Document& document = session_->shown().document;
  if (partitions["criterion"] != (field == Field::kabs ? "kabs" : "ikabs") ||
      (document.step("find_partitions") &&
       document.partition_method() == PartitionMethod::surfaces) ||
      !partitions.contains("intervals"))
    return;
  std::set<double> lower, upper;
  for (const auto& interval : partitions["intervals"]) {
    if (interval[0].get<double>() > 0.0) lower.insert(interval[0].get<double>());
    if (interval[1].is_number()) upper.insert(interval[1].get<double>());
  }
  std::set<double> bounds = lower;
  bounds.insert(upper.begin(), upper.end());
  for (const double bound : bounds) {
    ThresholdHandle handle;
    const bool is_max = upper.contains(bound), is_min = lower.contains(bound);
    handle.name = is_max && is_min ? "Kmax, Kmin" : is_max ? "Kmax" : "Kmin";
    handle.value = bound;
    const Distribution& distribution = fields_->distribution();
    handle.most = std::max(distribution.max(), bound * 1.01);
    handle.least = std::min(handle.most * 1e-7, bound);
    if (field == Field::kabs)
      handle.reading = [suffix = unit_suffix(session_->shown().document)](double kabs) {
        return "r = " + number(cylinder_radius(kabs)) + suffix;
      };
    handle.tooltip =
        tr("End of a curvature interval: partitions take faces whose vertices lie between Kmin "
           "and Kmax. Drag it: the partitions follow.");
    handles.push_back(handle);
    targets.push_back({Target::Kind::interval_bound, bound});
  }
}

void ThresholdPresenter::refresh() {
  if (session_->shown().document.empty()) {
    targets_.clear();
    histogram_->set_handles({});
    return;
  }
  std::vector<ThresholdHandle> handles;
  std::vector<Target> targets;
  add_sharp_angle(handles, targets);
  add_interval_bounds(handles, targets);
  // During a drag operations go on from the document at mouse down, where the bound had its old
  // value; and the handles stay what they are, even where two bounds meet for a moment.
  if (dragging_) {
    const std::vector<ThresholdHandle>& held = histogram_->handles();
    const bool same = std::equal(
        handles.begin(), handles.end(), held.begin(), held.end(),
        [](const ThresholdHandle& x, const ThresholdHandle& y) { return x.name == y.name; });
    if (same) histogram_->set_handles(handles);
    return;
  }
  histogram_->set_handles(handles);
  targets_ = std::move(targets);
}

}  // namespace arris::ui
