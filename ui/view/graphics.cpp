#include "ui/view/graphics.h"

#include <vtkVersion.h>
#include <QGuiApplication>
#include <QLibrary>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QSurfaceFormat>

#include "ui/view/translated.h"

namespace arris::ui {

namespace {

constexpr int least_major = 3, least_minor = 2;  // of OpenGL, for VTK
QString found;                                   // by why_nothing_can_be_drawn()

QString text_of(QOpenGLFunctions& functions, GLenum name) {
  return QString::fromLatin1(reinterpret_cast<const char*>(functions.glGetString(name)));
}

/// What is wrong with the context; empty: nothing. `by_processor`: drawing by it would help.
QString fault_of(QOpenGLContext& context, bool& by_processor) {
  if (!context.create()) return translated("this display offers no OpenGL");
#if defined(Q_OS_LINUX) && QT_CONFIG(xcb_glx_plugin)
  // Debian's VTK finds the functions of OpenGL through GLX alone.
  if (QGuiApplication::platformName() == "xcb" &&
      !context.nativeInterface<QNativeInterface::QGLXContext>()) {
    by_processor = false;
    return translated("this display offers OpenGL, but not through GLX, which Arris needs");
  }
#endif
  QOffscreenSurface surface;
  surface.setFormat(context.format());
  surface.create();
  if (!context.makeCurrent(&surface)) return translated("OpenGL of this display cannot be used");
  QOpenGLFunctions& functions = *context.functions();
  found = translated("%1, OpenGL %2")
              .arg(text_of(functions, GL_RENDERER), text_of(functions, GL_VERSION));
  const QSurfaceFormat format = context.format();
  context.doneCurrent();
  if (format.version() < std::pair(least_major, least_minor))
    return translated("OpenGL here is %1.%2 (%3), and Arris needs %4.%5 or later")
        .arg(format.majorVersion())
        .arg(format.minorVersion())
        .arg(found.section(", OpenGL", 0, 0))
        .arg(least_major)
        .arg(least_minor);
  return {};
}

}  // namespace

QString why_no_display() {
#ifdef Q_OS_LINUX
  if (qEnvironmentVariable("QT_QPA_PLATFORM", "xcb") != "xcb") return {};
  QLibrary library("xcb", 1);  // where it is not here, Qt will say what it misses
  using Connect = void*(const char*, int*);
  using HasError = int(void*);
  using Disconnect = void(void*);
  auto* const connect = reinterpret_cast<Connect*>(library.resolve("xcb_connect"));
  auto* const has_error = reinterpret_cast<HasError*>(library.resolve("xcb_connection_has_error"));
  auto* const disconnect = reinterpret_cast<Disconnect*>(library.resolve("xcb_disconnect"));
  if (!connect || !has_error || !disconnect) return {};
  void* const connection = connect(nullptr, nullptr);
  // A good one is never closed: a server like Xvfb begins anew when its last client goes, and would
  // turn away Qt, which comes next.
  if (has_error(connection) == 0) return {};
  disconnect(connection);
  const QString name = qEnvironmentVariable("DISPLAY");
  return (name.isEmpty() ? translated("There is no display (DISPLAY is not set)")
                         : translated("The display %1 cannot be reached").arg(name)) +
         translated(": start Arris on a desktop, or with xvfb-run; arris-cli works without one.");
#else
  return {};
#endif
}

QString why_nothing_can_be_drawn() {
  QOpenGLContext context;
  bool by_processor = true;
  const QString fault = fault_of(context, by_processor);
  if (fault.isEmpty()) return {};
  const QString way_out = by_processor ? translated(
                                             "Draw by the processor instead "
                                             "(LIBGL_ALWAYS_SOFTWARE=1 arris), update the graphics "
                                             "driver, or start Arris on the computer's own screen")
                                       : translated(
                                             "Start Arris on the computer's own screen, or through "
                                             "a remote desktop that has GLX");
  return translated("Arris cannot draw: %1. %2; arris-cli works without graphics.")
      .arg(fault, way_out);
}

QString graphics_text() { return found; }

QString vtk_version() { return QString::fromLatin1(vtkVersion::GetVTKVersion()); }

}  // namespace arris::ui
