#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>
#include <QApplication>
#include <QLineEdit>
#include <QSignalSpy>
#include <QTest>
#include <QWheelEvent>

#include "tests/ui/panel_fixture.h"
#include "ui/panels/controls.h"
#include "ui/panels/histogram_panel.h"

namespace arris::ui {
namespace {

using testing::show;
using testing::wheel;

/// A reading that says the same whatever the value.
std::function<QString(double)> said(const char* text) {
  return [text](double) { return QString(text); };
}

class HistogramPanelTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Histogram histogram;
    for (int i = 0; i <= 100; ++i) histogram.edges.push_back(i * 0.01);
    histogram.weights.assign(100, 0.01);
    histogram.title = "H (1/mm)";
    panel_.set_histogram(histogram, ColourScale());
    panel_.set_handles({{"Kmin", "Least", 0.25, 0.0, 1.0, said("r = 4 mm")},
                        {"Kmax", "Most", 0.75, 0.0, 1.0, said("r = 1.333 mm")}});
    show(panel_, 900, 180);
  }

  /// Value that one pixel is worth.
  double pixel() const {
    return 0.5 / (panel_.handle_position(1).x() - panel_.handle_position(0).x());
  }
  void press(int handle) {
    QTest::mousePress(&panel_, Qt::LeftButton, {}, panel_.handle_position(handle));
  }
  QLineEdit* editor() const { return panel_.findChild<QLineEdit*>(); }

  HistogramPanel panel_;
  QSignalSpy dragged_{&panel_, &HistogramPanel::threshold_dragged};
  QSignalSpy finished_{&panel_, &HistogramPanel::threshold_finished};
  QSignalSpy cancelled_{&panel_, &HistogramPanel::threshold_cancelled};
};

TEST_F(HistogramPanelTest, DraggingFollowsTheMouseAndFinishesOnce) {
  const QPoint start = panel_.handle_position(0);
  const double pixel_value = pixel();
  press(0);
  for (int dx = 10; dx <= 100; dx += 10) QTest::mouseMove(&panel_, start + QPoint(dx, 0));
  EXPECT_EQ(dragged_.size(), 10);
  EXPECT_EQ(finished_.size(), 0);
  QTest::mouseRelease(&panel_, Qt::LeftButton, {}, start + QPoint(100, 0));
  ASSERT_EQ(finished_.size(), 1);
  EXPECT_EQ(finished_[0][0].toInt(), 0);
  EXPECT_NEAR(finished_[0][1].toDouble(), 0.25 + 100 * pixel_value, pixel_value);
  EXPECT_EQ(dragged_.last()[1].toDouble(), finished_[0][1].toDouble());
  EXPECT_EQ(panel_.handles()[0].value, finished_[0][1].toDouble());
  EXPECT_EQ(panel_.handles()[1].value, 0.75);
  EXPECT_EQ(panel_.handle_position(0).x(), start.x() + 100);
  EXPECT_EQ(cancelled_.size(), 0);
}

TEST_F(HistogramPanelTest, DraggedValuesAreWhatTheLabelSays) {
  const QPoint start = panel_.handle_position(0);
  press(0);
  QTest::mouseMove(&panel_, start + QPoint(37, 0));
  QTest::mouseRelease(&panel_, Qt::LeftButton, {}, start + QPoint(37, 0));
  ASSERT_EQ(finished_.size(), 1);
  const double value = finished_[0][1].toDouble();
  EXPECT_EQ(shown_number(value).toDouble(), value);
}

TEST_F(HistogramPanelTest, AClickMovesNothing) {
  QTest::mouseClick(&panel_, Qt::LeftButton, {}, panel_.handle_position(1));
  EXPECT_EQ(dragged_.size() + finished_.size() + cancelled_.size(), 0);
  EXPECT_EQ(panel_.handles()[1].value, 0.75);
}

TEST_F(HistogramPanelTest, DraggingStaysInTheHandlesRange) {
  panel_.set_handles({{"Kmin", "", 0.25, 0.2, 0.5, {}}, {"Kmax", "", 0.75, 0.0, 1.0, {}}});
  press(0);
  QTest::mouseMove(&panel_, QPoint(5000, 90));
  EXPECT_EQ(panel_.handles()[0].value, 0.5);
  QTest::mouseMove(&panel_, QPoint(-5000, 90));
  EXPECT_EQ(panel_.handles()[0].value, 0.2);
  QTest::mouseRelease(&panel_, Qt::LeftButton, {}, QPoint(0, 90));
  EXPECT_EQ(finished_.size(), 1);
}

