#pragma once

#include <gtest/gtest.h>
#include <QApplication>
#include <QTest>
#include <QWheelEvent>
#include <QWidget>

/// What tests of single panels do with them.
namespace arris::ui::testing {

/// Shows a widget at a size with the keyboard focus in its window.
inline void show(QWidget& widget, int width, int height) {
  widget.resize(width, height);
  widget.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&widget));
  widget.activateWindow();
  QApplication::setActiveWindow(&widget);
  ASSERT_TRUE(QTest::qWaitForWindowActive(&widget));
}

inline void wheel(QWidget& widget, const QPoint& at, int delta) {
  QWheelEvent event(QPointF(at), QPointF(widget.mapToGlobal(at)), QPoint(), QPoint(0, delta),
                    Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
  QApplication::sendEvent(&widget, &event);
}

}  // namespace arris::ui::testing
