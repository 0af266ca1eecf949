#include <gtest/gtest.h>
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalSpy>
#include <QTableView>
#include <QTest>
#include <QToolButton>

#include "tests/ui/panel_fixture.h"
#include "ui/panels/colour_map_panel.h"
#include "ui/panels/controls.h"
#include "ui/panels/element_table.h"
#include "ui/panels/history_panel.h"
#include "ui/panels/start_page.h"
#include "ui/panels/steps_panel.h"

namespace arris::ui {
namespace {

using testing::show;
using testing::wheel;

QPushButton* button(const QWidget& in, const QString& accessible_name) {
  for (QPushButton* found : in.findChildren<QPushButton*>()) {
    if (found->accessibleName() == accessible_name || found->text() == accessible_name) {
      if (!found->isHidden()) return found;
    }
  }
  return nullptr;
}

// ---- numbers
// -------------------------------------------------------------------------------------

TEST(Numbers, HaveAPointAtMostFourDigitsAndNoGroups) {
  EXPECT_EQ(shown_number(0.0).toStdString(), "0");
  EXPECT_EQ(shown_number(12.3456).toStdString(), "12.35");
  EXPECT_EQ(shown_number(0.0012).toStdString(), "0.0012");
  EXPECT_EQ(shown_number(-24.0).toStdString(), "-24");
  EXPECT_EQ(shown_number(9999.96).toStdString(), "10000");
  EXPECT_EQ(shown_number(2.5e-5).toStdString(), "2.5×10⁻⁵");
  EXPECT_EQ(shown_number(1e-4).toStdString(), "10⁻⁴");
  EXPECT_EQ(shown_number(1e12).toStdString(), "10¹²");
  EXPECT_EQ(shown_number(std::nan("")).toStdString(), "–");
  EXPECT_EQ(percent_text(0.0234).toStdString(), "2.3 %");
  EXPECT_EQ(count_text(20000).toStdString(), "20,000");
}

TEST(Numbers, AreReadWithoutGuessingWhatACommaMeans) {
  EXPECT_EQ(typed_number(" 12.5 "), 12.5);
  EXPECT_EQ(typed_number("-1e-3"), -1e-3);
  EXPECT_EQ(typed_number(".5"), 0.5);
  for (const char* bad : {"", "1,5", "1,203", "12 mm", "nan", "inf", "0x10", "1e999", "--1", "."}) {
    EXPECT_FALSE(typed_number(bad)) << bad;
  }
}

TEST(Numbers, EditorTextsReadBackAsTheirValue) {
  for (const double value : {0.0, 1e-5, 2.5e-7, 0.4189, -12.25, 123456.0, 3e12}) {
    EXPECT_EQ(typed_number(edit_text(value)), value);
  }
}

// ---- colour map
// ----------------------------------------------------------------------------------

class ColourMapPanelTest : public ::testing::Test {
 protected:
  void SetUp() override {
    panel_.set_fields({"Kabs", "H", "Shape"}, {"a", "b", "c"});
    show(panel_, 320, 460);
  }
  QLineEdit* edit(const QString& name) const {
    for (QLineEdit* found : panel_.findChildren<QLineEdit*>()) {
      if (found->accessibleName() == name) return found;
    }
    return nullptr;
  }
  ColourMapPanel panel_;
  QSignalSpy changed_{&panel_, &ColourMapPanel::changed};
};

TEST_F(ColourMapPanelTest, SettingTheStateIsNoChangeByTheUser) {
  ColourMapState state;
  state.field = 1;
  state.scale = {ColourMap::diverging, -3.0, 7.25, false, true, 7, Qt::blue, Qt::red, Qt::black};
  state.range = ColourMapState::Range::typed;
  state.low_percentile = 40.0;
  state.high_percentile = 41.5;
  state.locked = true;
  panel_.set_state(state);
  EXPECT_EQ(panel_.state(), state);
  panel_.set_state(ColourMapState());
  EXPECT_EQ(panel_.state(), ColourMapState());
  panel_.set_fields({"K"}, {});
  EXPECT_EQ(changed_.size(), 0);
}

TEST_F(ColourMapPanelTest, CombosAndBoxesTellTheNewState) {
  auto combos = panel_.findChildren<QComboBox*>();
  ASSERT_EQ(combos.size(), 2);
  combos[0]->setFocus();
  QTest::keyClick(combos[0], Qt::Key_Down);
  ASSERT_EQ(changed_.size(), 1);
  EXPECT_EQ(panel_.state().field, 1);
  combos[1]->setFocus();
  QTest::keyClick(combos[1], Qt::Key_Down);
  ASSERT_EQ(changed_.size(), 2);
  EXPECT_EQ(changed_[1][0].value<ColourMapState>().scale.map, ColourMap::viridis);
  for (QCheckBox* box : panel_.findChildren<QCheckBox*>()) {
    box->setFocus();
    QTest::keyClick(box, Qt::Key_Space);
  }
  EXPECT_EQ(changed_.size(), 5);
  EXPECT_TRUE(panel_.state().locked);
  EXPECT_TRUE(panel_.state().scale.logarithmic);
  EXPECT_TRUE(panel_.state().scale.reversed);
}

TEST_F(ColourMapPanelTest, ATypedEndMakesATypedRange) {
  QLineEdit* max = edit("Greatest value");
  ASSERT_NE(max, nullptr);
  max->setFocus();
  max->selectAll();
  QTest::keyClicks(max, "2.5");
  EXPECT_EQ(changed_.size(), 0);
  QTest::keyClick(max, Qt::Key_Return);
  ASSERT_EQ(changed_.size(), 1);
  EXPECT_EQ(panel_.state().range, ColourMapState::Range::typed);
  EXPECT_EQ(panel_.state().scale.max, 2.5);
  QTest::keyClick(max, Qt::Key_Return);
  EXPECT_EQ(changed_.size(), 1);
}

TEST_F(ColourMapPanelTest, ARangeThatEndsBeforeItBeginsIsNotTaken) {
  QLineEdit* max = edit("Greatest value");
  max->setFocus();
  max->selectAll();
  QTest::keyClicks(max, "-4");
  QTest::keyClick(max, Qt::Key_Return);
  EXPECT_EQ(changed_.size(), 0);
  EXPECT_EQ(panel_.state().scale.max, 1.0);
  EXPECT_TRUE(max->toolTip().contains("above"));
}

TEST_F(ColourMapPanelTest, PercentilesAreTakenOnEnter) {
  auto boxes = panel_.findChildren<QDoubleSpinBox*>();
  ASSERT_EQ(boxes.size(), 2);
  boxes[0]->setFocus();
  boxes[0]->selectAll();
  QTest::keyClicks(boxes[0], "12.5");
  QTest::keyClick(boxes[0], Qt::Key_Return);
  ASSERT_EQ(changed_.size(), 1);
  EXPECT_EQ(panel_.state().low_percentile, 12.5);
  EXPECT_EQ(panel_.state().range, ColourMapState::Range::percentile);
}

// ---- table
// ---------------------------------------------------------------------------------------

class ElementTableTest : public ::testing::Test {
 protected:
  void SetUp() override {
    table_.set_rows(rows());
    show(table_, 420, 300);
  }
  static std::vector<ElementRow> rows() {
    return {{7, {7, "convex", 10.5}, Qt::red},
            {9, {9, "concave", 9.25}, Qt::green},
            {20, {20, "convex", 100.0}, Qt::blue},
            {3, {3, "undefined", -2e-5}, {}}};
  }
  QTableView* view() const { return table_.findChild<QTableView*>(); }
  QString cell(int row, int column) const {
    return view()->model()->index(row, column).data().toString();
  }
  QStringList column(int c) const {
    QStringList list;
    for (int r = 0; r < view()->model()->rowCount(); ++r) list += cell(r, c);
    return list;
  }
  QString count() const { return table_.findChild<MutedLabel*>()->text(); }
  void click(int row, Qt::KeyboardModifiers keys = {}) {
    const QPoint at = view()->visualRect(view()->model()->index(row, 1)).center();
    QTest::mouseClick(view()->viewport(), Qt::LeftButton, keys, at);
  }
  using Ids = std::unordered_set<std::uint32_t>;

