// Saving, opening and recovering sessions in the real window.

#include <filesystem>

#include <gtest/gtest.h>
#include <QAction>
#include <QApplication>
#include <QFile>
#include <QFileDialog>
#include <QLineEdit>
#include <QMessageBox>
#include <QPointer>
#include <QPushButton>
#include <QSettings>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>

#include "core/document/journal.h"
#include "tests/support/documents.h"
#include "tests/ui/window_fixture.h"
#include "ui/panels/start_page.h"
#include "ui/window/export_dialog.h"

namespace arris::ui {
namespace {

class Saving : public MainWindowTest {
 protected:
  /// Answers the next message box by the button of this text, and keeps what it said.
  void answer(const QString& button) {
    when_asked<QMessageBox>([this, button](QMessageBox* box) {
      said << box->text() + " " + box->informativeText();
      for (QAbstractButton* b : box->buttons())
        if (b->text().remove('&') == button) return b->click();
      ADD_FAILURE() << "no " << button.toStdString() << " in: " << box->text().toStdString();
      box->reject();
    });
  }
  /// The same for a file dialog.
  void choose(const QString& path) {
    when_asked<QFileDialog>([this, path](QFileDialog* dialog) {
      ++dialogs;
      type(dialog, path);
    });
  }
  /// As typed, and Enter.
  static void type(QFileDialog* dialog, const QString& path) {
    dialog->selectFile(path);  // and what was selected no more
    auto* edit = dialog->findChild<QLineEdit*>("fileNameEdit");
    edit->setText(path);
    emit edit->textEdited(path);
    QMetaObject::invokeMethod(dialog, "accept");
  }
  /// A question that nobody expected fails the test instead of waiting for ever.
  void SetUp() override {
    MainWindowTest::SetUp();
    QObject::connect(&watchdog, &QTimer::timeout, &watchdog, [this] {
      QWidget* modal = QApplication::activeModalWidget();
      // One that just came, on a machine that is busy, may still be answered.
      const bool is_new = modal != waiting.data();
      waiting = modal;
      if (!modal || is_new) return;
      auto* box = qobject_cast<QMessageBox*>(modal);
      ADD_FAILURE() << "nobody answers: " << (box ? box->text().toStdString() : "a file dialog");
      modal->close();
    });
    watchdog.start(8000);
  }
  template <class Dialog, class Act>
  void when_asked(Act act) {
    auto* timer = new QTimer(qApp);
    timers.push_back(timer);
    QObject::connect(timer, &QTimer::timeout, timer, [timer, act] {
      auto* dialog = qobject_cast<Dialog*>(QApplication::activeModalWidget());
      if (!dialog || !dialog->isVisible()) return;
      timer->stop();
      act(dialog);
    });
    timer->start(20);
  }
  void TearDown() override {
    for (QTimer* timer : timers) {
      EXPECT_FALSE(timer->isActive()) << "nothing was asked";
      delete timer;
    }
    MainWindowTest::TearDown();
  }

  void edit(double angle) { run({"find_sharp_lines", {{"angle", angle}}}); }
  /// No window manager gives the focus back after a dialog.
  static void press(MainWindow& to, const QKeySequence& keys) {
    to.activateWindow();
    EXPECT_TRUE(QTest::qWaitForWindowActive(&to));
    QTest::keySequence(&to, keys);
    EXPECT_TRUE(QTest::qWaitFor([&] { return !to.session().saving(); }, patience));
  }
  void press_save() { press(*window, QKeySequence::Save); }
  /// Saves for the first time.
  void save_to(const QString& path) {
    choose(path);
    press_save();
    ASSERT_TRUE(QFile::exists(path));
    ASSERT_FALSE(window->isWindowModified());
  }
  std::string hash_in(const QString& path) const {
    return hash_of(arris::testing::value_of(replay(path.toStdString())).history.current());
  }
  bool wait_until_open(MainWindow& other) {
    return QTest::qWaitFor(
        [&] { return !other.session().current().document.empty() && !other.session().busy(); },
        patience);
  }
  std::unique_ptr<MainWindow> another_window() {
    auto other = std::make_unique<MainWindow>();
    other->resize(1000, 700);
    other->show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(other.get()));
    other->activateWindow();
    EXPECT_TRUE(QTest::qWaitForWindowActive(other.get()));
    return other;
  }

