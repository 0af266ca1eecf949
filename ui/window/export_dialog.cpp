#include "ui/window/export_dialog.h"

#include "ui/panels/controls.h"

#include <QDialogButtonBox>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QSettings>
#include <QStandardPaths>
#include <QVBoxLayout>

namespace arris::ui {

ExportDialog::ExportDialog(QString prefix, QWidget* parent)
    : QDialog(parent), prefix_(std::move(prefix)) {
  setWindowTitle(tr("Export results"));
  setObjectName("export_dialog");
  auto* column = new QVBoxLayout(this);
  files_ = new QListWidget(this);
  files_->setObjectName("export_files");
  files_->setUniformItemSizes(true);
  files_->setSpacing(1);
  const QSettings settings;
  const bool chosen_before = settings.contains("export/files");
  const QStringList before = settings.value("export/files").toStringList();
  for (const ResultFile& file : result_files()) {
    auto* item = new QListWidgetItem(
        tr("%1  (%2)")
            .arg(tr(QByteArray(file.title.data(), qsizetype(file.title.size()))), name_of(file)),
        files_);
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
    const bool on = chosen_before ? before.contains(shown_text(file.name)) : file.usual;
    item->setCheckState(on ? Qt::Checked : Qt::Unchecked);
  }
  files_->setCurrentRow(0);
  files_->setMinimumWidth(files_->sizeHintForColumn(0) + 2 * files_->frameWidth() + 24);
  files_->setMinimumHeight(files_->count() * (files_->sizeHintForRow(0) + 2 * files_->spacing()) +
                           2 * files_->frameWidth());
  auto* what = new QLabel(tr("&Files to write"), this);
  what->setBuddy(files_);
  column->addWidget(what);
  column->addWidget(files_);

  QString documents = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
  if (!QFileInfo(documents).isDir()) documents = QDir::homePath();
  folder_ = new QLineEdit(settings.value("folders/results", documents).toString(), this);
  folder_->setObjectName("export_folder");
  auto* browse = new QPushButton(tr("&Browse…"), this);
  browse->setAutoDefault(false);
  auto* where = new QLabel(tr("&To the folder"), this);
  where->setBuddy(folder_);
  auto* row = new QHBoxLayout;
  row->addWidget(where);
  row->addWidget(folder_, 1);
  row->addWidget(browse);
  column->addLayout(row);

  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
  export_ = buttons->addButton(tr("Export"), QDialogButtonBox::AcceptRole);
  export_->setDefault(true);
  column->addWidget(buttons);
  connect(browse, &QPushButton::clicked, this, &ExportDialog::choose_folder);
  connect(files_, &QListWidget::itemChanged, this, &ExportDialog::update_buttons);
  connect(folder_, &QLineEdit::textChanged, this, &ExportDialog::update_buttons);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  update_buttons();
}

std::vector<const ResultFile*> ExportDialog::chosen() const {
  std::vector<const ResultFile*> files;
  int row = 0;
  for (const ResultFile& file : result_files())
    if (files_->item(row++)->checkState() == Qt::Checked) files.push_back(&file);
  return files;
}

QString ExportDialog::folder() const { return QDir::fromNativeSeparators(folder_->text()); }

QString ExportDialog::name_of(const ResultFile& file) const {
  return prefix_ + shown_text(file.name);
}

void ExportDialog::choose_folder() {
  const QString folder =
      QFileDialog::getExistingDirectory(this, tr("Folder for what is exported"), folder_->text());
  if (!folder.isEmpty()) folder_->setText(QDir::toNativeSeparators(folder));
}

void ExportDialog::update_buttons() {
  const bool there = QFileInfo(folder()).isDir();
  export_->setEnabled(there && !chosen().empty());
  export_->setToolTip(!there             ? tr("Choose a folder that is there")
                      : chosen().empty() ? tr("Choose what to write")
                                         : QString());
}

void ExportDialog::accept() {
  QStringList names;
  for (const ResultFile* file : chosen()) names << shown_text(file->name);
  QSettings settings;
  settings.setValue("export/files", names);
  settings.setValue("folders/results", folder());
  QDialog::accept();
}

}  // namespace arris::ui