  ElementTable table_{"lines", {"Line", "Kind", "Length (mm)"}, {"a", "b", "c"}};
  QSignalSpy changed_{&table_, &ElementTable::selection_changed};
  QSignalSpy activated_{&table_, &ElementTable::activated};
};

TEST_F(ElementTableTest, SortsNumbersByValue) {
  EXPECT_EQ(column(0), QStringList({"3", "7", "9", "20"}));
  view()->sortByColumn(2, Qt::AscendingOrder);
  EXPECT_EQ(column(2), QStringList({"-2×10⁻⁵", "9.25", "10.5", "100"}));
  view()->sortByColumn(2, Qt::DescendingOrder);
  EXPECT_EQ(column(0), QStringList({"20", "7", "9", "3"}));
}

TEST_F(ElementTableTest, ColumnsGrowWithWhatComesUnlessTheUserSetThem) {
  const int before = view()->columnWidth(1);
  auto longer = rows();
  longer[0].cells[1] = "convex, closed, and then some more";
  table_.set_rows(longer);
  EXPECT_GT(view()->columnWidth(1), before);
  table_.set_rows(rows());  // nothing jumps back
  EXPECT_GT(view()->columnWidth(1), before);
  view()->setColumnWidth(1, 50);
  table_.set_rows(longer);
  EXPECT_EQ(view()->columnWidth(1), 50);
}

TEST_F(ElementTableTest, TheUsersSelectionIsToldAndTheProgramsIsNot) {
  click(1);
  click(3, Qt::ControlModifier);
  EXPECT_EQ(changed_.size(), 2);
  EXPECT_EQ(changed_.last()[0].value<Ids>(), (Ids{7, 20}));
  EXPECT_EQ(count(), "4 lines, 2 selected");
  table_.set_selected({3, 9, 4711});
  EXPECT_EQ(table_.selected(), (Ids{3, 9}));
  EXPECT_EQ(view()->selectionModel()->selectedRows().size(), 2);
  table_.set_selected({});
  EXPECT_EQ(count(), "4 lines");
  EXPECT_EQ(changed_.size(), 2);
}

TEST_F(ElementTableTest, TheSelectionStaysOverNewRowsSortingAndFiltering) {
  click(1);  // 7
  click(3, Qt::ControlModifier);
  changed_.clear();
  auto fewer = rows();
  fewer.erase(fewer.begin() + 2);  // 20 goes
  fewer.insert(fewer.begin(), {1, {1, "convex", 5.0}, {}});
  table_.set_rows(fewer);
  EXPECT_EQ(table_.selected(), Ids{7});
  ASSERT_EQ(view()->selectionModel()->selectedRows().size(), 1);
  EXPECT_EQ(view()->selectionModel()->selectedRows()[0].data().toInt(), 7);
  view()->sortByColumn(2, Qt::DescendingOrder);
  EXPECT_EQ(table_.selected(), Ids{7});
  auto* filter = table_.findChild<QLineEdit*>();
  QTest::keyClicks(filter, "concave");
  EXPECT_EQ(table_.selected(), Ids{7});
  EXPECT_EQ(count(), "1 of 4 lines, 1 selected (1 filtered out)");
  QTest::keyClick(filter, Qt::Key_Escape);
  ASSERT_EQ(view()->selectionModel()->selectedRows().size(), 1);
  EXPECT_EQ(view()->selectionModel()->selectedRows()[0].data().toInt(), 7);
  EXPECT_EQ(changed_.size(), 0);
}

TEST_F(ElementTableTest, EachWordOfTheFilterMustOccur) {
  auto* filter = table_.findChild<QLineEdit*>();
  QTest::keyClicks(filter, "CONVEX");
  EXPECT_EQ(column(0), QStringList({"7", "20"}));
  EXPECT_EQ(count(), "2 of 4 lines");
  QTest::keyClicks(filter, " 10.5");
  EXPECT_EQ(column(0), QStringList({"7"}));
}

TEST_F(ElementTableTest, EnterAndDoubleClickActivate) {
  click(1);
  QTest::keyClick(view(), Qt::Key_Return);
  ASSERT_EQ(activated_.size(), 1);
  EXPECT_EQ(activated_[0][0].toUInt(), 7u);
  const QPoint at = view()->visualRect(view()->model()->index(2, 1)).center();
  click(2);
  QTest::mouseDClick(view()->viewport(), Qt::LeftButton, {}, at);
  ASSERT_EQ(activated_.size(), 2);
  EXPECT_EQ(activated_[1][0].toUInt(), 9u);
}

TEST_F(ElementTableTest, ManyRowsKeepTheirPlace) {
  std::vector<ElementRow> many;
  for (std::uint32_t id = 0; id < 20000; ++id) {
    many.push_back({id, {id, "convex", 0.5 * id}, Qt::red});
  }
  table_.set_rows(many);
  EXPECT_EQ(count(), "20,000 lines");
  table_.set_selected({15000});
  const int place = view()->verticalScrollBar()->value();
  EXPECT_GT(place, 10000);
  table_.set_rows(many);
  EXPECT_EQ(view()->verticalScrollBar()->value(), place);
  EXPECT_EQ(table_.selected(), Ids{15000});
  EXPECT_EQ(changed_.size(), 0);
}

// ---- history
// -------------------------------------------------------------------------------------

class HistoryPanelTest : public ::testing::Test {
 protected:
  void SetUp() override {
    show(panel_, 260, 120);
    set(40, 35);
  }
  void set(int count, int current) {
    std::vector<HistoryRow> rows;
    for (int i = 0; i < count; ++i) {
      const auto sequence = static_cast<std::uint32_t>(100 + i);
      rows.push_back({sequence, QString("Step %1").arg(i), "", i > current, i == current});
    }
    panel_.set_rows(rows);
  }
  QListWidget* list() const { return panel_.findChild<QListWidget*>(); }
  bool visible(int row) const {
    return list()->viewport()->rect().contains(list()->visualItemRect(list()->item(row)).center());
  }
  HistoryPanel panel_;
  QSignalSpy travel_{&panel_, &HistoryPanel::travel};
};

TEST_F(HistoryPanelTest, KeepsTheCurrentRowInSight) {
  EXPECT_TRUE(visible(35));
  set(40, 2);
  EXPECT_TRUE(visible(2));
  set(3, 1);
  EXPECT_EQ(list()->count(), 3);
  EXPECT_EQ(travel_.size(), 0);
}

TEST_F(HistoryPanelTest, ClickAndEnterTravel) {
  const auto click = [&](int row) {
    QTest::mouseClick(list()->viewport(), Qt::LeftButton, {},
                      list()->visualItemRect(list()->item(row)).center());
  };
  click(35);
  EXPECT_EQ(travel_.size(), 0);  // One is there already.
  click(36);
  ASSERT_EQ(travel_.size(), 1);
  EXPECT_EQ(travel_[0][0].toUInt(), 136u);
  set(40, 36);
  list()->setFocus();
  QTest::keyClick(list(), Qt::Key_Up);
  EXPECT_EQ(travel_.size(), 1);
  QTest::keyClick(list(), Qt::Key_Return);
  ASSERT_EQ(travel_.size(), 2);
  EXPECT_EQ(travel_[1][0].toUInt(), 135u);
}

TEST_F(HistoryPanelTest, RowsMayChangeWithinAClick) {
  QObject::connect(&panel_, &HistoryPanel::travel, &panel_, [this] { set(2, 0); });
  QTest::mouseClick(list()->viewport(), Qt::LeftButton, {},
                    list()->visualItemRect(list()->item(36)).center());
  EXPECT_EQ(list()->count(), 2);
}

// ---- steps
// ---------------------------------------------------------------------------------------

QVariantList interval(double low, double high) { return {low, high}; }

class StepsPanelTest : public ::testing::Test {
 protected:
  void SetUp() override {
    panel_.set_cards(cards());
    show(panel_, 260, 700);
  }

