// The report as the window writes it: asked for by hand, with pictures, and on paper.

#include <QApplication>
#include <QCheckBox>
#include <QDir>
#include <QFile>
#include <QImage>
#include <QLineEdit>
#include <QMessageBox>
#include <QProcess>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTimer>

#include "core/document/history.h"
#include "core/document/session_file.h"
#include "core/mesh/write_ply.h"
#include "core/samples/mould.h"
#include "tests/ui/window_fixture.h"
#include "ui/window/report_dialog.h"
#include "ui/window/report_presenter.h"

namespace arris::ui {
namespace {

class WriteReport : public MainWindowTest {
 protected:
  static QPushButton* button(const QWidget& dialog, const QString& text) {
    for (QPushButton* b : dialog.findChildren<QPushButton*>())
      if (b->text() == text) return b;
    return nullptr;
  }
  static QByteArray read(const QString& path) {
    QFile file(path);
    EXPECT_TRUE(file.open(QIODevice::ReadOnly)) << path.toStdString();
    return file.readAll();
  }
  const QTemporaryDir folder;
};

TEST_F(WriteReport, WithPicturesAsAPageAndOnPaper) {
  open_sample();
  run_both();
  window->set_field(Field::h);
  window->view().look_from(MeshView::StandardView::left);
  const Point before = window->view().towards_viewer();
  const QString place = folder.filePath("report");
  bool asked = false, told = false;
  QTimer timer;
  QObject::connect(&timer, &QTimer::timeout, &timer, [&] {
    QWidget* modal = QApplication::activeModalWidget();
    if (auto* dialog = qobject_cast<ReportDialog*>(modal); dialog && !asked) {
      asked = true;
      auto* where = dialog->findChild<QLineEdit*>("report_folder");
      where->setText("somewhere");
      EXPECT_FALSE(button(*dialog, "Write")->isEnabled());
      EXPECT_NE(button(*dialog, "Write")->toolTip(), "");
      where->setText(place);
      dialog->findChild<QLineEdit*>("report_title")->setText("Lower half");
      dialog->findChild<QCheckBox*>("report_paper")->setChecked(true);
      QTest::mouseClick(button(*dialog, "Write"), Qt::LeftButton);
    } else if (auto* box = qobject_cast<QMessageBox*>(modal); box && !told) {
      told = true;
      EXPECT_NE(button(*box, "&Open"), nullptr);
      EXPECT_TRUE(box->informativeText().contains("report.html"))
          << box->informativeText().toStdString();
      box->button(QMessageBox::Close)->click();
    }
  });
  timer.start(20);
  press(Qt::Key_P, Qt::ControlModifier | Qt::ShiftModifier);
  ASSERT_TRUE(QTest::qWaitFor([&] { return told; }, patience));
  EXPECT_FALSE(window->reports().writing());

  const QString page = QString::fromUtf8(read(place + "/report.html"));
  EXPECT_TRUE(page.contains("<h1>Lower half</h1>"));
  for (const char* name : {"view.png", "partitions.png", "partitions_behind.png", "kabs.png"}) {
    EXPECT_TRUE(page.contains(QString("src=\"%1\"").arg(name))) << name;
    const QImage picture(place + "/" + name);
    ASSERT_FALSE(picture.isNull()) << name;
    EXPECT_EQ(picture.width(), 1600);
    // A part stands on a white ground.
    qint64 part = 0;
    for (int y = 0; y < picture.height(); y += 10)
      for (int x = 0; x < picture.width(); x += 10) part += picture.pixelColor(x, y) != Qt::white;
    EXPECT_GT(100 * part, 5 * (picture.height() / 10) * (picture.width() / 10)) << name;
  }
  EXPECT_NE(QImage(place + "/partitions.png"), QImage(place + "/kabs.png"));
  const QByteArray paper = read(place + "/report.pdf");
  EXPECT_TRUE(paper.startsWith("%PDF-"));
  EXPECT_GT(paper.count("/Type /Page\n"), 3);
  EXPECT_GE(paper.count("/Subtype /Image"), 4) << "the pictures are on it, too";
  // The part is looked at as before.
  EXPECT_EQ(window->fields().field(), Field::h);
  EXPECT_NEAR((window->view().towards_viewer() - before).norm(), 0.0, 1e-9);
}

TEST_F(WriteReport, ThatCannotBeWrittenIsTold) {
  open_sample();
  QFile file(folder.filePath("taken"));
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.close();
  ReportRequest request;
  request.folder = (folder.filePath("taken") + "/report").toStdString();
  QString error;
  window->reports().write(request, true, [&](const QString& told) { error = told; });
  EXPECT_TRUE(error.contains("taken")) << error.toStdString();
  EXPECT_FALSE(window->reports().writing());
}

/// The program itself, which ends by itself.
class Program : public ::testing::Test {
 protected:
  int run(const QStringList& arguments) {
    QProcess process;
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert("XDG_CONFIG_HOME", folder.path());
    environment.insert("XDG_DATA_HOME", folder.path());
    process.setProcessEnvironment(environment);
    process.start(ARRIS_PROGRAM, arguments);
    if (!process.waitForFinished(patience)) {
      process.kill();
      return -1;
    }
    told = process.readAllStandardError();
    return process.exitStatus() == QProcess::NormalExit ? process.exitCode() : -2;
  }
  const QTemporaryDir folder;
  QByteArray told;
};

TEST_F(Program, DrawsPicturesAndReportsOfSessionsAsOfScans) {
  const QString path = folder.filePath("part.arris");
  {
    const std::string scan = folder.filePath("part.ply").toStdString();
    SampleMould mould = make_mould();
    const auto mesh = Mesh::create(std::move(mould.points), std::move(mould.triangles));
    ASSERT_TRUE(mesh && write_ply(scan, **mesh, {}, LengthUnit::millimetre));
    History history;
    ASSERT_TRUE(history.run(open_file(scan)));
    ASSERT_TRUE(save_session(path.toStdString(), history, {}, {}));
  }
  for (const char* name : {"part.ply", "part.arris"}) {
    EXPECT_EQ(run({folder.filePath(name), "--screenshot", folder.filePath("picture.png"), "--size",
                   "400x300"}),
              0)
        << told.toStdString();
    EXPECT_EQ(QImage(folder.filePath("picture.png")).size(), QSize(400, 300)) << name;
    EXPECT_TRUE(QFile::remove(folder.filePath("picture.png")));
  }
  EXPECT_EQ(run({path, "--screenshot", folder.filePath("none.png"), "--view", "Front"}), 1);
  EXPECT_TRUE(told.contains("\"Front\"")) << told.toStdString();
  EXPECT_FALSE(QFile::exists(folder.filePath("none.png")));
  EXPECT_EQ(run({path, "--report", folder.filePath("report")}), 0) << told.toStdString();
  EXPECT_TRUE(QFile::exists(folder.filePath("report/report.pdf")));
  EXPECT_FALSE(QImage(folder.filePath("report/view.png")).isNull());
  // A session whose scan is gone says so, and does not wait for anybody.
  QFile journal(folder.filePath("lost.jsonl"));
  ASSERT_TRUE(journal.open(QIODevice::WriteOnly));
  journal.write(R"({"operation":"open","file":"/nowhere/lost.ply"})"
                "\n");
  journal.close();
  EXPECT_EQ(run({journal.fileName(), "--report", folder.filePath("none")}), 1);
  EXPECT_TRUE(told.contains("lost.ply")) << told.toStdString();
}

}  // namespace
}  // namespace arris::ui
