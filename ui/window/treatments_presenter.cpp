#include "ui/window/treatments_presenter.h"

#include <algorithm>
#include <cmath>

#include <QAction>
#include <QMenu>
#include <QShortcut>

#include "core/sharp_lines/interactive_treatments.h"
#include "ui/panels/controls.h"
#include "ui/window/actions.h"
#include "ui/window/unit_suffix.h"

namespace arris::ui {

using nlohmann::json;

namespace {

const Parameter& parameter_of(std::string_view operation, std::string_view name) {
  return *find_operation(operation)->find(name);
}

/// The slider of a parameter of the operation table.
TreatmentBar::Number number_of(std::string_view operation, std::string_view name, double value) {
  const Parameter& parameter = parameter_of(operation, name);
  const bool whole = parameter.kind == ParameterKind::whole;
  const double low = parameter.to > 0.0 ? parameter.from : parameter.least;
  const double high = parameter.to > 0.0 ? parameter.to : parameter.most;
  const QString unit = shown_text(parameter.unit);
  return {low,
          high,
          std::clamp(std::round(value), low, high),
          parameter.logarithmic,
          whole ? " " + unit : unit,
          shown_text(parameter.help) + " " +
              TreatmentsPresenter::tr("Drag or type: the part follows; Enter accepts."),
          whole};
}

TreatmentBar::Choice choice_of(std::string_view operation, std::string_view name) {
  const Parameter& parameter = parameter_of(operation, name);
  TreatmentBar::Choice choice{{}, shown_text(parameter.help)};
  for (const ParameterChoice& one : parameter.choices) choice.texts << shown_text(one.label);
  return choice;
}

/// The key of what is chosen in a choice_of().
std::string_view chosen_in(std::string_view operation, std::string_view name, int place) {
  return parameter_of(operation, name).choices[static_cast<std::size_t>(std::max(place, 0))].key;
}

}  // namespace

TreatmentsPresenter::TreatmentsPresenter(Session* session, MeshView* view,
                                         ElementsPresenter* elements, TreatmentBar* bar,
                                         QObject* parent)
    : QObject(parent), session_(session), view_(view), elements_(elements), bar_(bar) {
  bar_->hide();
  accept_key_ = new QShortcut(Qt::Key_Return, bar_->parentWidget());
  cancel_key_ = new QShortcut(Qt::Key_Escape, bar_->parentWidget());
  for (QShortcut* key : {accept_key_, cancel_key_}) key->setEnabled(false);
  connect(accept_key_, &QShortcut::activated, this, &TreatmentsPresenter::accept);
  connect(cancel_key_, &QShortcut::activated, this, &TreatmentsPresenter::stop);
  connect(bar_, &TreatmentBar::changed, this, &TreatmentsPresenter::preview);
  connect(bar_, &TreatmentBar::accepted, this, &TreatmentsPresenter::accept);
  // A click on the part takes what is shown.
  connect(view_, &MeshView::clicked, this, [this] {
    if (running_ && session_->is_previewing()) accept();
  });
  connect(bar_, &TreatmentBar::cancelled, this, &TreatmentsPresenter::stop);

  connect(session_, &Session::changed, this, [this](bool other_mesh) {
    if (running_ && session_->is_previewing()) show_result();
    if (other_mesh && !session_->is_previewing()) stop();  // its points are of the mesh before
    refresh();
  });
  // Undo, F5, F7 and others close the bar: it never stands over what it was not made for.
  connect(session_, &Session::preview_cancelled, this, [this] {
    if (running_) stop();
  });
  connect(session_, &Session::busy_changed, this, &TreatmentsPresenter::refresh);
  connect(session_, &Session::preview_refused, this, [this](const QString& why) {
    if (running_) bar_->set_result(why, true);
  });
  connect(elements_, &ElementsPresenter::selection_changed, this, &TreatmentsPresenter::refresh);

  connect(view_, &MeshView::path_point, this, [this](const Pick& pick) {
    if (on_point_) on_point_(pick);
  });
  connect(view_, &MeshView::path_hover, this, [this](const Pick& pick) {
    if (path_preview_ && !points_.empty() && pick.vertex != no_id && pick.vertex != points_.back())
      session_->preview(path_preview_(pick.vertex));
  });
  connect(view_, &MeshView::path_done, this, [this] {
    if (on_path_done_) on_path_done_();
  });
  connect(view_, &MeshView::path_back, this, [this] {
    if (!path_preview_ || points_.empty()) return;
    points_.pop_back();
    if (points_.size() < 2) session_->cancel_preview();
    show_points();
  });
  connect(view_, &MeshView::tool_left, this, &TreatmentsPresenter::stop);
  connect(view_, &MeshView::brushed, this,
          [this](const std::vector<VertexId>& stroke, double radius) {
            if (on_brushed_ && !stroke.empty())
              on_brushed_(json{{"vertices", stroke}, {"radius", radius}});
          });
  connect(view_, &MeshView::line_grabbed, this, [this](std::uint32_t line, VertexId vertex) {
    grabbed_line_ = line;
    grabbed_vertex_ = vertex;
  });
  const auto rerouted = [this](VertexId via) -> std::optional<Operation> {
    const Document& document = session_->current().document;
    const Line* line = document.lines.find(grabbed_line_);
    if (!line || via == grabbed_vertex_) return {};
    const double distance =
        (document.mesh->point(via) - document.mesh->point(grabbed_vertex_)).norm();
    const auto [from, to] = stretch_round(*document.mesh, *line, grabbed_vertex_, distance);
    return Operation{"reroute_line",
                     {{"line", grabbed_line_}, {"from", from}, {"to", to}, {"via", via}}};
  };
  connect(view_, &MeshView::line_dragged, this, [this, rerouted](VertexId via) {
    if (const auto operation = rerouted(via); operation && !session_->busy())
      session_->preview(*operation);
  });
  connect(view_, &MeshView::line_dropped, this, [this, rerouted](VertexId via) {
    const auto operation = rerouted(via);
    if (operation && !session_->busy())
      session_->commit_preview(*operation);
    else
      session_->cancel_preview();
  });
}

// ---- menus ----

void TreatmentsPresenter::add(QMenu* menu, std::vector<Entry>& entries, const QString& text,
                              const QString& shortcut, const QString& tooltip,
                              std::function<QString()> why_not, std::function<void()> run) {
  QAction* a = action(menu, text, QKeySequence(shortcut), tooltip);
  connect(a, &QAction::triggered, this, std::move(run));
  entries.push_back({a, std::move(why_not)});
}

void TreatmentsPresenter::add_line_actions(QMenu* menu) {
  const auto lines = [this](std::size_t least, std::size_t most) {
    return [this, least, most] { return needs_lines(least, most); };
  };
  const auto open_lines = [this](std::size_t least, std::size_t most) {
    return [this, least, most]() -> QString {
      const QString why = needs_lines(least, most);
      if (!why.isEmpty()) return why;
      for (const std::uint32_t id : elements_->selected_lines())
        if (session_->current().document.lines.find(id)->closed)
          return tr("A closed line has no end.");
      return {};
    };
  };
  const auto part = [this] { return needs_part(); };
  add(menu, line_actions_, tr("&Extend…"), "X",
      tr("The ends of the selected line go on under an angle of their own"), open_lines(1, 1),
      [this] { extend_line(); });
  add(menu, line_actions_, tr("&Merge…"), "J",
      tr("Joins two selected lines over the gap between them"), open_lines(2, 2),
      [this] { merge(); });
  add(menu, line_actions_, tr("&Draw"), "D",
      tr("Draws a line through clicked points; it snaps to sharp edges"), part, [this] { draw(); });
  add(menu, line_actions_, tr("&Trim…"), "T",
      tr("Takes away the part of the selected line beyond a clicked vertex"), open_lines(1, 1),
      [this] { trim(); });
  add(menu, line_actions_, tr("&Split"), "Shift+S",
      tr("Makes two lines of the selected one at a clicked vertex"), lines(1, 1),
      [this] { split_line(); });
  add(menu, line_actions_, tr("Re&route"), "G",
      tr("Drag a point of any line: the line runs through where it is let go"), part,
      [this] { reroute(); });
  menu->addSeparator();
  add(menu, line_actions_, tr("Re&compute selected…"), "Q",
      tr("Finds the selected lines again under an angle of their own"), lines(1, no_id),
      [this] { recompute_lines(); });
  add(menu, line_actions_, tr("Recompute in a &brushed region…"), "Shift+Q",
      tr("Brush over the part: lines inside are found again under an angle of their own"), part,
      [this] {
        brush("recompute_lines", tr("Brush where lines are to be found again"),
              [this](json region) {
                tune(
                    tr("Recompute lines in the region"),
                    [this, region] {
                      return Operation{"recompute_lines",
                                       {{"region", region}, {"angle", bar_->value()}}};
                    },
                    number_of("recompute_lines", "angle", angle_in_force()));
              });
      });
  menu->addSeparator();
  add(
      menu, line_actions_, tr("De&lete"), "Del",
      tr("Deletes what is selected; it stays deleted when lines or partitions are found again"),
      [this]() -> QString {
        return elements_->selected_lines().empty() && elements_->selected_partitions().empty()
                   ? tr("Select a line or a partition first.")
                   : QString();
      },
      [this] { delete_selected(); });
  const auto anything = [this]() -> QString {
    return elements_->selected_lines().empty() && elements_->selected_partitions().empty()
               ? tr("Select a line or a partition first.")
               : QString();
  };
  add(menu, line_actions_, tr("Loc&k"), "K",
      tr("Approves what is selected: no finding changes it any more"), anything,
      [this] { lock(true); });
  add(
      menu, line_actions_, tr("&Unlock"), "Shift+K", tr("What is selected may change again"),
      [this, anything]() -> QString {
        const QString why = anything();
        return !why.isEmpty()  ? why
               : !any_locked() ? tr("Nothing that is selected is locked.")
                               : QString();
      },
      [this] { lock(false); });
  refresh();
}

void TreatmentsPresenter::add_partition_actions(QMenu* menu) {
  const auto partitions = [this](std::size_t least, std::size_t most) {
    return [this, least, most] { return needs_partitions(least, most); };
  };
  const auto found = [this] { return needs_found_partitions(); };
  add(menu, partition_actions_, tr("&Connect…"), "Shift+J",
      tr("Makes one of the selected adjacent partitions"), partitions(2, no_id),
      [this] { connect_partitions(); });
  add(
      menu, partition_actions_, tr("&Extend…"), "Shift+E",
      tr("The selected partitions grow over their undefined boundaries under an interval of their "
         "own"),
      [this]() -> QString {
        const QString why = needs_partitions(1, no_id);
        if (!why.isEmpty()) return why;
        const auto& ids = elements_->selected_partitions();
        for (const BoundaryPtr& b : session_->current().boundaries)
          if (b->type == BoundaryType::undefined &&
              (ids.contains(b->left) || ids.contains(b->right)))
            return {};
        return tr("Nothing unassigned lies beside it: there is nothing to extend into.");
      },
      [this] { extend_partition(); });
  add(menu, partition_actions_, tr("&Restart…"), "Shift+R",
      tr("Finds the selected partitions, and what is unassigned round them, under another "
         "interval"),
      partitions(1, no_id), [this] { restart_partitions(); });
  add(menu, partition_actions_, tr("S&plit along a path"), "Shift+D",
      tr("Parts the selected partition along a path through clicked points"), partitions(1, 1),
      [this] { split_partition(); });
  menu->addSeparator();
  add(menu, partition_actions_, tr("Paint &into"), "Shift+P",
      tr("Brushed faces join the selected partition; the brush stops at sharp lines"),
      partitions(1, 1), [this] {
        brush("paint_partition", tr("Paint faces into partition %1").arg(*one_partition()),
              [this](json region) {
                const auto id = one_partition();
                if (!id) return;
                run_now({"paint_partition", {{"partition", *id}, {"region", region}}});
              });
      });
  add(menu, partition_actions_, tr("Paint &out"), "Shift+U",
      tr("Brushed faces belong to no partition any more"), found, [this] {
        brush("paint_partition", tr("Paint faces out of their partitions"), [this](json region) {
          run_now({"paint_partition", {{"partition", 0u}, {"region", region}}});
        });
      });
  add(
      menu, partition_actions_, tr("Find again in a &brushed region…"), "Shift+G",
      tr("Brush over the part: partitions inside are found again under an interval of their own"),
      [this] { return needs_part(); },
      [this] {
        brush("recompute_partitions", tr("Brush where partitions are to be found again"),
              [this](json region) {
                tune(
                    tr("Partitions in the region up to Kmax"),
                    [this, region] {
                      return Operation{"recompute_partitions",
                                       {{"region", region}, {"interval", {0.0, bar_->value()}}}};
                    },
                    curvature_number(0.0));
              });
      });
  menu->addSeparator();
  add(menu, partition_actions_, tr("&Smooth boundaries"), "Shift+B",
      tr("Takes the teeth off the boundaries of the selected partitions, or of all"), found,
      [this] {
        run_now({"smooth_boundaries", {{"partitions", selected_partitions()}}});
      });
  add(menu, partition_actions_, tr("Cut into &four sides"), "Shift+W",
      tr("Cuts the selected partitions, or all, so that none has more than four sides or a hole"),
      found, [this] {
        const auto chosen = selected_partitions();
        run_now({"split_to_four_sides",
                 chosen.empty() ? json::object() : json{{"partitions", chosen}}});
      });
  add(menu, partition_actions_, tr("Remove s&mall ones…"), "Shift+M",
      tr("Partitions under a number of faces go to their neighbours, or are removed"), found,
      [this] { remove_small(); });
  add(
      menu, partition_actions_, tr("Fi&ll the unassigned…"), "Shift+I",
      tr("Areas in no partition go to the neighbours they belong to: by curvature, then by the "
         "longest border"),
      [this]() -> QString {
        const QString why = needs_found_partitions();
        if (!why.isEmpty()) return why;
        const auto& labels = session_->current().document.partitions.labels;
        for (FaceId f = 0; f < labels.size(); ++f)
          if (labels[f] == 0) return {};
        return tr("Every face is in a partition.");
      },
      [this] { fill_unassigned(); });
  refresh();
}

QList<QAction*> TreatmentsPresenter::available(const std::vector<Entry>& entries) const {
  QList<QAction*> actions;
  for (const Entry& entry : entries)
    if (entry.action->isEnabled()) actions.push_back(entry.action);
  return actions;
}

void TreatmentsPresenter::refresh() {
  for (const std::vector<Entry>* entries : {&line_actions_, &partition_actions_})
    for (const Entry& entry : *entries) {
      const QString why = session_->busy()                       ? tr("Work is going on.")
                          : session_->current().document.empty() ? needs_part()
                                                                 : entry.why_not();
      set_available(entry.action, why.isEmpty(), why);
    }
}

// ---- what can be done ----

std::optional<std::uint32_t> TreatmentsPresenter::one_line() const {
  const auto& ids = elements_->selected_lines();
  return ids.size() == 1 ? std::optional(*ids.begin()) : std::nullopt;
}

std::optional<std::uint32_t> TreatmentsPresenter::one_partition() const {
  const auto& ids = elements_->selected_partitions();
  return ids.size() == 1 ? std::optional(*ids.begin()) : std::nullopt;
}

json TreatmentsPresenter::selected_lines() const {
  std::vector<std::uint32_t> ids(elements_->selected_lines().begin(),
                                 elements_->selected_lines().end());
  std::sort(ids.begin(), ids.end());
  return ids;
}

json TreatmentsPresenter::selected_partitions() const {
  std::vector<std::uint32_t> ids(elements_->selected_partitions().begin(),
                                 elements_->selected_partitions().end());
  std::sort(ids.begin(), ids.end());
  return ids;
}

QString TreatmentsPresenter::needs_part() const {
  return session_->current().document.empty() ? tr("Open a part first.") : QString();
}

QString TreatmentsPresenter::needs_found_partitions() const {
  return session_->current().document.partitions.labels.empty() ? tr("Find partitions first.")
                                                                : QString();
}

QString TreatmentsPresenter::needs_lines(std::size_t least, std::size_t most) const {
  const auto& ids = elements_->selected_lines();
  for (const std::uint32_t id : ids)
    if (!session_->current().document.lines.find(id)) return tr("Accept or cancel first.");
  if (ids.size() >= least && ids.size() <= most) return {};
  return least == 1 && most == 1 ? tr("Select one line first.")
         : least == 2            ? tr("Select two lines first: click one, Ctrl-click the other.")
                                 : tr("Select a line first.");
}

QString TreatmentsPresenter::needs_partitions(std::size_t least, std::size_t most) const {
  const auto& ids = elements_->selected_partitions();
  for (const std::uint32_t id : ids)
    if (!session_->current().document.partitions.find(id)) return tr("Accept or cancel first.");
  if (ids.size() >= least && ids.size() <= most) return {};
  return least == 1 && most == 1 ? tr("Select one partition first.")
         : least == 2 ? tr("Select two partitions first: click one, Ctrl-click the other.")
                      : tr("Select a partition first.");
}

bool TreatmentsPresenter::any_locked() const {
  const Document& document = session_->current().document;
  for (const std::uint32_t id : elements_->selected_lines())
    if (const Line* line = document.lines.find(id); line && line->locked) return true;
  for (const std::uint32_t id : elements_->selected_partitions())
    if (const Partition* p = document.partitions.find(id); p && p->locked) return true;
  return false;
}

double TreatmentsPresenter::angle_in_force() const {
  return session_->current_parameters("find_sharp_lines").value("angle", 30.0);
}

TreatmentBar::Number TreatmentsPresenter::curvature_number(double value) const {
  // From the distribution in force: its largest bound up to where nearly everything passes.
  double bound = 0.0;
  const json parameters = session_->current_parameters("find_partitions");
  for (const auto& interval : parameters.value("intervals", json::array()))
    for (const auto& end : interval)
      if (end.is_number()) bound = std::max(bound, end.get<double>());
  if (!(bound > 0.0)) bound = 1.0;
  const double low = bound * 1e-3, high = bound * 1e3;
  return {low,
          high,
          std::clamp(round_significant(value > 0.0 ? value : bound, 2), low, high),
          true,
          "",
          tr("Kmax: the largest value of the criterion. Drag or type: the partition follows; Enter "
             "accepts.")};
}

// ---- tuning ----

void TreatmentsPresenter::run_now(Operation operation) {
  if (!session_->busy()) session_->run({std::move(operation)});
}

void TreatmentsPresenter::tune(const QString& name, std::function<Operation()> operation,
                               const std::optional<TreatmentBar::Number>& number,
                               const std::optional<TreatmentBar::Choice>& choice) {
  running_ = std::move(operation);
  bar_->show_treatment(name, number ? &*number : nullptr, choice ? &*choice : nullptr);
  in_use_ = QString::fromStdString(running_().name);
  bar_->show();
  for (QShortcut* key : {accept_key_, cancel_key_}) key->setEnabled(true);
  preview();
}

void TreatmentsPresenter::preview() {
  if (running_ && !session_->busy()) session_->preview(running_());
}

void TreatmentsPresenter::accept() {
  if (!running_ || session_->busy()) return;
  bar_->take_typed();
  const Operation operation = running_();
  running_ = nullptr;
  session_->commit_preview(operation);
  stop();
}

void TreatmentsPresenter::stop() {
  const bool had_preview = running_ || path_preview_ || grabbed_line_ != 0;
  running_ = nullptr;
  in_use_.clear();
  on_point_ = nullptr;
  path_preview_ = nullptr;
  on_path_done_ = nullptr;
  on_brushed_ = nullptr;
  grabbed_line_ = 0;
  points_.clear();
  view_->set_picked_points({});
  for (QShortcut* key : {accept_key_, cancel_key_}) key->setEnabled(false);
  bar_->hide();
  if (had_preview && session_->is_previewing()) session_->cancel_preview();
  if (view_->tool() != Tool::select) view_->set_tool(Tool::select);
  refresh();
}

void TreatmentsPresenter::use(const char* operation) {
  stop();
  in_use_ = operation;
}

void TreatmentsPresenter::show_result() {
  const Document &before = session_->current().document, &after = session_->shown().document;
  const LengthUnit unit = length_unit_of(after);
  double length_before = 0.0, length_after = 0.0;
  for (const LinePtr& line : before.lines.lines) length_before += line->length;
  for (const LinePtr& line : after.lines.lines) length_after += line->length;
  QStringList parts;
  if (before.lines.lines != after.lines.lines) {
    const double change = length_after - length_before;
    parts << tr("lines %1%2, %3 → %4")
                 .arg(change < 0.0 ? "−" : "+",
                      shown_number(std::abs(change), 3) + unit_in_sentence(unit))
                 .arg(before.lines.lines.size())
                 .arg(after.lines.lines.size());
  }
  if (before.partitions.partitions != after.partitions.partitions) {
    double area_before = 0.0, area_after = 0.0;
    for (const PartitionPtr& p : before.partitions.partitions) area_before += p->area;
    for (const PartitionPtr& p : after.partitions.partitions) area_after += p->area;
    const double change = area_after - area_before;
    QString text = tr("partitions %1 → %2")
                       .arg(before.partitions.partitions.size())
                       .arg(after.partitions.partitions.size());
    constexpr double rounding = 1e-9;
    if (std::abs(change) > rounding * area_before)
      text += tr(", area %1%2")
                  .arg(change < 0.0 ? "−" : "+",
                       shown_number(std::abs(change), 3) + unit_in_sentence(unit, 2));
    parts << text;
  }
  bar_->set_result(parts.isEmpty() ? tr("nothing changes") : parts.join("; "), false);
}

// ---- lines ----

void TreatmentsPresenter::delete_selected() {
  std::vector<Operation> operations;
  if (const json ids = selected_lines(); !ids.empty())
    operations.push_back({"delete_lines", {{"lines", ids}}});
  if (const json ids = selected_partitions(); !ids.empty())
    operations.push_back({"remove_partitions", {{"partitions", ids}}});
  if (!operations.empty() && !session_->busy()) session_->run(std::move(operations));
}

void TreatmentsPresenter::extend_line() {
  const std::uint32_t id = *one_line();
  tune(
      tr("Extend line %1").arg(id),
      [this, id] {
        return Operation{"extend_line",
                         {{"line", id},
                          {"angle", bar_->value()},
                          {"ends", chosen_in("extend_line", "ends", bar_->choice())}}};
      },
      number_of("extend_line", "angle", 0.75 * angle_in_force()), choice_of("extend_line", "ends"));
}

void TreatmentsPresenter::merge() {
  const json ids = selected_lines();
  tune(tr("Merge lines %1 and %2").arg(ids[0].get<int>()).arg(ids[1].get<int>()),
       [ids] {
         return Operation{"merge_lines", {{"a", ids[0]}, {"b", ids[1]}}};
       },
       {});
}

void TreatmentsPresenter::draw() {
  use("draw_line");
  path_preview_ = [this](VertexId v) {
    std::vector<VertexId> points = points_;
    points.push_back(v);
    return Operation{"draw_line", {{"vertices", points}}};
  };
  on_point_ = [this](const Pick& pick) { add_point(pick); };
  on_path_done_ = [this] {
    if (points_.size() < 2 || session_->busy()) return;
    const Operation operation{"draw_line", {{"vertices", points_}}};
    path_preview_ = nullptr;
    session_->commit_preview(operation);
    stop();
  };
  view_->set_tool(Tool::path,
                  tr("Click points; snaps to sharp edges. Enter ends, Backspace takes back."));
}

void TreatmentsPresenter::add_point(const Pick& pick) {
  if (pick.vertex == no_id || (!points_.empty() && points_.back() == pick.vertex)) return;
  points_.push_back(pick.vertex);
  show_points();
}

void TreatmentsPresenter::show_points() {
  std::vector<Point> marks;
  for (const VertexId v : points_) marks.push_back(session_->current().document.mesh->point(v));
  view_->set_picked_points(marks);
}

void TreatmentsPresenter::trim() {
  const std::uint32_t id = *one_line();
  use("trim_line");
  on_point_ = [this, id](const Pick& pick) {
    const Document& document = session_->current().document;
    const Line* line = document.lines.find(id);
    if (!line) return;
    const VertexId vertex = nearest_on(*document.mesh, *line, pick.point);
    const auto place =
        std::find(line->vertices.begin(), line->vertices.end(), vertex) - line->vertices.begin();
    const bool first_is_shorter = 2 * place < static_cast<std::ptrdiff_t>(line->vertices.size());
    view_->set_tool(Tool::select);
    const TreatmentBar::Choice side{{tr("Shorter side goes"), tr("Longer side goes")},
                                    tr("Which part of the line is taken away")};
    tune(
        tr("Trim line %1").arg(id),
        [this, id, vertex, first_is_shorter] {
          const bool first = first_is_shorter == (bar_->choice() <= 0);
          return Operation{"trim_line",
                           {{"line", id}, {"vertex", vertex}, {"side", first ? "first" : "last"}}};
        },
        {}, side);
  };
  view_->set_tool(Tool::path, tr("Click where line %1 is to be cut. Esc leaves.").arg(id));
}

void TreatmentsPresenter::split_line() {
  const std::uint32_t id = *one_line();
  use("split_line");
  on_point_ = [this, id](const Pick& pick) {
    const Document& document = session_->current().document;
    const Line* line = document.lines.find(id);
    const VertexId vertex = line ? nearest_on(*document.mesh, *line, pick.point) : no_id;
    stop();
    if (line) run_now({"split_line", {{"line", id}, {"vertex", vertex}}});
  };
  view_->set_tool(Tool::path, tr("Click where line %1 is to be split. Esc leaves.").arg(id));
}

void TreatmentsPresenter::reroute() {
  use("reroute_line");
  view_->set_tool(Tool::move_point,
                  tr("Drag a point of a line to where it is to run. Esc leaves."));
}

void TreatmentsPresenter::recompute_lines() {
  const json ids = selected_lines();
  tune(
      tr("Recompute %n line(s)", nullptr, static_cast<int>(ids.size())),
      [this, ids] {
        return Operation{"recompute_lines", {{"lines", ids}, {"angle", bar_->value()}}};
      },
      number_of("recompute_lines", "angle", angle_in_force()));
}

void TreatmentsPresenter::lock(bool locked) {
  run_now(
      {"lock",
       {{"lines", selected_lines()}, {"partitions", selected_partitions()}, {"locked", locked}}});
}

void TreatmentsPresenter::brush(const char* operation, const QString& hint,
                                std::function<void(json)> take) {
  use(operation);
  on_brushed_ = std::move(take);
  view_->set_tool(Tool::brush, hint + tr(". [ and ] change its size."));
}

// ---- partitions ----

void TreatmentsPresenter::connect_partitions() {
  const json ids = selected_partitions();
  const auto meant = [&](std::uint32_t id) {
    return elements_->selected_partitions().contains(id);
  };
  const Boundaries& boundaries = session_->current().boundaries;
  const bool line_between = std::any_of(boundaries.begin(), boundaries.end(), [&](const auto& b) {
    return b->type == BoundaryType::c0 && b->left != b->right && meant(b->left) && meant(b->right);
  });
  std::optional<TreatmentBar::Choice> lines;
  if (line_between) lines = choice_of("connect_partitions", "lines");
  tune(
      tr("Connect %n partitions", nullptr, static_cast<int>(ids.size())),
      [this, ids] {
        return Operation{"connect_partitions",
                         {{"partitions", ids},
                          {"lines", chosen_in("connect_partitions", "lines", bar_->choice())}}};
      },
      {}, lines);
}

void TreatmentsPresenter::extend_partition() {
  const json ids = selected_partitions();
  double most = 0.0;
  for (const std::uint32_t id : elements_->selected_partitions())
    if (const double end = session_->current().document.partitions.find(id)->interval.max;
        std::isfinite(end))
      most = std::max(most, end);
  tune(
      ids.size() == 1 ? tr("Extend partition %1 up to Kmax").arg(ids[0].get<int>())
                      : tr("Extend %1 partitions up to Kmax").arg(ids.size()),
      [this, ids] {
        return Operation{"extend_partition",
                         {{"partitions", ids}, {"interval", {0.0, bar_->value()}}}};
      },
      curvature_number(most));
}

void TreatmentsPresenter::restart_partitions() {
  const json ids = selected_partitions();
  tune(
      tr("Restart %n partition(s) up to Kmax", nullptr, static_cast<int>(ids.size())),
      [this, ids] {
        return Operation{"restart_partitions",
                         {{"partitions", ids}, {"interval", {0.0, bar_->value()}}}};
      },
      curvature_number(0.0));
}

void TreatmentsPresenter::split_partition() {
  const std::uint32_t id = *one_partition();
  use("split_partition");
  on_point_ = [this](const Pick& pick) { add_point(pick); };
  on_path_done_ = [this, id] {
    if (points_.size() < 2) return;
    const Operation operation{"split_partition", {{"partition", id}, {"vertices", points_}}};
    stop();
    run_now(operation);
  };
  view_->set_tool(
      Tool::path,
      tr("Click from one boundary of partition %1 to another. Enter parts it.").arg(id));
}

void TreatmentsPresenter::remove_small() {
  // Begins where the smallest goes.
  constexpr double usual = 20.0;
  std::uint32_t smallest = 0;
  for (const PartitionPtr& partition : session_->current().document.partitions.partitions)
    if (!partition->locked && (smallest == 0 || partition->faces < smallest))
      smallest = partition->faces;
  tune(
      tr("Remove partitions under"),
      [this] {
        return Operation{"remove_small_partitions",
                         {{"faces", static_cast<std::uint32_t>(std::lround(bar_->value()))},
                          {"fill", bar_->choice() != 1}}};
      },
      number_of("remove_small_partitions", "faces", std::max(usual, smallest + 1.0)),
      TreatmentBar::Choice{{tr("Neighbours take them over"), tr("They leave holes")},
                           tr("What becomes of the faces they had")});
}

void TreatmentsPresenter::fill_unassigned() {
  // Up to all of this part.
  TreatmentBar::Number faces = number_of("fill_unassigned", "faces", 1.0);
  faces.high = std::max<double>(10.0, session_->current().document.partitions.labels.size());
  faces.value = faces.high;
  tune(
      tr("Fill unassigned areas up to"),
      [this] {
        return Operation{"fill_unassigned",
                         {{"faces", static_cast<std::uint32_t>(std::lround(bar_->value()))}}};
      },
      faces);
}

}  // namespace arris::ui
