#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <QColor>
#include <QWidget>

class QComboBox;
class QLabel;
class QSplitter;
class QToolButton;
class QVBoxLayout;

namespace arris::ui {

class ElidedLabel;

/// The view of the part, and beside it, to its left, that of another version of it; a header over
/// each says which one it is and what only it has.
class SideBySide : public QWidget {
  Q_OBJECT
 public:
  /// `view` shows the part as it is now.
  SideBySide(QWidget* view, const QColor& marked, QWidget* parent);

  /// Puts `other` beside the view; null: the view alone again. What was there before is given up
  /// to its owner.
  void set_other(QWidget* other);

  /// A bar over both views.
  void set_strip(QWidget* strip);

  struct Version {
    std::uint32_t sequence = 0;
    QString text;
  };
  void set_versions(const std::vector<Version>& versions, std::uint32_t chosen);
  /// Name of the state the part is in.
  void set_now(const QString& text);
  /// What a version holds, and what only it has; `side`: 0 the other, 1 the part as it is now.
  void set_figures(int side, const QString& holds, const QString& only);
  /// Offers to draw the line selected in the other version here, too.
  void set_line_takeable(bool takeable);
  /// Whether going to the other version is possible.
  void set_travel_possible(bool possible);

 signals:
  void version_wanted(std::uint32_t sequence);
  void travel_wanted();  ///< Go to the version shown, and compare with this one.
  void line_wanted();    ///< Draw its selected line here, too.
  void marks_wanted(bool shown);
  void closed();

 private:
  struct Header {
    QWidget* widget = nullptr;
    ElidedLabel* holds = nullptr;
    QLabel* chip = nullptr;
    ElidedLabel* only = nullptr;
    QWidget* row = nullptr;  // the one above the figures
  };
  Header make_header();

  QSplitter* splitter_;
  QWidget* other_side_;
  QVBoxLayout* other_column_;
  QWidget* other_ = nullptr;
  std::array<Header, 2> headers_;
  QComboBox* versions_;
  ElidedLabel* now_;
  QToolButton* take_line_;
  QToolButton* travel_;
};

}  // namespace arris::ui
