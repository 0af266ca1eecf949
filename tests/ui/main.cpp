#include <utility>

#include <gtest/gtest.h>
#include <QApplication>

/// The window tests own one QApplication; they need a display (Xvfb will do).
int main(int argc, char** argv) {
  QApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
  // VTK is built for GLX here; what the user set comes first.
  for (const auto& [name, value] :
       {std::pair{"QT_QPA_PLATFORM", "xcb"}, std::pair{"QT_XCB_GL_INTEGRATION", "xcb_glx"}}) {
    if (!qEnvironmentVariableIsSet(name)) qputenv(name, value);
  }
  ::testing::InitGoogleTest(&argc, argv);
  QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
