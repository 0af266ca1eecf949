#pragma once

#include <QString>

/// What the window needs of display and OpenGL, looked at before anything is drawn: Qt and VTK end
/// the program where they do not find it.
namespace arris::ui {

/// Before there is a QApplication: empty, or in one sentence why no window can be shown, and the
/// way out.
QString why_no_display();

/// Once there is one: empty, or why nothing can be drawn, and the way out. Makes a small OpenGL
/// context and asks it.
QString why_nothing_can_be_drawn();

/// "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core Profile) Mesa 22.3.6", as found by
/// why_nothing_can_be_drawn(); empty before.
QString graphics_text();

/// "9.1.0".
QString vtk_version();

}  // namespace arris::ui