  static StepParameter parameter(const QString& key, const QString& label, StepParameter::Kind kind,
                                 const QVariant& value) {
    StepParameter p;
    p.key = key;
    p.label = label;
    p.tooltip = "What it does.";
    p.kind = kind;
    p.value = value;
    p.most = 180.0;
    return p;
  }

  static std::vector<StepCard> cards() {
    using Kind = StepParameter::Kind;
    StepParameter candidates = parameter("candidates", "Candidates", Kind::choice, QString("ring"));
    candidates.choices = {"ring", "best", "all"};
    candidates.choice_labels = {"Edges of the vertex and its ring", "Best edge", "All edges"};
    StepParameter angle = parameter("angle", "Angle TV_IH", Kind::real, 24.123456);
    angle.suffix = " °";
    return {
        {"open", "Scan", "What was opened.", StepState::done, "12 faces", "", {}, false},
        {"find_sharp_lines",
         "Sharp lines",
         "Finds lines.",
         StepState::done,
         "137 lines, 1,203 edges",
         "0.12 s",
         {angle, candidates, parameter("min_length", "Shortest line", Kind::whole, 3)}},
        {"find_partitions",
         "Partitions",
         "",
         StepState::out_of_date,
         "42 partitions",
         "1.04 s",
         {parameter("intervals", "Intervals", Kind::intervals,
                    QVariantList{QVariant(interval(0.0, 1.0)), QVariant(interval(2.0, 3.0))})}},
    };
  }
  template <class T>
  T* editor(const QString& name, int index = 0) const {
    for (T* found : panel_.findChildren<T*>()) {
      if (found->accessibleName() == name && !found->isHidden() && index-- == 0) return found;
    }
    return nullptr;
  }
  static void type(QDoubleSpinBox* box, const QString& text) {
    box->setFocus();
    box->selectAll();
    QTest::keyClicks(box, text);
  }

