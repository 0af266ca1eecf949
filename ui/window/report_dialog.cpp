#include "ui/window/report_dialog.h"

#include <functional>

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QPushButton>
#include <QSettings>
#include <QStandardPaths>

namespace arris::ui {

ReportDialog::ReportDialog(const QString& part, QWidget* parent) : QDialog(parent) {
  setWindowTitle(tr("Write report"));
  setObjectName("report_dialog");
  const QSettings settings;
  auto* form = new QFormLayout(this);
  const auto line = [&](const char* name, const QString& text) {
    auto* edit = new QLineEdit(text, this);
    edit->setObjectName(name);
    edit->setMinimumWidth(360);
    return edit;
  };
  const auto with_browse = [&](QLineEdit* edit, const std::function<QString()>& choose) {
    auto* row = new QHBoxLayout;
    auto* browse = new QPushButton(tr("Browse…"), this);
    browse->setAutoDefault(false);
    row->addWidget(edit, 1);
    row->addWidget(browse);
    connect(browse, &QPushButton::clicked, this, [edit, choose] {
      if (const QString path = choose(); !path.isEmpty())
        edit->setText(QDir::toNativeSeparators(path));
    });
    return row;
  };
  title_ = line("report_title", part);
  company_ = line("report_company", settings.value("report/company").toString());
  logo_ = line("report_logo", settings.value("report/logo").toString());
  logo_->setPlaceholderText(tr("None"));
  page_ = line("report_page", settings.value("report/page").toString());
  page_->setPlaceholderText(tr("That of Arris"));
  page_->setToolTip(
      tr("An HTML page of your own with places as {{partitions}}, in which the report is set"));
  QString documents = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
  if (!QFileInfo(documents).isDir()) documents = QDir::homePath();
  const QString above = settings.value("folders/reports", documents).toString();
  folder_ = line("report_folder", QDir::toNativeSeparators(QDir(above).filePath(part + "_report")));
  paper_ = new QCheckBox(tr("&PDF beside the page"), this);
  paper_->setObjectName("report_paper");
  paper_->setChecked(settings.value("report/paper", true).toBool());
  form->addRow(tr("&Title"), title_);
  form->addRow(tr("&Company"), company_);
  form->addRow(tr("&Logo"), with_browse(logo_, [this] {
                 return QFileDialog::getOpenFileName(this, tr("Logo"), logo_->text(),
                                                     tr("Pictures (*.png *.jpg *.jpeg *.svg)"));
               }));
  form->addRow(tr("Pa&ge"), with_browse(page_, [this] {
                 return QFileDialog::getOpenFileName(this, tr("Page for reports"), page_->text(),
                                                     tr("HTML (*.html *.htm)"));
               }));
  form->addRow(tr("&Folder"), with_browse(folder_, [this] {
                 return QFileDialog::getExistingDirectory(this, tr("Folder for the report"),
                                                          folder_->text());
               }));
  form->addRow(QString(), paper_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
  write_ = buttons->addButton(tr("Write"), QDialogButtonBox::AcceptRole);
  write_->setDefault(true);
  form->addRow(buttons);
  connect(folder_, &QLineEdit::textChanged, this, &ReportDialog::update_buttons);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  update_buttons();
}

ReportRequest ReportDialog::request() const {
  ReportRequest request;
  const auto path = [](const QLineEdit* edit) {
    return QDir::fromNativeSeparators(edit->text().trimmed()).toStdString();
  };
  request.options.title = title_->text().trimmed().toStdString();
  request.options.company = company_->text().trimmed().toStdString();
  request.folder = path(folder_);
  request.logo = path(logo_);
  request.page = path(page_);
  return request;
}

bool ReportDialog::paper() const { return paper_->isChecked(); }

void ReportDialog::update_buttons() {
  const QFileInfo folder(QDir::fromNativeSeparators(folder_->text().trimmed()));
  const bool good = folder.isAbsolute() && (!folder.exists() || folder.isDir());
  write_->setEnabled(good);
  write_->setToolTip(good ? QString() : tr("Choose a folder, by its whole path"));
}

void ReportDialog::accept() {
  QSettings settings;
  settings.setValue("report/company", company_->text().trimmed());
  settings.setValue("report/logo", logo_->text().trimmed());
  settings.setValue("report/page", page_->text().trimmed());
  settings.setValue("report/paper", paper_->isChecked());
  settings.setValue(
      "folders/reports",
      QFileInfo(QDir::fromNativeSeparators(folder_->text().trimmed())).absolutePath());
  QDialog::accept();
}

}  // namespace arris::ui
