#include "ui/window/section_presenter.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <QActionGroup>

#include "ui/panels/section_bar.h"
#include "ui/window/actions.h"
#include "ui/window/saved_view.h"
#include "ui/window/unit_suffix.h"

namespace arris::ui {

SectionPresenter::SectionPresenter(Session* session, MeshView* view, SectionBar* bar,
                                   QObject* parent)
    : QObject(parent), session_(session), view_(view), bar_(bar) {
  connect(bar_, &SectionBar::moved, this, [this](double position) {
    position_ = position;
    show();
  });
  connect(bar_, &SectionBar::flip_wanted, this, [this] { flip_->trigger(); });
  connect(bar_, &SectionBar::off_wanted, this, [this] { choose(Direction::off); });
  connect(view_, &MeshView::path_point, this, &SectionPresenter::take_point);
  connect(view_, &MeshView::path_back, this, [this] {
    if (!picking_ || picks_.empty()) return;
    picks_.pop_back();
    view_->set_picked_points(picks_);
  });
  connect(view_, &MeshView::tool_changed, this, &SectionPresenter::stop_picking);
  connect(session_, &Session::opened, this, [this] { choose(Direction::off); });
  connect(session_, &Session::changed, this, [this] {
    bar_->set_unit_suffix(unit_suffix(session_->shown().document));
    refresh();
  });
}

void SectionPresenter::add_actions(QMenu* menu) {
  struct Row {
    Direction direction;
    QString text, shortcut, tooltip;
  };
  directions_ = new QActionGroup(this);
  for (const Row& row :
       {Row{Direction::off, tr("&Off"), "Shift+O", tr("Show the whole part")},
        Row{Direction::x, tr("Across &X"), "Shift+X", tr("Cut at right angles to the x axis")},
        Row{Direction::y, tr("Across &Y"), "Shift+Y", tr("Cut at right angles to the y axis")},
        Row{Direction::z, tr("Across &Z"), "Shift+Z", tr("Cut at right angles to the z axis")},
        Row{Direction::view, tr("Across the &view direction"), "Shift+V",
            tr("Cut away what is near to the viewer")},
        Row{Direction::three_points, tr("Through &three points…"), "Shift+T",
            tr("Click three points of the part; the plane goes through them")}}) {
    QAction* a = action(menu, row.text, QKeySequence(row.shortcut), row.tooltip);
    a->setCheckable(true);
    a->setData(static_cast<int>(row.direction));
    a->setChecked(row.direction == Direction::off);
    directions_->addAction(a);
    connect(a, &QAction::triggered, this, [this, d = row.direction] { choose(d); });
  }
  menu->addSeparator();
  flip_ = action(menu, tr("&Flip"), QKeySequence("Shift+F"), tr("Cut away the other side"));
  connect(flip_, &QAction::triggered, this, [this] {
    flipped_ = !flipped_;
    show();
  });
  refresh();
}

void SectionPresenter::choose(Direction direction) {
  if (picking_) view_->set_tool(Tool::select);  // stops the picking
  const Document& document = session_->shown().document;
  if (direction == Direction::off || document.empty()) {
    direction_ = Direction::off;
    show();
    return;
  }
  switch (direction) {
    case Direction::x:
      cut(direction, Point::UnitX());
      break;
    case Direction::y:
      cut(direction, Point::UnitY());
      break;
    case Direction::z:
      cut(direction, Point::UnitZ());
      break;
    case Direction::view:
      cut(direction, view_->towards_viewer());
      break;
    case Direction::three_points:
      view_->set_tool(Tool::path, tr("Section: click three points of the part  ·  Backspace takes "
                                     "the last back  ·  Esc ends"));
      picking_ = true;
      refresh();
      break;
    case Direction::off:
      break;
  }
}

void SectionPresenter::cut(Direction direction, const Point& normal,
                           std::optional<double> position) {
  direction_ = direction;
  axis_ = normal;
  flipped_ = normal.dot(view_->towards_viewer()) < 0.0;
  const Mesh& mesh = *session_->shown().document.mesh;
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const Triangle& t : mesh.triangles()) {
    for (const VertexId v : t) {
      low = std::min(low, axis_.dot(mesh.point(v)));
      high = std::max(high, axis_.dot(mesh.point(v)));
    }
  }
  if (!(high > low)) {  // a flat part, cut along itself
    low -= 0.5;
    high += 0.5;
  }
  position_ = position.value_or((low + high) / 2);
  const QString name = direction == Direction::x      ? "X"
                       : direction == Direction::y    ? "Y"
                       : direction == Direction::z    ? "Z"
                       : direction == Direction::view ? tr("along the view")
                                                      : tr("through points");
  bar_->set_unit_suffix(unit_suffix(session_->shown().document));
  bar_->show_plane(name, low, high, position_);
  show();
}

nlohmann::json SectionPresenter::saved() const {
  return {{"direction", static_cast<int>(direction_)},
          {"axis", {axis_.x(), axis_.y(), axis_.z()}},
          {"position", position_},
          {"flipped", flipped_}};
}

void SectionPresenter::restore(const nlohmann::json& saved) {
  const auto last = static_cast<double>(Direction::three_points);
  const auto direction =
      static_cast<Direction>(static_cast<int>(saved_number(saved, "direction", 0.0, 0.0, last)));
  const std::optional<Point> axis = saved_point(saved, "axis");
  constexpr double rounding = 1e-6;
  if (direction == Direction::off || session_->shown().document.empty() || !axis ||
      !(std::abs(axis->norm() - 1.0) < rounding))
    return choose(Direction::off);
  cut(direction, *axis, saved_number(saved, "position", 0.0));
  flipped_ = saved_flag(saved, "flipped", flipped_);
  show();
}

void SectionPresenter::show() {
  const bool on = direction_ != Direction::off;
  bar_->setVisible(on);
  view_->set_section(
      on ? std::optional(flipped_ ? Section{-axis_, -position_} : Section{axis_, position_})
         : std::nullopt);
  refresh();
}

void SectionPresenter::take_point(const Pick& pick) {
  if (!picking_) return;
  picks_.push_back(pick.point);
  view_->set_picked_points(picks_);
  if (picks_.size() < 3) return;
  const Point normal = (picks_[1] - picks_[0]).cross(picks_[2] - picks_[0]);
  const double longest = std::max((picks_[1] - picks_[0]).norm(), (picks_[2] - picks_[0]).norm());
  constexpr double least = 1e-4;  // height of the triangle over its length
  if (!(normal.norm() > least * longest * longest)) {
    picks_.pop_back();
    view_->set_picked_points(picks_);
    emit message(tr("The three points lie on one line: click another third point."));
    return;
  }
  const Point axis = normal.normalized();
  const double position = axis.dot(picks_.front());
  view_->set_tool(Tool::select);
  cut(Direction::three_points, axis, position);
}

void SectionPresenter::stop_picking() {
  if (!picking_) return;
  picking_ = false;
  picks_.clear();
  view_->set_picked_points({});
  refresh();
}

void SectionPresenter::refresh() {
  if (!directions_) return;
  const bool part = !session_->shown().document.empty();
  const Direction checked = picking_ ? Direction::three_points : direction_;
  for (QAction* a : directions_->actions()) {
    a->setChecked(a->data().toInt() == static_cast<int>(checked));
    set_available(a, part, tr("Open a part first."));
  }
  set_available(flip_, direction_ != Direction::off, tr("There is no section: choose one first."));
}

}  // namespace arris::ui
