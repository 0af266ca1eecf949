// One whole tuning session by mouse and keyboard, on a real scan where there is one, with asserts
// on the document after each step. ARRIS_SHOTS=folder keeps a picture of the window at each step.

#include <filesystem>
#include <set>

#include <gtest/gtest.h>
#include <QAction>
#include <QDir>
#include <QDockWidget>
#include <QImage>
#include <QLabel>
#include <QTableView>
#include <QTemporaryDir>
#include <QTest>

#include "core/document/treatments/treatment.h"
#include "tests/ui/window_fixture.h"
#include "ui/panels/controls.h"
#include "ui/panels/element_table.h"
#include "ui/panels/steps_panel.h"
#include "ui/panels/treatment_bar.h"

namespace arris::ui {
namespace {

class TuningSession : public MainWindowTest {
 protected:
  void press(Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    QTest::keyClick(window.get(), key, modifiers);
  }
  /// Waits until `reached` holds and nothing runs.
  bool settles(const std::function<bool()>& reached) {
    return QTest::qWaitFor([&] { return idle() && reached(); }, patience);
  }
  void shot(const char* name) {
    const QString folder = qEnvironmentVariable("ARRIS_SHOTS");
    if (folder.isEmpty()) return;
    ASSERT_TRUE(comes_to_rest());
    window->grab().save(QDir(folder).filePath(QString(name) + ".png"));
  }
  /// Selects rows of a table by their ids: a click, then Ctrl-clicks.
  void select(const char* dock, const std::vector<std::uint32_t>& ids) {
    auto* panel = window->findChild<QDockWidget*>(dock);
    panel->raise();
    ASSERT_TRUE(comes_to_rest());
    auto* table = panel->findChild<QTableView*>();
    Qt::KeyboardModifiers modifiers;
    for (const std::uint32_t id : ids) {
      for (int row = 0; row < table->model()->rowCount(); ++row) {
        const QModelIndex cell = table->model()->index(row, 0);
        if (cell.data().toUInt() != id) continue;
        table->scrollTo(cell);
        QTest::mouseClick(table->viewport(), Qt::LeftButton, modifiers,
                          table->visualRect(cell).center());
        break;
      }
      modifiers = Qt::ControlModifier;
    }
  }
  TreatmentBar& bar() { return *window->findChild<TreatmentBar*>(); }
  /// Types into the number of the treatment bar.
  void type_number(double value) {
    auto* box = bar().findChild<NumberBox*>();
    box->setFocus();
    box->selectAll();
    QTest::keyClicks(box, QString::number(value));
    QTest::keyClick(box, Qt::Key_Tab);
  }
  std::string last_operation() const {
    const History& history = window->session().history();
    return history.entries()[history.head() - 1].operation.name;
  }
  /// Refused or not, as the operation itself says.
  bool possible(const Operation& operation) const {
    return apply(document(), operation).has_value();
  }
};

TEST_F(TuningSession, FromTheScanToLinesAndPartitionsAndAllTheWayBack) {
  const std::filesystem::path scan =
      std::filesystem::path(ARRIS_SOURCE_DIR) / "../shared/data/truth/crankarm_scan.ply";
  if (std::filesystem::exists(scan)) {
    window->open(QString::fromStdString(scan.string()));
    ASSERT_TRUE(settles([&] { return !document().empty(); }));
  } else {
    open_sample();
  }
  ASSERT_TRUE(comes_to_rest());
  shot("01_open");

  // Prepare, find, and tune the sharp angle by its handle.
  press(Qt::Key_F5, Qt::ShiftModifier);  // the paper's flow
  ASSERT_TRUE(settles([&] { return document().step("find_partitions").has_value(); }));
  EXPECT_TRUE(document().step("simplify").has_value());
  EXPECT_LT(document().mesh->face_count(), document().opened.mesh->face_count());
  shot("02_prepared");
  window->set_field(Field::ihe);
  HistogramPanel& histogram = window->histogram();
  const double angle_before = document().step("find_sharp_lines")->parameters["angle"];
  const QPoint handle = histogram.handle_position(0);
  QTest::mousePress(&histogram, Qt::LeftButton, {}, handle);
  for (int k = 1; k <= 6; ++k) {
    QTest::mouseMove(&histogram, handle + QPoint(2 * k, 0));
    QTest::qWait(40);  // as fast as a hand
  }
  QTest::mouseRelease(&histogram, Qt::LeftButton, {}, handle + QPoint(12, 0));
  ASSERT_TRUE(settles([&] {
    return document().step("find_sharp_lines")->parameters["angle"].get<double>() > angle_before;
  }));
  shot("03_tuned");

  // Delete two lines.
  ASSERT_GE(document().lines.lines.size(), 8u);
  const std::uint32_t first = document().lines.lines[0]->id, second = document().lines.lines[1]->id;
  select("lines", {first, second});
  ASSERT_EQ(window->elements().selected_lines().size(), 2u);
  shot("04_two_selected");
  press(Qt::Key_Delete);
  ASSERT_TRUE(settles([&] { return last_operation() == "delete_lines"; }));
  EXPECT_EQ(document().lines.find(first), nullptr);
  EXPECT_EQ(document().lines.find(second), nullptr);

  // Extend one under an angle of its own: previewed, then one row of history.
  std::uint32_t extended = 0;
  for (const LinePtr& line : document().lines.lines) {
    const Operation extend{"extend_line", {{"line", line->id}, {"angle", 8.0}}};
    const auto longer = apply(document(), extend);
    if (longer && longer->lines.find(line->id) &&
        longer->lines.find(line->id)->length > line->length) {
      extended = line->id;
      break;
    }
  }
  ASSERT_NE(extended, 0u);
  const double length_before = document().lines.find(extended)->length;
  select("lines", {extended});
  const std::uint32_t rows_before = rows();
  press(Qt::Key_X);
  ASSERT_TRUE(bar().isVisible());
  type_number(8.0);
  ASSERT_TRUE(settles([&] {
    const Line* line = shown().lines.find(extended);
    return window->session().is_previewing() && line && line->length > length_before;
  }));
  EXPECT_EQ(rows(), rows_before);  // a preview leaves no trace
  shot("05_extend");
  press(Qt::Key_Return);
  ASSERT_TRUE(settles([&] { return last_operation() == "extend_line"; }));
  EXPECT_EQ(rows(), rows_before + 1);
  EXPECT_FALSE(bar().isVisible());
  EXPECT_GT(document().lines.find(extended)->length, length_before);

  // Merge two across a gap.
  std::vector<std::uint32_t> pair;
  for (const LinePtr& a : document().lines.lines)
    for (const LinePtr& b : document().lines.lines)
      if (pair.empty() && a->id < b->id && !a->closed && !b->closed &&
          (document().mesh->point(a->vertices.back()) - document().mesh->point(b->vertices.front()))
                  .norm() < 4.0 * document().mesh->mean_edge_length() &&
          possible({"merge_lines", {{"a", a->id}, {"b", b->id}}}))
        pair = {a->id, b->id};
  ASSERT_EQ(pair.size(), 2u);
  select("lines", pair);
  press(Qt::Key_J);
  ASSERT_TRUE(settles([&] { return window->session().is_previewing(); }));
  shot("06_merge");
  press(Qt::Key_Return);
  ASSERT_TRUE(settles([&] { return last_operation() == "merge_lines"; }));

  // Draw one: two clicks on the part and Enter.
  window->elements().clear_selection();
  press(Qt::Key_F);
  press(Qt::Key_D);
  ASSERT_EQ(window->view().tool(), Tool::path);
  std::set<std::uint32_t> on_lines;
  for (const LinePtr& line : document().lines.lines)
    on_lines.insert(line->vertices.begin(), line->vertices.end());
  const auto from = find([&](const Pick& p) {
    return p.vertex != no_id && !on_lines.contains(p.vertex) &&
           !document().mesh->is_border(p.vertex);
  });
  ASSERT_TRUE(from.has_value());
  const VertexId start = window->view().pick(*from)->vertex;
  const auto to = find([&](const Pick& p) {
    return p.vertex != no_id && p.vertex != start && !document().mesh->is_border(p.vertex) &&
           (document().mesh->point(p.vertex) - document().mesh->point(start)).norm() >
               5.0 * document().mesh->mean_edge_length();
  });
  ASSERT_TRUE(to.has_value());
  QTest::mouseClick(&window->view(), Qt::LeftButton, {}, *from);
  QTest::mouseMove(&window->view(), *to);
  ASSERT_TRUE(settles([&] { return window->session().is_previewing(); }));
  shot("07_draw");
  QTest::mouseClick(&window->view(), Qt::LeftButton, {}, *to);
  QTest::keyClick(&window->view(), Qt::Key_Return);
  ASSERT_TRUE(settles([&] { return last_operation() == "draw_line"; }));
  EXPECT_EQ(window->view().tool(), Tool::select);

  // The corrections hold when lines are found again.
  const std::size_t corrections = document().corrections.size();
  EXPECT_EQ(corrections, 4u);
  press(Qt::Key_F5);
  ASSERT_TRUE(settles([&] { return last_operation() == "find_partitions"; }));
  EXPECT_EQ(document().corrections.size(), corrections);

  // Connect two partitions, extend one, remove one.
  window->show_partitions(true);
  std::vector<std::uint32_t> adjacent;
  for (const BoundaryPtr& b : *document().boundaries)
    if (adjacent.empty() && b->left != 0 && b->right != 0 && b->left != b->right)
      adjacent = {b->left, b->right};
  ASSERT_EQ(adjacent.size(), 2u);
  const std::size_t partitions = document().partitions.partitions.size();
  select("partitions", adjacent);
  press(Qt::Key_J, Qt::ShiftModifier);
  ASSERT_TRUE(settles([&] { return window->session().is_previewing(); }));
  shot("08_connect");
  press(Qt::Key_Return);
  ASSERT_TRUE(settles([&] { return last_operation() == "connect_partitions"; }));
  EXPECT_EQ(document().partitions.partitions.size(), partitions - 1);

  std::uint32_t open = 0;
  for (const BoundaryPtr& b : *document().boundaries)
    if (open == 0 && b->type == BoundaryType::undefined) open = std::max(b->left, b->right);
  if (open != 0) {
    select("partitions", {open});
    press(Qt::Key_E, Qt::ShiftModifier);
    ASSERT_TRUE(settles([&] { return window->session().is_previewing(); }));
    shot("09_extend_partition");
    press(Qt::Key_Return);
    ASSERT_TRUE(settles([&] { return last_operation() == "extend_partition"; }));
  }
  const std::uint32_t removed = document().partitions.partitions.back()->id;
  select("partitions", {removed});
  press(Qt::Key_Delete);
  ASSERT_TRUE(settles([&] { return last_operation() == "remove_partitions"; }));
  EXPECT_EQ(document().partitions.find(removed), nullptr);
  shot("10_removed");

  // All the way back, and all the way forth.
  const std::string end = hash_of(document());
  const std::uint32_t head = window->session().history().head();
  const auto head_now = [&] { return window->session().history().head(); };
  for (int k = 0; k < 100 && head_now() > 1; ++k) {
    const std::uint32_t was = head_now();
    press(Qt::Key_Z, Qt::ControlModifier);
    ASSERT_TRUE(settles([&] { return head_now() < was; }));
  }
  EXPECT_EQ(window->session().history().head(), 1u);
  EXPECT_TRUE(document().lines.lines.empty());
  EXPECT_EQ(document().mesh, document().opened.mesh);
  shot("11_undone");
  for (int k = 0; k < 100 && window->session().history().can_redo(); ++k) {
    const std::uint32_t was = head_now();
    press(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
    ASSERT_TRUE(settles([&] { return head_now() > was; }));
  }
  EXPECT_EQ(window->session().history().head(), head);
  EXPECT_EQ(hash_of(document()), end);
  shot("12_redone");

  const QTemporaryDir folder;
  const QString picture = folder.filePath("picture.png");
  PictureOptions options;
  options.size = {800, 600};
  EXPECT_TRUE(window->save_picture(picture, options));
  EXPECT_EQ(QImage(picture).size(), QSize(800, 600));
}

TEST_F(TuningSession, ADragThatChangesOnlyLinesKeepsThePictureOfTheSurface) {
  open_sample();
  run_both();
  window->set_field(Field::normal_jump);
  ASSERT_TRUE(comes_to_rest());
  HistogramPanel& histogram = window->histogram();
  const QPoint handle = histogram.handle_position(0);
  const auto angle = [&] {
    return shown().step("find_sharp_lines")->parameters["angle"].get<double>();
  };
  const auto move = [&](int by) {
    const double before = angle();
    QTest::mouseMove(&histogram, handle + QPoint(by, 0));
    return QTest::qWaitFor([&] { return angle() != before; }, patience) && comes_to_rest();
  };
  QTest::mousePress(&histogram, Qt::LeftButton, {}, handle);
  // The first move greys the partitions, as those of other lines.
  ASSERT_TRUE(move(6));
  const int drawn = window->view().surfaces_drawn();
  const QImage before = window->view().grabFramebuffer();
  for (int by = 12; by <= 60; by += 12) ASSERT_TRUE(move(by));
  EXPECT_EQ(window->view().surfaces_drawn(), drawn);
  EXPECT_NE(window->view().grabFramebuffer(), before) << "the lines follow";
  QTest::keyClick(&histogram, Qt::Key_Escape);
  QTest::mouseRelease(&histogram, Qt::LeftButton, {}, handle);
}

TEST_F(TuningSession, ActionsThatCannotBeDoneSayWhy) {
  open_sample();
  run_both();
  const auto named = [&](const QString& text) {
    for (QAction* a : window->findChildren<QAction*>())
      if (a->text().remove('&').startsWith(text)) return a;
    return static_cast<QAction*>(nullptr);
  };
  window->elements().clear_selection();
  for (const char* text : {"Extend", "Merge", "Trim", "Connect", "Restart"}) {
    QAction* action = named(text);
    ASSERT_NE(action, nullptr) << text;
    EXPECT_FALSE(action->isEnabled()) << text;
    EXPECT_TRUE(action->toolTip().contains("elect")) << action->toolTip().toStdString();
  }
}

TEST_F(TuningSession, EscapeLeavesEverythingAsItWas) {
  open_sample();
  run_both();
  const std::string before = hash_of(document());
  ASSERT_FALSE(document().lines.lines.empty());
  std::uint32_t open = 0;
  for (const LinePtr& line : document().lines.lines)
    if (!line->closed) open = line->id;
  ASSERT_NE(open, 0u);
  select("lines", {open});
  press(Qt::Key_X);
  ASSERT_TRUE(bar().isVisible());
  type_number(5.0);
  ASSERT_TRUE(settles([&] { return window->session().is_previewing(); }));
  press(Qt::Key_Escape);
  EXPECT_FALSE(bar().isVisible());
  EXPECT_FALSE(window->session().is_previewing());
  EXPECT_EQ(hash_of(document()), before);
  EXPECT_TRUE(window->elements().selected_lines().contains(open));
}

TEST_F(TuningSession, ANumberThatIsTypedAndEnteredIsTheOneThatIsTaken) {
  open_sample();
  run_both();
  ASSERT_FALSE(document().partitions.partitions.empty());
  const std::uint32_t before = rows();
  press(Qt::Key_M, Qt::ShiftModifier);
  ASSERT_TRUE(bar().isVisible());
  auto* box = bar().findChild<NumberBox*>();
  box->setFocus();
  box->selectAll();
  std::vector<std::uint32_t> faces;
  for (const PartitionPtr& partition : document().partitions.partitions)
    faces.push_back(partition->faces);
  std::ranges::sort(faces);
  const std::uint32_t limit = faces[2] + 1;  // three go
  QTest::keyClicks(box, QString::number(limit));
  QTest::keyClick(box, Qt::Key_Return);
  ASSERT_TRUE(settles([&] { return rows() == before + 1; }));
  const Operation& operation = window->session().history().entries().back().operation;
  EXPECT_EQ(operation.name, "remove_small_partitions");
  EXPECT_EQ(operation.parameters.at("faces"), limit);
  EXPECT_EQ(document().partitions.partitions.size(), faces.size() - 3);
  EXPECT_FALSE(bar().isVisible());
}

TEST_F(TuningSession, LettingGoOfTheSliderShowsAndAClickOnThePartTakes) {
  open_sample();
  run_both();
  const std::uint32_t before = rows();
  press(Qt::Key_M, Qt::ShiftModifier);
  ASSERT_TRUE(bar().isVisible());
  auto* slider = bar().findChild<QSlider*>();
  slider->setSliderDown(true);
  slider->setValue(slider->maximum() / 2);
  slider->setSliderDown(false);
  ASSERT_TRUE(settles([&] { return window->session().is_previewing(); }));
  EXPECT_EQ(rows(), before) << "shown, not taken";
  EXPECT_TRUE(bar().isVisible());
  const double value = bar().value();
  EXPECT_EQ(value, std::round(value)) << "faces are counted";
  QTest::mouseClick(&window->view(), Qt::LeftButton, {}, window->view().rect().center());
  ASSERT_TRUE(settles([&] { return rows() == before + 1; }));
  EXPECT_EQ(window->session().history().entries().back().operation.parameters.at("faces"), value);
  EXPECT_FALSE(bar().isVisible());
}

TEST_F(TuningSession, KeysThatGoElsewhereCloseThePreviewFirst) {
  open_sample();
  run_both();
  const std::string current = hash_of(document());
  const auto start = [&] {
    press(Qt::Key_M, Qt::ShiftModifier);
    ASSERT_TRUE(bar().isVisible());
    type_number(500.0);
    ASSERT_TRUE(settles([&] { return window->session().is_previewing(); }));
  };
  start();
  press(Qt::Key_F7);
  EXPECT_FALSE(bar().isVisible());
  EXPECT_FALSE(window->session().is_previewing());
  EXPECT_EQ(hash_of(document()), current);
  start();
  const std::uint32_t head = window->session().history().head();
  press(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_FALSE(bar().isVisible());
  ASSERT_TRUE(settles([&] { return idle() && window->session().history().head() == head - 1; }));
  EXPECT_FALSE(bar().isVisible()) << "nor does it come back over another document";
}

TEST_F(TuningSession, AnEditedCardSaysSoAndF5RunsIt) {
  open_sample();
  run_both();
  auto* panel = window->findChild<StepsPanel*>();
  const double angle = document().step("find_sharp_lines")->parameters.at("angle").get<double>();
  NumberBox* box = nullptr;
  for (NumberBox* each : panel->findChildren<NumberBox*>())
    if (each->accessibleName().contains("TV_IH")) box = each;
  ASSERT_NE(box, nullptr);
  const auto says_changed = [&] {
    const QList<QLabel*> labels = panel->findChildren<QLabel*>();
    return std::ranges::any_of(labels, [](const QLabel* label) {
      return label->isVisible() && label->text().startsWith("Changed, not run");
    });
  };
  EXPECT_FALSE(says_changed());
  const std::uint32_t before = rows();
  box->setFocus();
  box->selectAll();
  QTest::keyClicks(box, QString::number(angle + 8.0));
  EXPECT_TRUE(panel->is_edited("find_sharp_lines"));
  EXPECT_TRUE(says_changed());
  press(Qt::Key_F5);
  ASSERT_TRUE(settles([&] { return rows() == before + 2 && idle(); })) << "lines, then partitions";
  EXPECT_NEAR(document().step("find_sharp_lines")->parameters.at("angle").get<double>(),
              angle + 8.0, 1e-9);
  EXPECT_FALSE(says_changed());
  EXPECT_FALSE(panel->is_edited("find_sharp_lines"));
  press(Qt::Key_Tab);  // the field is left as it was run
  QTest::qWait(200);   // nothing may happen in this time
  EXPECT_EQ(rows(), before + 2);
  EXPECT_FALSE(document().step("find_partitions")->out_of_date);
  box->setFocus();
  // Typed back to what it is: nothing has changed.
  box->selectAll();
  QTest::keyClicks(box, QString::number(angle));
  EXPECT_TRUE(panel->is_edited("find_sharp_lines"));
  box->selectAll();
  QTest::keyClicks(box, QString::number(angle + 8.0));
  EXPECT_FALSE(panel->is_edited("find_sharp_lines"));
}

TEST_F(TuningSession, EachOfManyUndosIsDone) {
  open_sample();
  for (int k = 0; k < 12; ++k) run({"find_sharp_lines", {{"angle", 20.0 + k}}});
  const std::uint32_t head = window->session().history().head();
  ASSERT_EQ(head, 13u);
  for (int k = 0; k < 10; ++k) press(Qt::Key_Z, Qt::ControlModifier);
  ASSERT_TRUE(settles([&] { return idle() && window->session().history().head() == head - 10; }))
      << window->session().history().head();
  for (int k = 0; k < 4; ++k) press(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  press(Qt::Key_Z, Qt::ControlModifier);
  ASSERT_TRUE(settles([&] { return idle() && window->session().history().head() == head - 7; }))
      << window->session().history().head();
}

}  // namespace
}  // namespace arris::ui
