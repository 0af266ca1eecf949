#include "ui/window/status_presenter.h"

#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QStatusBar>
#include <QTimer>

#include "ui/panels/controls.h"
#include "ui/window/elements_presenter.h"
#include "ui/window/field_presenter.h"
#include "ui/window/hover_text.h"
#include "ui/window/report_presenter.h"

namespace arris::ui {

namespace {

constexpr int progress_delay = 300;  // ms: shorter work shows no progress

}  // namespace

StatusPresenter::StatusPresenter(Session* session, FieldPresenter* fields,
                                 ElementsPresenter* elements, ReportPresenter* reports,
                                 QStatusBar* bar)
    : QObject(bar),
      session_(session),
      fields_(fields),
      elements_(elements),
      reports_(reports),
      bar_(bar),
      hover_(new QLabel(bar)),
      counts_(new QLabel(bar)),
      progress_(new QProgressBar(bar)),
      cancel_(new QPushButton(tr("Cancel"), bar)),
      delay_(new QTimer(this)) {
  // Not the bar that runs to and fro: where the processor draws, its every step costs the work
  // that it stands for.
  progress_->setRange(0, 100);
  progress_->setFixedWidth(240);
  progress_->hide();
  cancel_->setToolTip(tr("Stops the running work; nothing of it is kept."));
  cancel_->hide();
  bar_->addWidget(hover_, 1);
  bar_->addPermanentWidget(progress_);
  bar_->addPermanentWidget(cancel_);
  bar_->addPermanentWidget(counts_);
  connect(cancel_, &QPushButton::clicked, this, [this] {
    if (session_->busy())
      session_->cancel();
    else
      reports_->cancel();
  });
  delay_->setSingleShot(true);
  connect(delay_, &QTimer::timeout, this, [this] {
    progress_->show();
    cancel_->setVisible(can_be_cancelled());
  });
  connect(session_, &Session::changed, this, &StatusPresenter::refresh_counts);
  connect(elements_, &ElementsPresenter::visibility_changed, this,
          &StatusPresenter::refresh_counts);
  connect(session_, &Session::busy_changed, this, &StatusPresenter::show_working);
  connect(fields_, &FieldPresenter::working_changed, this, &StatusPresenter::show_working);
  connect(reports_, &ReportPresenter::writing_changed, this, &StatusPresenter::show_working);
  connect(session_, &Session::progress, this, &StatusPresenter::show_progress);
  connect(fields_, &FieldPresenter::progress, this, &StatusPresenter::show_progress);
  connect(reports_, &ReportPresenter::progress, this, &StatusPresenter::show_progress);
  refresh_counts();
}

void StatusPresenter::tell(const QString& text, int milliseconds) {
  bar_->showMessage(text, milliseconds);
}

void StatusPresenter::show_hover(const Document& document, const std::optional<Pick>& pick) {
  hover_->setText(pick ? hover_text(document, *pick) : QString());
}

/// A field stops where another one is chosen.
bool StatusPresenter::can_be_cancelled() const { return session_->busy() || reports_->writing(); }

void StatusPresenter::show_progress(double fraction, const QString& what) {
  progress_->setValue(static_cast<int>(100.0 * fraction));
  progress_->setFormat(what + " %p %");
}

void StatusPresenter::show_working() {
  if (!can_be_cancelled() && !fields_->working()) {
    delay_->stop();
    progress_->hide();
    cancel_->hide();
  } else if (progress_->isHidden() && !delay_->isActive()) {
    progress_->setValue(0);
    progress_->setFormat(QString());
    delay_->start(progress_delay);
  } else if (!progress_->isHidden()) {
    cancel_->setVisible(can_be_cancelled());
  }
}

void StatusPresenter::refresh_counts() {
  const Document& document = session_->shown().document;
  if (document.empty()) {
    counts_->setText({});
    return;
  }
  QString text = shown_count(document.mesh->face_count(), tr("face"), tr("faces"));
  if (document.step("find_sharp_lines"))
    text += "  ·  " + shown_count(document.lines.lines.size(), tr("line"), tr("lines"));
  if (document.step("find_partitions"))
    text += "  ·  " +
            shown_count(document.partitions.partitions.size(), tr("partition"), tr("partitions")) +
            (document.step("find_partitions")->out_of_date ? tr(" (out of date)") : QString());
  if (elements_->hides_any()) text += "  ·  " + tr("some hidden (Shift+H shows all)");
  counts_->setText(text);
}

}  // namespace arris::ui
