#include "ui/window/load_report_box.h"

#include <QFileInfo>
#include <QMessageBox>

#include "ui/panels/controls.h"

namespace arris::ui {

void show_load_report(const LoadReport& report, QWidget* window) {
  QString text =
      QObject::tr("%1: %2 with %3 and %4.")
          .arg(QFileInfo(QString::fromStdString(report.file)).fileName(),
               QString::fromStdString(report.format),
               shown_count(report.file_faces, QObject::tr("face"), QObject::tr("faces")),
               shown_count(report.file_vertices, QObject::tr("vertex"), QObject::tr("vertices")));
  text +=
      "\n" + QObject::tr("The mesh has %1, %2, has %3 and Euler number %4.")
                 .arg(shown_count(report.faces, QObject::tr("triangle"), QObject::tr("triangles")),
                      report.components == 1
                          ? QObject::tr("hangs together in one piece")
                          : QObject::tr("falls into %1 loose pieces")
                                .arg(count_text(static_cast<qint64>(report.components))),
                      shown_count(report.border_edges, QObject::tr("border edge"),
                                  QObject::tr("border edges")))
                 .arg(report.euler_number);
  QMessageBox box(QMessageBox::Information, QObject::tr("Load report"), text, QMessageBox::Ok,
                  window);
  QString details;
  for (const std::string& sentence : report.sentences())
    details += "• " + QString::fromStdString(sentence) + "\n";
  box.setInformativeText(details.isEmpty() ? QObject::tr("Nothing had to be mended.")
                                           : details.trimmed());
  box.exec();
}

}  // namespace arris::ui
