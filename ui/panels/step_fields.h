#pragma once

#include <functional>
#include <memory>

#include <QObject>
#include <QString>
#include <QStringList>
#include <QVariant>
#include <QVariantMap>

class QWidget;

namespace arris::ui {

/// A parameter of a step as the panel shows it.
struct StepParameter {
  /// scale: a real number on a logarithmic slider, from `least` to `most`.
  enum class Kind { real, whole, choice, intervals, scale };
  QString key;    ///< As in the operation: "angle".
  QString label;  ///< "Angle TV_IH".
  QString tooltip;
  Kind kind = Kind::real;
  QVariant value;  ///< double, int, choice key (QString), or for intervals a QVariantList of
                   ///< [min, max] QVariantLists (max infinite: no upper end).
  double least = 0.0, most = 0.0;
  int decimals = 2;
  QString suffix;       ///< " °", " mm", " 1/mm²".
  QStringList choices;  ///< Keys.
  QStringList choice_labels;
  /// Key of the choice that this parameter hangs on; empty: on none. It is shown, and among the
  /// values, where `value_of` has the chosen key, and takes that value when the choice is made
  /// unless it was edited. `value` does not count then.
  QString hangs_on;
  QVariantMap value_of;
};

/// A parameter's editor. Until the user changes it, its value is the very value it was given, with
/// all the digits that the editor does not show.
class StepField {
 public:
  explicit StepField(StepParameter parameter) : parameter_(std::move(parameter)) {}
  virtual ~StepField() = default;

  virtual QWidget* widget() const = 0;
  /// Whether it takes a line of its own under the label.
  virtual bool wide() const { return false; }
  /// What is wrong with the values, as a sentence; empty if nothing is.
  virtual QString mistake() const { return {}; }

  QVariant value() { return touched_ ? read() : parameter_.value; }
  void touch() {
    touched_ = true;
    if (edited) edited();
  }

  /// Whether this editor can show it: the same parameter but for its value.
  bool fits(const StepParameter& other) const;

  /// A new value from the document is shown unless the user is at work here. The same value again
  /// is no news: what the user has edited and not yet run stays.
  void update(const QVariant& value);
  /// Another choice was made that this parameter hangs on: what was edited stays.
  void rebase(const QVariant& value) {
    parameter_.value = value;
    if (!touched_) show();
  }

  /// Whether it shows another value than the document has.
  bool is_edited() const { return touched_ && typed() != parameter_.value; }

  std::function<void()> edited;
  std::function<void()> entered;           // a number, whole
  std::function<void()> dragged, settled;  // of a slider, which is followed at once

 protected:
  virtual QVariant read() = 0;
  virtual QVariant typed() const = 0;  ///< As far as it was typed.
  virtual void show() = 0;
  void enter() {
    if (is_edited() && entered) entered();
  }

  StepParameter parameter_;
  QObject alive_;  // editors that lose the focus in their end still tell that they are finished

 private:
  bool touched_ = false;
};

/// The editor of its kind, with `parent` as the parent of its widget.
std::unique_ptr<StepField> make_step_field(const StepParameter& parameter, QWidget* parent);

}  // namespace arris::ui
