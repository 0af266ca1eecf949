#include "ui/panels/side_by_side.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPixmap>
#include <QSplitter>
#include <QToolButton>
#include <QVBoxLayout>

#include "ui/panels/controls.h"

namespace arris::ui {

namespace {

QToolButton* small_button(const QString& text, const QString& tooltip, QWidget* parent) {
  auto* button = new QToolButton(parent);
  button->setText(text);
  button->setToolTip(tooltip);
  button->setAutoRaise(true);
  return button;
}

}  // namespace

SideBySide::SideBySide(QWidget* view, const QColor& marked, QWidget* parent) : QWidget(parent) {
  splitter_ = new QSplitter(Qt::Horizontal, this);
  splitter_->setChildrenCollapsible(false);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(0);
  all->addWidget(splitter_, 1);

  QPixmap chip(22, 10);
  chip.fill(marked);
  for (Header& header : headers_) {
    header = make_header();
    header.chip->setPixmap(chip);
  }
  auto* left = new QHBoxLayout(headers_[0].row);
  versions_ = new QuietCombo(headers_[0].row);
  versions_->setToolTip(tr("The version shown on this side: a named one, or a row of the history"));
  versions_->setAccessibleName(tr("Version to compare with"));
  take_line_ = small_button(
      tr("Take line over"),
      tr("Draw the selected line of this version in the part as it is now, too"), headers_[0].row);
  travel_ = small_button(tr("Swap"), tr("Go to this version, and show the one you leave here"),
                         headers_[0].row);
  QToolButton* close =
      small_button(tr("Close"), tr("The part alone again (Ctrl+K)"), headers_[0].row);
  left->addWidget(versions_, 1);
  for (QToolButton* button : {take_line_, travel_, close}) left->addWidget(button);
  auto* right = new QHBoxLayout(headers_[1].row);
  now_ = new ElidedLabel(headers_[1].row);
  now_->set_prominent();
  auto* marks = new QCheckBox(tr("Marks"), headers_[1].row);
  marks->setChecked(true);
  marks->setToolTip(
      tr("Underlay what only one of the two versions has: stretches of lines and borders farther "
         "than 1.5 mean edges from any of the other version"));
  right->addWidget(now_, 1);
  right->addWidget(marks);
  for (QHBoxLayout* row : {left, right}) {
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(4);
  }

  constexpr int least_width = 150;  // whatever the headers want: both views are alike
  other_side_ = new QWidget(splitter_);
  other_side_->setMinimumWidth(least_width);
  other_column_ = new QVBoxLayout(other_side_);
  auto* side = new QWidget(splitter_);
  side->setMinimumWidth(least_width);
  auto* column = new QVBoxLayout(side);
  for (QVBoxLayout* each : {other_column_, column}) {
    each->setContentsMargins(0, 0, 0, 0);
    each->setSpacing(0);
  }
  other_column_->addWidget(headers_[0].widget);
  column->addWidget(headers_[1].widget);
  column->addWidget(view, 1);
  set_other(nullptr);

  connect(versions_, &QComboBox::activated, this,
          [this](int index) { emit version_wanted(versions_->itemData(index).toUInt()); });
  connect(take_line_, &QToolButton::clicked, this, &SideBySide::line_wanted);
  connect(travel_, &QToolButton::clicked, this, &SideBySide::travel_wanted);
  connect(close, &QToolButton::clicked, this, &SideBySide::closed);
  connect(marks, &QCheckBox::toggled, this, &SideBySide::marks_wanted);
}

SideBySide::Header SideBySide::make_header() {
  Header header;
  header.widget = new QWidget(this);
  auto* column = new QVBoxLayout(header.widget);
  column->setContentsMargins(6, 4, 6, 4);
  column->setSpacing(2);
  header.row = new QWidget(header.widget);
  // Both sides are as high, so that both views are.
  header.row->setFixedHeight(QComboBox().sizeHint().height());
  column->addWidget(header.row);
  header.holds = new ElidedLabel(header.widget);
  column->addWidget(header.holds);
  auto* marks = new QHBoxLayout;
  marks->setSpacing(6);
  header.chip = new QLabel(header.widget);
  header.only = new ElidedLabel(header.widget);
  marks->addWidget(header.chip);
  marks->addWidget(header.only, 1);
  column->addLayout(marks);
  return header;
}

void SideBySide::set_strip(QWidget* strip) {
  static_cast<QVBoxLayout*>(layout())->insertWidget(0, strip);
}

void SideBySide::set_other(QWidget* other) {
  if (other_) {
    other_column_->removeWidget(other_);
    other_->setParent(nullptr);
  }
  other_ = other;
  if (other_) {
    other_column_->addWidget(other_, 1);
    other_->show();
  }
  other_side_->setVisible(other_ != nullptr);
  for (const Header& header : headers_) header.widget->setVisible(other_ != nullptr);
  if (other_) splitter_->setSizes({1000, 1000});
}

void SideBySide::set_versions(const std::vector<Version>& versions, std::uint32_t chosen) {
  versions_->clear();
  for (const Version& version : versions) versions_->addItem(version.text, version.sequence);
  versions_->setCurrentIndex(versions_->findData(chosen));
}

void SideBySide::set_now(const QString& text) { now_->set_whole(text); }

void SideBySide::set_figures(int side, const QString& holds, const QString& only) {
  const Header& header = headers_[static_cast<std::size_t>(side)];
  header.holds->set_whole(holds);
  header.only->set_whole(only);
}

void SideBySide::set_line_takeable(bool takeable) { take_line_->setVisible(takeable); }

void SideBySide::set_travel_possible(bool possible) { travel_->setEnabled(possible); }

}  // namespace arris::ui
