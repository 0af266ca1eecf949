#pragma once

#include <memory>
#include <vector>

#include <QString>
#include <QVariantMap>
#include <QWidget>

#include "ui/panels/step_card.h"

namespace arris::ui {

/// The left panel: the paper's figure 2 from top to bottom.
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
