// The log, what About tells, and that a report tells nothing that is private.

#include <algorithm>

#include <gtest/gtest.h>
#include <QApplication>
#include <QClipboard>
#include <QFile>
#include <QImageReader>
#include <QLabel>
#include <QPushButton>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>

#include "core/mesh/write_ply.h"
#include "tests/support/documents.h"
#include "tests/ui/window_fixture.h"
#include "ui/view/graphics.h"
#include "ui/window/about_dialog.h"
#include "ui/window/log_file.h"

namespace arris::ui {
namespace {

TEST(LogFiles, ArePutAsideWhenTheyAreLargeAndOnlyAFewAreKept) {
  const QTemporaryDir folder;
  LogFile log(folder.filePath("deep/arris.log"), 1000, 2);
  for (int k = 0; k < 200; ++k) log.write(QString("line %1\nand more").arg(k));
  const QDir deep(folder.filePath("deep"));
  EXPECT_EQ(deep.entryList(QDir::Files), QStringList({"arris.log", "arris.log.1", "arris.log.2"}));
  for (const QFileInfo& file : deep.entryInfoList(QDir::Files)) EXPECT_LT(file.size(), 1100);
  const QStringList last = log.last(5);
  ASSERT_FALSE(last.isEmpty());
  EXPECT_LE(last.size(), 5);
  EXPECT_TRUE(last.last().endsWith("line 199 and more")) << "a line is a line";
  EXPECT_TRUE(last.last().startsWith("20")) << "its time";
  EXPECT_EQ(QFile::permissions(log.path()) & (QFile::ReadGroup | QFile::ReadOther),
            QFile::Permissions());
  log.write(QString(100000, 'x'));
  EXPECT_LT(QFileInfo(log.path()).size(), 6000);
  // Where nothing can be written there is no log, and that is all.
  ASSERT_TRUE(QFile(folder.filePath("file")).open(QIODevice::WriteOnly));
  LogFile none(folder.filePath("file/arris.log"));
  none.write("lost");
  EXPECT_TRUE(none.last(5).isEmpty());
}

TEST(Reports, HoldNoPathsAndNoNames) {
  EXPECT_EQ(without_paths("/home/anna/work/secret part.ply cannot be read: gone."),
            "<path>.ply cannot be read: gone.");
  EXPECT_EQ(without_paths("told: /a/b.arris was removed."), "told: <path>.arris was removed.");
  EXPECT_EQ(without_paths("opened ~/x.stl: STL"), "opened <path>.stl: STL");
  EXPECT_EQ(without_paths("file:///tmp/x.ply"), "<path>.ply");
  EXPECT_EQ(without_paths("see \"/a b/c d/e\" there"), "see \"<path>\" there");
  EXPECT_EQ(without_paths("/a/b and /c/d"), "<path>");
  EXPECT_EQ(without_paths("1/mm² and/or 3 / 4"), "1/mm² and/or 3 / 4") << "no paths";
  EXPECT_EQ(without_paths("open bracket.ply, bracket", {"bracket.ply", "bracket"}),
            "open <name>, <name>");
  for (const QString& text : {QString("/x/Müller GmbH/Teil 7.stl"), QString("saved /x/y z/w")}) {
    const QString left = without_paths(text);
    for (const char* word : {"Müller", "GmbH", "Teil", "/x", "y", "z/"})
      EXPECT_FALSE(left.contains(word)) << qPrintable(left);
  }
}

class About : public MainWindowTest {};

TEST_F(About, TellsWhatItIsMadeOfAndCopiesAReportWithoutNames) {
  const QTemporaryDir folder;
  const QString path = folder.filePath("Geheimteil 7.ply");
  ASSERT_TRUE(write_ply(path.toStdString(), *testing::mesh_of(testing::sample_mould(4.0)), {}));
  window->open(path);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !document().empty() && idle(); }, patience));
  program_log().write("told: " + path + " cannot be read.");
  program_log().write("told: There is no Geheimteil 7.ply.");
  ASSERT_EQ(why_nothing_can_be_drawn(), "");
  AboutDialog about(window->session(), window.get());
  about.show();
  const QString text = about.findChild<QLabel*>("runs_on")->text();
  for (const QString& part : {QString("Qt ") + qVersion(), "VTK " + vtk_version(),
                              QString("SQLite "), QString("OpenGL "), program_log().path()})
    EXPECT_TRUE(text.contains(part)) << qPrintable(part + " is not in " + text);
  for (QPushButton* button : about.findChildren<QPushButton*>())
    if (button->text().remove('&') == "Copy report") QTest::mouseClick(button, Qt::LeftButton);
  const QString report = QApplication::clipboard()->text();
  for (const QString& part : {QString("Qt ") + qVersion(), QString("Graphics: "), QString("PLY, "),
                              QString(" faces"), QString("cannot be read")})
    EXPECT_TRUE(report.contains(part)) << qPrintable(part + " is not in " + report);
  for (const QString& secret : {QString("Geheimteil"), folder.path(), QDir::homePath() + "/"})
    EXPECT_FALSE(report.contains(secret)) << qPrintable(report);
}

TEST(Icon, OfTheWindowIsTheDrawing) {
  const QString place = QString(ARRIS_SOURCE_DIR) + "/resources/install/org.arris.Arris";
  const QImage window = QImage(place + ".png").convertToFormat(QImage::Format_ARGB32);
  ASSERT_EQ(window.size(), QSize(256, 256));
  QImageReader reader(place + ".svg");
  reader.setScaledSize(window.size());
  const QImage drawn = reader.read().convertToFormat(QImage::Format_ARGB32);
  ASSERT_EQ(drawn.size(), window.size()) << reader.errorString().toStdString();
  int differ = 0, opaque = 0;
  for (int y = 0; y < window.height(); ++y)
    for (int x = 0; x < window.width(); ++x) {
      const QColor a = window.pixelColor(x, y), b = drawn.pixelColor(x, y);
      opaque += a.alpha() == 255;
      const int most = std::max({std::abs(a.red() - b.red()), std::abs(a.green() - b.green()),
                                 std::abs(a.blue() - b.blue())});
      // Colours under nothing do not show; edges are smoothed by each renderer in its own way.
      differ += std::abs(a.alpha() - b.alpha()) > 64 ||
                (std::min(a.alpha(), b.alpha()) > 200 && most > 13);
    }
  EXPECT_GT(opaque, 256 * 256 / 4);
  EXPECT_LT(differ, 256 * 256 / 200);
}

}  // namespace
}  // namespace arris::ui
