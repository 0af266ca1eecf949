#pragma once

#include <vector>

#include <QDialog>

#include "core/document/results.h"

class QLineEdit;
class QListWidget;
class QPushButton;

namespace arris::ui {

/// Asks what of a finished part is exported, and to which folder. Both are remembered.
class ExportDialog : public QDialog {
  Q_OBJECT
 public:
  /// `prefix`: what file names begin with, from the name of the part: "cover_".
  ExportDialog(QString prefix, QWidget* parent);

  /// Those that were chosen, as long as result_files() lasts.
  std::vector<const ResultFile*> chosen() const;
  QString folder() const;
  /// The name of a file, without its folder.
  QString name_of(const ResultFile& file) const;

  void accept() override;  ///< Remembers both.

 private:
  void choose_folder();
  /// Only what can be done can be pressed.
  void update_buttons();

  QString prefix_;
  QListWidget* files_;
  QLineEdit* folder_;
  QPushButton* export_;
};

}  // namespace arris::ui