  const QTemporaryDir folder;
  QStringList said;
  int dialogs = 0;
  std::vector<QTimer*> timers;
  QTimer watchdog;
  QPointer<QWidget> waiting;  // at the watchdog's last look
};

TEST_F(Saving, AsksOnlyTheFirstTimeAndTheTitleTellsWhatIsNotSaved) {
  open_sample();
  EXPECT_TRUE(window->windowTitle().startsWith("sample_mould.ply"))
      << qPrintable(window->windowTitle());
  EXPECT_FALSE(window->isWindowModified()) << "a part that was only opened";
  edit(30.0);
  EXPECT_TRUE(window->isWindowModified());
  const QString path = folder.filePath("mould.arris");
  choose(folder.filePath("mould"));  // the ending comes by itself
  press_save();
  EXPECT_EQ(dialogs, 1);
  ASSERT_TRUE(QFile::exists(path));
  EXPECT_FALSE(window->isWindowModified());
  EXPECT_TRUE(window->windowTitle().startsWith("mould.arris")) << qPrintable(window->windowTitle());
  EXPECT_EQ(hash_in(path), hash_of(document()));
  // It opens from a snapshot that this user's key signed, which nobody else can read.
  QFile key(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) +
            "/sessions/snapshot.key");
  ASSERT_TRUE(key.open(QIODevice::ReadOnly));
  EXPECT_EQ(key.permissions() & (QFile::ReadGroup | QFile::ReadOther), QFile::Permissions());
  const auto session = arris::testing::value_of(SessionFile::read(path.toStdString()));
  EXPECT_TRUE(arris::testing::value_of(session->snapshot(key.readAll().toStdString())));

  edit(40.0);
  EXPECT_TRUE(window->isWindowModified());
  EXPECT_NE(hash_in(path), hash_of(document())) << "the file is as it was saved";
  press_save();
  EXPECT_EQ(dialogs, 1);
  EXPECT_FALSE(window->isWindowModified());
  EXPECT_EQ(hash_in(path), hash_of(document()));
  press(*window, QKeySequence::Undo);
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle() && window->isWindowModified(); }, patience));
  press(*window, QKeySequence::Redo);
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle() && !window->isWindowModified(); }, patience))
      << "as it is in the file";

  // Under another name: the first file stays, and what follows goes to the second.
  const std::string first = hash_in(path);
  const QString second = folder.filePath("second.arris");
  edit(50.0);
  choose(second);
  press(*window, QKeySequence("Ctrl+Shift+S"));
  EXPECT_EQ(window->session().file(), second);
  EXPECT_EQ(hash_in(path), first);
  edit(20.0);
  press_save();
  EXPECT_EQ(dialogs, 2);
  EXPECT_EQ(hash_in(second), hash_of(document()));
  EXPECT_EQ(hash_in(path), first);
  EXPECT_EQ(QSettings().value("recent").toStringList().first(), second);
}

TEST_F(Saving, ClosingAsksWhereSomethingIsNotSaved) {
  open_sample();
  edit(30.0);
  answer("Cancel");
  EXPECT_FALSE(window->close());
  EXPECT_TRUE(window->isVisible());
  EXPECT_TRUE(said.last().contains("sample_mould.ply")) << "the part is named";

  // Save, but not after all.
  answer("Save");
  when_asked<QFileDialog>([](QFileDialog* dialog) { dialog->reject(); });
  EXPECT_FALSE(window->close());

  const QString path = folder.filePath("mould.arris");
  const std::string hash = hash_of(document());
  answer("Save");
  choose(path);
  EXPECT_TRUE(window->close());
  EXPECT_EQ(hash_in(path), hash);
  EXPECT_TRUE(Session::abandoned_sessions().isEmpty()) << "closed on purpose";
}

TEST_F(Saving, DiscardingLeavesTheFileAsItWasSaved) {
  open_sample();
  edit(30.0);
  const QString path = folder.filePath("mould.arris");
  save_to(path);
  const std::string hash = hash_in(path);
  edit(45.0);
  answer("Discard");
  EXPECT_TRUE(window->close());
  EXPECT_EQ(hash_in(path), hash);
  EXPECT_TRUE(Session::abandoned_sessions().isEmpty());
}

