#pragma once

#include <QObject>
#include <QString>

#include "ui/window/latest_work.h"
#include "ui/window/session.h"

namespace arris::ui {

/// Writes results of the part for other programs (core/document/results), beside the UI thread.
class ResultsPresenter : public QObject {
  Q_OBJECT
 public:
  ResultsPresenter(Session* session, QWidget* window);

  /// Asks what and where, then writes it and tells.
  void ask();
  bool writing() const { return work_.running(); }
  /// Returns once all is written; see LatestWork::wait().
  void wait() const { work_.wait(); }

 signals:
  /// Empty: what was said before no longer holds.
  void message(const QString& text, int milliseconds);

 private:
  Session* session_;
  QWidget* window_;
  LatestWork work_;
};

}  // namespace arris::ui
