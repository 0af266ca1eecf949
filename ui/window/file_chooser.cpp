#include "ui/window/file_chooser.h"

#include <QFileDialog>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>

namespace arris::ui {

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

QString as_file_name(QString name) {
  for (QChar& c : name)
    if (QString("/\\:*?\"<>|").contains(c) || c.unicode() < 0x20) c = '_';
  return name;
}

bool may_replace(QWidget* parent, const QStringList& names, const QString& folder) {
  QMessageBox box(QMessageBox::Question, "Arris",
                  QObject::tr("Replace what is in this folder from before?"), QMessageBox::NoButton,
                  parent);
  box.setInformativeText(QObject::tr("%1 in %2 would be replaced.").arg(names.join(", "), folder));
  QPushButton* replace = box.addButton(QObject::tr("Replace"), QMessageBox::AcceptRole);
  box.addButton(QMessageBox::Cancel);
  box.exec();
  return box.clickedButton() == replace;
}

}  // namespace arris::ui
