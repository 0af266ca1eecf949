#include "ui/panels/controls.h"

#include <algorithm>
#include <cmath>

#include <QHelpEvent>
#include <QKeyEvent>
#include <QLocale>
#include <QPainter>
#include <QRegularExpression>
#include <QStyle>
#include <QStyleOptionComboBox>
#include <QStyleOptionSpinBox>
#include <QStylePainter>
#include <QToolTip>
#include <QWheelEvent>

#include "core/base/words.h"

namespace arris::ui {

namespace {

QString superscript(int exponent) {
  static const QString digits = QStringLiteral("⁰¹²³⁴⁵⁶⁷⁸⁹");
  QString text = exponent < 0 ? QStringLiteral("⁻") : QString();
  for (const QChar digit : QString::number(std::abs(exponent))) text += digits[digit.digitValue()];
  return text;
}

QString without_zeros(QString text) {
  if (!text.contains(QLatin1Char('.'))) return text;
  while (text.endsWith(QLatin1Char('0'))) text.chop(1);
  if (text.endsWith(QLatin1Char('.'))) text.chop(1);
  return text;
}

QString plain_text(double value, int digits) {
  if (value == 0.0) return QStringLiteral("0");
  const int whole_digits = static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
  return without_zeros(QString::number(value, 'f', std::clamp(digits - whole_digits, 0, 20)));
}

/// A comma from a keypad of another language is meant as the decimal point; it becomes one before
/// the user's eyes.
QKeyEvent with_point(const QKeyEvent& event) {
  const bool comma = event.text() == QLatin1String(",");
  return QKeyEvent(event.type(), comma ? int(Qt::Key_Period) : event.key(), event.modifiers(),
                   comma ? QStringLiteral(".") : event.text(), event.isAutoRepeat(),
                   static_cast<quint16>(event.count()));
}

}  // namespace

QString shown_number(double value, int digits) {
  if (std::isnan(value)) return QStringLiteral("–");
  if (std::isinf(value)) return value > 0 ? QStringLiteral("∞") : QStringLiteral("-∞");
  const double rounded = round_significant(value, digits);
  if (rounded == 0.0) return QStringLiteral("0");
  const double size = std::abs(rounded);
  if (size >= 0.001 && size < 1e6) return plain_text(rounded, digits);
  const QString scientific = QString::number(rounded, 'e', digits - 1);
  const qsizetype e = scientific.indexOf(QLatin1Char('e'));
  const QString mantissa = without_zeros(scientific.left(e));
  QString power = QStringLiteral("10") + superscript(scientific.mid(e + 1).toInt());
  if (mantissa == QLatin1String("1")) return power;
  if (mantissa == QLatin1String("-1")) return QLatin1Char('-') + power;
  return mantissa + QStringLiteral("×") + power;
}

QString edit_text(double value, int digits) {
  const double size = std::abs(value);
  if (size == 0.0 || (size >= 1e-6 && size < 1e9)) return plain_text(value, digits);
  return QString::number(value, 'g', digits);
}

QString percent_text(double share) { return shown_number(100.0 * share, 2) + QStringLiteral(" %"); }

QString shown_text(std::string_view text) {
  return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
}

QString count_text(qint64 count) { return QString::fromStdString(grouped(count)); }

QString shown_count(std::size_t count, const QString& one, const QString& many) {
  return count_text(static_cast<qint64>(count)) + " " + (count == 1 ? one : many);
}

std::optional<double> typed_number(const QString& text) {
  static const QRegularExpression form(
      QStringLiteral(R"(^[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$)"));
  QString plain = text.trimmed();
  plain.replace(QChar(0x2212), QLatin1Char('-'));
  if (!form.match(plain).hasMatch()) return std::nullopt;
  bool fine = false;
  const double value = QLocale::c().toDouble(plain, &fine);
  if (!fine || !std::isfinite(value)) return std::nullopt;
  return value;
}

double round_significant(double value, int digits) {
  if (value == 0.0 || !std::isfinite(value)) return value;
  // Through the decimal text, so that the result is the double nearest to what is shown.
  return QString::number(value, 'e', digits - 1).toDouble();
}

QColor mix(const QColor& first, const QColor& second, double share) {
  const auto part = [share](int a, int b) {
    return static_cast<int>(std::lround(a + (b - a) * std::clamp(share, 0.0, 1.0)));
  };
  return QColor(part(first.red(), second.red()), part(first.green(), second.green()),
                part(first.blue(), second.blue()));
}

QColor muted_text(const QPalette& palette) {
  return mix(palette.color(QPalette::WindowText), palette.color(QPalette::Window), 0.32);
}

QColor card_ground(const QPalette& palette) {
  const QColor window = palette.color(QPalette::Window), base = palette.color(QPalette::Base);
  if (base.lightness() > window.lightness()) return base;
  return mix(window, palette.color(QPalette::WindowText), 0.06);
}

QColor mistake_colour(const QPalette& palette) {
  return palette.color(QPalette::Base).lightness() < 128 ? QColor(255, 110, 100)
                                                         : QColor(190, 20, 20);
}

MutedLabel::MutedLabel(const QString& text, QWidget* parent) : QLabel(text, parent) {}

void MutedLabel::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setPen(muted_text(palette()));
  const int flags = static_cast<int>(alignment()) | (wordWrap() ? Qt::TextWordWrap : 0);
  painter.drawText(contentsRect(), flags, text());
}

