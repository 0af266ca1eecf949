#pragma once

#include <QPointF>
#include <QRectF>
#include <QSizeF>

#include "core/mesh/mesh.h"

namespace arris::ui {

/// The orthographic camera of a view. Positions on the widget run from its top left corner, in any
/// one unit of pixels together with the widget's size.
class ViewCamera {
 public:
  const Point& focus() const { return focus_; }
  double height() const { return height_; }  ///< Of the view, in the mesh's unit.
  Point right() const { return axes_.col(0); }
  Point up() const { return axes_.col(1); }
  Point towards_viewer() const { return axes_.col(2); }
  const Eigen::Matrix3d& axes() const {
    return axes_;
  }  ///< Columns: right, up, towards the viewer.

  double units_per_pixel(QSizeF size) const { return height_ / size.height(); }
  /// The point on the plane through the focus that is drawn at a position.
  Point unproject(QPointF position, QSizeF size) const;
  /// x and y: position on the widget; z: how near to the viewer, in the mesh's unit.
  Eigen::Vector3d project(const Point& point, QSizeF size) const;

  /// Looks against `towards_viewer`; the focus and the height stay.
  void look(const Point& towards_viewer, const Point& up);
  /// Turns about `pivot`, which stays where it is drawn; radians about the upright and the
  /// horizontal axis of the screen.
  void orbit(const Point& pivot, double about_up, double about_right);
  void pan(QPointF by, QSizeF size);
  /// Magnifies; what is drawn at `position` stays there. The height stays within `least` and
  /// `most`.
  void zoom(double factor, QPointF position, QSizeF size, double least, double most);
  /// Puts points in the middle of `area` (of the widget; empty: all of it) so that their extent on
  /// the screen takes `share` of that; keeps the direction. Nothing happens without points; the
  /// height is at least `least`.
  void frame(const std::vector<Point>& points, QSizeF size, double share, double least,
             QRectF area = {});
  void set_height(double height) { height_ = height; }
  void set_focus(const Point& focus) { focus_ = focus; }
  bool operator==(const ViewCamera&) const = default;

 private:
  Point focus_ = Point::Zero();
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();
  double height_ = 1.0;
};

}  // namespace arris::ui
