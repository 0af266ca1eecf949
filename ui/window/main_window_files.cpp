// What the main window reads and writes: scans, sessions, pictures and results.

#include <QApplication>
#include <QBuffer>
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
#include <QTimer>

#include "core/document/journal.h"
#include "core/document/results.h"
#include "core/mesh/write_ply.h"
#include "core/samples/mould.h"
#include "ui/panels/controls.h"
#include "ui/panels/start_page.h"
#include "ui/window/export_dialog.h"
#include "ui/window/latest_work.h"
#include "ui/window/main_window.h"
#include "ui/window/named_views_presenter.h"
#include "ui/window/picture_dialog.h"

namespace arris::ui {

namespace {

constexpr int most_recent = 10;

/// Asks where to save; empty: nowhere. The folder that is taken is remembered for files of this
/// kind.
QString choose_path(QWidget* parent, const QString& title, const QFileInfo& proposed,
                    const QString& kind, const QString& filter) {
  QFileDialog dialog(parent, title, proposed.absolutePath(), filter);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  // Not added afterwards: the question whether to replace a file is about its whole name.
  dialog.setDefaultSuffix(proposed.suffix());
  dialog.selectFile(proposed.fileName());
  if (dialog.exec() != QDialog::Accepted || dialog.selectedFiles().isEmpty()) return {};
  const QString path = dialog.selectedFiles().first();
  QSettings().setValue("folders/" + kind, QFileInfo(path).absolutePath());
  return path;
}

/// A name without what file systems refuse.
QString as_file_name(QString name) {
  for (QChar& c : name)
    if (QString("/\\:*?\"<>|").contains(c) || c.unicode() < 0x20) c = '_';
  return name;
}

}  // namespace

void MainWindow::open(const QString& path) {
  if (!may_leave_session()) return;
  located_.clear();
  open_again_ = [this, path](const QStringList& located) { session_->open(path, located); };
  open_again_({});
}

void MainWindow::ask_for_scan(const QString& session, const QString& scan) {
  const QString name = QFileInfo(scan).fileName();
  QMessageBox box(QMessageBox::Question, "Arris",
                  tr("Where is %1, the scan of this session?").arg(name), QMessageBox::NoButton,
                  this);
  box.setInformativeText(
      located_.isEmpty()
          ? tr("It is neither beside %1 nor at %2, or is another file there by now.")
                .arg(QFileInfo(session).fileName(), scan)
          : tr("%1 is not the file that was opened then: its content is another one.")
                .arg(located_.last()));
  QPushButton* locate = box.addButton(tr("Locate…"), QMessageBox::AcceptRole);
  box.addButton(QMessageBox::Cancel);
  box.setDefaultButton(locate);
  box.exec();
  if (box.clickedButton() != locate) return;
  const QString found = QFileDialog::getOpenFileName(
      this, tr("Locate %1").arg(name), QFileInfo(session).absolutePath(),
      tr("Scans (*.stl *.ply *.obj *.off *.3mf *.gz);;All files (*)"));
  if (found.isEmpty()) return;
  located_ << found;
  open_again_(located_);
}

void MainWindow::take_opened() {
  const Document& document = session_->current().document;
  // An open scan is shown from the side it was scanned from, a closed part from a corner.
  const Point side = mean_normal(*document.mesh);
  constexpr double open_scan = 0.15;
  if (side.norm() > open_scan)
    view_->look_against(side);
  else
    view_->look_from(MeshView::StandardView::isometric);
  show_partitions(false);
  // A session that nobody looked at yet, as from the command line, shows what was found.
  if (!restore_view(view_keepers(), session_->extras().view) && document.step("find_partitions"))
    show_partitions(true);
  const nlohmann::json kept = parse_record(session_->extras().view);
  named_views_->restore(kept.is_object() && kept.contains("named") ? kept["named"]
                                                                   : nlohmann::json());
  named_views_->set_part(true);
  view_->setFocus();
  refresh_title();
  remember_recent(session_->file().isEmpty() ? QString::fromStdString(document.scan_path)
                                             : session_->file());
  statusBar()->showMessage(
      document.scan->report.clean()
          ? tr("Opened %1").arg(session_->part_name())
          : tr("Opened %1. It was mended where a mesh cannot hold it: see Part ▸ Load report.")
                .arg(session_->part_name()),
      10000);
  if (session_->is_read_only())
    QTimer::singleShot(0, this, [this, file = session_->file()] {
      QMessageBox::information(
          this, "Arris",
          tr("%1 is open in another window. It is read-only here: what you do can be saved under "
             "another name.")
              .arg(file));
    });
}

void MainWindow::refresh_title() {
  if (session_->current().document.empty()) return;
  const QString name =
      session_->file().isEmpty() ? session_->part_name() : QFileInfo(session_->file()).fileName();
  setWindowTitle(name + (session_->is_read_only() ? tr(" (read-only)") : QString()) +
                 "[*] – Arris");
  setWindowModified(session_->has_unsaved_edits());
}

ViewKeepers MainWindow::view_keepers() {
  return {view_, fields_, elements_, section_, view_presenter_, show_partitions_, toggles_};
}

std::string MainWindow::views_to_keep() {
  nlohmann::json view = parse_record(saved_view(view_keepers()));
  view["named"] = named_views_->saved();
  return view.dump();
}

SessionExtras MainWindow::extras_to_save() {
  SessionExtras extras;
  extras.view = views_to_keep();
  // Small, for the list of recent files.
  PictureOptions options;
  options.size = {320, 240};
  options.scalar_bar = options.scale_bar = options.orientation_marker = false;
  QByteArray png;
  QBuffer buffer(&png);
  if (const QImage image = view_->picture(options);
      !image.isNull() && buffer.open(QIODevice::WriteOnly) && image.save(&buffer, "PNG"))
    extras.picture = png.toStdString();
  return extras;
}

bool MainWindow::may_leave_session() {
  if (!session_->has_unsaved_edits()) return true;
  QMessageBox box(QMessageBox::Question, "Arris",
                  tr("Save the edits of %1?").arg(session_->part_name()), QMessageBox::NoButton,
                  this);
  box.setInformativeText(
      tr("A saved session opens again with its whole history. Discarded edits are lost."));
  QPushButton* save_it = box.addButton(tr("Save"), QMessageBox::AcceptRole);
  QPushButton* discard = box.addButton(tr("Discard"), QMessageBox::DestructiveRole);
  box.addButton(QMessageBox::Cancel);
  box.setDefaultButton(save_it);
  box.exec();
  if (box.clickedButton() == discard) return true;
  if (box.clickedButton() != save_it || !save()) return false;
  session_->wait_until_saved();
  return !session_->has_unsaved_edits();
}

bool MainWindow::save() {
  const bool has_file = !session_->file().isEmpty() && !session_->is_read_only();
  if (!has_file) return save_as();
  save_to(session_->file());
  return true;
}

bool MainWindow::save_as() {
  QFileInfo suggested(session_->file());
  if (session_->file().isEmpty()) {
    QString folder = QSettings().value("folders/sessions").toString();
    // Beside its scan, but not where the sample lies, which nobody looks into.
    const QFileInfo scan(QString::fromStdString(session_->current().document.scan_path));
    const QString own = QStandardPaths::writableLocation(QStandardPaths::AppDataLocation);
    if (folder.isEmpty())
      folder = scan.absolutePath() == QFileInfo(own).absoluteFilePath() || !scan.dir().exists()
                   ? QDir::homePath()
                   : scan.absolutePath();
    suggested.setFile(QDir(folder), scan.completeBaseName() + ".arris");
  }
  const QString path =
      choose_path(this, tr("Save session"), suggested, "sessions", tr("Arris session (*.arris)"));
  if (path.isEmpty()) return false;
  save_to(path);
  return true;
}

void MainWindow::save_to(const QString& path) {
  statusBar()->showMessage(tr("Saving %1 …").arg(path));
  session_->save(path, extras_to_save(),
                 [this, path](const Result<void>& written) { tell_saved(path, written); });
}

void MainWindow::tell_saved(const QString& path, const Result<void>& written) {
  if (written) {
    statusBar()->showMessage(tr("Saved %1").arg(path), 5000);
    remember_recent(path);
    return;
  }
  statusBar()->clearMessage();
  QMessageBox box(QMessageBox::Warning, "Arris", QString::fromStdString(written.error().message),
                  QMessageBox::NoButton, this);
  box.setInformativeText(
      tr("Nothing is lost: the session is as it was, and can be saved "
         "elsewhere."));
  QPushButton* elsewhere = box.addButton(tr("Save as…"), QMessageBox::AcceptRole);
  box.addButton(QMessageBox::Cancel);
  box.setDefaultButton(elsewhere);
  box.exec();
  if (box.clickedButton() == elsewhere) save_as();
}

bool MainWindow::offer_recovery() {
  for (const QString& recovery : Session::abandoned_sessions()) {
    const QString part = Session::part_of(recovery);
    QMessageBox box(
        QMessageBox::Question, "Arris",
        tr("The session of %1 from %2 was not closed.")
            .arg(part.isEmpty() ? tr("a part") : part,
                 QLocale::c().toString(QFileInfo(recovery).lastModified(), "yyyy-MM-dd hh:mm")),
        QMessageBox::NoButton, this);
    box.setInformativeText(tr("It is complete up to its last edit. Go on with it?"));
    QPushButton* go_on = box.addButton(tr("Go on"), QMessageBox::AcceptRole);
    QPushButton* discard = box.addButton(tr("Discard it"), QMessageBox::DestructiveRole);
    box.addButton(tr("Later"), QMessageBox::RejectRole);
    box.setDefaultButton(go_on);
    box.exec();
    if (box.clickedButton() == discard) {
      Session::discard(recovery);
    } else if (box.clickedButton() == go_on) {
      located_.clear();
      open_again_ = [this, recovery](const QStringList& located) {
        session_->recover(recovery, located);
      };
      open_again_({});
      return true;
    }
  }
  return false;
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
    return write_ply(file, **mesh, {}, LengthUnit::millimetre);
  });
}

