// What the window exports: chosen by hand, named by the part, and read again by VTK.

#include <algorithm>

#include <QApplication>
#include <QDir>
#include <QLineEdit>
#include <QListWidget>
#include <QMessageBox>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTimer>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include "tests/ui/window_fixture.h"
#include "ui/window/export_dialog.h"

namespace arris::ui {
namespace {

class ExportResults : public MainWindowTest {
 protected:
  /// Ctrl+E, and what is done in the dialog that comes.
  void when_asked(const std::function<void(ExportDialog&)>& act) {
    bool asked = false;
    QTimer timer;
    QObject::connect(&timer, &QTimer::timeout, &timer, [&] {
      auto* dialog = qobject_cast<ExportDialog*>(QApplication::activeModalWidget());
      if (!dialog || !dialog->isVisible() || asked) return;
      asked = true;
      act(*dialog);
      if (dialog->isVisible()) dialog->reject();
    });
    timer.start(20);
    press(Qt::Key_E, Qt::ControlModifier);
    ASSERT_TRUE(QTest::qWaitFor([&] { return asked && !window->exporting(); }, patience));
  }
  static QListWidgetItem* item_of(ExportDialog& dialog, const QString& name) {
    auto* files = dialog.findChild<QListWidget*>("export_files");
    const auto found = files->findItems("_" + name, Qt::MatchContains);
    return found.isEmpty() ? nullptr : found.front();
  }
  static QPushButton* button(ExportDialog& dialog, const QString& text) {
    for (QPushButton* b : dialog.findChildren<QPushButton*>())
      if (b->text() == text) return b;
    return nullptr;
  }
  const QTemporaryDir folder;
};

TEST_F(ExportResults, WritesWhatIsTickedNamedByThePart) {
  open_sample();
  run_both();
  when_asked([&](ExportDialog& dialog) {
    auto* files = dialog.findChild<QListWidget*>("export_files");
    EXPECT_EQ(files->count(), static_cast<int>(result_files().size()));
    // At first what the command line writes, too.
    for (const ResultFile& file : result_files()) {
      const auto* item =
          item_of(dialog, QString::fromUtf8(file.name.data(), qsizetype(file.name.size())));
      ASSERT_NE(item, nullptr) << file.name;
      EXPECT_EQ(item->checkState() == Qt::Checked, file.usual) << file.name;
    }
    auto* where = dialog.findChild<QLineEdit*>("export_folder");
    where->setText(folder.filePath("nowhere"));
    EXPECT_FALSE(button(dialog, "Export")->isEnabled());
    where->setText(folder.path());
    EXPECT_TRUE(button(dialog, "Export")->isEnabled());
    for (int row = 0; row < files->count(); ++row) files->item(row)->setCheckState(Qt::Unchecked);
    EXPECT_FALSE(button(dialog, "Export")->isEnabled());
    for (const char* name : {"lines.vtp", "boundaries.vtp", "partitions.vtp", "line_table.csv"})
      item_of(dialog, name)->setCheckState(Qt::Checked);
    QTest::mouseClick(button(dialog, "Export"), Qt::LeftButton);
  });
  const QString part = QFileInfo(window->session().part_name()).completeBaseName();
  QStringList expected;
  for (const char* name : {"boundaries.vtp", "line_table.csv", "lines.vtp", "partitions.vtp"})
    expected << part + "_" + name;
  EXPECT_EQ(QDir(folder.path()).entryList(QDir::Files, QDir::Name), expected);

  const auto read = [&](const char* name) {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(folder.filePath(part + "_" + name).toUtf8().constData());
    reader->Update();
    return vtkSmartPointer<vtkPolyData>(reader->GetOutput());
  };
  const auto lines = read("lines.vtp");
  ASSERT_EQ(lines->GetNumberOfLines(), static_cast<int>(document().lines.lines.size()));
  for (vtkIdType k = 0; k < lines->GetNumberOfLines(); ++k) {
    const Line& line = *document().lines.lines[static_cast<std::size_t>(k)];
    EXPECT_EQ(lines->GetCellData()->GetArray("line")->GetComponent(k, 0), line.id);
    EXPECT_NEAR(lines->GetCellData()->GetArray("length")->GetComponent(k, 0), line.length,
                1e-9 * line.length);
    ASSERT_EQ(lines->GetCell(k)->GetNumberOfPoints(), static_cast<int>(line.vertices.size()));
    double place[3];
    lines->GetCell(k)->GetPoints()->GetPoint(1, place);
    EXPECT_NEAR((Point(place) - document().mesh->point(line.vertices[1])).norm(), 0.0, 1e-6);
  }
  EXPECT_EQ(read("boundaries.vtp")->GetNumberOfLines(),
            static_cast<int>(document().boundaries->size()));
  const auto partitions = read("partitions.vtp");
  ASSERT_EQ(partitions->GetNumberOfPolys(), static_cast<int>(document().mesh->face_count()));
  vtkDataArray* labels = partitions->GetCellData()->GetArray("partition");
  for (FaceId f = 0; f < document().mesh->face_count(); f += 97)
    ASSERT_EQ(labels->GetComponent(f, 0), document().partitions.label(f));
}

TEST_F(ExportResults, RemembersTheChoiceAndAsksBeforeItReplaces) {
  open_sample();
  run_both();
  const auto only_the_table = [&](ExportDialog& dialog) {
    auto* files = dialog.findChild<QListWidget*>("export_files");
    for (int row = 0; row < files->count(); ++row) files->item(row)->setCheckState(Qt::Unchecked);
    item_of(dialog, "partition_table.csv")->setCheckState(Qt::Checked);
    dialog.findChild<QLineEdit*>("export_folder")->setText(folder.path());
    QTest::mouseClick(button(dialog, "Export"), Qt::LeftButton);
  };
  when_asked(only_the_table);
  const QString name = QDir(folder.path()).entryList(QDir::Files).value(0);
  ASSERT_TRUE(name.endsWith("_partition_table.csv")) << name.toStdString();
  QFile file(folder.filePath(name));
  ASSERT_TRUE(file.open(QIODevice::WriteOnly) && file.write("mine") == 4);
  file.close();
  bool asked = false;
  QTimer answer;
  QObject::connect(&answer, &QTimer::timeout, &answer, [&] {
    if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget())) {
      asked = true;
      box->reject();
    }
  });
  answer.start(20);
  when_asked([&](ExportDialog& dialog) {
    EXPECT_EQ(dialog.folder(), folder.path());
    ASSERT_EQ(dialog.chosen().size(), 1u);
    EXPECT_EQ(dialog.chosen().front()->name, "partition_table.csv");
    QTest::mouseClick(button(dialog, "Export"), Qt::LeftButton);
  });
  EXPECT_TRUE(QTest::qWaitFor([&] { return asked; }, patience));
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  EXPECT_EQ(file.readAll(), "mine");
}

}  // namespace
}  // namespace arris::ui
