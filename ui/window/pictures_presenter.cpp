#include "ui/window/pictures_presenter.h"

#include <utility>

#include <QApplication>
#include <QClipboard>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QMessageBox>
#include <QSettings>

#include "ui/window/actions.h"
#include "ui/window/comparison_presenter.h"
#include "ui/window/field_presenter.h"
#include "ui/window/file_chooser.h"
#include "ui/window/named_views_presenter.h"
#include "ui/window/picture_dialog.h"

namespace arris::ui {

namespace {

/// A line for each step: "Find sharp lines, 27° (11 lines, 886 mm)".
QString thresholds_of(const Document& document) {
  QStringList steps;
  for (std::size_t k = 0; k < chain_steps.size(); ++k) {
    const std::optional<Step>& step = document.steps[k];
    if (!step || step->out_of_date) continue;
    const std::string name(chain_steps[k].name);
    steps << QString::fromStdString(describe({name, step->parameters}) + " (" +
                                    find_operation(name)->outcome(document) + ")");
  }
  return steps.join('\n');
}

}  // namespace

PicturesPresenter::PicturesPresenter(Session* session, std::function<ViewKeepers()> keepers,
                                     ComparisonPresenter* comparison, NamedViewsPresenter* views,
                                     QWidget* shown, QWidget* window)
    : QObject(window),
      session_(session),
      keepers_(std::move(keepers)),
      comparison_(comparison),
      views_(views),
      shown_(shown),
      window_(window) {}

void PicturesPresenter::add_actions(QMenu* menu) {
  save_ = action(menu, tr("Save &picture…"), QKeySequence("Ctrl+P"),
                 tr("Save the view at a size in pixels, with its scalar bar"));
  save_->setObjectName("save_picture");
  connect(save_, &QAction::triggered, this, &PicturesPresenter::choose);
  copy_ = action(menu, tr("&Copy picture"), QKeySequence("Ctrl+Shift+C"),
                 tr("Copy the view to the clipboard"));
  connect(copy_, &QAction::triggered, this, [this] {
    PictureOptions options = options_;
    options.size = shown_->size() * shown_->devicePixelRatioF();
    options.dots_per_inch = options.height = 0.0;  // as on the screen
    QApplication::clipboard()->setImage(picture(options));
    emit message(tr("The picture is on the clipboard."), 4000);
  });
}

bool PicturesPresenter::save(const QString& path, const PictureOptions& options, QString* error) {
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

QImage PicturesPresenter::picture(const PictureOptions& options) {
  if (!comparison_->active()) return keepers_().view->picture(options);
  PictureOptions both = options;
  both.caption.clear();  // each side has a heading of its own
  return comparison_->picture(both);
}

void PicturesPresenter::choose() {
  const Document& document = session_->current().document;
  const LengthUnit unit = length_unit_of(document);
  PictureDialog dialog(
      options_,
      {keepers_().view->extent_seen(), shown_->size(), !views_->views().empty(),
       info_of(unit).millimetres, QFileInfo(session_->part_name()).completeBaseName(),
       thresholds_of(document)},
      window_);
  if (dialog.exec() != QDialog::Accepted) return;
  options_ = dialog.options();
  if (dialog.each_view()) {
    choose_each();
    return;
  }
  const QString name = QFileInfo(session_->part_name()).completeBaseName() + ".png";
  const QFileInfo proposed(QDir(QSettings().value("folders/pictures").toString()), name);
  const QString path = choose_path(window_, tr("Save picture"), proposed, "pictures",
                                   tr("PNG (*.png);;JPEG (*.jpg)"));
  if (path.isEmpty()) return;
  QString error;
  if (save(path, options_, &error))
    emit message(tr("Saved %1").arg(path), 5000);
  else
    QMessageBox::warning(window_, "Arris", error);
}

void PicturesPresenter::choose_each() {
  QSettings settings;
  const QString folder = QFileDialog::getExistingDirectory(
      window_, tr("Folder for the pictures"), settings.value("folders/pictures").toString());
  if (folder.isEmpty()) return;
  settings.setValue("folders/pictures", folder);
  const QString before = QFileInfo(session_->part_name()).completeBaseName() + "_";
  QStringList names, there;
  for (const NamedViewsPresenter::NamedView& view : views_->views()) {
    const QString name = before + as_file_name(view.name);
    QString unique = name + ".png";
    for (int k = 2; names.contains(unique, Qt::CaseInsensitive); ++k)
      unique = QString("%1_%2.png").arg(name).arg(k);
    names << unique;
    if (QFileInfo::exists(QDir(folder).filePath(names.back()))) there << names.back();
  }
  if (!there.isEmpty() && !may_replace(window_, there, folder)) return;
  const QString error = save_each(folder, names);
  if (error.isEmpty())
    emit message(tr("%1 saved to %2").arg(names.join(", "), folder), 8000);
  else
    QMessageBox::warning(window_, "Arris", error);
}

QString PicturesPresenter::save_each(const QString& folder, const QStringList& names) {
  const std::string before = saved_view(keepers_());
  QString error;
  for (qsizetype k = 0; k < names.size() && error.isEmpty(); ++k) {
    views_->show(static_cast<std::size_t>(k));
    keepers_().fields->wait_until_there();
    save(QDir(folder).filePath(names[k]), options_, &error);
  }
  restore_view(keepers_(), before);
  return error;
}

}  // namespace arris::ui