void MainWindow::choose_file() {
  QSettings settings;
  const QString path = QFileDialog::getOpenFileName(
      this, tr("Open scan"), settings.value("folders/open").toString(),
      tr("Scans and sessions (*.stl *.ply *.obj *.off *.3mf *.gz *.arris *.jsonl);;All files (*)"));
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
  const LengthUnit unit = length_unit_of(session_->current().document);
  PictureDialog dialog(picture_options_,
                       {stack_->size(), !named_views_->views().empty(), info_of(unit).millimetres},
                       this);
  if (dialog.exec() != QDialog::Accepted) return;
  picture_options_ = dialog.options();
  if (dialog.each_view()) {
    choose_pictures();
    return;
  }
  const QString name = QFileInfo(session_->part_name()).completeBaseName() + ".png";
  const QFileInfo proposed(QDir(QSettings().value("folders/pictures").toString()), name);
  const QString path =
      choose_path(this, tr("Save picture"), proposed, "pictures", tr("PNG (*.png);;JPEG (*.jpg)"));
  if (path.isEmpty()) return;
  QString error;
  if (save_picture(path, picture_options_, &error))
    statusBar()->showMessage(tr("Saved %1").arg(path), 5000);
  else
    QMessageBox::warning(this, "Arris", error);
}

void MainWindow::choose_pictures() {
  QSettings settings;
  const QString folder = QFileDialog::getExistingDirectory(
      this, tr("Folder for the pictures"), settings.value("folders/pictures").toString());
  if (folder.isEmpty()) return;
  settings.setValue("folders/pictures", folder);
  const QString before = QFileInfo(session_->part_name()).completeBaseName() + "_";
  QStringList names, there;
  for (const NamedViewsPresenter::NamedView& view : named_views_->views()) {
    const QString name = before + as_file_name(view.name);
    QString unique = name + ".png";
    for (int k = 2; names.contains(unique, Qt::CaseInsensitive); ++k)
      unique = QString("%1_%2.png").arg(name).arg(k);
    names << unique;
    if (QFileInfo::exists(QDir(folder).filePath(names.back()))) there << names.back();
  }
  if (!there.isEmpty() && !may_replace(there, folder)) return;
  const QString error = save_pictures(folder, names);
  if (error.isEmpty())
    statusBar()->showMessage(tr("%1 saved to %2").arg(names.join(", "), folder), 8000);
  else
    QMessageBox::warning(this, "Arris", error);
}

