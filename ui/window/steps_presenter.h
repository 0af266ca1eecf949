#pragma once

#include <map>
#include <string>
#include <utility>
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
  bool wants_run(const ChainStep& one) const;
  void refresh();
  StepCard scan_card() const;
  /// The parameters of a step that its card shows, from the operation table.
  std::vector<StepParameter> editors_of(const OperationKind& kind);
  /// What a step that was run came to.
  QString outcome_of(std::size_t place);
  /// Parameters of a step as they would be by another method.
  const nlohmann::json& defaults(const std::string& step, const std::string& method);
  Operation operation_from(const QString& step, const QVariantMap& values) const;
  Operation from_card(const std::string& step) const;

  Session* session_;
  StepsPanel* panel_;
  /// By the method that is not in use, for the scan that they come from.
  struct MethodDefaults {
    std::string scan, step, method;
    nlohmann::json parameters;
  };
  std::vector<MethodDefaults> defaults_;
  /// Results that take a look at the whole mesh: of what, and the text.
  std::map<std::size_t, std::pair<std::string, QString>> outcomes_;
};

}  // namespace arris::ui
