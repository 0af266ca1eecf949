// Views that were given names: kept by hand, walked through by keys, saved with the session, and
// pictured.

#include <QApplication>
#include <QCheckBox>
#include <QDir>
#include <QFileDialog>
#include <QImage>
#include <QInputDialog>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTimer>

#include "tests/ui/window_fixture.h"
#include "ui/window/named_views_dialog.h"
#include "ui/window/named_views_presenter.h"
#include "ui/window/report_presenter.h"

namespace arris::ui {
namespace {

class NamedViews : public MainWindowTest {
 protected:
  NamedViewsPresenter& named() { return window->named_views(); }
  QStringList names() {
    QStringList list;
    for (const auto& view : named().views()) list << view.name;
    return list;
  }
  /// Ctrl+Shift+V and a name.
  void keep(const QString& name) {
    bool asked = false;
    QTimer timer;
    QObject::connect(&timer, &QTimer::timeout, &timer, [&] {
      auto* dialog = qobject_cast<QInputDialog*>(QApplication::activeModalWidget());
      if (!dialog || asked) return;
      asked = true;
      dialog->setTextValue(name);
      dialog->accept();
    });
    timer.start(20);
    press(Qt::Key_V, Qt::ControlModifier | Qt::ShiftModifier);
    ASSERT_TRUE(QTest::qWaitFor([&] { return asked; }, patience));
  }
  void two_views() {
    open_sample();
    run_both();
    window->view().look_from(MeshView::StandardView::top);
    window->show_partitions(true);
    keep("Partitions from above");
    window->view().look_from(MeshView::StandardView::left);
    window->set_field(Field::h);
    keep("Mean curvature");
    window->view().look_from(MeshView::StandardView::isometric);
    window->set_field(Field::k);
  }
  void expect_first() {
    EXPECT_GT(window->view().towards_viewer().dot(Point::UnitZ()), 0.999);
    EXPECT_TRUE(shows_partitions());
  }
  void expect_second() {
    EXPECT_GT(std::abs(window->view().towards_viewer().dot(Point::UnitX())), 0.999);
    EXPECT_FALSE(shows_partitions());
    EXPECT_EQ(window->fields().field(), Field::h);
  }
  bool shows_partitions() {
    for (QAction* a : window->findChildren<QAction*>())
      if (a->shortcut() == QKeySequence("P")) return a->isChecked();
    return false;
  }
  const QTemporaryDir folder;
};

TEST_F(NamedViews, AreWalkedThroughByKeysAndComeBackWithTheSession) {
  two_views();
  EXPECT_EQ(names(), (QStringList{"Partitions from above", "Mean curvature"}));
  QTest::keyClick(window.get(), Qt::Key_1, Qt::ControlModifier);
  expect_first();
  QTest::keyClick(window.get(), Qt::Key_PageDown, Qt::ControlModifier);
  expect_second();
  QTest::keyClick(window.get(), Qt::Key_PageDown, Qt::ControlModifier);
  expect_first();  // round
  QTest::keyClick(window.get(), Qt::Key_PageUp, Qt::ControlModifier);
  expect_second();

  // A name again: the view is another.
  window->view().look_from(MeshView::StandardView::bottom);
  keep("Mean curvature");
  EXPECT_EQ(names().size(), 2);
  window->view().look_from(MeshView::StandardView::left);
  keep("Mean curvature");

  const QString path = folder.filePath("part.arris");
  bool saved = false;
  const auto save = [&] {
    saved = false;
    SessionExtras extras;
    nlohmann::json view;
    view["named"] = named().saved();
    extras.view = view.dump();
    window->session().save(path, extras, [&](const Result<void>& written) { saved = !!written; });
    ASSERT_TRUE(QTest::qWaitFor([&] { return saved; }, patience));
  };
  EXPECT_TRUE(window->session().has_unsaved_edits());
  save();
  EXPECT_FALSE(window->session().has_unsaved_edits());
  keep("Third");
  EXPECT_TRUE(window->session().has_unsaved_edits()) << "a view alone is worth a question";
  save();
  window->session().mark_saved();
  window->open_sample();
  ASSERT_TRUE(QTest::qWaitFor([&] { return rows() == 1 && idle(); }, patience));
  EXPECT_EQ(names(), QStringList()) << "those were of another session";
  window->open(path);
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return document().step("find_partitions") && idle(); }, patience));
  EXPECT_EQ(names(), (QStringList{"Partitions from above", "Mean curvature", "Third"}));
  EXPECT_FALSE(window->session().has_unsaved_edits());
  named().show(0);
  expect_first();
  named().show(1);
  expect_second();
}

