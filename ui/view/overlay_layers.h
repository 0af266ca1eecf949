#pragma once

#include <array>
#include <vector>

#include "ui/view/gl_canvas.h"
#include "ui/view/overlay.h"

namespace arris::ui {

/// What is written over the part as layers for the graphics card. Each piece is a picture no larger
/// than it needs, painted anew only where it changed: while the part is turned that is the
/// orientation marker alone.
class OverlayLayers {
 public:
  /// On a view of `pixels`; `scale`: device pixels per pixel of text. One layer for each piece, in
  /// the order of painting, null where there is nothing.
  std::vector<GlCanvas::Layer> layers_of(const Overlay& overlay, QSize pixels, double scale);

  /// Pieces painted so far.
  int painted() const { return painted_; }

 private:
  struct Piece {
    Overlay from;
    std::array<QRectF, 2> panels;
    GlCanvas::Layer layer;
  };
  std::array<Piece, overlay_pieces.size()> pieces_;
  std::array<QRectF, 2> panels_;
  QSize pixels_;
  double scale_ = 0.0;
  int painted_ = 0;
};

}  // namespace arris::ui
