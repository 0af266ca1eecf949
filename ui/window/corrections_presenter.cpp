#include "ui/window/corrections_presenter.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace arris::ui {

namespace {

using nlohmann::json;

CorrectionRow row_of(const Correction& correction) {
  CorrectionRow row;
  row.id = correction.id;
  row.text = QString::fromStdString(describe(correction.operation));
  row.message = QString::fromStdString(correction.message);
  switch (correction.state) {
    case CorrectionState::applied:
      row.state = CorrectionRow::State::applied;
      row.state_text = QObject::tr("applied");
      break;
    case CorrectionState::adapted:
      row.state = CorrectionRow::State::adapted;
      row.state_text = QObject::tr("adapted");
      break;
    case CorrectionState::failed:
      row.state = CorrectionRow::State::failed;
      row.state_text = QObject::tr("failed");
      break;
    case CorrectionState::off:
      row.state = CorrectionRow::State::off;
      row.state_text = QObject::tr("off");
      break;
  }
  return row;
}

/// Lists of vertices under `name`: one list, or a list of lists.
std::vector<std::vector<VertexId>> lists_of(const json& parameters, const char* name) {
  std::vector<std::vector<VertexId>> lists;
  if (!parameters.contains(name) || !parameters[name].is_array() || parameters[name].empty())
    return lists;
  if (parameters[name][0].is_array())
    for (const json& list : parameters[name]) lists.push_back(list);
  else
    lists.push_back(parameters[name]);
  return lists;
}

/// Ids under one of two names.
std::vector<std::uint32_t> ids_of(const json& parameters, const char* one, const char* many) {
  if (parameters.contains(one) && parameters[one].is_number_unsigned()) return {parameters[one]};
  if (parameters.contains(many) && parameters[many].is_array()) return parameters[many];
  return {};
}

}  // namespace

CorrectionsPresenter::CorrectionsPresenter(Session* session, MeshView* view,
                                           ElementsPresenter* elements, CorrectionsPanel* panel,
                                           QObject* parent)
    : QObject(parent), session_(session), view_(view), elements_(elements), panel_(panel) {
  connect(session_, &Session::changed, this, [this] {
    clear_marks();
    refresh();
  });
  connect(session_, &Session::opened, this,
          [this] { panel_->set_applied_again(session_->applies_corrections()); });
  connect(session_, &Session::busy_changed, panel_, &CorrectionsPanel::set_busy);
  connect(view_, &MeshView::tool_changed, this, [this] { clear_marks(); });
  connect(panel_, &CorrectionsPanel::lift_wanted, this, [this](std::uint32_t id) {
    session_->run({Operation{"lift_correction", {{"correction", id}}}});
  });
  connect(panel_, &CorrectionsPanel::show_wanted, this, &CorrectionsPresenter::show);
  connect(panel_, &CorrectionsPanel::applied_again_changed, session_,
          &Session::set_applies_corrections);
}

void CorrectionsPresenter::set_shown(bool shown) {
  if (!shown) clear_marks();
}

void CorrectionsPresenter::refresh() {
  std::vector<CorrectionRow> rows;
  int failed = 0;
  for (const CorrectionPtr& correction : session_->shown().document.corrections) {
    rows.push_back(row_of(*correction));
    failed += correction->state == CorrectionState::failed;
  }
  panel_->set_rows(std::move(rows));
  emit title_changed(failed == 0 ? tr("Corrections") : tr("Corrections (%1 failed)").arg(failed));
}

void CorrectionsPresenter::show(std::uint32_t id) {
  const Document& document = session_->current().document;
  const auto found = std::find_if(document.corrections.begin(), document.corrections.end(),
                                  [id](const CorrectionPtr& c) { return c->id == id; });
  if (found == document.corrections.end()) return;
  const json& parameters = (*found)->operation.parameters;
  std::vector<std::vector<VertexId>> ghosts;
  std::vector<VertexId> place;
  std::vector<Point> rings;
  const auto add_place = [&](const std::vector<VertexId>& vertices) {
    for (const VertexId v : vertices)
      if (v < document.mesh->vertex_count()) place.push_back(v);
  };
  for (const char* name : {"path", "paths", "path_a", "path_b"})
    for (std::vector<VertexId>& path : lists_of(parameters, name)) {
      add_place(path);
      ghosts.push_back(std::move(path));
    }
  for (const char* name : {"vertices", "anchor", "anchors"})
    for (const std::vector<VertexId>& vertices : lists_of(parameters, name)) add_place(vertices);
  if (parameters.contains("region") && parameters["region"].is_object())
    for (const auto& vertices : lists_of(parameters["region"], "vertices")) add_place(vertices);
  // Where there is no path, the picks themselves are marked: few of them.
  constexpr std::size_t most_rings = 24;
  if (ghosts.empty() && place.size() <= most_rings)
    for (const VertexId v : place) rings.push_back(document.mesh->point(v));
  const std::vector<std::uint32_t> lines = ids_of(parameters, "line", "lines");
  const std::vector<std::uint32_t> partitions = ids_of(parameters, "partition", "partitions");
  elements_->select({lines.begin(), lines.end()}, {partitions.begin(), partitions.end()});
  view_->set_ghost_paths(std::move(ghosts));
  view_->set_picked_points(std::move(rings));
  marked_ = true;
  view_->show_place(place);
}

void CorrectionsPresenter::clear_marks() {
  if (!std::exchange(marked_, false)) return;
  view_->set_ghost_paths({});
  view_->set_picked_points({});
}

}  // namespace arris::ui
