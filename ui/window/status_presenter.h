#pragma once

#include <optional>

#include <QObject>

#include "ui/view/mesh_view.h"
#include "ui/window/session.h"

class QLabel;
class QProgressBar;
class QPushButton;
class QStatusBar;
class QTimer;

namespace arris::ui {

class ElementsPresenter;
class FieldPresenter;
class ReportPresenter;

/// The status bar: what lies under the mouse, progress of work with Cancel, what the part has.
class StatusPresenter : public QObject {
  Q_OBJECT
 public:
  StatusPresenter(Session* session, FieldPresenter* fields, ElementsPresenter* elements,
                  ReportPresenter* reports, QStatusBar* bar);

  void show_hover(const Document& document, const std::optional<Pick>& pick);
  /// 0: until something else is said.
  void tell(const QString& text, int milliseconds);

 private:
  bool can_be_cancelled() const;
  /// Shows progress while something takes its time, and Cancel where it can be.
  void show_working();
  void show_progress(double fraction, const QString& what);
  void refresh_counts();

  Session* session_;
  FieldPresenter* fields_;
  ElementsPresenter* elements_;
  ReportPresenter* reports_;
  QStatusBar* bar_;
  QLabel* hover_;
  QLabel* counts_;
  QProgressBar* progress_;
  QPushButton* cancel_;
  QTimer* delay_;
};

}  // namespace arris::ui
