#pragma once

#include <string>
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
  /// Runs again what an earlier step has put out of date; in a fresh part, sharp lines and
  /// partitions.
  void run_out_of_date();
  /// The steps of figure 2 from the scan on, with defaults from the part; those that were run
  /// besides (swaps, smoothing) run again in their place.
  void run_paper_flow();
  bool anything_out_of_date() const;

 signals:
  /// anything_out_of_date() may be otherwise than before.
  void edited();

 private:
  bool wants_run(const char* step) const;
  void refresh();
  const nlohmann::json& line_defaults(const char* method);
  StepCard lines_card();
  StepCard partitions_card();
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
  /// Defaults of find_sharp_lines by the method that is not in use, for the scan they come from.
  struct LineDefaults {
    MeshPtr scan;
    std::string method;
    nlohmann::json parameters;
  };
  LineDefaults line_defaults_;
};

}  // namespace arris::ui
