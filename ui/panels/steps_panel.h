#pragma once

#include <memory>
#include <vector>

#include <QString>
#include <QVariantMap>
#include <QWidget>

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

enum class StepState { unavailable, not_run, done, out_of_date };

/// A step of figure 2 as the panel shows it.
struct StepCard {
  QString name;     ///< Operation name: "find_sharp_lines".
  QString title;    ///< "Sharp lines".
  QString tooltip;  ///< What the step does.
  StepState state = StepState::not_run;
  QString result;  ///< "137 lines, 1,203 edges".
  QString time;    ///< "0.12 s".
  std::vector<StepParameter> parameters;
  bool runnable = true;  ///< False: no Run button.
};

/// The left panel: the paper's figure 2 from top to bottom. A card that is `unavailable` (a phase
/// of a later version) shows its place and its tooltip and has no controls.
class StepsPanel : public QWidget {
  Q_OBJECT
 public:
  explicit StepsPanel(QWidget* parent = nullptr);
  ~StepsPanel() override;

  /// Shows these cards. Editors that the user is typing in keep focus and text.
  void set_cards(const std::vector<StepCard>& cards);
  void set_busy(bool busy);  ///< Run buttons off while work goes on.
  QVariantMap values(const QString& step) const;
  /// Whether a value of the step was edited and not run.
  bool is_edited(const QString& step) const;

 signals:
  /// Whether a step is edited may be otherwise than before.
  void edited();
  /// A number that was typed is complete (Enter, or the focus went elsewhere).
  void entered(const QString& step, const QVariantMap& values);
  /// Run pressed: the step with the values in its editors (key to value).
  void run_requested(const QString& step, const QVariantMap& values);
  /// A slider of the step is being dragged, or was let go: its values as they are now.
  void dragged(const QString& step, const QVariantMap& values);
  void settled(const QString& step, const QVariantMap& values);
  void run_out_of_date_requested();  ///< "Run again all that is out of date".

 private:
  class Private;
  std::unique_ptr<Private> p_;
};

}  // namespace arris::ui