TEST_F(Saving, TheViewBelongsToTheSession) {
  open_sample();
  run_both();
  window->set_field(Field::ikabs);
  window->elements().select({}, {document().partitions.partitions[2]->id});
  QTest::keyClick(window.get(), Qt::Key_H);
  QTest::keyClick(window.get(), Qt::Key_E);                     // mesh edges
  QTest::keyClick(window.get(), Qt::Key_B);                     // no scalar bar
  QTest::keyClick(window.get(), Qt::Key_Y, Qt::ShiftModifier);  // a section
  window->view().look_from(MeshView::StandardView::top);
  window->view().zoom_by(3.0);
  const ViewCamera camera = window->view().camera();
  const auto section = window->view().section();
  ASSERT_TRUE(section);
  const QString path = folder.filePath("mould.arris");
  save_to(path);
  const std::string view = window->session().extras().view;
  ASSERT_TRUE(window->close());

  auto other = another_window();
  other->open(path);
  ASSERT_TRUE(wait_until_open(*other));
  EXPECT_EQ(other->fields().field(), Field::ikabs);
  EXPECT_TRUE(other->elements().hides_any());
  EXPECT_TRUE(
      other->elements().hides(other->session().current().document.partitions.partitions[2]->id));
  EXPECT_FALSE(other->elements().partitions_shown());
  EXPECT_TRUE((other->view().camera().focus() - camera.focus()).norm() < 1e-9);
  EXPECT_NEAR(other->view().camera().height(), camera.height(), 1e-9);
  EXPECT_TRUE(other->view().camera().axes().isApprox(camera.axes(), 1e-9));
  ASSERT_TRUE(other->view().section());
  EXPECT_NEAR(other->view().section()->offset, section->offset, 1e-9);
  EXPECT_TRUE(other->view().section()->normal.isApprox(section->normal, 1e-12));
  for (const auto& [name, on] : {std::pair{"edges", true}, {"scalar_bar", false}, {"lines", true}})
    EXPECT_EQ(other->findChild<QAction*>(name)->isChecked(), on) << name;
  EXPECT_FALSE(other->isWindowModified());
  EXPECT_EQ(QSettings().value("recent").toStringList().first(), path);
  other->close();
}

TEST_F(Saving, AViewThatMakesNoSenseIsPassedOver) {
  open_sample();
  const ViewCamera before = window->view().camera();
  for (const char* text :
       {"", "[]", "{", R"({"camera": 5, "field": [], "hidden": {"hidden": [-1, "x", 4e9]}})",
        R"({"camera": {"towards_viewer": [0, 0, 0], "up": [0, 0, 0], "focus": [0, 0, 0]}})",
        R"({"camera": {"towards_viewer": [1e999, 0, 0], "up": [0, 1, 0], "focus": [0, 0, 0]}})",
        R"({"section": {"direction": 2, "axis": [5, 5, 5], "position": 1}})",
        R"({"section": {"direction": 99}, "surface": 7, "shown": {"lines": "yes"}})",
        R"({"field": {"name": "Deviation", "map": 2}})",
        R"({"field": {"name": "K", "map": 77, "min": 5, "max": 1, "bands": -3}})"}) {
    SessionExtras extras;
    extras.view = text;
    const std::string path = folder.filePath("odd.arris").toStdString();
    ASSERT_TRUE(save_session(path, window->session().history(), extras));
    window->open(QString::fromStdString(path));
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return idle() && !window->session().file().isEmpty(); }, patience));
    EXPECT_FALSE(window->view().section()) << text;
    EXPECT_TRUE(window->view().camera().focus().allFinite()) << text;
    EXPECT_GT(window->view().camera().height(), 0.0) << text;
    EXPECT_LT(window->fields().scale().min, window->fields().scale().max) << text;
    EXPECT_FALSE(window->elements().hides_any()) << text;
    window->open_sample();
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return idle() && window->session().file().isEmpty(); }, patience));
  }
  EXPECT_TRUE(window->view().camera().axes().isApprox(before.axes()));
}

