#include "ui/window/about_dialog.h"

#include <sqlite3.h>

#include <QApplication>
#include <QClipboard>
#include <QDialogButtonBox>
#include <QFileInfo>
#include <QLabel>
#include <QPushButton>
#include <QSysInfo>
#include <QVBoxLayout>

#include "core/base/machine_memory.h"
#include "core/base/number_text.h"
#include "core/document/document.h"
#include "ui/panels/controls.h"
#include "ui/view/graphics.h"
#include "ui/window/log_file.h"
#include "ui/window/session.h"

namespace arris::ui {

namespace {

QString known_or(const QString& text) {
  return text.isEmpty() ? AboutDialog::tr("not known") : text;
}

}  // namespace

QStringList made_of() {
  return {"Arris " + QApplication::applicationVersion(), QString("Qt ") + qVersion(),
          "VTK " + vtk_version(), QString("SQLite ") + sqlite3_libversion()};
}

AboutDialog::AboutDialog(const Session& session, QWidget* parent) : QDialog(parent) {
  setWindowTitle(tr("About Arris"));
  auto* what = new QLabel(
      tr("<h3>Arris %1</h3><p>Segments scanned moulds: sharp lines, curvature and partitions, "
         "after "
         "Lesage, Léon and Véron, “Discrete curvature approximations and segmentation of "
         "polyhedral surfaces”.</p><p>BSD 3-Clause licence.</p>")
          .arg(QApplication::applicationVersion()),
      this);
  what->setWordWrap(true);
  auto* runs_on =
      new QLabel(tr("%1\nGraphics: %2\nLog: %3")
                     .arg(made_of().join(", "), known_or(graphics_text()), program_log().path()),
                 this);
  runs_on->setObjectName("runs_on");
  runs_on->setWordWrap(true);
  runs_on->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  auto* copied = new MutedLabel({}, this);
  copied->setWordWrap(true);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  QPushButton* copy = buttons->addButton(tr("Copy report"), QDialogButtonBox::ActionRole);
  copy->setToolTip(
      tr("Copies the versions, the graphics, what kind of part is open and the end of the log, "
         "without paths and names of files"));
  copy->setAutoDefault(false);
  auto* column = new QVBoxLayout(this);
  column->setSpacing(12);
  for (QWidget* widget : std::initializer_list<QWidget*>{what, runs_on, copied, buttons})
    column->addWidget(widget);
  setMinimumWidth(460);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(copy, &QPushButton::clicked, this, [&session, copied] {
    QApplication::clipboard()->setText(report(session));
    copied->setText(
        tr("Copied. Paths and names of files are left out; read it before you send it."));
  });
}

QString AboutDialog::report(const Session& session) {
  QStringList lines = made_of();
  lines << "System: " + QSysInfo::prettyProductName() + ", " + QSysInfo::currentCpuArchitecture()
        << "Graphics: " + known_or(graphics_text())
        << "Memory: " +
               QString::fromStdString(fixed_text(static_cast<double>(machine_memory()) / 1e9, 1)) +
               " GB";
  const Document& document = session.current().document;
  QStringList known;
  if (!document.empty()) {
    const LoadReport& scan = document.scan->report;
    lines << QString("Part: %1, %2 faces, %3 vertices, %4 border edges, %5 lines, %6 partitions")
                 .arg(QString::fromStdString(scan.format))
                 .arg(document.mesh->face_count())
                 .arg(document.mesh->vertex_count())
                 .arg(document.mesh->border_edge_count())
                 .arg(document.lines.lines.size())
                 .arg(document.partitions.partitions.size());
    for (const QString& path :
         {QString::fromStdString(document.scan_path), session.file(), session.part_name()})
      known << path << QFileInfo(path).absoluteFilePath() << QFileInfo(path).fileName()
            << QFileInfo(path).completeBaseName();
  }
  lines << ""
        << "End of the log:" << program_log().last(40);
  known.removeAll(QString());
  known.removeDuplicates();
  return without_paths(lines.join('\n'), known) + "\n";
}

}  // namespace arris::ui
