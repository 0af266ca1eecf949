#include "ui/view/overlay_layers.h"

#include <cmath>

#include <QPainter>

namespace arris::ui {

namespace {

GlCanvas::Layer paint_layer(const Overlay& overlay, OverlayPiece piece,
                            const std::array<QRectF, 2>& panels, QSize pixels, double scale) {
  const QSizeF size = QSizeF(pixels) / scale;
  const auto image_of = [](QSize of) {
    QImage image(of, QImage::Format_RGBA8888_Premultiplied);
    image.fill(Qt::transparent);
    return image;
  };
  QRectF bounds;
  {
    QImage nowhere = image_of({1, 1});
    QPainter painter(&nowhere);
    bounds = paint_piece(painter, size, overlay, piece, panels);
  }
  if (bounds.isEmpty()) return {};
  constexpr double rim = 2.0;  // of pens
  bounds = bounds.adjusted(-rim, -rim, rim, rim);
  const QRect place = QRectF(bounds.topLeft() * scale, bounds.size() * scale)
                          .toAlignedRect()
                          .intersected(QRect(QPoint(), pixels));
  GlCanvas::Layer layer{image_of(place.size()), place.topLeft()};
  QPainter painter(&layer.image);
  painter.translate(-layer.at);
  painter.scale(scale, scale);
  paint_piece(painter, size, overlay, piece, panels);
  return layer;
}

}  // namespace

std::vector<GlCanvas::Layer> OverlayLayers::layers_of(const Overlay& overlay, QSize pixels,
                                                      double scale) {
  const bool resized = pixels != pixels_ || scale != scale_;
  pixels_ = pixels;
  scale_ = scale;
  std::vector<GlCanvas::Layer> layers;
  for (std::size_t k = 0; k < overlay_pieces.size(); ++k) {
    Piece& piece = pieces_[k];
    Overlay from = part_of(overlay, overlay_pieces[k]);
    const bool changed = resized || piece.from != from;
    if (overlay_pieces[k] == OverlayPiece::panels && changed)
      panels_ = overlay_panels(QSizeF(pixels) / scale, overlay);
    if (changed || piece.panels != panels_) {
      piece.from = std::move(from);
      piece.panels = panels_;
      piece.layer = paint_layer(piece.from, overlay_pieces[k], panels_, pixels, scale);
      ++painted_;
    }
    layers.push_back(piece.layer);
  }
  return layers;
}

}  // namespace arris::ui
