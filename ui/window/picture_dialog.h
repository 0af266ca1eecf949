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
  /// `named_views`: there are some to make pictures of.
  PictureDialog(const PictureOptions& options, QSize view_size, bool named_views, QWidget* parent);
  PictureOptions options() const;
  bool each_view() const;  ///< A picture of each named view instead of one of this.

 private:
  QSpinBox* width_;
  QSpinBox* height_;
  QCheckBox* keep_proportion_;
  QCheckBox* scalar_bar_;
  QCheckBox* scale_bar_;
  QCheckBox* marker_;
  QComboBox* background_;
  QCheckBox* each_view_;
};

}  // namespace arris::ui
