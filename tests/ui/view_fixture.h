#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>
#include <QApplication>
#include <QMouseEvent>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QSignalSpy>
#include <QTest>
#include <QWindow>

#include "tests/support/meshes.h"
#include "ui/view/mesh_view.h"

/// A view in a real window, and what its tests ask of pictures and meshes.
namespace arris::ui {

using testing::mesh_of;

inline int difference(QRgb a, QRgb b) {
  return std::max({std::abs(qRed(a) - qRed(b)), std::abs(qGreen(a) - qGreen(b)),
                   std::abs(qBlue(a) - qBlue(b))});
}

inline QRgb rgb(const std::array<std::uint8_t, 3>& colour) {
  return qRgb(colour[0], colour[1], colour[2]);
}

/// Share of pixels that differ by more than `tolerance`.
inline double unlike(const QImage& a, const QImage& b, int tolerance) {
  if (a.size() != b.size()) return 1.0;
  qint64 count = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      if (difference(a.pixel(x, y), b.pixel(x, y)) > tolerance) ++count;
    }
  }
  return static_cast<double>(count) / (static_cast<double>(a.width()) * a.height());
}

inline bool is_opaque(const QImage& image) {
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (qAlpha(image.pixel(x, y)) != 255) return false;
    }
  }
  return !image.isNull();
}

/// Share of pixels near to a colour.
inline double share_of(const QImage& image, QRgb colour, int tolerance) {
  qint64 count = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (difference(image.pixel(x, y), colour) <= tolerance) ++count;
    }
  }
  return static_cast<double>(count) / (static_cast<double>(image.width()) * image.height());
}

inline GLenum gl_error(MeshView& view) {
  view.makeCurrent();
  const GLenum error = view.context()->functions()->glGetError();
  view.doneCurrent();
  return error;
}

/// A grid in the plane z = 0 from (0, 0) to (size, size), seen from above as its front.
inline MeshPtr plane(double size, double step) {
  return mesh_of(testing::noisy_plane(size, step, 0.0, 0.0, 1));
}

inline Point centre(const Mesh& mesh) { return (mesh.box_min() + mesh.box_max()) / 2; }

inline VertexId nearest_vertex(const Mesh& mesh, const Point& point) {
  VertexId best = 0;
  for (VertexId v = 1; v < mesh.vertex_count(); ++v) {
    if ((mesh.point(v) - point).norm() < (mesh.point(best) - point).norm()) best = v;
  }
  return best;
}

/// The vertices on y = `y`, from left to right.
inline std::vector<VertexId> row(const Mesh& mesh, double y) {
  std::vector<VertexId> result;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (std::abs(mesh.point(v).y() - y) < 1e-9) result.push_back(v);
  }
  std::sort(result.begin(), result.end(),
            [&](VertexId a, VertexId b) { return mesh.point(a).x() < mesh.point(b).x(); });
  return result;
}

inline ViewField field_of(const Mesh& mesh, const std::function<double(const Point&)>& value) {
  auto values = std::make_shared<std::vector<double>>();
  for (const Point& point : mesh.points()) values->push_back(value(point));
  ViewField field;
  field.title = "value";
  field.values = values;
  return field;
}

class MeshViewTest : public ::testing::Test {
 protected:
  void SetUp() override {
    view_.resize(500, 400);
    view_.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&view_));
  }
  void TearDown() override { EXPECT_EQ(gl_error(view_), GLenum{GL_NO_ERROR}); }

  /// Returns once the window system has resized the window, too: what it tells late of one size
  /// would undo the next.
  [[nodiscard]] bool resize(const QSize& size) {
    const QWindow* window = view_.windowHandle();
    const QSignalSpy width(window, &QWindow::widthChanged), height(window, &QWindow::heightChanged);
    view_.resize(size);
    return QTest::qWaitFor([&] { return !width.isEmpty() || !height.isEmpty(); }, 10000);
  }
  QImage grab() { return view_.grabFramebuffer(); }
  QPoint middle() const { return {view_.width() / 2, view_.height() / 2}; }
  QRgb middle_colour() {
    const QImage image = grab();
    return image.pixel(image.width() / 2, image.height() / 2);
  }
  PictureOptions bare(QSize size) {
    PictureOptions options;
    options.size = size;
    options.scalar_bar = options.scale_bar = options.orientation_marker = false;
    return options;
  }

  MeshView view_;
};

}  // namespace arris::ui