TEST_F(Saving, ASecondWindowOpensTheFileReadOnlyAndSaysSo) {
  open_sample();
  edit(30.0);
  const QString path = folder.filePath("mould.arris");
  save_to(path);
  auto other = another_window();
  answer("OK");
  other->open(path);
  ASSERT_TRUE(wait_until_open(*other));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !said.isEmpty(); }, patience));
  EXPECT_TRUE(said.last().contains("another window") && said.last().contains("mould.arris"));
  EXPECT_TRUE(other->session().is_read_only());
  EXPECT_TRUE(other->windowTitle().contains("(read-only)")) << qPrintable(other->windowTitle());
  other->session().run({{"find_sharp_lines", {{"angle", 50.0}}}});
  ASSERT_TRUE(QTest::qWaitFor([&] { return !other->session().busy(); }, patience));
  const std::string before = hash_in(path);
  // Save means another name; that of the file in use is refused.
  other->session().save(path, {}, [](const Result<void>& written) { EXPECT_FALSE(written); });
  other->session().wait_until_saved();
  EXPECT_EQ(hash_in(path), before);
  const QString second = folder.filePath("second.arris");
  choose(second);
  press(*other, QKeySequence::Save);
  EXPECT_EQ(dialogs, 2) << "one in each window";
  EXPECT_FALSE(other->session().is_read_only());
  EXPECT_EQ(hash_in(second), hash_of(other->session().current().document));
  other->close();
  // The first window still has its file, and gives it free when it closes.
  edit(40.0);
  press_save();
  EXPECT_EQ(hash_in(path), hash_of(document()));
  window->close();
  other = another_window();
  other->open(path);
  ASSERT_TRUE(wait_until_open(*other));
  EXPECT_FALSE(other->session().is_read_only());
  other->close();
}

TEST_F(Saving, WhatCannotBeSavedIsToldAndSavedElsewhere) {
  open_sample();
  edit(30.0);
  QDir().mkpath(folder.filePath("gone"));
  save_to(folder.filePath("gone/mould.arris"));
  edit(40.0);
  QDir(folder.filePath("gone")).removeRecursively();
  const QString elsewhere = folder.filePath("elsewhere.arris");
  answer("Save as…");
  choose(elsewhere);
  press_save();
  EXPECT_TRUE(said.last().contains("gone/mould.arris")) << qPrintable(said.last());
  EXPECT_TRUE(said.last().contains("Nothing is lost"));
  EXPECT_EQ(window->session().file(), elsewhere);
  EXPECT_EQ(hash_in(elsewhere), hash_of(document()));
  EXPECT_FALSE(window->isWindowModified());
}

TEST_F(Saving, ARecoverySessionThatWasRemovedIsToldAndSavingGoesOn) {
  open_sample();
  edit(30.0);
  const QString recoveries =
      QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + "/sessions";
  for (const QFileInfo& file : QDir(recoveries).entryInfoList({"*.arris"}))
    QFile::remove(file.filePath());
  const std::string before = hash_of(document());
  answer("OK");
  edit(40.0);
  EXPECT_TRUE(said.last().contains("was removed")) << qPrintable(said.last());
  EXPECT_EQ(hash_of(document()), before) << "an edit that is not on disk is not shown";
  const QString path = folder.filePath("mould.arris");
  save_to(path);
  EXPECT_EQ(hash_in(path), before);
  edit(40.0);
  EXPECT_NE(hash_of(document()), before) << "and from there on it goes on";
}

/// What a crash leaves behind: the recovery session as it stands, and no owner.
QString left_by_a_crash(const QString& content_of, const QString& ending) {
  const QString path = QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) +
                       "/sessions/00000000-000000000-1" + ending;
  QFile::remove(path);
  EXPECT_TRUE(QFile::copy(content_of, path));
  return path;
}

