#pragma once

#include <optional>

#include <QWidget>

#include "core/sharp_lines/jump_profile.h"

namespace arris::ui {

/// How the surface turns across an edge: the faces as dots, the straight lines through both sides,
/// and what they leave at the edge, the jump, as a bar.
class ProfileChart : public QWidget {
  Q_OBJECT
 public:
  explicit ProfileChart(QWidget* parent = nullptr);

  /// Absent: nothing is drawn.
  void set_profile(std::optional<JumpProfile> profile);
  const std::optional<JumpProfile>& profile() const { return profile_; }

  QSize sizeHint() const override { return {320, 200}; }
  QSize minimumSizeHint() const override { return {260, 160}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Plot;
  void paint_axes(QPainter& painter, const Plot& plot) const;
  void paint_sides(QPainter& painter, const Plot& plot) const;
  /// The jump at the edge, and what it says.
  void paint_jump(QPainter& painter, const Plot& plot) const;

  std::optional<JumpProfile> profile_;
};

}  // namespace arris::ui
