#pragma once

#include <functional>
#include <string>
#include <vector>

#include <QObject>

#include "core/report/report.h"
#include "ui/window/latest_work.h"
#include "ui/window/saved_view.h"
#include "ui/window/session.h"

namespace arris::ui {

/// Writes the report of the part with pictures of it: a page, and the same on paper as PDF.
class ReportPresenter : public QObject {
  Q_OBJECT
 public:
  /// `keepers`: how the part is looked at now. `show_partitions`: makes partitions, or the field,
  /// colour the surface.
  ReportPresenter(Session* session, std::function<ViewKeepers()> keepers,
                  std::function<void(bool)> show_partitions, QWidget* window);

  /// Asks where and how, then writes it and tells.
  void ask();
  /// Draws the pictures now, then writes the report beside the UI thread. `then` hears of the
  /// error; empty where it is written.
  void write(ReportRequest request, bool paper, std::function<void(const QString& error)> then);
  bool writing() const { return work_->running(); }
  void cancel();  ///< Stops writing; of a report that was there before nothing is changed but its
                  ///< pictures.

 signals:
  void message(const QString& text);
  void writing_changed(bool writing);
  void progress(double fraction, const QString& what);

 private:
  /// Errors: a picture could not be drawn or saved.
  QString draw_pictures(const QString& folder, std::vector<ReportPicture>& pictures);

  Session* session_;
  std::function<ViewKeepers()> keepers_;
  std::function<void(bool)> show_partitions_;
  QWidget* window_;
  LatestWork* work_;
};

}  // namespace arris::ui