TEST_F(Saving, AfterACrashThePartIsNamedAndGoneOnWithWhereItWasSaved) {
  open_sample();
  edit(30.0);
  const QString path = folder.filePath("mould.arris");
  save_to(path);
  edit(40.0);
  const std::string hash = hash_of(document());
  const QDir recoveries(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) +
                        "/sessions");
  const QStringList own = recoveries.entryList({"*.arris"});
  ASSERT_EQ(own.size(), 1);
  const QString left = left_by_a_crash(recoveries.filePath(own[0]), ".arris");
  window->session().mark_saved();
  window->close();

  auto other = another_window();
  answer("Later");
  EXPECT_FALSE(other->offer_recovery());
  answer("Go on");
  EXPECT_TRUE(other->offer_recovery());
  ASSERT_TRUE(wait_until_open(*other));
  EXPECT_TRUE(said.last().contains("sample_mould.ply")) << qPrintable(said.last());
  EXPECT_EQ(hash_of(other->session().current().document), hash);
  EXPECT_TRUE(other->isWindowModified());
  EXPECT_EQ(other->session().file(), path);
  press(*other, QKeySequence::Save);
  EXPECT_EQ(hash_in(path), hash);
  EXPECT_FALSE(other->isWindowModified());
  EXPECT_TRUE(other->close());
  EXPECT_FALSE(QFile::exists(left));
}

// Not as it was when recovery began, but as it was seen last.
TEST_F(Saving, AfterACrashTheViewIsTheLastOneSeen) {
  open_sample();
  edit(30.0);
  window->set_field(Field::ih);
  window->view().look_from(MeshView::StandardView::left);
  const Point towards = window->view().camera().towards_viewer();
  const QDir recoveries(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) +
                        "/sessions");
  const QStringList own = recoveries.entryList({"*.arris"});
  ASSERT_EQ(own.size(), 1);
  const auto kept = [&] {
    const auto session = SessionFile::read(recoveries.filePath(own[0]).toStdString());
    return session ? arris::testing::value_of((*session)->extras()).view : std::string();
  };
  ASSERT_TRUE(QTest::qWaitFor([&] { return kept().find("IH") != std::string::npos; }, patience))
      << "it is kept by itself";
  left_by_a_crash(recoveries.filePath(own[0]), ".arris");
  window->session().mark_saved();
  window->close();

  auto other = another_window();
  answer("Go on");
  EXPECT_TRUE(other->offer_recovery());
  ASSERT_TRUE(wait_until_open(*other));
  ASSERT_TRUE(comes_to_rest());
  EXPECT_EQ(other->fields().field(), Field::ih);
  EXPECT_LT((other->view().camera().towards_viewer() - towards).norm(), 1e-9);
  other->session().mark_saved();
  other->close();
}

// Of the command line: nobody has looked at it yet, and it shows what was found.
TEST_F(Saving, ASessionWithoutAViewShowsItsPartitionsAndIsNotTalkedOver) {
  History history;
  const std::string part = folder.filePath("part.ply").toStdString();
  ASSERT_TRUE(write_ply(part, *arris::testing::mesh_of(arris::testing::sample_mould(3.0)), {}));
  for (const Operation& operation : {Operation{"open", {{"file", part}}},
                                     Operation{"find_sharp_lines", nlohmann::json::object()},
                                     Operation{"find_partitions", nlohmann::json::object()}})
    ASSERT_TRUE(history.run(operation));
  const QString path = folder.filePath("part.arris");
  ASSERT_TRUE(save_session(path.toStdString(), history, {}));
  window->tour().offer();
  window->open(path);
  ASSERT_TRUE(wait_until_open(*window));
  ASSERT_TRUE(comes_to_rest());
  bool partitions_shown = false;
  for (const QAction* a : window->findChildren<QAction*>())
    if (a->text() == "&Partitions" && a->isCheckable()) partitions_shown = a->isChecked();
  EXPECT_TRUE(partitions_shown);
  for (QWidget* card : window->findChildren<QWidget*>())
    EXPECT_FALSE(card->inherits("arris::ui::TourCard") && card->isVisible());
  // Opened again, as when it is chosen among the recent ones, it is still this window's own.
  window->open(path);
  ASSERT_TRUE(window->session().busy());
  ASSERT_TRUE(wait_until_open(*window));
  ASSERT_TRUE(comes_to_rest());
  EXPECT_FALSE(window->session().is_read_only());
}

