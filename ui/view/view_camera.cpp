#include "ui/view/view_camera.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace arris::ui {

Point ViewCamera::unproject(QPointF position, QSizeF size) const {
  const double unit = units_per_pixel(size);
  return focus_ + right() * ((position.x() - size.width() / 2) * unit) -
         up() * ((position.y() - size.height() / 2) * unit);
}

Eigen::Vector3d ViewCamera::project(const Point& point, QSizeF size) const {
  const Eigen::Vector3d local = axes_.transpose() * (point - focus_);
  const double unit = units_per_pixel(size);
  return {size.width() / 2 + local.x() / unit, size.height() / 2 - local.y() / unit, local.z()};
}

void ViewCamera::look(const Point& towards_viewer, const Point& up) {
  axes_.col(2) = towards_viewer.normalized();
  axes_.col(0) = up.cross(axes_.col(2)).normalized();
  axes_.col(1) = axes_.col(2).cross(axes_.col(0));
}

void ViewCamera::orbit(const Point& pivot, double about_up, double about_right) {
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(about_up, Point(up())) * Eigen::AngleAxisd(about_right, Point(right())))
          .toRotationMatrix();
  focus_ = pivot + turn * (focus_ - pivot);
  axes_ = turn * axes_;
  look(axes_.col(2), axes_.col(1));  // so that rounding never adds up to a skewed frame
}

void ViewCamera::pan(QPointF by, QSizeF size) {
  const double unit = units_per_pixel(size);
  focus_ += up() * (by.y() * unit) - right() * (by.x() * unit);
}

void ViewCamera::zoom(double factor, QPointF position, QSizeF size, double least, double most) {
  const Point fixed = unproject(position, size);
  const double height = std::clamp(height_ / factor, least, most);
  focus_ = fixed + (focus_ - fixed) * (height / height_);
  height_ = height;
}

void ViewCamera::frame(const std::vector<Point>& points, QSizeF size, double share, double least,
                       QRectF area) {
  if (points.empty()) return;
  if (area.isEmpty()) area = QRectF(QPointF(0.0, 0.0), size);
  Eigen::Vector3d low = axes_.transpose() * points.front();
  Eigen::Vector3d high = low;
  for (const Point& point : points) {
    const Eigen::Vector3d local = axes_.transpose() * point;
    low = low.cwiseMin(local);
    high = high.cwiseMax(local);
  }
  const Eigen::Vector3d extent = high - low;
  const double unit = std::max(extent.y() / area.height(), extent.x() / area.width()) / share;
  height_ = std::max(unit * size.height(), least);
  const QPointF aside = area.center() - QPointF(size.width() / 2, size.height() / 2);
  focus_ = axes_ * ((low + high) / 2);
  focus_ += units_per_pixel(size) * (aside.y() * up() - aside.x() * right());
}

}  // namespace arris::ui
