#include "ui/window/worklist_presenter.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/base/words.h"
#include "ui/panels/controls.h"
#include "ui/window/actions.h"
#include "ui/window/unit_suffix.h"

namespace arris::ui {

namespace {

constexpr int settle_time = 400;  // ms

QString title_of(WorkKind kind) {
  switch (kind) {
    case WorkKind::leak:
      return QObject::tr("Gaps that leak");
    case WorkKind::loose_end:
      return QObject::tr("Loose ends");
    case WorkKind::unassigned_area:
      return QObject::tr("Unassigned areas");
    case WorkKind::undefined_boundary:
      return QObject::tr("Undefined boundaries");
    case WorkKind::many_borders:
      return QObject::tr("To be cut for four-sided patches");
    case WorkKind::sliver:
      return QObject::tr("Slivers");
  }
  return {};
}

QString choice_text(const Continuation& way, LengthUnit unit) {
  const QString length = QString::fromStdString(length_in_words(way.length, unit));
  const QString where = way.line != 0 ? QObject::tr("to line %1").arg(way.line)
                        : way.arrives ? QObject::tr("to the border")
                                      : QObject::tr("fading out");
  return QObject::tr("%1 %2, %3 %")
      .arg(length, where, QString::fromStdString(fixed_text(100.0 * way.score, 0)));
}

/// Names an item for as long as the mesh stays: what it is about keeps its vertices and ids.
std::string key_of(const WorkItem& item) {
  nlohmann::json key{name_of(item.kind)};
  if (item.kind == WorkKind::many_borders || item.kind == WorkKind::sliver)
    key.push_back(item.partitions);
  else if (item.kind == WorkKind::unassigned_area)
    key.push_back(item.face);
  else
    key.push_back(item.vertices);
  return key.dump();
}

/// The ways to settle an item, as the lines or cuts that each of them draws.
std::vector<std::vector<std::vector<VertexId>>> ways_of(const WorkItem& item) {
  std::vector<std::vector<std::vector<VertexId>>> ways;
  if (item.kind == WorkKind::leak || (item.kind == WorkKind::many_borders && !item.paths.empty()))
    ways.push_back(item.paths);
  for (const Continuation& way : item.continuations) ways.push_back({way.vertices});
  return ways;
}

}  // namespace

WorklistPresenter::WorklistPresenter(Session* session, MeshView* view, ElementsPresenter* elements,
                                     WorklistPanel* panel, QObject* parent)
    : QObject(parent),
      session_(session),
      view_(view),
      elements_(elements),
      panel_(panel),
      work_(new LatestWork(this)),
      cuts_(new LatestWork(this)) {
  settle_.setSingleShot(true);
  connect(&settle_, &QTimer::timeout, this, &WorklistPresenter::look);
  connect(session_, &Session::changed, this, &WorklistPresenter::outdate);
  connect(session_, &Session::opened, this, [this] {
    dismissed_.clear();
    leaks_.clear();
  });
  connect(session_, &Session::failed, this, [this] { go_to_ = -1; });
  connect(session_, &Session::busy_changed, this, &WorklistPresenter::refresh_buttons);
  connect(view_, &MeshView::tool_changed, this, [this] { clear_marks(); });
  connect(panel_, &WorklistPanel::current_changed, this,
          [this](int row, int choice) { show(row, choice, true); });
  connect(panel_, &WorklistPanel::next_wanted, this, &WorklistPresenter::next);
  connect(panel_, &WorklistPanel::previous_wanted, this, &WorklistPresenter::previous);
  connect(panel_, &WorklistPanel::accept_wanted, this, &WorklistPresenter::accept);
  connect(panel_, &WorklistPanel::dismiss_wanted, this, &WorklistPresenter::dismiss);
  connect(panel_, &WorklistPanel::dismiss_under_wanted, this, &WorklistPresenter::dismiss_under);
  list();
}

void WorklistPresenter::add_actions(QMenu* menu) {
  connect(action(menu, tr("&Next in the worklist"), QKeySequence("F7"),
                 tr("Zoom to the next thing that is left to do")),
          &QAction::triggered, this, &WorklistPresenter::next);
  connect(action(menu, tr("&Previous in the worklist"), QKeySequence("Shift+F7"),
                 tr("Zoom to the one before")),
          &QAction::triggered, this, &WorklistPresenter::previous);
  accept_action_ =
      action(menu, tr("&Accept"), QKeySequence("A"),
             tr("Draw the line or make the cuts that the worklist proposes, shown dashed"));
  connect(accept_action_, &QAction::triggered, this, &WorklistPresenter::accept);
  dismiss_action_ = action(menu, tr("&Dismiss"), QKeySequence("Shift+A"),
                           tr("Leave it as it is and take it off the worklist, as long as this "
                              "window is open"));
  connect(dismiss_action_, &QAction::triggered, this, &WorklistPresenter::dismiss);
  bring_back_ = action(menu, tr("&Bring back what was dismissed"), {},
                       tr("Put the things taken off the worklist on it again"));
  connect(bring_back_, &QAction::triggered, this, &WorklistPresenter::bring_back);
  refresh_buttons();
}

void WorklistPresenter::set_shown(bool shown) {
  if (shown == shown_) return;
  shown_ = shown;
  if (!shown_) {
    settle_.stop();
    work_->cancel();
    cuts_->cancel();
    clear_marks();
  } else if (!current_) {
    look();
  }
  refresh_buttons();
}

void WorklistPresenter::outdate(bool other_mesh) {
  work_->cancel();
  cuts_->cancel();
  planned_.clear();
  clear_marks();
  if (other_mesh) {  // its vertices are others
    dismissed_.clear();
    leaks_.clear();
  }
  current_ = false;
  if (other_mesh) {
    items_.clear();
    list();
  }
  panel_->set_stale(true);
  refresh_summary();
  if (shown_) settle_.start(go_to_ >= 0 ? 0 : settle_time);
}

void WorklistPresenter::look() {
  if (!shown_ || current_) return;
  if (session_->busy() || session_->is_previewing()) {
    settle_.start(settle_time);
    return;
  }
  work_->start([document = session_->current().document](
                   const Context& context) { return worklist(document, {}, context); },
               [this](Result<std::vector<WorkItem>> found) {
                 if (found) take(std::move(*found));
               });
}

void WorklistPresenter::take(std::vector<WorkItem> items) {
  current_ = true;
  panel_->set_stale(false);
  items_ = std::move(items);
  // Lines drawn since the partitions were found part them already: what leaks can only be told once
  // they are found again. Until then the leaks known before are gone on with.
  const std::optional<Step>& lines = session_->current().document.step("find_sharp_lines");
  if (partitions_out_of_date()) {
    if (lines != leaks_lines_) leaks_.clear();  // through lines that are no more
    std::erase_if(items_, [](const WorkItem& item) { return item.kind == WorkKind::leak; });
    items_.insert(items_.begin(), leaks_.begin(), leaks_.end());
  } else {
    leaks_lines_ = lines;
    leaks_.clear();
    std::copy_if(items_.begin(), items_.end(), std::back_inserter(leaks_),
                 [](const WorkItem& item) { return item.kind == WorkKind::leak; });
  }
  dismissed_here_ = std::erase_if(
      items_, [this](const WorkItem& item) { return dismissed_.contains(key_of(item)); });
  double small = 0.0;
  for (const WorkItem& item : items_)
    if (item.small) small = std::max(small, item.extent);
  const Mesh& mesh = *session_->current().document.mesh;
  panel_->set_small_extent(
      round_significant(std::max(1.001 * small, 2.0 * mesh.mean_edge_length()), 2),
      unit_suffix(session_->current().document));
  list();
  if (const int row = std::exchange(go_to_, -1); row >= 0 && !items_.empty())
    show(std::min(row, static_cast<int>(items_.size()) - 1), 0, true);
}

void WorklistPresenter::list() {
  std::vector<WorkRow> rows;
  const LengthUnit unit = length_unit_of(session_->current().document);
  for (const WorkItem& item : items_) {
    WorkRow row{
        item.small ? tr("Small") : title_of(item.kind), QString::fromStdString(item.sentence), {}};
    for (const Continuation& way : item.continuations) row.choices << choice_text(way, unit);
    rows.push_back(std::move(row));
  }
  panel_->set_rows(std::move(rows));
  refresh_summary();
}

void WorklistPresenter::refresh_summary() {
  const Document& document = session_->current().document;
  QString summary, empty;
  if (document.empty()) {
    empty = tr("Open a scan first.");
  } else if (!document.step("find_sharp_lines") && !document.step("find_partitions")) {
    empty = tr("What is left shows here once sharp lines or partitions were found.");
  } else {
    const auto count = std::ranges::count_if(items_, is_left);
    const qint64 more = static_cast<qint64>(items_.size()) - count;
    QString left = !current_    ? tr("looking for what is left …")
                   : count == 0 ? tr("nothing left")
                   : count == 1 ? tr("1 thing left")
                                : tr("%1 things left").arg(count_text(count));
    if (current_ && more > 0)
      left += more == 1 ? tr("; 1 partition is no four-sided patch")
                        : tr("; %1 partitions are no four-sided patches").arg(count_text(more));
    summary =
        tr("%1 % of the area assigned, %2")
            .arg(QString::fromStdString(fixed_text(100.0 * assigned_share(document), 1)), left);
    if (current_ && dismissed_here_ > 0)
      summary += tr(" (%1 dismissed)").arg(count_text(static_cast<qint64>(dismissed_here_)));
    if (current_ && partitions_out_of_date())
      summary += tr(". Lines have changed since the partitions were found: F5 finds them again.");
    empty = current_ ? tr("Nothing is left to do.") : tr("Looking for what is left …");
  }
  panel_->set_summary(summary, empty);
  refresh_buttons();
}

void WorklistPresenter::step(int by) {
  if (session_->current().document.empty()) return;
  session_->cancel_preview();
  if (!shown_ || !current_) {
    go_to_ = std::max(go_to_, 0);
    emit wanted();
    if (!current_) return;
    go_to_ = -1;
  }
  if (items_.empty()) return;
  const int count = static_cast<int>(items_.size());
  const int row = panel_->current_row();
  show(row < 0 ? (by > 0 ? 0 : count - 1) : (row + by + count) % count, 0, true);
}

void WorklistPresenter::show(int row, int choice, bool zoom) {
  const Document& document = session_->current().document;
  const WorkItem& item = items_[static_cast<std::size_t>(row)];
  panel_->set_current(row, choice);
  // What lies beside an unassigned area is not what is to be looked at.
  const bool of_partitions = item.kind != WorkKind::unassigned_area;
  elements_->select({item.lines.begin(), item.lines.end()},
                    of_partitions
                        ? ElementsPresenter::Ids(item.partitions.begin(), item.partitions.end())
                        : ElementsPresenter::Ids());
  std::vector<std::vector<VertexId>> ghosts;
  std::vector<Point> rings;
  std::vector<VertexId> place = item.vertices;
  const auto ways = ways_of(item);
  for (const auto& way : ways)
    for (const std::vector<VertexId>& path : way) {
      ghosts.push_back(path);
      place.insert(place.end(), path.begin(), path.end());
    }
  if (item.kind == WorkKind::undefined_boundary) ghosts.push_back(item.vertices);
  if (ways.size() > 1)
    for (const std::vector<VertexId>& path : ways[static_cast<std::size_t>(choice)])
      rings.push_back(document.mesh->point(path.back()));
  if (item.kind == WorkKind::unassigned_area)
    rings.push_back(document.mesh->point(document.mesh->triangle(item.face)[0]));
  if (item.kind == WorkKind::loose_end && ways.empty())
    rings.push_back(document.mesh->point(item.vertices.front()));
  view_->set_ghost_paths(std::move(ghosts));
  view_->set_picked_points(std::move(rings));
  marked_ = true;
  if (zoom) view_->show_place(place);
  plan_cuts(row);
  refresh_buttons();
}

void WorklistPresenter::plan_cuts(int row) {
  cuts_->cancel();
  const WorkItem& item = items_[static_cast<std::size_t>(row)];
  if (item.kind != WorkKind::many_borders || planned_.contains(key_of(item))) return;
  cuts_->start([document = session_->current().document,
                item](const Context& context) { return with_cuts(document, item, context); },
               [this, row](Result<WorkItem> planned) {
                 if (!planned || row >= static_cast<int>(items_.size()) ||
                     key_of(items_[static_cast<std::size_t>(row)]) != key_of(*planned))
                   return;
                 planned_.insert(key_of(*planned));
                 panel_->set_text(row, QString::fromStdString(planned->sentence));
                 items_[static_cast<std::size_t>(row)] = std::move(*planned);
                 if (panel_->current_row() == row) show(row, 0, false);
               });
}

bool WorklistPresenter::can_accept() const {
  const int row = panel_->current_row();
  if (!shown_ || !current_ || row < 0 || session_->busy() || session_->is_previewing())
    return false;
  const WorkItem& item = items_[static_cast<std::size_t>(row)];
  // Cuts that are still being worked out are accepted unseen.
  return !ways_of(item).empty() ||
         (item.kind == WorkKind::many_borders && !planned_.contains(key_of(item)));
}

void WorklistPresenter::accept() {
  if (!can_accept()) return;
  const int row = panel_->current_row();
  const WorkItem& item = items_[static_cast<std::size_t>(row)];
  const auto ways = ways_of(item);
  std::vector<Operation> operations;
  if (item.kind == WorkKind::many_borders)
    operations.push_back({"split_to_four_sides", {{"partitions", item.partitions}}});
  else if (const auto& paths = ways[static_cast<std::size_t>(panel_->current_choice())];
           paths.size() == 1)
    operations.push_back({"draw_line", {{"vertices", paths.front()}}});
  else
    operations.push_back({"draw_line", {{"paths", paths}}});  // one entry of the history
  go_to_ = row;                                               // what follows moves up
  const std::string settled = key_of(items_[static_cast<std::size_t>(row)]);
  std::erase_if(leaks_, [&](const WorkItem& leak) { return key_of(leak) == settled; });
  session_->run(std::move(operations));
}

void WorklistPresenter::dismiss() {
  const int row = panel_->current_row();
  if (!current_ || row < 0) return;
  dismissed_.insert(key_of(items_[static_cast<std::size_t>(row)]));
  items_.erase(items_.begin() + row);
  ++dismissed_here_;
  clear_marks();
  list();
  if (!items_.empty()) show(std::min(row, static_cast<int>(items_.size()) - 1), 0, true);
}

void WorklistPresenter::dismiss_under(double extent) {
  if (!current_) return;
  dismissed_here_ += std::erase_if(items_, [&](const WorkItem& item) {
    const bool goes = is_left(item) && item.extent < extent;
    if (goes) dismissed_.insert(key_of(item));
    return goes;
  });
  clear_marks();
  list();
}

void WorklistPresenter::bring_back() {
  dismissed_.clear();
  outdate(false);
  emit wanted();
}

bool WorklistPresenter::partitions_out_of_date() const {
  const std::optional<Step>& step = session_->current().document.step("find_partitions");
  return step && step->out_of_date;
}

void WorklistPresenter::clear_marks() {
  if (!std::exchange(marked_, false)) return;
  view_->set_ghost_paths({});
  view_->set_picked_points({});
}

void WorklistPresenter::refresh_buttons() {
  const bool chosen = current_ && panel_->current_row() >= 0;
  panel_->set_enabled_buttons(current_ && !items_.empty(), can_accept(), chosen);
  if (!accept_action_) return;
  set_available(accept_action_, can_accept(),
                tr("Go to something in the worklist (F7) that has a way on, shown dashed."));
  set_available(dismiss_action_, shown_ && chosen,
                tr("Go to something in the worklist (F7) first."));
  set_available(bring_back_, !dismissed_.empty(), tr("Nothing was dismissed."));
}

}  // namespace arris::ui