ElidedLabel::ElidedLabel(QWidget* parent) : MutedLabel({}, parent) {
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
}

void ElidedLabel::set_whole(const QString& text) {
  whole_ = text;
  setToolTip(text);
  setAccessibleName(text);
  elide();
}

void ElidedLabel::set_prominent() {
  prominent_ = true;
  QFont bold = font();
  bold.setBold(true);
  setFont(bold);
}

void ElidedLabel::paintEvent(QPaintEvent* event) {
  if (prominent_)
    QLabel::paintEvent(event);
  else
    MutedLabel::paintEvent(event);
}

void ElidedLabel::resizeEvent(QResizeEvent* event) {
  MutedLabel::resizeEvent(event);
  elide();
}

void ElidedLabel::elide() { setText(fontMetrics().elidedText(whole_, Qt::ElideRight, width())); }

NumberEdit::NumberEdit(QWidget* parent) : QLineEdit(parent) {
  setLocale(QLocale::c());
  setMinimumWidth(fontMetrics().horizontalAdvance(QStringLiteral("0.0000")));
  connect(this, &QLineEdit::textEdited, this, [this] { set_mistake({}); });
}

void NumberEdit::set_help(const QString& tooltip) {
  help_ = tooltip;
  if (!has_mistake()) setToolTip(help_);
}

void NumberEdit::set_mistake(const QString& mistake) {
  mistake_ = mistake;
  setToolTip(has_mistake() ? mistake_ : help_);
  update();
}

void NumberEdit::keyPressEvent(QKeyEvent* event) {
  QKeyEvent meant = with_point(*event);
  QLineEdit::keyPressEvent(&meant);
  event->setAccepted(meant.isAccepted());
}

void NumberEdit::paintEvent(QPaintEvent* event) {
  QLineEdit::paintEvent(event);
  if (!has_mistake()) return;
  QPainter painter(this);
  painter.fillRect(QRect(2, height() - 4, width() - 4, 2), mistake_colour(palette()));
}

NumberBox::NumberBox(QWidget* parent) : QDoubleSpinBox(parent) {
  setLocale(QLocale::c());
  setFocusPolicy(Qt::StrongFocus);
  setKeyboardTracking(false);
  setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  connect(lineEdit(), &QLineEdit::textEdited, this, &NumberBox::edited);
}

void NumberBox::set_unlimited(bool unlimited) {
  unlimited_ = unlimited;
  setValue(value());
}

bool NumberBox::means_unlimited(const QString& plain) const {
  return unlimited_ && (plain.isEmpty() || plain == QStringLiteral("∞"));
}

QString NumberBox::textFromValue(double value) const {
  if (unlimited_ && value >= maximum()) return QStringLiteral("∞");
  const QString text = without_zeros(QString::number(value, 'f', decimals()));
  return text == QLatin1String("-0") ? QStringLiteral("0") : text;
}

QString NumberBox::bare(const QString& text) const {
  QString plain = text;
  if (!suffix().isEmpty() && plain.endsWith(suffix())) plain.chop(suffix().size());
  return plain.trimmed();
}

double NumberBox::valueFromText(const QString& text) const {
  if (means_unlimited(bare(text))) return maximum();
  return typed_number(bare(text)).value_or(value());
}

