#include <QApplication>
#include <gtest/gtest.h>

/// The window tests own one QApplication; they need a display (Xvfb will do).
int main(int argc, char** argv) {
  QApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
  qputenv("QT_XCB_GL_INTEGRATION", "xcb_glx");
  ::testing::InitGoogleTest(&argc, argv);
  QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
