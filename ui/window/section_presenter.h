#pragma once

#include <optional>
#include <vector>

#include <QObject>

#include "ui/view/mesh_view.h"
#include "ui/window/session.h"

class QAction;
class QActionGroup;
class QMenu;

namespace arris::ui {

class SectionBar;

/// The section plane: its direction from the menu, its place from the bar.
class SectionPresenter : public QObject {
  Q_OBJECT
 public:
  SectionPresenter(Session* session, MeshView* view, SectionBar* bar, QObject* parent);

  void add_actions(QMenu* menu);
  /// The plane as it stands, as a session keeps it; what cannot be is passed over.
  nlohmann::json saved() const;
  void restore(const nlohmann::json& saved);

 signals:
  void message(const QString& text);

 private:
  enum class Direction { off, x, y, z, view, three_points };
  void choose(Direction direction);
  /// The plane with this normal at `position` along it, or through the middle of the part; the side
  /// towards the viewer is cut away.
  void cut(Direction direction, const Point& normal, std::optional<double> position = {});
  void show();
  void take_point(const Pick& pick);
  void stop_picking();
  void refresh();

  Session* session_;
  MeshView* view_;
  SectionBar* bar_;
  QActionGroup* directions_ = nullptr;
  QAction* flip_ = nullptr;
  Direction direction_ = Direction::off;
  Point axis_ = Point::UnitX();  // positions count along it
  double position_ = 0.0;
  bool flipped_ = false;
  bool picking_ = false;
  std::vector<Point> picks_;
};

}  // namespace arris::ui