QString MainWindow::save_pictures(const QString& folder, const QStringList& names) {
  const std::string before = saved_view(view_keepers());
  QString error;
  for (qsizetype k = 0; k < names.size() && error.isEmpty(); ++k) {
    named_views_->show(static_cast<std::size_t>(k));
    fields_->wait_until_there();
    save_picture(QDir(folder).filePath(names[k]), picture_options_, &error);
  }
  restore_view(view_keepers(), before);
  return error;
}

bool MainWindow::may_replace(const QStringList& names, const QString& folder) {
  QMessageBox box(QMessageBox::Question, "Arris", tr("Replace what is in this folder from before?"),
                  QMessageBox::NoButton, this);
  box.setInformativeText(tr("%1 in %2 would be replaced.").arg(names.join(", "), folder));
  QPushButton* replace = box.addButton(tr("Replace"), QMessageBox::AcceptRole);
  box.addButton(QMessageBox::Cancel);
  box.exec();
  return box.clickedButton() == replace;
}

void MainWindow::export_results() {
  export_work_->wait();  // one after the other
  // Named by the part, so that results of several parts fit into one folder.
  ExportDialog dialog(QFileInfo(session_->part_name()).completeBaseName() + "_", this);
  if (dialog.exec() != QDialog::Accepted) return;
  const std::vector<const ResultFile*> files = dialog.chosen();
  const auto path = [&](const ResultFile& file) {
    return QDir(dialog.folder()).filePath(dialog.name_of(file));
  };
  QStringList all, there;
  for (const ResultFile* file : files) {
    all << dialog.name_of(*file);
    if (QFileInfo::exists(path(*file))) there << dialog.name_of(*file);
  }
  if (!there.isEmpty() && !may_replace(there, dialog.folder())) return;
  std::vector<std::pair<const ResultFile*, std::string>> wanted;
  for (const ResultFile* file : files) wanted.emplace_back(file, path(*file).toStdString());
  // A copy, which shares the document: surfaces are fitted for some of the files, and the window
  // goes on meanwhile.
  const auto history = std::make_shared<const History>(session_->history().copy_to_save());
  statusBar()->showMessage(tr("Writing %1 …").arg(all.join(", ")));
  export_work_->start(
      [history, wanted](const Context& context) {
        Result<void> written;
        for (const auto& [file, where] : wanted)
          if (written && !context.cancelled()) written = file->write(where, *history);
        return written;
      },
      [this, all, folder = dialog.folder()](const Result<void>& written) {
        if (written) {
          statusBar()->showMessage(tr("%1 written to %2").arg(all.join(", "), folder), 8000);
        } else {
          statusBar()->clearMessage();
          QMessageBox::warning(this, "Arris", QString::fromStdString(written.error().message));
        }
      });
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
  QList<QImage> pictures;
  for (const QString& path : recent) {
    const std::string png = SessionFile::picture_of(path.toStdString());
    pictures << QImage::fromData(reinterpret_cast<const uchar*>(png.data()),
                                 static_cast<int>(png.size()), "PNG");
  }
  start_page_->set_recent(recent, pictures);
  recent_menu_->clear();
  recent_menu_->setEnabled(!recent.isEmpty());
  for (const QString& path : recent)
    connect(recent_menu_->addAction(QFileInfo(path).fileName()), &QAction::triggered, this,
            [this, path] { open(path); });
}

}  // namespace arris::ui
