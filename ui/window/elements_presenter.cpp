#include "ui/window/elements_presenter.h"

#include <cmath>
#include <set>

#include "core/base/number_text.h"
#include "core/document/treatments/treatment.h"
#include "ui/panels/controls.h"
#include "ui/window/shown_elements.h"
#include "ui/window/unit_suffix.h"

namespace arris::ui {

namespace {

double shown(double value) { return rounded(value, 3); }
/// Lengths and areas: whole from 100 on.
double measured(double value) { return std::abs(value) < 99.95 ? shown(value) : std::round(value); }

QString partition_name(std::uint32_t id) { return id == 0 ? QString("–") : QString::number(id); }

QString interval_text(const CurvatureInterval& interval) {
  return QString::fromStdString(interval_in_words(interval));
}

template <class Find>
void drop_gone(ElementsPresenter::Ids& ids, const Find& find) {
  std::erase_if(ids, [&](std::uint32_t id) { return !find(id); });
}

}  // namespace

QString ElementsPresenter::origin_text(const Line& line) {
  const QString origin = line.origin == Origin::extended ? tr("extended")
                         : line.origin == Origin::merged ? tr("merged")
                         : line.origin == Origin::drawn  ? tr("drawn")
                                                         : tr("found");
  return line.locked ? origin + tr(", locked") : origin;
}

QStringList ElementsPresenter::lines_headers(LengthUnit unit) {
  return {tr("Line"),    tr("Type"),   tr("Length") + unit_suffix(unit),
          tr("Angle °"), tr("Origin"), tr("Edges")};
}

QStringList ElementsPresenter::partitions_headers(LengthUnit unit) {
  const QString length = unit_suffix(unit);
  return {tr("Partition"),
          tr("Surface"),
          tr("Size"),
          tr("Deviation") + length,
          tr("Largest") + length,
          tr("Within %"),
          tr("Sides"),
          tr("Area") + unit_suffix(unit, 2),
          tr("Faces"),
          tr("Mean"),
          tr("Interval")};
}

QStringList ElementsPresenter::boundaries_headers(LengthUnit unit) {
  const QString length = unit_suffix(unit);
  return {tr("No."),  tr("Type"), tr("Length") + length, tr("Angle °"), tr("Radius") + length,
          tr("Left"), tr("Right")};
}

ElementTable* ElementsPresenter::make_lines_table(QWidget* parent) {
  auto* table = new ElementTable(
      tr("lines"), lines_headers(LengthUnit::unknown),
      {tr("Id of the line; it keeps it while thresholds move"),
       tr("Convex or concave; closed lines have no ends"), tr("Length along the line"),
       tr("Mean angle across it, by what lines are found by: the normal jump, or IHe (walk); "
          "positive where convex"),
       tr("Found, or extended, merged or drawn by hand; locked lines are not changed by finding"),
       tr("Number of sharp edges")},
      parent);
  table->set_empty_text(
      tr("No sharp lines yet. Run the step “Sharp lines”, or drag TV_IH on the "
         "histogram of the normal jump."));
  return table;
}

ElementTable* ElementsPresenter::make_partitions_table(QWidget* parent) {
  auto* table = new ElementTable(
      tr("partitions"), partitions_headers(LengthUnit::unknown),
      {tr("Id of the partition; it keeps it while thresholds move"),
       tr("The surface that explains it: plane, sphere, cylinder, cone, torus, blend (of one "
          "radius along a curve), or free: none of them"),
       tr("Radius or half angle of that surface; of a torus both radii, of a blend that of the "
          "ball that rolls along it"),
       tr("Mean distance of its vertices from that surface"),
       tr("Largest distance of its vertices from that surface"),
       tr("Share of its vertices within three times the noise of the scan"),
       tr("Its sides between corners, and its holes; a surface patch wants four and none"),
       tr("Area of its faces"), tr("Number of faces"),
       tr("Mean value of the criterion (Kabs or IKabs)"),
       tr("Values of the criterion inside it, or the interval it was found under")},
      parent);
  table->set_empty_text(tr("No partitions yet. Run the step “Partitions”."));
  return table;
}

ElementTable* ElementsPresenter::make_boundaries_table(QWidget* parent) {
  auto* table = new ElementTable(
      tr("boundaries"), boundaries_headers(LengthUnit::unknown),
      {tr("Number"),
       tr("C0: sharp line. Gn: between two partitions; tangent where their surfaces touch, as at "
          "both rims of a fillet. Undefined: unassigned faces beyond. Border: the scan ends"),
       tr("Length along the boundary"),
       tr("Mean angle across it, positive where convex: of a sharp line as in the table of lines, "
          "else the exterior angle"),
       tr("Of a tangent line: radius across it of the surface that is bent the more, the fillet"),
       tr("Partition to its left"), tr("Partition to its right")},
      parent);
  table->set_empty_text(tr("Boundaries come with lines and partitions."));
  return table;
}

ElementsPresenter::ElementsPresenter(Session* session, MeshView* view, Tables tables,
                                     QObject* parent)
    : QObject(parent),
      session_(session),
      view_(view),
      tables_(tables),
      surfaces_work_(this),
      scan_work_(this) {
  for (ElementTable* table : {tables.lines, tables.partitions, tables.boundaries})
    connect(table, &ElementTable::context_menu_wanted, this, &ElementsPresenter::table_menu_wanted);
  connect(session_, &Session::changed, this, [this] { refresh(); });
  connect(view_, &MeshView::clicked, this, &ElementsPresenter::clicked);
  connect(view_, &MeshView::banded, this, &ElementsPresenter::banded);
  connect(tables_.lines, &ElementTable::selection_changed, this, [this](const Ids& ids) {
    lines_ = ids;
    partitions_.clear();
    boundaries_.clear();
    show_selection();
    bring_into_sight();
    emit selection_changed();
  });
  connect(tables_.partitions, &ElementTable::selection_changed, this, [this](const Ids& ids) {
    partitions_ = ids;
    lines_.clear();
    boundaries_.clear();
    show_selection();
    bring_into_sight();
    emit selection_changed();
  });
  connect(tables_.boundaries, &ElementTable::selection_changed, this, [this](const Ids& ids) {
    boundaries_ = ids;
    lines_.clear();
    partitions_.clear();
    show_selection();
    bring_into_sight();
    emit selection_changed();
  });
  for (ElementTable* table : {tables_.lines, tables_.partitions, tables_.boundaries})
    connect(table, &ElementTable::activated, this, [this] { zoom_to_selection(); });
}

void ElementsPresenter::set_partitions_shown(bool shown_now) {
  if (partitions_shown_ == shown_now) return;
  partitions_shown_ = shown_now;
  refresh();
  emit partitions_shown_changed();
}

void ElementsPresenter::set_tangent_lines_shown(bool shown_now) {
  tangent_lines_shown_ = shown_now;
  show_lines();
}

void ElementsPresenter::show_lines() {
  std::unordered_set<std::size_t> tangent;
  if (tangent_lines_shown_ && !session_->is_previewing())
    for (const auto& [place, line] : tangent_) tangent.insert(place);
  view_->set_lines(view_lines(session_->shown().document, tangent));
}

void ElementsPresenter::refresh() {
  const ShownDocument& snapshot = session_->shown();
  const Document& document = snapshot.document;
  // A preview may come and go; the selection is that of the state that stays.
  const Document& current = session_->current().document;
  drop_gone(lines_, [&](std::uint32_t id) { return current.lines.find(id); });
  drop_gone(partitions_, [&](std::uint32_t id) { return current.partitions.find(id); });
  drop_gone(boundaries_,
            [&](std::uint32_t k) { return k >= 1 && k <= snapshot.boundaries.size(); });

  const std::vector<QColor> colours = colours_of_partitions(document);
  if (partitions_shown_)
    show_partitions_in(*view_, document, colours);
  else
    view_->set_face_labels({}, {});
  drop_gone(hidden_, [&](std::uint32_t id) { return document.partitions.find(id); });
  drop_gone(isolated_, [&](std::uint32_t id) { return document.partitions.find(id); });
  if (!session_->is_previewing()) tangent_.clear();  // until they are found again
  show_lines();
  show_visibility();

  // Tables of a part with thousands of rows are filled only for the state that stays.
  if (!session_->is_previewing()) {
    const LengthUnit unit = length_unit_of(document);
    tables_.lines->set_headers(lines_headers(unit));
    tables_.partitions->set_headers(partitions_headers(unit));
    tables_.boundaries->set_headers(boundaries_headers(unit));
    std::vector<ElementRow> rows;
    for (const LinePtr& line : document.lines.lines) {
      const QString type = (line->convex() ? tr("convex") : tr("concave")) +
                           (line->closed ? tr(", closed") : QString());
      rows.push_back({line->id,
                      {line->id, type, measured(line->length), shown(line->mean_angle),
                       origin_text(*line), static_cast<int>(line->vertices.size() - 1)},
                      {}});
    }
    tables_.lines->set_rows(std::move(rows));
    fill_partitions_table();
    fit_surfaces();
    fill_boundaries_table();
  }
  show_selection();
}

void ElementsPresenter::fill_boundaries_table() {
  const Boundaries& boundaries = session_->shown().boundaries;
  const SharpLines& lines = session_->shown().document.lines;
  std::vector<ElementRow> rows;
  for (std::uint32_t k = 0; k < boundaries.size(); ++k) {
    const Boundary& b = *boundaries[k];
    const std::string_view name = name_of(b.type);
    QString type = shown_text(name);
    // One value for one line, whichever table says it.
    const Line* line = b.type == BoundaryType::c0 ? lines.find(b.line) : nullptr;
    QVariant radius;
    if (const auto tangent = tangent_.find(k); tangent != tangent_.end()) {
      type += tr(", tangent");
      radius = shown(tangent->second.radius);
    }
    rows.push_back({k + 1,
                    {k + 1, type, measured(b.length), shown(line ? line->mean_angle : b.mean_angle),
                     radius, partition_name(b.left), partition_name(b.right)},
                    {}});
  }
  tables_.boundaries->set_rows(std::move(rows));
}

void ElementsPresenter::fill_partitions_table() {
  const Document& document = session_->shown().document;
  const std::vector<PartitionPtr>& partitions = document.partitions.partitions;
  const std::vector<QColor> colours = colours_of_partitions(document);
  std::vector<ElementRow> rows;
  for (std::size_t k = 0; k < partitions.size(); ++k) {
    const Partition& p = *partitions[k];
    QString type, size;
    QVariant mean, most, within;
    if (const auto known = fitted_.find(&p); known != fitted_.end()) {
      const PartitionSurface& fit = known->second.surface;
      const std::string_view name = name_of(fit.surface.type);
      type = shown_text(name);
      size = QString::fromStdString(size_text(fit.surface, length_unit_of(document)));
      if (fit.fitted) {
        mean = shown(fit.mean_deviation);
        most = shown(fit.max_deviation);
        within = shown(100.0 * fit.within);
      }
    }
    rows.push_back({p.id,
                    {p.id, type, size, mean, most, within, sides_[p.id], measured(p.area), p.faces,
                     shown(p.mean_value), interval_text(p.interval)},
                    colours[k]});
  }
  tables_.partitions->set_rows(std::move(rows));
}

void ElementsPresenter::fit_surfaces() {
  surfaces_work_.cancel();
  const Document& document = session_->shown().document;
  const std::vector<PartitionPtr>& partitions = document.partitions.partitions;
  std::unordered_map<const Partition*, Fitted> kept;
  for (const PartitionPtr& p : partitions)
    if (const auto known = fitted_.find(p.get()); known != fitted_.end()) kept.insert(*known);
  fitted_ = std::move(kept);
  struct Found {
    std::vector<PartitionSurface> surfaces;
    std::vector<Outline> outlines;
    std::vector<TangentLine> tangent;
  };
  std::vector<PartitionSurface> known;  // empty: not all are
  if (fitted_.size() == partitions.size())
    for (const PartitionPtr& p : partitions) known.push_back(fitted_.at(p.get()).surface);
  surfaces_work_.start(
      [document, known = std::move(known)](const Context& context) {
        Found found;
        found.outlines = outlines_of(*document.mesh, document.lines, document.partitions);
        if (context.cancelled() || !document.boundaries) return found;
        found.surfaces = known;
        if (known.empty()) {
          auto fitted =
              fit_partition_surfaces(*document.mesh, document.lines, document.partitions, context);
          if (!fitted) return found;
          found.surfaces = std::move(*fitted);
        }
        auto tangent = find_tangent_lines(*document.mesh, document.partitions, *document.boundaries,
                                          found.surfaces, {}, context);
        if (tangent) found.tangent = std::move(*tangent);
        return found;
      },
      [this, partitions](const Found& found) {
        sides_.clear();
        for (std::size_t k = 0; k < partitions.size(); ++k) {
          const Outline& outline = found.outlines[k];
          sides_[partitions[k]->id] = outline.loops.size() == 1 && outline.handles == 0
                                          ? QVariant(static_cast<int>(outline.sides()))
                                          : QVariant(QString::fromStdString(outline.text()));
          if (!found.surfaces.empty())
            fitted_.insert_or_assign(partitions[k].get(), Fitted{partitions[k], found.surfaces[k]});
        }
        tangent_.clear();
        for (const TangentLine& line : found.tangent) tangent_[line.boundary] = line;
        if (!session_->is_previewing()) {
          fill_partitions_table();
          if (!tangent_.empty()) fill_boundaries_table();
          if (!tangent_.empty() && tangent_lines_shown_) show_lines();
        }
        show_selection();
      });
}

void ElementsPresenter::show_selection() {
  const ShownDocument& snapshot = session_->shown();
  Ids shown_lines = lines_;
  for (const std::uint32_t k : boundaries_) {
    const Boundary& boundary = *snapshot.boundaries[k - 1];
    shown_lines.insert(boundary.type == BoundaryType::c0 ? boundary.line : first_boundary + k - 1);
  }
  view_->set_selected_lines(shown_lines);
  Ids labels;
  const std::vector<PartitionPtr>& partitions = snapshot.document.partitions.partitions;
  for (std::uint32_t k = 0; k < partitions.size(); ++k)
    if (partitions_.contains(partitions[k]->id)) labels.insert(k + 1);
  view_->set_selected_labels(labels);
  tables_.lines->set_selected(lines_);
  tables_.partitions->set_selected(partitions_);
  tables_.boundaries->set_selected(boundaries_);
}

void ElementsPresenter::clicked(const std::optional<Pick>& pick, bool toggle) {
  const Document& document = session_->shown().document;
  Ids* chosen = nullptr;
  std::uint32_t id = 0;
  if (pick && pick->line >= first_boundary) {
    chosen = &boundaries_;
    id = pick->line - first_boundary + 1;
  } else if (pick && pick->line != 0) {
    chosen = &lines_;
    id = pick->line;
  } else if (pick && partitions_shown_ && pick->face != no_id) {
    id = document.partitions.label(pick->face);
    if (id != 0) chosen = &partitions_;
  }
  if (!toggle || !chosen) {
    const bool again = chosen && chosen->size() == 1 && chosen->contains(id);
    if (again) return;
    clear_sets();
  }
  if (chosen && !chosen->insert(id).second) chosen->erase(id);
  show_selection();
  emit selection_changed();
}

void ElementsPresenter::banded(const std::vector<std::uint32_t>& line_ids, bool toggle) {
  if (!toggle) clear_sets();
  for (const std::uint32_t id : line_ids) {
    const bool is_line = id < first_boundary;
    Ids& chosen = is_line ? lines_ : boundaries_;
    const std::uint32_t number = is_line ? id : id - first_boundary + 1;
    if (!chosen.insert(number).second) chosen.erase(number);
  }
  show_selection();
  emit selection_changed();
}

void ElementsPresenter::select_at(const std::optional<Pick>& pick) {
  if (!pick) return;
  const Partitions& partitions = session_->shown().document.partitions;
  const std::uint32_t partition = pick->face == no_id ? 0 : partitions.label(pick->face);
  const bool selected = pick->line >= first_boundary
                            ? boundaries_.contains(pick->line - first_boundary + 1)
                        : pick->line != 0 ? lines_.contains(pick->line)
                                          : partitions_.contains(partition);
  if (!selected) clicked(pick, false);
}

void ElementsPresenter::hide_selected() {
  if (partitions_.empty()) return;
  hidden_.insert(partitions_.begin(), partitions_.end());
  show_visibility();
  clear_selection();
  emit visibility_changed();
}

void ElementsPresenter::isolate_selected() {
  if (partitions_.empty()) return;
  isolated_ = partitions_;
  hidden_.clear();
  show_visibility();
  clear_selection();
  emit visibility_changed();
}

void ElementsPresenter::show_all() {
  hidden_.clear();
  isolated_.clear();
  show_visibility();
  emit visibility_changed();
}

void ElementsPresenter::show_visibility() {
  scan_work_.cancel();
  if (!hides_any()) {
    view_->set_hidden_faces({});
    view_->set_hidden_reference_faces({});
    return;
  }
  const Document& document = session_->shown().document;
  const auto& labels = document.partitions.labels;
  std::vector<bool> hidden(labels.size());
  for (FaceId f = 0; f < hidden.size(); ++f) hidden[f] = hides(labels[f]);
  view_->set_hidden_faces(std::move(hidden));
  if (document.mesh == document.opened.mesh) return;
  // On the scan, which may be shown instead: takes most of a second for a million faces.
  std::vector<bool> hides_id(document.next_id);
  for (std::uint32_t id = 0; id < hides_id.size(); ++id) hides_id[id] = hides(id);
  scan_work_.start(
      [document, hides_id](const Context&) {
        const std::vector<std::uint32_t> on_scan = labels_on_scan(document);
        std::vector<bool> result(document.opened.mesh->face_count());
        for (FaceId f = 0; f < result.size(); ++f)
          result[f] = hides_id[on_scan[document.scan_faces ? (*document.scan_faces)[f] : f]];
        return result;
      },
      [this](std::vector<bool> result) { view_->set_hidden_reference_faces(std::move(result)); });
}

nlohmann::json ElementsPresenter::saved_visibility() const {
  const auto sorted = [](const Ids& ids) {
    return std::set<std::uint32_t>(ids.begin(), ids.end());
  };
  return {{"hidden", sorted(hidden_)}, {"isolated", sorted(isolated_)}};
}

void ElementsPresenter::restore_visibility(const nlohmann::json& saved) {
  const Document& document = session_->shown().document;
  const auto ids = [&](const char* key) {
    Ids found;
    const auto list = saved.find(key);
    if (list == saved.end() || !list->is_array()) return found;
    for (const nlohmann::json& id : *list)
      if (id.is_number_unsigned() && id.get<std::uint64_t>() <= 0xFFFFFFFFu &&
          document.partitions.find(id.get<std::uint32_t>()))
        found.insert(id.get<std::uint32_t>());
    return found;
  };
  hidden_ = ids("hidden");
  isolated_ = ids("isolated");
  show_visibility();
  emit visibility_changed();
}

void ElementsPresenter::clear_sets() {
  lines_.clear();
  partitions_.clear();
  boundaries_.clear();
}

void ElementsPresenter::clear_selection() {
  clear_sets();
  show_selection();
  emit selection_changed();
}

void ElementsPresenter::select(const Ids& lines, const Ids& partitions) {
  const Document& document = session_->shown().document;
  clear_sets();
  lines_ = lines;
  partitions_ = partitions;
  drop_gone(lines_, [&](std::uint32_t id) { return document.lines.find(id); });
  drop_gone(partitions_, [&](std::uint32_t id) { return document.partitions.find(id); });
  show_selection();
  emit selection_changed();
}

std::vector<VertexId> ElementsPresenter::place_of_selection() const {
  const ShownDocument& snapshot = session_->shown();
  std::vector<VertexId> vertices;
  const auto add = [&](const auto& more) {
    vertices.insert(vertices.end(), more.begin(), more.end());
  };
  for (const std::uint32_t id : lines_)
    if (const Line* line = snapshot.document.lines.find(id)) add(line->vertices);
  for (const std::uint32_t k : boundaries_) add(snapshot.boundaries[k - 1]->vertices);
  if (!partitions_.empty())
    for (FaceId f = 0; f < snapshot.document.partitions.labels.size(); ++f)
      if (partitions_.contains(snapshot.document.partitions.labels[f]))
        add(snapshot.document.mesh->triangle(f));
  return vertices;
}

void ElementsPresenter::zoom_to_selection() {
  const std::vector<VertexId> place = place_of_selection();
  if (!place.empty()) view_->show_place(place);
}

void ElementsPresenter::bring_into_sight() {
  const std::vector<VertexId> place = place_of_selection();
  if (!place.empty() && !view_->sees(place)) view_->show_place(place);
}

}  // namespace arris::ui