  StepsPanel panel_;
  QSignalSpy run_{&panel_, &StepsPanel::run_requested};
};

TEST_F(StepsPanelTest, RunGivesTheValuesAsEdited) {
  type(editor<QDoubleSpinBox>("Angle TV_IH"), "18.5");
  QComboBox* combo = editor<QComboBox>("Candidates");
  combo->setFocus();
  QTest::keyClick(combo, Qt::Key_Down);
  QTest::mouseClick(button(panel_, "Run Sharp lines"), Qt::LeftButton);
  ASSERT_EQ(run_.size(), 1);
  EXPECT_EQ(run_[0][0].toString(), "find_sharp_lines");
  const QVariantMap expected{{"angle", 18.5}, {"candidates", "best"}, {"min_length", 3}};
  EXPECT_EQ(run_[0][1].toMap(), expected);
  EXPECT_EQ(panel_.values("find_sharp_lines"), expected);
}

TEST_F(StepsPanelTest, AValueNobodyEditedKeepsAllItsDigits) {
  EXPECT_EQ(panel_.values("find_sharp_lines")["angle"].toDouble(), 24.123456);
  QTest::mouseClick(button(panel_, "Run Sharp lines"), Qt::LeftButton);
  EXPECT_EQ(run_[0][1].toMap()["angle"].toDouble(), 24.123456);
}

TEST_F(StepsPanelTest, NewCardsLeaveTypingAndEditsAlone) {
  QDoubleSpinBox* angle = editor<QDoubleSpinBox>("Angle TV_IH");
  type(angle, "18.");
  auto news = cards();
  news[1].state = StepState::out_of_date;
  news[1].result = "140 lines";
  news[1].parameters[0].value = 30.0;
  panel_.set_cards(news);
  EXPECT_TRUE(angle->hasFocus());
  EXPECT_EQ(angle->text(), "18. °");
  QTest::keyClicks(angle, "5");
  editor<QComboBox>("Candidates")->setFocus();
  panel_.set_cards(news);  // The same value again is no news.
  EXPECT_EQ(panel_.values("find_sharp_lines")["angle"].toDouble(), 18.5);
  news[1].parameters[0].value = 31.0;
  panel_.set_cards(news);
  EXPECT_EQ(panel_.values("find_sharp_lines")["angle"].toDouble(), 31.0);
}

TEST_F(StepsPanelTest, TheWheelScrollsThePanelAndTurnsNoEditorWithoutFocus) {
  QDoubleSpinBox* angle = editor<QDoubleSpinBox>("Angle TV_IH");
  editor<QComboBox>("Candidates")->setFocus();
  const double before = angle->value();
  wheel(*angle, angle->rect().center(), 120);
  EXPECT_EQ(angle->value(), before);
  angle->setFocus();
  wheel(*angle, angle->rect().center(), 120);
  EXPECT_GT(angle->value(), before);
}

TEST_F(StepsPanelTest, IntervalsAreAddedEditedAndDropped) {
  const auto intervals = [&] { return panel_.values("find_partitions")["intervals"].toList(); };
  for (QToolButton* add : panel_.findChildren<QToolButton*>()) {
    if (add->text().startsWith("+")) QTest::mouseClick(add, Qt::LeftButton);
  }
  ASSERT_EQ(intervals().size(), 3);
  type(editor<QDoubleSpinBox>("Interval from", 2), "5");
  type(editor<QDoubleSpinBox>("Interval to", 2), "6.5");
  EXPECT_EQ(intervals()[2].toList(), interval(5.0, 6.5));
  QTest::mouseClick(editor<QToolButton>("Drop interval", 0), Qt::LeftButton);
  ASSERT_EQ(intervals().size(), 2);
  EXPECT_EQ(intervals()[0].toList(), interval(2.0, 3.0));
}

TEST_F(StepsPanelTest, AnIntervalThatEndsBeforeItBeginsCannotRun) {
  QPushButton* run = button(panel_, "Run Partitions");
  EXPECT_TRUE(run->isEnabled());
  type(editor<QDoubleSpinBox>("Interval from"), "7");
  EXPECT_FALSE(run->isEnabled());
  EXPECT_TRUE(run->toolTip().contains("interval"));
  type(editor<QDoubleSpinBox>("Interval to"), "8");
  EXPECT_TRUE(run->isEnabled());
}

TEST_F(StepsPanelTest, BusyTurnsRunOff) {
  panel_.set_busy(true);
  panel_.set_cards(cards());
  EXPECT_FALSE(button(panel_, "Run Sharp lines")->isEnabled());
  EXPECT_FALSE(button(panel_, "Run all out of date")->isEnabled());
  panel_.set_busy(false);
  EXPECT_TRUE(button(panel_, "Run Sharp lines")->isEnabled());
}

TEST_F(StepsPanelTest, OutOfDateStepsOfferToRunAgain) {
  QSignalSpy again(&panel_, &StepsPanel::run_out_of_date_requested);
  QTest::mouseClick(button(panel_, "Run all out of date"), Qt::LeftButton);
  EXPECT_EQ(again.size(), 1);
  auto news = cards();
  news[2].state = StepState::done;
  panel_.set_cards(news);
  EXPECT_EQ(button(panel_, "Run all out of date"), nullptr);
}

TEST_F(StepsPanelTest, ACardThatCannotBeRunHasNoButton) {
  EXPECT_EQ(button(panel_, "Run Scan"), nullptr);
  EXPECT_TRUE(panel_.values("open").isEmpty());
  EXPECT_TRUE(panel_.values("no_such_step").isEmpty());
}

TEST_F(StepsPanelTest, CardsMayChangeWithinAClick) {
  QObject::connect(&panel_, &StepsPanel::run_requested, &panel_,
                   [this] { panel_.set_cards({cards()[0]}); });
  QTest::mouseClick(button(panel_, "Run Sharp lines"), Qt::LeftButton);
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  EXPECT_EQ(button(panel_, "Run Sharp lines"), nullptr);
}

TEST_F(StepsPanelTest, ANarrowPanelCutsNothing) {
  auto* scroll = panel_.findChild<QScrollArea*>();
  auto long_words = cards();
  for (const char* label : {"Parallel distance", "Least mean curvature of a face that passes"}) {
    long_words[1].parameters.push_back(parameter(label, label, StepParameter::Kind::real, 0.25));
    long_words[1].parameters.back().suffix = " 1/mm²";
  }
  panel_.set_cards(long_words);
  for (const int height : {700, 200}) {
    panel_.resize(260, height);
    QApplication::processEvents();
    EXPECT_LE(scroll->widget()->width(), scroll->viewport()->width());
    for (const QLabel* label : panel_.findChildren<QLabel*>()) {
      if (label->isHidden() || label->text().isEmpty()) continue;
      const QRect text = label->fontMetrics().boundingRect(
          QRect(0, 0, label->width(), 1000), label->wordWrap() ? int(Qt::TextWordWrap) : 0,
          label->text());
      EXPECT_LE(text.width(), label->width()) << label->text().toStdString();
      EXPECT_LE(text.height(), label->height()) << label->text().toStdString();
    }
  }
}

// ---- start page
// ----------------------------------------------------------------------------------

TEST(StartPage, SaysWhatIsWanted) {
  StartPage page;
  QSignalSpy open(&page, &StartPage::open_wanted), sample(&page, &StartPage::sample_wanted);
  QSignalSpy recent(&page, &StartPage::recent_wanted);
  const QString file = "/data/moulds/a very long folder name that nobody can read/blade.stl";
  page.set_recent({"/data/mould.ply", file});
  show(page, 900, 700);
  QTest::mouseClick(button(page, "Open scan…"), Qt::LeftButton);
  EXPECT_EQ(open.size(), 1);
  QTest::mouseClick(button(page, "Open the sample mould"), Qt::LeftButton);
  EXPECT_EQ(sample.size(), 1);
  QPushButton* entry = button(page, "blade.stl");
  ASSERT_NE(entry, nullptr);
  EXPECT_TRUE(entry->toolTip().contains("nobody can read"));
  QObject::connect(&page, &StartPage::recent_wanted, &page, [&] { page.set_recent({}); });
  QTest::mouseClick(entry, Qt::LeftButton);
  ASSERT_EQ(recent.size(), 1);
  EXPECT_EQ(recent[0][0].toString(), file);
  EXPECT_EQ(button(page, "mould.ply"), nullptr);
}

}  // namespace
}  // namespace arris::ui
