#pragma once

#include <QDialog>

#include "ui/view/mesh_view.h"

class QCheckBox;
class QComboBox;
class QSpinBox;

namespace arris::ui {

/// Asks for size and contents of a picture before it is saved.
class PictureDialog : public QDialog {
  Q_OBJECT
 public:
  /// Opens with `options`; the width follows the height in the proportion of `view_size`.
  PictureDialog(const PictureOptions& options, QSize view_size, QWidget* parent);
  PictureOptions options() const;

 private:
  QSpinBox* width_;
  QSpinBox* height_;
  QCheckBox* keep_proportion_;
  QCheckBox* scalar_bar_;
  QCheckBox* scale_bar_;
  QCheckBox* marker_;
  QComboBox* background_;
};

}  // namespace arris::ui
