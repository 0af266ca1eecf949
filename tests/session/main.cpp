#include <gtest/gtest.h>
#include <QCoreApplication>
#include <QStandardPaths>

/// The session needs events and files, but no display.
int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  QStandardPaths::setTestModeEnabled(true);
  QCoreApplication::setApplicationName("arris-session-tests");
  QCoreApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
