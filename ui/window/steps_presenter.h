#pragma once

#include <vector>

#include <QObject>

#include "ui/panels/steps_panel.h"
#include "ui/window/session.h"

namespace arris::ui {

/// The steps of figure 2 in the left panel: their parameters, states and results, and Run.
class StepsPresenter : public QObject {
  Q_OBJECT
 public:
  StepsPresenter(Session* session, StepsPanel* panel, QObject* parent);

  /// Runs a step with the values in its card.
  void run(const QString& step);
  /// Runs again what an earlier step has put out of date; in a fresh part, what was never run.
  void run_out_of_date();
  bool anything_out_of_date() const;

 private:
  void refresh();
  QString swaps_text(const MeshPtr& before, const MeshPtr& after);
  Operation operation_from(const QString& step, const QVariantMap& values) const;

  Session* session_;
  StepsPanel* panel_;
  /// Results that take a look at the whole mesh, for the meshes they were worked out for.
  struct Swaps {
    MeshPtr before, after;
    QString text;
  };
  std::vector<Swaps> swaps_;
};

}  // namespace arris::ui