TEST_F(HistogramPanelTest, ShiftDragsTenTimesFiner) {
  const QPoint start = panel_.handle_position(0);
  const double pixel_value = pixel();
  press(0);
  QMouseEvent move(QEvent::MouseMove, start + QPoint(50, 0),
                   panel_.mapToGlobal(start + QPoint(50, 0)), Qt::NoButton, Qt::LeftButton,
                   Qt::ShiftModifier);
  QApplication::sendEvent(&panel_, &move);
  EXPECT_NEAR(panel_.handles()[0].value, 0.25 + 5 * pixel_value, pixel_value);
  QTest::mouseRelease(&panel_, Qt::LeftButton, {}, start + QPoint(50, 0));
}

TEST_F(HistogramPanelTest, EscapeRestoresAndTheReleaseThenSaysNothing) {
  const QPoint start = panel_.handle_position(0);
  press(0);
  QTest::mouseMove(&panel_, start + QPoint(80, 0));
  EXPECT_NE(panel_.handles()[0].value, 0.25);
  QTest::keyClick(&panel_, Qt::Key_Escape);
  EXPECT_EQ(panel_.handles()[0].value, 0.25);
  ASSERT_EQ(cancelled_.size(), 1);
  EXPECT_EQ(cancelled_[0][0].toInt(), 0);
  const auto before = dragged_.size();
  QTest::mouseMove(&panel_, start + QPoint(120, 0));
  QTest::mouseRelease(&panel_, Qt::LeftButton, {}, start + QPoint(120, 0));
  EXPECT_EQ(dragged_.size(), before);
  EXPECT_EQ(finished_.size(), 0);
  EXPECT_EQ(panel_.handles()[0].value, 0.25);
}

TEST_F(HistogramPanelTest, AnswersDuringADragDoNotPullTheHandleBack) {
  const QPoint start = panel_.handle_position(0);
  press(0);
  QTest::mouseMove(&panel_, start + QPoint(80, 0));
  const double value = panel_.handles()[0].value;
  auto stale = panel_.handles();
  stale[0].value = 0.26;
  stale[0].reading = [](double shown) { return QString::number(2.0 * shown); };
  panel_.set_handles(stale);
  EXPECT_EQ(panel_.handles()[0].value, value);
  EXPECT_EQ(panel_.handles()[0].reading(1.5), "3");
  QTest::mouseRelease(&panel_, Qt::LeftButton, {}, start + QPoint(80, 0));
  EXPECT_EQ(finished_.size(), 1);
}

TEST_F(HistogramPanelTest, OtherHandlesEndADragInSilence) {
  press(1);
  QTest::mouseMove(&panel_, panel_.handle_position(1) - QPoint(80, 0));
  panel_.set_handles({{"TV_IH", "", 0.5, 0.0, 1.0, {}}});
  QTest::mouseMove(&panel_, QPoint(300, 90));
  QTest::mouseRelease(&panel_, Qt::LeftButton, {}, QPoint(300, 90));
  EXPECT_EQ(finished_.size() + cancelled_.size(), 0);
  EXPECT_EQ(panel_.handles()[0].value, 0.5);
}

TEST_F(HistogramPanelTest, TabWalksOverTheHandlesAndArrowsMoveThem) {
  panel_.setFocus(Qt::TabFocusReason);
  QTest::keyClick(&panel_, Qt::Key_Right);
  EXPECT_GT(panel_.handles()[0].value, 0.25);
  const double small = panel_.handles()[0].value - 0.25;
  QTest::keyClick(&panel_, Qt::Key_Left);
  EXPECT_NEAR(panel_.handles()[0].value, 0.25, 1e-12);
  QTest::keyClick(&panel_, Qt::Key_Tab);  // Ends what was done to the first.
  EXPECT_EQ(finished_.size(), 1);
  QTest::keyClick(&panel_, Qt::Key_Left, Qt::ShiftModifier);
  EXPECT_NEAR(panel_.handles()[0].value, 0.25, 1e-12);
  EXPECT_GT(0.75 - panel_.handles()[1].value, 5 * small);
  QTest::keyClick(&panel_, Qt::Key_Return);
  ASSERT_EQ(finished_.size(), 2);
  EXPECT_EQ(finished_[1][0].toInt(), 1);
  EXPECT_EQ(finished_[1][1].toDouble(), panel_.handles()[1].value);
}