// The window goes on while it saves, and closes only when that is done.
TEST_F(Saving, GoesOnWhileItSavesAndWaitsForItAtTheEnd) {
  open_sample();
  edit(30.0);
  const std::string saved = hash_of(document());
  const QString path = folder.filePath("mould.arris");
  bool done = false;
  window->session().save(path, {},
                         [&](const Result<void>& written) { done = written.has_value(); });
  EXPECT_TRUE(window->session().saving());
  EXPECT_FALSE(window->session().busy()) << "edits are taken meanwhile";
  edit(40.0);
  window->session().wait_until_saved();
  EXPECT_TRUE(done);
  EXPECT_EQ(hash_in(path), saved) << "as it was when it was asked for";
  EXPECT_TRUE(window->isWindowModified()) << "the edit since then is not in the file";
  window->session().mark_saved();
  const std::string last = hash_of(document());
  window->session().save(path, {}, [](const Result<void>&) {});
  EXPECT_TRUE(window->close());
  EXPECT_EQ(hash_in(path), last);
}

TEST_F(Saving, AfterACrashNobodyIsAskedForWhatWasSaved) {
  const QDir recoveries(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) +
                        "/sessions");
  const auto crash = [&] {
    const QStringList own = recoveries.entryList({"*.arris"});
    EXPECT_EQ(own.size(), 1);
    return left_by_a_crash(recoveries.filePath(own[0]), ".arris");
  };
  open_sample();
  edit(30.0);
  edit(40.0);
  save_to(folder.filePath("mould.arris"));
  const QString left = crash();
  EXPECT_TRUE(Session::abandoned_sessions().isEmpty()) << "all of it is in mould.arris";
  EXPECT_FALSE(QFile::exists(left));

  // What was undone since is not.
  window->session().undo();
  ASSERT_TRUE(wait_until_open(*window));
  const QString undone = crash();
  EXPECT_EQ(Session::abandoned_sessions(), QStringList{undone});

  // Nor is anything where the file is gone.
  window->session().redo();
  ASSERT_TRUE(wait_until_open(*window));
  QFile::remove(undone);
  const QString redone = crash();
  ASSERT_TRUE(QFile::rename(folder.filePath("mould.arris"), folder.filePath("elsewhere.arris")));
  EXPECT_EQ(Session::abandoned_sessions(), QStringList{redone});
  ASSERT_TRUE(QFile::rename(folder.filePath("elsewhere.arris"), folder.filePath("mould.arris")));
  EXPECT_TRUE(Session::abandoned_sessions().isEmpty()) << "undone and redone is as it was";
  window->session().mark_saved();
}

TEST_F(Saving, ARecoveryOfAnOlderVersionIsOfferedToo) {
  open_sample();
  edit(30.0);
  const std::string hash = hash_of(document());
  const QString text = folder.filePath("old.jsonl");
  QFile file(text);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write(QByteArray::fromStdString(journal_text(window->session().history())));
  file.close();
  const QString left = left_by_a_crash(text, ".jsonl");
  window->session().mark_saved();
  window->close();

  auto other = another_window();
  answer("Go on");
  EXPECT_TRUE(other->offer_recovery());
  ASSERT_TRUE(wait_until_open(*other));
  EXPECT_TRUE(said.last().contains("sample_mould.ply")) << qPrintable(said.last());
  EXPECT_EQ(hash_of(other->session().current().document), hash);
  EXPECT_FALSE(QFile::exists(left)) << "a session that needs nothing else took its place";
  other->session().mark_saved();
  other->close();
}

