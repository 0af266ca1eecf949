#pragma once

#include <QDialog>

#include "core/report/report.h"

class QCheckBox;
class QLineEdit;
class QPushButton;

namespace arris::ui {

/// Asks where a report goes and what stands on it. Company, logo, page and folder are remembered.
class ReportDialog : public QDialog {
  Q_OBJECT
 public:
  /// `part`: its name, which the report is called by.
  ReportDialog(const QString& part, QWidget* parent);

  ReportRequest request() const;  ///< Without pictures, date and program.
  bool paper() const;             ///< As PDF, too.

  void accept() override;

 private:
  void update_buttons();

  QLineEdit *title_, *company_, *logo_, *page_, *folder_;
  QCheckBox* paper_;
  QPushButton* write_;
};

}  // namespace arris::ui