QValidator::State NumberBox::validate(QString& text, int&) const {
  static const QRegularExpression beginning(
      QStringLiteral(R"(^([+-]?)\d*(\.(\d*))?([eE][+-]?\d*)?$)"));
  const QString plain = bare(text);
  if (means_unlimited(plain)) return QValidator::Acceptable;
  const auto match = beginning.match(plain);
  if (!match.hasMatch()) return QValidator::Invalid;
  if (match.captured(1) == QLatin1String("-") && minimum() >= 0.0) return QValidator::Invalid;
  const bool exponent = !match.captured(4).isEmpty();
  if (!exponent && match.captured(3).size() > decimals()) return QValidator::Invalid;
  const auto value = typed_number(plain);
  if (!value) return QValidator::Intermediate;
  if (*value >= minimum() && *value <= maximum()) return QValidator::Acceptable;
  // More digits only lead further away from a range that was overshot; an exponent may lead back.
  const bool overshot = (*value > maximum() && *value >= 0.0) || (*value < minimum() && *value < 0);
  return overshot && !exponent ? QValidator::Invalid : QValidator::Intermediate;
}

QSize NumberBox::sizeHint() const {
  const QString widest = QStringLiteral("0000.00") + suffix();
  QStyleOptionSpinBox option;
  initStyleOption(&option);
  const QSize text(fontMetrics().horizontalAdvance(widest) + 4,
                   QDoubleSpinBox::sizeHint().height());
  QSize size = style()->sizeFromContents(QStyle::CT_SpinBox, &option, text, this);
  size.setHeight(QDoubleSpinBox::sizeHint().height());
  return size;
}

QSize NumberBox::minimumSizeHint() const {
  QSize size = sizeHint();
  size.rwidth() -= fontMetrics().horizontalAdvance(QStringLiteral("000"));
  return size;
}

void NumberBox::keyPressEvent(QKeyEvent* event) {
  QKeyEvent meant = with_point(*event);
  QDoubleSpinBox::keyPressEvent(&meant);
  event->setAccepted(meant.isAccepted());
}

void NumberBox::wheelEvent(QWheelEvent* event) {
  if (hasFocus()) {
    QDoubleSpinBox::wheelEvent(event);
  } else {
    event->ignore();
  }
}

void NumberBox::stepBy(int steps) {
  QDoubleSpinBox::stepBy(steps);
  emit edited();
}

WholeBox::WholeBox(QWidget* parent) : QSpinBox(parent) {
  setLocale(QLocale::c());
  setFocusPolicy(Qt::StrongFocus);
  setKeyboardTracking(false);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  connect(lineEdit(), &QLineEdit::textEdited, this, &WholeBox::edited);
}

void WholeBox::wheelEvent(QWheelEvent* event) {
  if (hasFocus()) {
    QSpinBox::wheelEvent(event);
  } else {
    event->ignore();
  }
}

void WholeBox::stepBy(int steps) {
  QSpinBox::stepBy(steps);
  emit edited();
}

QuietCombo::QuietCombo(QWidget* parent) : QComboBox(parent) {
  setFocusPolicy(Qt::StrongFocus);
  setSizeAdjustPolicy(QComboBox::AdjustToContents);
}

QSize QuietCombo::minimumSizeHint() const {
  return QSize(std::min(90, sizeHint().width()), QComboBox::minimumSizeHint().height());
}

QString QuietCombo::shown_text() const {
  QStyleOptionComboBox option;
  initStyleOption(&option);
  const QRect room =
      style()->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, this);
  const int icon = option.currentIcon.isNull() ? 0 : option.iconSize.width() + 6;
  return fontMetrics().elidedText(option.currentText, Qt::ElideRight, room.width() - icon);
}

bool QuietCombo::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip && shown_text() != currentText()) {
    QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(),
                       currentText() + QLatin1Char('\n') + toolTip(), this);
    return true;
  }
  return QComboBox::event(event);
}

void QuietCombo::paintEvent(QPaintEvent*) {
  QStylePainter painter(this);
  QStyleOptionComboBox option;
  initStyleOption(&option);
  painter.drawComplexControl(QStyle::CC_ComboBox, option);
  option.currentText = shown_text();
  painter.drawControl(QStyle::CE_ComboBoxLabel, option);
}

void QuietCombo::wheelEvent(QWheelEvent* event) {
  if (hasFocus()) {
    QComboBox::wheelEvent(event);
  } else {
    event->ignore();
  }
}

}  // namespace arris::ui
