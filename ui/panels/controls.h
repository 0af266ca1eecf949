#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include <QColor>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPalette>
#include <QSpinBox>
#include <QString>

namespace arris::ui {

/// At most `digits` significant digits with a decimal point and without group separators: "0.0125",
/// "2.5×10⁻⁵". A dash for NaN.
QString shown_number(double value, int digits = 4);
/// The same for an editor, in characters that a keyboard has: "0.00025", "2.5e-7".
QString edit_text(double value, int digits = 6);
/// Share of a whole (0 to 1) as a percentage: "2.3 %".
QString percent_text(double share);
/// What the core calls something, for reading.
QString shown_text(std::string_view text);
/// A count for reading: "20,000".
QString count_text(qint64 count);
/// "1 face", "20,000 faces".
QString shown_count(std::size_t count, const QString& one, const QString& many);
/// Reads "12.5", "-1e-3". Nothing for a comma (it is a group separator to one reader and a decimal
/// point to the other), for trailing letters, NaN or infinity.
std::optional<double> typed_number(const QString& text);
/// `value` rounded to `digits` significant digits, as shown_number() shows it.
double round_significant(double value, int digits = 4);

/// `share` = 0: `first`, 1: `second`.
QColor mix(const QColor& first, const QColor& second, double share);
/// Colour of secondary text and marks on the window's ground.
QColor muted_text(const QPalette& palette);
/// Ground of a card on the window, against which the palette's editors stand out.
QColor card_ground(const QPalette& palette);
/// Colour of a mistake in an editor, legible on the palette's base.
QColor mistake_colour(const QPalette& palette);

/// Label for secondary text; follows the palette.
class MutedLabel : public QLabel {
  Q_OBJECT
 public:
  explicit MutedLabel(const QString& text = {}, QWidget* parent = nullptr);

 protected:
  void paintEvent(QPaintEvent* event) override;
};

/// Secondary text on one line, cut off with an ellipsis where there is no room; whole in the
/// tooltip.
class ElidedLabel : public MutedLabel {
  Q_OBJECT
 public:
  explicit ElidedLabel(QWidget* parent = nullptr);
  void set_whole(const QString& text);
  void set_prominent();  ///< Bold, in the colour of text that is not secondary.

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void elide();
  QString whole_;
  bool prominent_ = false;
};

/// Line that holds a number. Text that is none, or that the owner marks as a mistake, is underlined
/// in red and says why in the tooltip.
class NumberEdit : public QLineEdit {
  Q_OBJECT
 public:
  explicit NumberEdit(QWidget* parent = nullptr);

  void set_help(const QString& tooltip);     ///< Tooltip where there is no mistake.
  void set_mistake(const QString& mistake);  ///< Empty: none.
  bool has_mistake() const { return !mistake_.isEmpty(); }

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  QString help_, mistake_;
};

/// Spin box for real numbers: decimal point whatever the locale, no group separators, no trailing
/// zeros, and the wheel turns it only while it has the focus.
class NumberBox : public QDoubleSpinBox {
  Q_OBJECT
 public:
  explicit NumberBox(QWidget* parent = nullptr);

  /// The largest value stands for "no limit": it is shown as ∞, and an empty box means it.
  void set_unlimited(bool unlimited);
  bool is_unlimited() const { return unlimited_ && value() >= maximum(); }

  QString textFromValue(double value) const override;
  double valueFromText(const QString& text) const override;
  QValidator::State validate(QString& text, int& cursor) const override;
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;
  void stepBy(int steps) override;

 signals:
  void edited();  ///< The user typed or stepped; not emitted by setValue().

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  QString bare(const QString& text) const;
  bool means_unlimited(const QString& plain) const;
  bool unlimited_ = false;
};

/// The same for whole numbers.
class WholeBox : public QSpinBox {
  Q_OBJECT
 public:
  explicit WholeBox(QWidget* parent = nullptr);

  void stepBy(int steps) override;

 signals:
  void edited();

 protected:
  void wheelEvent(QWheelEvent* event) override;
};

/// Combo box that may be narrow (its text is then elided, and whole in the tooltip) and that the
/// wheel turns only while it has the focus.
class QuietCombo : public QComboBox {
  Q_OBJECT
 public:
  explicit QuietCombo(QWidget* parent = nullptr);
  QSize minimumSizeHint() const override;

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  QString shown_text() const;
};

}  // namespace arris::ui
