#include "ui/panels/explanation_panel.h"

#include <QEvent>
#include <QTextBrowser>
#include <QVBoxLayout>

#include "ui/panels/controls.h"
#include "ui/panels/profile_chart.h"

namespace arris::ui {

ExplanationPanel::ExplanationPanel(QWidget* parent)
    : QWidget(parent), browser_(new QTextBrowser(this)), chart_(new ProfileChart(this)) {
  browser_->setOpenLinks(false);
  browser_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  browser_->setAccessibleName(tr("Explanation"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(6, 6, 6, 6);
  column->addWidget(browser_, 1);
  column->addWidget(chart_);
  chart_->hide();
}

void ExplanationPanel::set_sections(std::vector<ExplanationSection> sections) {
  sections_ = std::move(sections);
  note_.clear();
  refresh();
}

void ExplanationPanel::set_note(const QString& note) {
  sections_.clear();
  note_ = note;
  refresh();
}

QString ExplanationPanel::text() const { return browser_->toPlainText(); }

void ExplanationPanel::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) refresh();
  QWidget::changeEvent(event);
}

void ExplanationPanel::refresh() {
  const QString muted = muted_text(palette()).name();
  const QString failed = mistake_colour(palette()).name();
  QString html;
  if (!note_.isEmpty())
    html = QStringLiteral("<p style='color:%1'>%2</p>").arg(muted, note_.toHtmlEscaped());
  for (const ExplanationSection& section : sections_) {
    html += QStringLiteral(
                "<p style='margin-top:8px; margin-bottom:2px; color:%1'>%2</p>"
                "<p style='margin-top:0px; margin-bottom:6px'><b>%3</b></p>")
                .arg(muted, section.title.toHtmlEscaped(), section.headline.toHtmlEscaped());
    if (section.rows.empty()) continue;
    html += QStringLiteral(
                "<table width='100%' cellspacing='0' cellpadding='2'>"
                "<tr style='color:%1'><td width='36%'>%2</td><td "
                "align='right'>%3</td><td width='22%' align='right'>%4</td>"
                "<td width='21%' align='right'>%5</td></tr>")
                .arg(muted, tr("Test"), tr("Value"), tr("Threshold"), tr("Result"));
    for (const ExplanationRow& row : section.rows) {
      const QString result = row.passed ? tr("✓ passed") : tr("✗ failed");
      html +=
          QStringLiteral(
              "<tr><td>%1</td><td align='right'>%2</td><td align='right'>%3</td>"
              "<td align='right'><span style='white-space:nowrap%4'>%5</span></td></tr>"
              "<tr><td colspan='4' style='color:%6; padding-bottom:6px'>%7</td></tr>")
              .arg(row.name.toHtmlEscaped(), row.value.toHtmlEscaped(),
                   row.threshold.toHtmlEscaped(),
                   row.passed ? QString() : QStringLiteral("; font-weight:bold; color:") + failed,
                   result, muted, row.sentence.toHtmlEscaped());
    }
    html += QStringLiteral("</table>");
  }
  browser_->setHtml(html);
  std::optional<JumpProfile> profile;
  for (const ExplanationSection& section : sections_)
    if (section.profile) profile = section.profile;
  chart_->setVisible(profile.has_value());
  chart_->set_profile(std::move(profile));
}

}  // namespace arris::ui