TEST_F(HistogramPanelTest, ManyKeysMakeOneFinish) {
  panel_.setFocus(Qt::TabFocusReason);
  for (int i = 0; i < 7; ++i) QTest::keyClick(&panel_, Qt::Key_Right);
  EXPECT_EQ(dragged_.size(), 7);
  EXPECT_EQ(finished_.size(), 0);
  EXPECT_TRUE(finished_.wait(3000));
  EXPECT_EQ(finished_.size(), 1);
}

TEST_F(HistogramPanelTest, EscapeTakesStepsBackToo) {
  panel_.setFocus(Qt::TabFocusReason);
  for (int i = 0; i < 3; ++i) QTest::keyClick(&panel_, Qt::Key_Right);
  QTest::keyClick(&panel_, Qt::Key_Escape);
  EXPECT_EQ(panel_.handles()[0].value, 0.25);
  EXPECT_EQ(cancelled_.size(), 1);
  EXPECT_FALSE(finished_.wait(700));
}

TEST_F(HistogramPanelTest, ATypedNumberIsTakenAsItIs) {
  panel_.setFocus(Qt::TabFocusReason);
  QTest::keyClick(&panel_, Qt::Key_Tab);
  QTest::keyClick(&panel_, Qt::Key_0);
  ASSERT_TRUE(editor()->isVisible());
  QTest::keyClicks(editor(), ".612345");
  QTest::keyClick(editor(), Qt::Key_Return);
  EXPECT_FALSE(editor()->isVisible());
  ASSERT_EQ(finished_.size(), 1);
  EXPECT_EQ(finished_[0][0].toInt(), 1);
  EXPECT_EQ(finished_[0][1].toDouble(), 0.612345);
  EXPECT_EQ(panel_.handles()[1].value, 0.612345);
  EXPECT_TRUE(panel_.hasFocus());
}

TEST_F(HistogramPanelTest, NumbersThatAreNoneOrOutOfRangeAreNotTaken) {
  panel_.setFocus(Qt::TabFocusReason);
  QTest::keyClick(&panel_, Qt::Key_7);
  QTest::keyClick(editor(), Qt::Key_Return);
  EXPECT_TRUE(editor()->isVisible());
  EXPECT_FALSE(editor()->toolTip().isEmpty());
  QTest::keyClicks(editor(), "x");
  QTest::keyClick(editor(), Qt::Key_Return);
  EXPECT_TRUE(editor()->isVisible());
  QTest::keyClick(editor(), Qt::Key_Escape);
  EXPECT_FALSE(editor()->isVisible());
  EXPECT_EQ(finished_.size(), 0);
  EXPECT_EQ(panel_.handles()[0].value, 0.25);
}

TEST_F(HistogramPanelTest, DoubleClickOnALabelOpensItsNumber) {
  const QPoint label = panel_.label_rectangle(1).center();
  QTest::mouseClick(&panel_, Qt::LeftButton, {}, label);
  QTest::mouseDClick(&panel_, Qt::LeftButton, {}, label);
  ASSERT_TRUE(editor()->isVisible());
  EXPECT_EQ(editor()->text(), "0.75");
  QTest::keyClicks(editor(), "0,5");  // A comma is typed as the point.
  EXPECT_EQ(editor()->text(), "0.5");
  QTest::keyClick(editor(), Qt::Key_Enter);
  ASSERT_EQ(finished_.size(), 1);
  EXPECT_EQ(panel_.handles()[1].value, 0.5);
}

TEST_F(HistogramPanelTest, TheWheelStepsAHandleUnderThePointerOnly) {
  wheel(panel_, panel_.handle_position(0), 120);
  EXPECT_GT(panel_.handles()[0].value, 0.25);
  wheel(panel_, QPoint(panel_.width() / 2, 90), 120);
  EXPECT_EQ(dragged_.size(), 1);
  EXPECT_TRUE(finished_.wait(3000));
  EXPECT_EQ(finished_.size(), 1);
}