TEST_F(Saving, AScanThatIsNotWhereItWasIsAskedFor) {
  const std::string part = folder.filePath("part.ply").toStdString();
  const std::string moved = folder.filePath("moved.ply").toStdString();
  const std::string wrong = folder.filePath("wrong.ply").toStdString();
  ASSERT_TRUE(write_ply(part, *arris::testing::mesh_of(arris::testing::random_terrain(20, 3)), {}));
  ASSERT_TRUE(
      write_ply(wrong, *arris::testing::mesh_of(arris::testing::random_terrain(20, 4)), {}));
  History history;
  ASSERT_TRUE(history.run({"open", {{"file", part}}}));
  const QString session = folder.filePath("session.jsonl");
  QFile file(session);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write(QByteArray::fromStdString(journal_text(history)));
  file.close();
  std::filesystem::rename(part, moved);

  answer("Cancel");
  window->open(session);
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle() && said.size() == 1; }, patience));
  EXPECT_TRUE(said.last().contains("part.ply")) << qPrintable(said.last());
  EXPECT_TRUE(document().empty());

  // Another file is not taken, and asked for again.
  answer("Locate…");
  when_asked<QFileDialog>([&](QFileDialog* dialog) {
    type(dialog, QString::fromStdString(wrong));
    answer("Locate…");
    choose(QString::fromStdString(moved));
  });
  window->open(session);
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle() && !document().empty(); }, patience));
  EXPECT_EQ(said.size(), 3);
  EXPECT_TRUE(said.last().contains("wrong.ply")) << qPrintable(said.last());
  EXPECT_EQ(hash_of(document()), hash_of(history.current()));
  // What goes on from here needs that file no more.
  std::filesystem::remove(moved);
  edit(30.0);
  save_to(folder.filePath("session.arris"));
  EXPECT_EQ(hash_in(folder.filePath("session.arris")), hash_of(document()));
}

TEST_F(Saving, ADamagedSessionIsToldAndTheOpenPartStays) {
  open_sample();
  const MeshPtr before = document().mesh;
  const QString path = folder.filePath("damaged.arris");
  ASSERT_TRUE(save_session(path.toStdString(), window->session().history(), {}));
  QFile file(path);
  ASSERT_TRUE(file.open(QIODevice::ReadWrite));
  ASSERT_TRUE(file.resize(file.size() / 2));
  file.close();
  answer("OK");
  window->open(path);
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle() && !said.isEmpty(); }, patience));
  EXPECT_TRUE(said.last().contains("damaged.arris")) << qPrintable(said.last());
  EXPECT_EQ(document().mesh, before);
}

TEST_F(Saving, ExportIsNamedByThePartAndAsksBeforeItReplaces) {
  open_sample();
  edit(30.0);
  const auto lines = [&] {
    QFile file(folder.filePath("sample_mould_lines.obj"));
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
  };
  const auto export_again = [&] {
    when_asked<ExportDialog>([&](ExportDialog* dialog) {
      dialog->findChild<QLineEdit*>("export_folder")->setText(folder.path());
      dialog->accept();
    });
    press(*window, QKeySequence("Ctrl+E"));
    ASSERT_TRUE(QTest::qWaitFor([&] { return !window->exporting(); }, patience));
  };
  export_again();
  const QByteArray first = lines();
  EXPECT_FALSE(first.isEmpty());
  for (const char* name : {"boundaries.obj", "scan_partitions.ply", "operations.jsonl"})
    EXPECT_TRUE(QFile::exists(folder.filePath(QString("sample_mould_") + name))) << name;
  EXPECT_TRUE(window->isWindowModified()) << "results are no session";

  edit(60.0);
  answer("Cancel");
  export_again();
  EXPECT_TRUE(said.last().contains("sample_mould_lines.obj")) << qPrintable(said.last());
  EXPECT_EQ(lines(), first);
  answer("Replace");
  export_again();
  EXPECT_NE(lines(), first);
}

TEST_F(Saving, RecentSessionsAreToldFromScansAndHaveAPicture) {
  open_sample();
  edit(30.0);
  save_to(folder.filePath("mould.arris"));
  const std::string png = SessionFile::picture_of(folder.filePath("mould.arris").toStdString());
  const QImage picture = QImage::fromData(QByteArray::fromStdString(png), "PNG");
  EXPECT_EQ(picture.size(), QSize(320, 240));
  // The start page on what was opened: the part is on it, not the ground alone.
  QSet<QRgb> colours;
  for (int x = 0; x < picture.width(); x += 3)
    for (int y = 0; y < picture.height(); y += 3) colours << picture.pixel(x, y);
  EXPECT_GT(colours.size(), 50);
  QTest::keyClick(window.get(), Qt::Key_Home, Qt::AltModifier);
  QPushButton* entry = nullptr;
  for (QPushButton* button : window->findChild<StartPage*>()->findChildren<QPushButton*>())
    if (button->accessibleName() == "mould.arris") entry = button;
  ASSERT_NE(entry, nullptr);
  EXPECT_TRUE(entry->accessibleDescription().startsWith("Session"));
}

}  // namespace
}  // namespace arris::ui
