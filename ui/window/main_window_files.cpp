// What the main window reads and writes: scans, sessions, pictures and results.

#include <QApplication>
#include <QDateTime>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QLocale>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>
#include <QStackedWidget>
#include <QStandardPaths>
#include <QStatusBar>

#include "core/base/write_file.h"
#include "core/document/export.h"
#include "core/document/journal.h"
#include "core/mesh/write_ply.h"
#include "core/samples/mould.h"
#include "ui/panels/controls.h"
#include "ui/panels/start_page.h"
#include "ui/window/main_window.h"
#include "ui/window/picture_dialog.h"

namespace arris::ui {

namespace {

constexpr int most_recent = 10;

/// Asks where to save what belongs to a part; empty: nowhere. The name proposed is the part's, the
/// folder the one that was taken last for files of this kind, which `folder` names.
QString choose_path(QWidget* parent, const Document& document, const QString& title,
                    const QString& folder, const QString& ending, const QString& filter) {
  QSettings settings;
  const QFileInfo part(QString::fromStdString(document.scan_path));
  QString path = QFileDialog::getSaveFileName(parent, title,
                                              QDir(settings.value("folders/" + folder).toString())
                                                  .filePath(part.completeBaseName() + "." + ending),
                                              filter);
  if (path.isEmpty()) return path;
  if (QFileInfo(path).suffix().isEmpty()) path += "." + ending;
  settings.setValue("folders/" + folder, QFileInfo(path).absolutePath());
  return path;
}

}  // namespace

void MainWindow::open(const QString& path) {
  if (may_leave_session()) session_->open(path);
}

bool MainWindow::may_leave_session() {
  if (!session_->has_unsaved_edits()) return true;
  QMessageBox box(QMessageBox::Question, "Arris", tr("Save the edits of this session?"),
                  QMessageBox::NoButton, this);
  box.setInformativeText(
      tr("A saved session opens again with its whole history. Discarded edits are lost."));
  QPushButton* save = box.addButton(tr("Save session…"), QMessageBox::AcceptRole);
  QPushButton* discard = box.addButton(tr("Discard"), QMessageBox::DestructiveRole);
  box.addButton(QMessageBox::Cancel);
  box.setDefaultButton(save);
  box.exec();
  if (box.clickedButton() == discard) return true;
  if (box.clickedButton() != save) return false;
  choose_session();
  return !session_->has_unsaved_edits();
}

void MainWindow::choose_session() {
  const QString path = choose_path(this, session_->current().document, tr("Save session"),
                                   "sessions", "jsonl", tr("Arris session (*.jsonl)"));
  if (path.isEmpty()) return;
  const Result<void> written =
      write_file_whole(path.toStdString(), journal_text(session_->history()));
  if (!written) {
    QMessageBox::warning(this, "Arris", QString::fromStdString(written.error().message));
    return;
  }
  session_->mark_saved();
  statusBar()->showMessage(tr("Saved %1").arg(path), 5000);
}

void MainWindow::offer_recovery() {
  for (const QString& journal : Session::abandoned_journals()) {
    QMessageBox box(
        QMessageBox::Question, "Arris",
        tr("A session of %1 was not closed.")
            .arg(QLocale::c().toString(QFileInfo(journal).lastModified(), "yyyy-MM-dd hh:mm")),
        QMessageBox::NoButton, this);
    box.setInformativeText(tr("It is complete up to its last edit. Go on with it?"));
    QPushButton* go_on = box.addButton(tr("Go on"), QMessageBox::AcceptRole);
    QPushButton* discard = box.addButton(tr("Discard it"), QMessageBox::DestructiveRole);
    box.addButton(tr("Later"), QMessageBox::RejectRole);
    box.setDefaultButton(go_on);
    box.exec();
    if (box.clickedButton() == discard) {
      Session::discard_journal(journal);
    } else if (box.clickedButton() == go_on) {
      session_->recover(journal);
      return;
    }
  }
}

void MainWindow::open_sample() {
  if (!may_leave_session()) return;
  const QString folder = QStandardPaths::writableLocation(QStandardPaths::AppDataLocation);
  QDir().mkpath(folder);
  const QString path = folder + "/sample_mould.ply";
  session_->open_made(path, [file = path.toStdString()]() -> Result<void> {
    SampleMould mould = make_mould();
    const Result<MeshPtr> mesh = Mesh::create(std::move(mould.points), std::move(mould.triangles));
    if (!mesh) return tl::unexpected<Error>(mesh.error());
    return write_ply(file, **mesh, {});
  });
}

void MainWindow::choose_file() {
  QSettings settings;
  const QString path = QFileDialog::getOpenFileName(
      this, tr("Open scan"), settings.value("folders/open").toString(),
      tr("Scans and sessions (*.stl *.ply *.obj *.off *.3mf *.gz *.jsonl);;All files (*)"));
  if (path.isEmpty()) return;
  settings.setValue("folders/open", QFileInfo(path).absolutePath());
  open(path);
}

bool MainWindow::save_picture(const QString& path, const PictureOptions& options, QString* error) {
  const QImage image = picture(options);
  QString message;
  if (image.isNull())
    message =
        tr("The picture could not be drawn at %1 × %2 pixels: the graphics driver refused it. "
           "Choose a smaller size.")
            .arg(options.size.width())
            .arg(options.size.height());
  else if (!image.save(path))
    message = tr("%1 could not be written. Is the folder there, and does the name end in .png or "
                 ".jpg?")
                  .arg(path);
  if (error) *error = message;
  return message.isEmpty();
}

QImage MainWindow::picture(const PictureOptions& options) {
  return comparison_->active() ? comparison_->picture(options) : view_->picture(options);
}

void MainWindow::choose_picture() {
  picture_options_.scalar_bar = true;
  PictureDialog dialog(picture_options_, stack_->size(), this);
  if (dialog.exec() != QDialog::Accepted) return;
  picture_options_ = dialog.options();
  const QString path = choose_path(this, session_->current().document, tr("Save picture"),
                                   "pictures", "png", tr("PNG (*.png);;JPEG (*.jpg)"));
  if (path.isEmpty()) return;
  QString error;
  if (save_picture(path, picture_options_, &error))
    statusBar()->showMessage(tr("Saved %1").arg(path), 5000);
  else
    QMessageBox::warning(this, "Arris", error);
}

void MainWindow::choose_results_folder() {
  QSettings settings;
  const QString folder = QFileDialog::getExistingDirectory(
      this, tr("Folder for lines, boundaries, labelled scan and operations"),
      settings.value("folders/results").toString());
  if (folder.isEmpty()) return;
  settings.setValue("folders/results", folder);
  const Document& document = session_->current().document;
  const auto path = [&](const char* name) { return QDir(folder).filePath(name).toStdString(); };
  Result<void> written = write_file_whole(path("lines.obj"), lines_obj(document));
  if (written) written = write_file_whole(path("boundaries.obj"), boundaries_obj(document));
  if (written)
    written =
        write_labelled_scan(path("scan_partitions.ply"), *document.scan, labels_on_scan(document));
  if (written)
    written = write_file_whole(path("operations.jsonl"), journal_text(session_->history()));
  if (written) session_->mark_saved();
  if (written)
    statusBar()->showMessage(
        tr("lines.obj, boundaries.obj, scan_partitions.ply and operations.jsonl written to %1")
            .arg(folder),
        8000);
  else
    QMessageBox::warning(this, "Arris", QString::fromStdString(written.error().message));
}

void MainWindow::show_load_report() {
  const LoadReport& report = session_->current().document.scan->report;
  QString text = tr("%1: %2 with %3 and %4.")
                     .arg(QFileInfo(QString::fromStdString(report.file)).fileName(),
                          QString::fromStdString(report.format),
                          shown_count(report.file_faces, tr("face"), tr("faces")),
                          shown_count(report.file_vertices, tr("vertex"), tr("vertices")));
  text += "\n" + tr("The mesh has %1, %2, has %3 and Euler number %4.")
                     .arg(shown_count(report.faces, tr("triangle"), tr("triangles")),
                          report.components == 1
                              ? tr("hangs together in one piece")
                              : tr("falls into %1 loose pieces")
                                    .arg(count_text(static_cast<qint64>(report.components))),
                          shown_count(report.border_edges, tr("border edge"), tr("border edges")))
                     .arg(report.euler_number);
  QMessageBox box(QMessageBox::Information, tr("Load report"), text, QMessageBox::Ok, this);
  QString details;
  for (const std::string& sentence : report.sentences())
    details += "• " + QString::fromStdString(sentence) + "\n";
  box.setInformativeText(details.isEmpty() ? tr("Nothing had to be mended.") : details.trimmed());
  box.exec();
}

void MainWindow::remember_recent(const QString& path) {
  QSettings settings;
  QStringList recent = settings.value("recent").toStringList();
  const QString absolute = QFileInfo(path).absoluteFilePath();
  recent.removeAll(absolute);
  recent.prepend(absolute);
  while (recent.size() > most_recent) recent.removeLast();
  settings.setValue("recent", recent);
  refresh_recent();
}

void MainWindow::refresh_recent() {
  const QStringList recent = QSettings().value("recent").toStringList();
  start_page_->set_recent(recent);
  recent_menu_->clear();
  recent_menu_->setEnabled(!recent.isEmpty());
  for (const QString& path : recent)
    connect(recent_menu_->addAction(QFileInfo(path).fileName()), &QAction::triggered, this,
            [this, path] { open(path); });
}

}  // namespace arris::ui
