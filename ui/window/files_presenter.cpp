#include "ui/window/files_presenter.h"

#include <QDateTime>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QLocale>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>
#include <QStandardPaths>
#include <QTimer>

#include "core/mesh/write_ply.h"
#include "core/samples/mould.h"
#include "ui/window/actions.h"
#include "ui/window/file_chooser.h"

namespace arris::ui {

namespace {

constexpr int most_recent = 10;

}  // namespace

FilesPresenter::FilesPresenter(Session* session, std::function<SessionExtras()> extras,
                               QWidget* window)
    : QObject(window), session_(session), extras_(std::move(extras)), window_(window) {
  // Once the session is no longer busy: the answer opens it again.
  connect(session_, &Session::scan_lost, this, &FilesPresenter::ask_for_scan, Qt::QueuedConnection);
  connect(session_, &Session::opened, this, [this] {
    remember_recent(session_->file().isEmpty()
                        ? QString::fromStdString(session_->current().document.scan_path)
                        : session_->file());
    emit message(
        session_->current().document.scan->report.clean()
            ? tr("Opened %1").arg(session_->part_name())
            : tr("Opened %1. It was mended where a mesh cannot hold it: see Part ▸ Load report.")
                  .arg(session_->part_name()),
        10000);
    if (!session_->is_read_only()) return;
    QTimer::singleShot(0, this, [this, file = session_->file()] {
      QMessageBox::information(
          window_, "Arris",
          tr("%1 is open in another window. It is read-only here: what you do can be saved under "
             "another name.")
              .arg(file));
    });
  });
}

void FilesPresenter::add_actions(QMenu* menu) {
  connect(action(menu, tr("&Open scan…"), QKeySequence::Open,
                 tr("Open an STL, PLY, OBJ, OFF or 3MF file, or a session")),
          &QAction::triggered, this, &FilesPresenter::choose_file);
  connect(action(menu, tr("Open the sample &mould"), QKeySequence("Ctrl+Shift+O"),
                 tr("Open the mould part that Arris makes itself")),
          &QAction::triggered, this, &FilesPresenter::open_sample);
  recent_menu_ = menu->addMenu(tr("Open &recent"));
  save_ = action(menu, tr("&Save session"), QKeySequence::Save,
                 tr("Save scan, operations and view in one file; open it to go on"));
  connect(save_, &QAction::triggered, this, &FilesPresenter::save);
  save_as_ = action(menu, tr("Save session &as…"), QKeySequence("Ctrl+Shift+S"),
                    tr("Save the session in another file and go on with that"));
  connect(save_as_, &QAction::triggered, this, &FilesPresenter::save_as);
}

void FilesPresenter::open(const QString& path) {
  if (!may_leave()) return;
  located_.clear();
  open_again_ = [this, path](const QStringList& located) { session_->open(path, located); };
  open_again_({});
}

void FilesPresenter::ask_for_scan(const QString& session, const QString& scan) {
  const QString name = QFileInfo(scan).fileName();
  QMessageBox box(QMessageBox::Question, "Arris",
                  tr("Where is %1, the scan of this session?").arg(name), QMessageBox::NoButton,
                  window_);
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
      window_, tr("Locate %1").arg(name), QFileInfo(session).absolutePath(),
      tr("Scans (*.stl *.ply *.obj *.off *.3mf *.gz);;All files (*)"));
  if (found.isEmpty()) return;
  located_ << found;
  open_again_(located_);
}

bool FilesPresenter::may_leave() {
  if (!session_->has_unsaved_edits()) return true;
  QMessageBox box(QMessageBox::Question, "Arris",
                  tr("Save the edits of %1?").arg(session_->part_name()), QMessageBox::NoButton,
                  window_);
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

bool FilesPresenter::save() {
  const bool has_file = !session_->file().isEmpty() && !session_->is_read_only();
  if (!has_file) return save_as();
  save_to(session_->file());
  return true;
}

bool FilesPresenter::save_as() {
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
  const QString path = choose_path(window_, tr("Save session"), suggested, "sessions",
                                   tr("Arris session (*.arris)"));
  if (path.isEmpty()) return false;
  save_to(path);
  return true;
}

void FilesPresenter::save_to(const QString& path) {
  emit message(tr("Saving %1 …").arg(path), 0);
  session_->save(path, extras_(),
                 [this, path](const Result<void>& written) { tell_saved(path, written); });
}

void FilesPresenter::tell_saved(const QString& path, const Result<void>& written) {
  if (written) {
    emit message(tr("Saved %1").arg(path), 5000);
    remember_recent(path);
    return;
  }
  emit message({}, 0);
  QMessageBox box(QMessageBox::Warning, "Arris", QString::fromStdString(written.error().message),
                  QMessageBox::NoButton, window_);
  box.setInformativeText(
      tr("Nothing is lost: the session is as it was, and can be saved "
         "elsewhere."));
  QPushButton* elsewhere = box.addButton(tr("Save as…"), QMessageBox::AcceptRole);
  box.addButton(QMessageBox::Cancel);
  box.setDefaultButton(elsewhere);
  box.exec();
  if (box.clickedButton() == elsewhere) save_as();
}

bool FilesPresenter::offer_recovery() {
  for (const QString& recovery : Session::abandoned_sessions()) {
    const QString part = Session::part_of(recovery);
    QMessageBox box(
        QMessageBox::Question, "Arris",
        tr("The session of %1 from %2 was not closed.")
            .arg(part.isEmpty() ? tr("a part") : part,
                 QLocale::c().toString(QFileInfo(recovery).lastModified(), "yyyy-MM-dd hh:mm")),
        QMessageBox::NoButton, window_);
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

void FilesPresenter::open_sample() {
  if (!may_leave()) return;
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

void FilesPresenter::choose_file() {
  QSettings settings;
  const QString path = QFileDialog::getOpenFileName(
      window_, tr("Open scan"), settings.value("folders/open").toString(),
      tr("Scans and sessions (*.stl *.ply *.obj *.off *.3mf *.gz *.arris *.jsonl);;All files (*)"));
  if (path.isEmpty()) return;
  settings.setValue("folders/open", QFileInfo(path).absolutePath());
  open(path);
}

void FilesPresenter::remember_recent(const QString& path) {
  QSettings settings;
  QStringList recent = settings.value("recent").toStringList();
  const QString absolute = QFileInfo(path).absoluteFilePath();
  recent.removeAll(absolute);
  recent.prepend(absolute);
  while (recent.size() > most_recent) recent.removeLast();
  settings.setValue("recent", recent);
  refresh_recent();
}

void FilesPresenter::refresh_recent() {
  const QStringList recent = QSettings().value("recent").toStringList();
  QList<QImage> pictures;
  for (const QString& path : recent) {
    const std::string png = SessionFile::picture_of(path.toStdString());
    pictures << QImage::fromData(reinterpret_cast<const uchar*>(png.data()),
                                 static_cast<int>(png.size()), "PNG");
  }
  emit recent_changed(recent, pictures);
  recent_menu_->clear();
  recent_menu_->setEnabled(!recent.isEmpty());
  for (const QString& path : recent)
    connect(recent_menu_->addAction(QFileInfo(path).fileName()), &QAction::triggered, this,
            [this, path] { open(path); });
}

}  // namespace arris::ui
