#include "ui/window/results_presenter.h"

#include <memory>
#include <utility>
#include <vector>

#include <QDir>
#include <QFileInfo>
#include <QMessageBox>

#include "ui/window/export_dialog.h"
#include "ui/window/file_chooser.h"

namespace arris::ui {

ResultsPresenter::ResultsPresenter(Session* session, QWidget* window)
    : QObject(window), session_(session), window_(window), work_(this) {}

void ResultsPresenter::ask() {
  work_.wait();  // one after the other
  // Named by the part, so that results of several parts fit into one folder.
  ExportDialog dialog(QFileInfo(session_->part_name()).completeBaseName() + "_", window_);
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
  if (!there.isEmpty() && !may_replace(window_, there, dialog.folder())) return;
  std::vector<std::pair<const ResultFile*, std::string>> wanted;
  for (const ResultFile* file : files) wanted.emplace_back(file, path(*file).toStdString());
  // A copy, which shares the document: surfaces are fitted for some of the files, and the window
  // goes on meanwhile.
  const auto history = std::make_shared<const History>(session_->history().copy_to_save());
  emit message(tr("Writing %1 …").arg(all.join(", ")), 0);
  work_.start(
      [history, wanted](const Context& context) {
        Result<void> written;
        for (const auto& [file, where] : wanted)
          if (written && !context.cancelled()) written = file->write(where, *history);
        return written;
      },
      [this, all, folder = dialog.folder()](const Result<void>& written) {
        if (written) {
          emit message(tr("%1 written to %2").arg(all.join(", "), folder), 8000);
        } else {
          emit message({}, 0);
          QMessageBox::warning(window_, "Arris", QString::fromStdString(written.error().message));
        }
      });
}

}  // namespace arris::ui
