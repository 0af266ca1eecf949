#include "ui/window/report_presenter.h"

#include <algorithm>
#include <memory>
#include <utility>

#include <QAbstractTextDocumentLayout>
#include <QCoreApplication>
#include <QDesktopServices>
#include <QDir>
#include <QFileInfo>
#include <QImage>
#include <QMessageBox>
#include <QPageSize>
#include <QPainter>
#include <QPdfWriter>
#include <QPushButton>
#include <QRegularExpression>
#include <QTextDocument>
#include <QUrl>

#include "ui/panels/controls.h"
#include "ui/view/mesh_view.h"
#include "ui/window/elements_presenter.h"
#include "ui/window/field_presenter.h"
#include "ui/window/report_dialog.h"

namespace arris::ui {

namespace {

constexpr int picture_width = 1600;
constexpr double margin = 16.0;  // mm of a page
constexpr int dots_per_inch = 300;

/// The page as it is laid out on A4. Errors: cannot be written.
QString write_paper(const QString& page, const QString& path) {
  QFile file(page);
  if (!file.open(QIODevice::ReadOnly))
    return QObject::tr("%1 could not be read again: %2").arg(page, file.errorString());
  QString html = QString::fromUtf8(file.readAll());
  QFile out(path);
  if (!out.open(QIODevice::WriteOnly))
    return QObject::tr("%1 could not be written: %2").arg(path, out.errorString());
  QPdfWriter writer(&out);
  writer.setPageSize(QPageSize(QPageSize::A4));
  writer.setPageMargins(QMarginsF(margin, margin, margin, margin), QPageLayout::Millimeter);
  writer.setResolution(dots_per_inch);
  writer.setTitle(QFileInfo(page).absoluteDir().dirName());
  writer.setCreator("Arris");
  QTextDocument document;
  document.setDefaultFont(QFont("sans-serif", 9));
  document.setDocumentMargin(0.0);
  document.documentLayout()->setPaintDevice(&writer);
  static const QRegularExpression source("<img[^>]*src=\"([^\"]+)\"[^>]*>");
  for (auto found = source.globalMatch(QString(html)); found.hasNext();) {
    const QRegularExpressionMatch picture = found.next();
    const QString name = picture.captured(1);
    const QImage image(QFileInfo(page).absoluteDir().filePath(name));
    document.addResource(QTextDocument::ImageResource, QUrl(name), image);
    // As histograms are where Qt has no reader of SVG.
    if (image.isNull())
      html.replace(picture.captured(0), QObject::tr("(%1 could not be read)").arg(name));
  }
  document.setHtml(html);
  const QRectF paper = writer.pageLayout().paintRectPixels(dots_per_inch);
  const QFont number("sans-serif", 8);
  const double foot = 2.0 * QFontMetricsF(number, &writer).height();
  const QSizeF body(paper.width(), paper.height() - foot);
  document.setPageSize(body);
  QPainter painter(&writer);
  for (int k = 0; k < document.pageCount(); ++k) {
    if (k > 0) writer.newPage();
    painter.save();
    painter.translate(0.0, -k * body.height());
    QAbstractTextDocumentLayout::PaintContext context;
    context.clip = QRectF(0.0, k * body.height(), body.width(), body.height());
    context.palette.setColor(QPalette::Text, Qt::black);
    painter.setClipRect(context.clip);
    document.documentLayout()->draw(&painter, context);
    painter.restore();
    painter.setFont(number);
    painter.setPen(Qt::gray);
    painter.drawText(QRectF(0.0, body.height(), body.width(), foot),
                     Qt::AlignRight | Qt::AlignBottom,
                     QString("%1 / %2").arg(k + 1).arg(document.pageCount()));
  }
  painter.end();
  return {};
}

}  // namespace

ReportPresenter::ReportPresenter(Session* session, std::function<ViewKeepers()> keepers,
                                 std::function<void(bool)> show_partitions,
                                 NamedViewsPresenter* views, QWidget* window)
    : QObject(window),
      session_(session),
      keepers_(std::move(keepers)),
      show_partitions_(std::move(show_partitions)),
      views_(views),
      window_(window),
      work_(new LatestWork(this)) {}

void ReportPresenter::ask() {
  ReportDialog dialog(QFileInfo(session_->part_name()).completeBaseName(), window_);
  if (dialog.exec() != QDialog::Accepted) return;
  const ReportRequest request = dialog.request();
  const QString folder = QString::fromStdString(request.folder);
  write(request, dialog.paper(), [this, folder](const QString& error) {
    if (!error.isEmpty()) {
      QMessageBox::warning(window_, "Arris", error);
      return;
    }
    emit message(tr("Report written to %1").arg(folder));
    QMessageBox box(QMessageBox::Information, "Arris", tr("The report is written."),
                    QMessageBox::Close, window_);
    box.setInformativeText(QDir::toNativeSeparators(QDir(folder).filePath(report_name)));
    QPushButton* open = box.addButton(tr("&Open"), QMessageBox::AcceptRole);
    box.setDefaultButton(open);
    box.exec();
    if (box.clickedButton() == open)
      QDesktopServices::openUrl(QUrl::fromLocalFile(QDir(folder).filePath(report_name)));
  });
}

void ReportPresenter::cancel() {
  if (!writing()) return;
  work_->cancel();
  emit writing_changed(false);
}

QString ReportPresenter::draw_pictures(const QString& folder,
                                       std::vector<ReportPicture>& pictures) {
  const ViewKeepers keepers = keepers_();
  MeshView& view = *keepers.view;
  const std::string before = saved_view(keepers);
  QString error;
  QImage last;
  // That of the view, for what is fitted to it to fill the picture.
  const double proportion =
      std::clamp(static_cast<double>(view.width()) / std::max(view.height(), 1), 1.2, 1.8);
  const auto draw = [&](const QString& name, const QString& caption) {
    if (!error.isEmpty()) return;
    PictureOptions options;
    options.size = {picture_width, static_cast<int>(picture_width / proportion)};
    const QImage image = view.picture(options);
    if (image == last) pictures.pop_back();  // looked at like that anyway
    last = image;
    const QString path = QDir(folder).filePath(name);
    if (image.isNull())
      error = tr("The picture could not be drawn: the graphics driver refused it.");
    else if (!image.save(path))
      error = tr("%1 could not be written.").arg(path);
    else
      pictures.push_back({name.toStdString(), caption.toStdString(), proportion});
  };
  const Document& document = session_->current().document;
  for (std::size_t k = 0; k < views_->views().size(); ++k) {
    views_->show(k);
    keepers.fields->wait_until_there();
    draw(QString("view_%1.png").arg(k + 1), views_->views()[k].name);
  }
  if (!views_->views().empty()) {
    restore_view(keepers, before);
    return error;
  }
  draw("view.png", tr("As it was looked at"));
  view.look_from(MeshView::StandardView::isometric);
  const bool divided = !document.partitions.partitions.empty();
  if (divided || !document.lines.lines.empty()) {
    show_partitions_(true);
    const QString what = divided ? tr("Partitions and sharp lines") : tr("Sharp lines");
    draw("partitions.png", what);
    const Point towards = view.towards_viewer();
    view.look_against({-towards.x(), -towards.y(), towards.z()});
    draw("partitions_behind.png", what + tr(", from behind"));
    view.look_against(towards);
  }
  keepers.fields->set_field(Field::kabs);
  show_partitions_(false);
  draw("kabs.png", tr("Absolute curvature Kabs"));
  restore_view(keepers, before);
  return error;
}

void ReportPresenter::write(ReportRequest request, bool paper,
                            std::function<void(const QString&)> then) {
  const QString folder = QString::fromStdString(request.folder);
  if (!QDir().mkpath(folder)) {
    then(tr("The folder %1 cannot be made.").arg(folder));
    return;
  }
  if (const QString error = draw_pictures(folder, request.options.pictures); !error.isEmpty()) {
    then(error);
    return;
  }
  request.options.date = today();
  request.options.program = "Arris " + QCoreApplication::applicationVersion().toStdString();
  if (request.options.title.empty())
    request.options.title = QFileInfo(session_->part_name()).completeBaseName().toStdString();
  emit writing_changed(true);
  const auto history = std::make_shared<const History>(session_->history().copy_to_save());
  work_->start(
      [history, request, folder, paper](const Context& context) {
        const Result<void> written = write_report(*history, request, context);
        if (!written) return QString::fromStdString(written.error().message);
        if (!paper) return QString();
        return write_paper(QDir(folder).filePath(report_name), QDir(folder).filePath("report.pdf"));
      },
      [this, then = std::move(then)](const QString& error) {
        emit writing_changed(false);
        then(error);
      },
      [this](double fraction, std::string_view what) {
        emit progress(fraction, shown_text(what));
      });
}

}  // namespace arris::ui
