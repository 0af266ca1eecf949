#pragma once

#include <utility>
#include <vector>

#include <QDialog>

#include "ui/view/mesh_view.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QLineEdit;
class QSpinBox;

namespace arris::ui {

/// Asks for size and contents of a picture before it is saved: in pixels, or in millimetres of
/// paper at so many dots per inch, and then also to scale; under it a title and the thresholds.
/// What was chosen is remembered, from one start to the next but for the title.
class PictureDialog : public QDialog {
  Q_OBJECT
 public:
  struct Part {
    QSizeF extent;             ///< As it is seen, in its unit.
    QSize view_size;           ///< The width follows the height in its proportion.
    bool named_views = false;  ///< There are some to make pictures of.
    double millimetres =
        0.0;             ///< Of one unit of the part; 0: not known, so that there is no scale.
    QString title;       ///< What it is called.
    QString thresholds;  ///< What its lines and partitions were found with; empty: not found.
  };
  /// Opens with `options`.
  PictureDialog(const PictureOptions& options, const Part& part, QWidget* parent);
  PictureOptions options() const;
  bool each_view() const;  ///< A picture of each named view instead of one of this.

  void accept() override;

 private:
  /// What is in the picture or not, by the key under which that is remembered.
  std::vector<std::pair<QString, QCheckBox*>> contents() const;
  bool in_millimetres() const;
  double dots_per_millimetre() const;
  /// Sizes in the unit that is chosen now.
  void change_unit();
  void refresh();

  Part part_;
  PictureOptions given_;
  QComboBox* unit_;
  QDoubleSpinBox* width_;
  QDoubleSpinBox* height_;
  QSpinBox* dots_;
  QComboBox* scale_;
  QLabel* pixels_;
  QCheckBox* keep_proportion_;
  QCheckBox* scalar_bar_;
  QCheckBox* scale_bar_;
  QCheckBox* marker_;
  QCheckBox* legend_;
  QCheckBox* titled_;
  QLineEdit* title_;
  QCheckBox* thresholds_;
  QComboBox* background_;
  QCheckBox* each_view_;
  bool were_millimetres_ = false;
};

}  // namespace arris::ui