TEST_F(NamedViews, AreArranged) {
  two_views();
  NamedViewsDialog dialog(named().views(), window.get());
  dialog.show();
  auto* list = dialog.findChild<QListWidget*>("named_views");
  ASSERT_EQ(list->count(), 2);
  list->item(0)->setText("  From   above ");
  list->item(1)->setText("From above");  // stands twice: as it was
  const auto button = [&](const QString& text) {
    for (QPushButton* b : dialog.findChildren<QPushButton*>())
      if (b->text() == text) return b;
    throw std::logic_error("no such button");
  };
  EXPECT_FALSE(button("&Up")->isEnabled());
  QTest::mouseClick(button("&Down"), Qt::LeftButton);
  const auto arranged = dialog.views();
  ASSERT_EQ(arranged.size(), 2u);
  EXPECT_EQ(arranged[0].name, "From above");
  EXPECT_EQ(arranged[1].name, "Partitions from above");
  QTest::mouseClick(button("Dele&te"), Qt::LeftButton);
  EXPECT_EQ(dialog.views().size(), 1u);
  named().set_views(dialog.views());
  EXPECT_EQ(names(), QStringList{"From above"});
  QTest::keyClick(window.get(), Qt::Key_1, Qt::ControlModifier);
  expect_second();
}

TEST_F(NamedViews, OfAStrangerAreTakenAsFarAsTheyCanBe) {
  open_sample();
  named().restore(nlohmann::json::parse(R"([1, {"name": "a"}])"));
  EXPECT_EQ(names(), QStringList());
  named().restore(nlohmann::json::parse(
      R"([{"name": "a"}, {"name": "b", "view": {}}, {"name": "b", "view": {}}, {"name": " ",
          "view": {}}, {"name": "c", "view": {"camera": {"up": [0, 0, 0], "height": -1}}}])"));
  EXPECT_EQ(names(), (QStringList{"b", "c"}));
  for (std::size_t k = 0; k < 3; ++k) named().show(k);
  named().restore({});
  EXPECT_EQ(names(), QStringList());
}

TEST_F(NamedViews, AreThePicturesOfTheReport) {
  two_views();
  ReportRequest request;
  request.folder = folder.filePath("report").toStdString();
  bool done = false;
  QString error;
  window->reports().write(request, false, [&](const QString& told) {
    error = told;
    done = true;
  });
  ASSERT_TRUE(QTest::qWaitFor([&] { return done; }, patience));
  EXPECT_EQ(error, "");
  const QDir report(folder.filePath("report"));
  EXPECT_EQ(report.entryList({"*.png"}, QDir::Files, QDir::Name),
            (QStringList{"view_1.png", "view_2.png"}));
  EXPECT_NE(QImage(report.filePath("view_1.png")), QImage(report.filePath("view_2.png")));
  QFile page(report.filePath("report.html"));
  ASSERT_TRUE(page.open(QIODevice::ReadOnly));
  EXPECT_TRUE(page.readAll().contains(">Partitions from above</p>"));
  EXPECT_EQ(window->fields().field(), Field::k) << "the part is looked at as before";
}

TEST_F(NamedViews, AreSavedAsPicturesAllAtOnce) {
  two_views();
  named().keep("a/b");
  named().keep("a:b");
  bool asked = false, chosen = false;
  QTimer timer;
  QObject::connect(&timer, &QTimer::timeout, &timer, [&] {
    QWidget* modal = QApplication::activeModalWidget();
    if (!modal) return;
    if (auto* files = qobject_cast<QFileDialog*>(modal)) {
      if (std::exchange(chosen, true)) return;
      files->setDirectory(folder.path());
      files->findChild<QLineEdit*>()->setText(folder.path());
      QMetaObject::invokeMethod(files, "accept");
    } else if (auto* each = modal->findChild<QCheckBox*>("each_view"); each && !asked) {
      asked = true;
      EXPECT_TRUE(each->isEnabled());
      each->setChecked(true);
      QMetaObject::invokeMethod(modal, "accept");
    }
  });
  timer.start(20);
  press(Qt::Key_P, Qt::ControlModifier);
  ASSERT_TRUE(QTest::qWaitFor([&] { return asked && chosen; }, patience));
  timer.stop();
  const QString part = QFileInfo(window->session().part_name()).completeBaseName();
  EXPECT_EQ(QDir(folder.path()).entryList({"*.png"}, QDir::Files, QDir::Name),
            (QStringList{part + "_Mean curvature.png", part + "_Partitions from above.png",
                         part + "_a_b.png", part + "_a_b_2.png"}));
}

}  // namespace
}  // namespace arris::ui