TEST_F(HistogramPanelTest, LabelsNeitherOverlapNorLeaveThePanel) {
  for (const int width : {900, 500, 320, 260}) {
    panel_.resize(width, 180);
    for (const auto& [low, high] : {std::pair(0.0, 0.0), std::pair(0.5, 0.51), std::pair(1.0, 1.0),
                                    std::pair(0.0, 1.0), std::pair(0.9, 0.1)}) {
      panel_.set_handles({{"Kmin", "", low, 0.0, 1.0, said("r = 123.4 mm")},
                          {"Kmax", "", high, 0.0, 1.0, said("r = 0.001234 mm")},
                          {"TV_IH", "", 0.5, 0.0, 1.0, said("24.0°")}});
      for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(panel_.rect().contains(panel_.label_rectangle(i))) << width << " " << i;
        for (int k = 0; k < i; ++k) {
          EXPECT_FALSE(panel_.label_rectangle(i).intersects(panel_.label_rectangle(k)))
              << width << " " << low << " " << high;
        }
      }
    }
  }
}

TEST_F(HistogramPanelTest, OfTwoHandlesOnOneSpotTheOneWithRoomIsTaken) {
  panel_.set_handles({{"Kmin", "", 0.0, 0.0, 1.0, {}}, {"Kmax", "", 0.0, 0.0, 1.0, {}}});
  QPoint start = panel_.handle_position(0);
  press(0);
  QTest::mouseMove(&panel_, start + QPoint(60, 0));
  QTest::mouseRelease(&panel_, Qt::LeftButton, {}, start + QPoint(60, 0));
  ASSERT_EQ(finished_.size(), 1);
  EXPECT_EQ(finished_[0][0].toInt(), 1);
}

TEST(HistogramPanel, TheLowEndOfALogarithmicAxisMeansZero) {
  HistogramPanel panel;
  Histogram histogram;
  for (int i = 0; i <= 60; ++i) histogram.edges.push_back(std::pow(10.0, -6.0 + 0.1 * i));
  histogram.weights.assign(60, 1.0 / 60);
  histogram.logarithmic = true;
  panel.set_histogram(histogram, ColourScale());
  panel.set_handles({{"Kmin", "", 1e-3, 0.0, 100.0, {}}});
  show(panel, 900, 180);
  QTest::mousePress(&panel, Qt::LeftButton, {}, panel.handle_position(0));
  QTest::mouseMove(&panel, panel.handle_position(0) - QPoint(100, 0));
  EXPECT_GT(panel.handles()[0].value, 1e-6);
  EXPECT_LT(panel.handles()[0].value, 1e-3);
  QTest::mouseMove(&panel, QPoint(0, 90));
  EXPECT_EQ(panel.handles()[0].value, 0.0);
  QTest::mouseRelease(&panel, Qt::LeftButton, {}, QPoint(0, 90));
}

TEST(HistogramPanel, TakesAnyHistogram) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Histogram> odd(7);
  odd[1].edges = {0, 1, 2};
  odd[1].weights = {0.5};
  odd[2].edges = {0, nan, 2};
  odd[2].weights = {0.5, 0.5};
  odd[3].edges = {1, 1};
  odd[3].weights = {1};
  odd[4].edges = {0, 1};
  odd[4].weights = {0};
  odd[5].edges = {-2, -1};
  odd[5].weights = {1};
  odd[5].logarithmic = true;
  odd[6].edges = {0, 1e-300, 1};
  odd[6].weights = {nan, 1};
  odd[6].logarithmic = true;
  HistogramPanel panel;
  panel.set_handles({{"TV_IH", "", 0.5, 0.0, 1.0, {}}, {"TV_IK", "", 1e9, 2.0, 1.0, {}}});
  for (const Histogram& histogram : odd) {
    panel.set_histogram(histogram, ColourScale());
    for (const int width : {10, 240, 900}) {
      panel.resize(width, 100);
      EXPECT_FALSE(panel.grab().isNull());
    }
    panel.setFocus();
    QTest::keyClick(&panel, Qt::Key_Right);
    QTest::mouseClick(&panel, Qt::LeftButton, {}, QPoint(120, 40));
  }
}

}  // namespace
}  // namespace arris::ui
