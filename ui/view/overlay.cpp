#include "ui/view/overlay.h"

#include <algorithm>
#include <cmath>

#include <QFontMetricsF>
#include <QPainter>
#include <QPainterPath>

#include "ui/view/scene.h"
#include "ui/view/translated.h"

namespace arris::ui {
namespace {

constexpr double margin = 14.0;  // between the view's rim and what is written
constexpr double padding = 9.0;  // between a panel's rim and its text

struct Look {
  QColor text, faint, panel, rim;
  QFont font, bold;
  explicit Look(bool dark)
      : text(dark ? QColor(228, 231, 236) : QColor(28, 32, 40)),
        faint(dark ? QColor(160, 166, 176) : QColor(95, 102, 114)),
        panel(dark ? QColor(38, 41, 47, 214) : QColor(255, 255, 255, 214)),
        rim(dark ? QColor(255, 255, 255, 34) : QColor(20, 30, 50, 34)) {
    font.setPixelSize(12);  // the painter scales, so points per inch must not come in
    bold = font;
    bold.setWeight(QFont::DemiBold);
  }
};

double text_width(const QFont& font, const QString& text) {
  return QFontMetricsF(font).horizontalAdvance(text);
}

void paint_panel(QPainter& painter, const Look& look, const QRectF& rect) {
  painter.setPen(QPen(look.rim, 1.0));
  painter.setBrush(look.panel);
  painter.drawRoundedRect(rect, 6.0, 6.0);
}

void paint_text(QPainter& painter, const QFont& font, const QColor& colour, const QRectF& rect,
                Qt::Alignment alignment, const QString& text) {
  painter.setFont(font);
  painter.setPen(colour);
  painter.drawText(rect, static_cast<int>(alignment) | Qt::TextSingleLine | Qt::TextDontClip, text);
}

/// A sample of what is hatched on the part (scene.cpp).
void paint_undefined(QPainter& painter, const Look& look, const QRectF& rect,
                     const QColor& colour) {
  painter.save();
  painter.setClipRect(rect);
  painter.fillRect(rect, colour);
  const auto lighter = [](int channel) {
    return static_cast<int>(channel + 0.55 * (255 - channel));
  };
  painter.setPen(
      QPen(QColor(lighter(colour.red()), lighter(colour.green()), lighter(colour.blue())),
           hatch_period / 2.0 / std::sqrt(2.0), Qt::SolidLine, Qt::FlatCap));
  for (double x = rect.left() - rect.height(); x < rect.right(); x += hatch_period)
    painter.drawLine(QPointF(x, rect.top()), QPointF(x + rect.height(), rect.bottom()));
  painter.restore();
  painter.setPen(QPen(look.faint, 1.0));
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(rect);
}

QColor to_colour(const std::array<std::uint8_t, 3>& rgb) { return {rgb[0], rgb[1], rgb[2]}; }

/// The value at a position of the scale.
double value_at(const ColourScale& scale, double position) {
  if (!scale.logarithmic || scale.max <= 0.0) {
    return scale.min + position * (scale.max - scale.min);
  }
  const double low = scale.min > 0.0 ? scale.min : scale.max / 1e6;
  return low * std::pow(scale.max / low, position);
}

QString radius_text(double curvature) {
  return curvature > 0.0 ? short_number(1.0 / std::sqrt(curvature)) : QStringLiteral("∞");
}

struct Tick {
  double position;
  QString value, radius;
};

/// Ends and round values between them, none so near to another that their texts would touch.
std::vector<Tick> ticks_of(const ViewField& field, double height) {
  const ColourScale& scale = field.scale;
  const double gap = 17.0 / height;
  std::vector<double> values;
  if (scale.bands > 0 && scale.bands * 17.0 <= height) {
    for (int k = 0; k <= scale.bands; ++k) {
      values.push_back(value_at(scale, static_cast<double>(k) / scale.bands));
    }
  } else {
    values = tick_values(scale, static_cast<int>(std::clamp(height / 44.0, 2.0, 8.0)));
    std::erase_if(values, [&](double value) {
      const double x = scale.position(value);
      return x < gap || x > 1.0 - gap;
    });
    values.insert(values.begin(), value_at(scale, 0.0));
    values.push_back(value_at(scale, 1.0));
  }
  std::vector<Tick> ticks;
  for (const double value : values) {
    ticks.push_back({std::clamp(scale.position(value), 0.0, 1.0), short_number(value),
                     field.read_as_radius ? radius_text(value) : QString()});
  }
  return ticks;
}

constexpr double strip_width = 18.0;
constexpr double tip_height = 12.0;  ///< Of what stands for colours beyond the range.

/// The strip of colours, with its tips.
void paint_strip(QPainter& painter, const Look& look, const ColourScale& scale, double x, double y,
                 double height) {
  // Row by row of the device, so that the strip is as fine as the surface.
  const int rows = static_cast<int>(std::ceil(height * painter.transform().m22()));
  QImage image(1, rows, QImage::Format_RGB32);
  ColourScale plain;
  plain.map = scale.map;
  plain.reversed = scale.reversed;
  plain.bands = scale.bands;
  for (int row = 0; row < rows; ++row) {
    image.setPixelColor(0, row, to_colour(plain.colour(1.0 - (row + 0.5) / rows)));
  }
  painter.drawImage(QRectF(x, y, strip_width, height), image);
  QPainterPath outline;
  outline.addRect(QRectF(x, y, strip_width, height));
  const auto tip_path = [&](double base, double point, const QColor& colour) {
    QPainterPath path;
    path.moveTo(x, base);
    path.lineTo(x + strip_width / 2, point);
    path.lineTo(x + strip_width, base);
    path.closeSubpath();
    painter.fillPath(path, colour);
    outline.addPath(path);
  };
  if (scale.above.isValid()) tip_path(y, y - tip_height, scale.above);
  if (scale.below.isValid()) tip_path(y + height, y + height + tip_height, scale.below);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(look.faint, 1.0));
  painter.drawPath(outline);
}

/// Returns the panel's rectangle; null where there is no room.
QRectF paint_scalar_bar(QPainter& painter, const Look& look, QSizeF size, const Overlay& overlay) {
  const ViewField& field = *overlay.field;
  const ColourScale& scale = field.scale;
  const bool undefined = overlay.field_has_undefined;
  const double line = QFontMetricsF(look.font).height();
  const double top = (scale.above.isValid() ? tip_height : 0.0) +
                     (field.read_as_radius ? 2 * line + 12 : line + 10);
  const double bottom = (scale.below.isValid() ? tip_height : 0.0) + (undefined ? line + 12 : 4);
  const double room = size.height() - 2 * margin - 2 * padding - top - bottom;
  const double height = std::min(room, std::clamp(0.5 * size.height(), 120.0, 340.0));
  if (height < 70.0) return {};
  const std::vector<Tick> ticks = ticks_of(field, height);
  double values_width = 0.0;
  double radii_width = 0.0;
  for (const Tick& tick : ticks) {
    values_width = std::max(values_width, text_width(look.font, tick.value));
    radii_width = std::max(radii_width, text_width(look.font, tick.radius));
  }
  const QString radius_title =
      overlay.unit == LengthUnit::unknown
          ? translated("r")
          : translated("r (%1)").arg(QString::fromStdString(unit_text(overlay.unit)));
  const QString undefined_text = translated("undefined");
  if (field.read_as_radius) {
    radii_width = std::max(radii_width, text_width(look.font, radius_title)) + 16.0;
  }
  double inner =
      std::max(strip_width + 10.0 + values_width + radii_width, text_width(look.bold, field.title));
  if (undefined)
    inner = std::max(inner, strip_width + 10.0 + text_width(look.font, undefined_text));
  const QRectF panel(size.width() - margin - inner - 2 * padding, margin, inner + 2 * padding,
                     height + top + bottom + 2 * padding);
  if (panel.left() < margin) return {};
  paint_panel(painter, look, panel);

  const double x = panel.left() + padding;
  const double y = panel.top() + padding + top;
  paint_text(painter, look.bold, look.text, {x, panel.top() + padding, inner, line},
             Qt::AlignLeft | Qt::AlignVCenter, field.title);
  const double values_x = x + strip_width + 10.0;
  if (field.read_as_radius) {
    paint_text(painter, look.font, look.faint, {x, panel.top() + padding + line + 2, inner, line},
               Qt::AlignRight | Qt::AlignVCenter, radius_title);
  }

  paint_strip(painter, look, scale, x, y, height);
  for (const Tick& tick : ticks) {
    const double at = y + (1.0 - tick.position) * height;
    painter.setPen(QPen(look.faint, 1.0));
    painter.drawLine(QPointF(x + strip_width, at), QPointF(x + strip_width + 5.0, at));
    paint_text(painter, look.font, look.text, {values_x, at - line / 2, values_width, line},
               Qt::AlignLeft | Qt::AlignVCenter, tick.value);
    if (!tick.radius.isEmpty()) {
      paint_text(painter, look.font, look.faint, {x, at - line / 2, inner, line},
                 Qt::AlignRight | Qt::AlignVCenter, tick.radius);
    }
  }
  if (undefined) {
    const double at = panel.bottom() - padding - line;
    paint_undefined(painter, look, QRectF(x, at + 2, strip_width, line - 4), scale.undefined);
    paint_text(painter, look.font, look.text, {values_x, at, inner, line},
               Qt::AlignLeft | Qt::AlignVCenter, undefined_text);
  }
  return panel;
}

QRectF paint_class_legend(QPainter& painter, const Look& look, QSizeF size,
                          const Overlay& overlay) {
  const ViewField& field = *overlay.field;
  const double line = QFontMetricsF(look.font).height();
  const double row = line + 5.0;
  QStringList names = field.class_names;
  std::vector<QColor> colours = field.class_colours;
  colours.resize(static_cast<std::size_t>(names.size()), field.scale.undefined);
  if (overlay.field_has_undefined) {
    names.append(translated("undefined"));
    colours.push_back(field.scale.undefined);
  }
  double inner = text_width(look.bold, field.title);
  for (const QString& name : names) inner = std::max(inner, 28.0 + text_width(look.font, name));
  const double height = line + 7.0 + row * static_cast<double>(names.size());
  const QRectF panel(size.width() - margin - inner - 2 * padding, margin, inner + 2 * padding,
                     height + 2 * padding);
  if (panel.left() < margin || panel.bottom() > size.height() - margin) return {};
  paint_panel(painter, look, panel);
  const double x = panel.left() + padding;
  double y = panel.top() + padding;
  paint_text(painter, look.bold, look.text, {x, y, inner, line}, Qt::AlignLeft | Qt::AlignVCenter,
             field.title);
  y += line + 7.0;
  for (int k = 0; k < names.size(); ++k, y += row) {
    painter.setPen(QPen(look.faint, 1.0));
    painter.setBrush(colours[static_cast<std::size_t>(k)]);
    painter.drawRect(QRectF(x, y + 1.5, 18.0, line - 3.0));
    paint_text(painter, look.font, look.text, {x + 28.0, y, inner, line},
               Qt::AlignLeft | Qt::AlignVCenter, names[k]);
  }
  return panel;
}

QString line_name(LineType type) {
  switch (type) {
    case LineType::c0_convex:
      return translated("C0 convex");
    case LineType::c0_concave:
      return translated("C0 concave");
    case LineType::gn:
      return translated("Gn");
    case LineType::tangent:
      return translated("Gn, tangent");
    case LineType::undefined:
      return translated("undefined");
    case LineType::border:
      return translated("border");
  }
  return {};
}

void paint_sample(QPainter& painter, const Stroke& stroke, const QPointF& from, double length) {
  QPainterPath path;
  if (stroke.period == 0.0F) {
    path.moveTo(from);
    path.lineTo(from + QPointF(length, 0.0));
  } else {
    for (double s = 0.0; s <= length; s += stroke.period) {
      path.moveTo(from + QPointF(s, 0.0));
      path.lineTo(from + QPointF(std::min(s + std::max<double>(stroke.dash, 0.01), length), 0.0));
    }
  }
  painter.setBrush(Qt::NoBrush);
  const auto pen = [&](const QColor& colour, double width) {
    painter.setPen(QPen(colour, width, Qt::SolidLine, Qt::RoundCap));
    painter.drawPath(path);
  };
  pen(QColor(255, 255, 255, 215), 2.0 * (stroke.half_width + line_rim));
  pen(stroke.colour, 2.0 * stroke.half_width);
}

QRectF paint_line_legend(QPainter& painter, const Look& look, QSizeF size, const Overlay& overlay,
                         const QRectF& taken) {
  constexpr double sample = 46.0;
  const double line = QFontMetricsF(look.font).height();
  const double row = line + 4.0;
  double inner = 0.0;
  for (const LineType type : overlay.line_types) {
    inner = std::max(inner, sample + 12.0 + text_width(look.font, line_name(type)));
  }
  const double height = row * static_cast<double>(overlay.line_types.size());
  const QRectF panel(margin, margin, inner + 2 * padding, height + 2 * padding);
  const QRectF room = panel.adjusted(-margin, -margin, margin, margin);
  if (room.right() > size.width() || room.bottom() > size.height() || room.intersects(taken)) {
    return {};
  }
  paint_panel(painter, look, panel);
  double y = panel.top() + padding;
  for (const LineType type : overlay.line_types) {
    paint_sample(painter, line_strokes()[static_cast<std::size_t>(type)],
                 {panel.left() + padding + 3.0, y + row / 2}, sample - 4.0);
    paint_text(painter, look.font, look.text,
               {panel.left() + padding + sample + 10.0, y, inner, row},
               Qt::AlignLeft | Qt::AlignVCenter, line_name(type));
    y += row;
  }
  return panel;
}

/// Between the orientation marker and the scale bar where it fits there, else above them.
QRectF paint_hint(QPainter& painter, const Look& look, QSizeF size, const Overlay& overlay) {
  constexpr double left = 116.0, right = 196.0;  // that marker and scale bar may take
  const double line = QFontMetricsF(look.font).height();
  const double most = size.width() - 2 * margin - 2 * padding;
  QStringList lines = overlay.hint.split('\n');
  double widest = 0.0;
  for (QString& text : lines) {
    text = QFontMetricsF(look.font).elidedText(text, Qt::ElideRight, most);
    widest = std::max(widest, text_width(look.font, text));
  }
  const double width = widest + 2 * padding;
  const double height = line * static_cast<double>(lines.size()) + 12.0;
  const bool between = width <= size.width() - left - right;
  const double middle = (size.width() - width) / 2;
  const double x =
      between ? std::clamp(middle, left, size.width() - right - width) : std::max(middle, margin);
  const bool free = between || (!overlay.orientation_marker && !overlay.scale_bar);
  const QRectF panel(x, size.height() - margin - height - (free ? 0.0 : 88.0), width, height);
  if (panel.top() < margin) return {};
  paint_panel(painter, look, panel);
  for (int k = 0; k < lines.size(); ++k)
    paint_text(painter, look.font, look.text, {x, panel.top() + 6.0 + k * line, width, line},
               Qt::AlignCenter, lines[k]);
  return panel;
}

QRectF paint_scale_bar(QPainter& painter, const Look& look, QSizeF size, const Overlay& overlay,
                       const QRectF& taken) {
  const double most = std::min(160.0, 0.3 * size.width());
  const double length = round_length(most * overlay.units_per_pixel);
  const double pixels = length / overlay.units_per_pixel;
  if (!(pixels > 8.0) || pixels > most * 1.0001) return {};
  const QString number = short_number(length);
  const QString text = overlay.unit == LengthUnit::unknown
                           ? number + translated(" units")
                           : number + " " + QString::fromStdString(unit_text(overlay.unit));
  const double line = QFontMetricsF(look.font).height();
  const double inner = std::max(pixels, text_width(look.font, text));
  const QRectF panel(size.width() - margin - inner - 2 * padding,
                     size.height() - margin - line - 13.0 - padding, inner + 2 * padding,
                     line + 13.0 + padding);
  if (panel.left() < 0.4 * size.width() || panel.top() < margin || panel.intersects(taken))
    return {};
  paint_panel(painter, look, panel);
  paint_text(painter, look.font, look.text,
             {panel.left() + padding, panel.top() + 4.0, inner, line}, Qt::AlignCenter, text);
  const double x = panel.center().x() - pixels / 2;
  const double y = panel.bottom() - 8.0;
  painter.setPen(QPen(look.text, 1.6, Qt::SolidLine, Qt::FlatCap, Qt::MiterJoin));
  painter.setBrush(Qt::NoBrush);
  painter.drawPolyline(QPolygonF({{x, y - 5.0}, {x, y}, {x + pixels, y}, {x + pixels, y - 5.0}}));
  return panel;
}

QRectF paint_orientation(QPainter& painter, const Look& look, QSizeF size, const Overlay& overlay,
                         const QRectF& taken) {
  constexpr double radius = 36.0;
  const QPointF centre(margin + radius + 8.0, size.height() - margin - radius - 8.0);
  const QRectF room(centre.x() - radius - 12.0, centre.y() - radius - 12.0, 2 * radius + 24.0,
                    2 * radius + 24.0);
  if (size.width() < 3.2 * room.width() || room.top() < 0.0 || room.intersects(taken)) return {};
  struct Axis {
    Eigen::Vector3d direction;  // right, up, towards the viewer
    QColor colour;
    QString name;
  };
  std::array<Axis, 3> axes{
      {{overlay.axes.transpose().col(0), QColor(214, 48, 49), QStringLiteral("x")},
       {overlay.axes.transpose().col(1), QColor(30, 150, 60), QStringLiteral("y")},
       {overlay.axes.transpose().col(2), overlay.dark ? QColor(90, 150, 255) : QColor(30, 90, 215),
        QStringLiteral("z")}}};
  std::sort(axes.begin(), axes.end(),
            [](const Axis& a, const Axis& b) { return a.direction.z() < b.direction.z(); });
  for (const Axis& axis : axes) {
    const QPointF along(axis.direction.x(), -axis.direction.y());
    const double length = std::hypot(along.x(), along.y());
    const QPointF tip = centre + along * (radius - 9.0);
    painter.setPen(QPen(axis.colour, 2.4, Qt::SolidLine, Qt::RoundCap));
    painter.setBrush(axis.colour);
    painter.drawLine(centre, tip);
    if (length > 0.25) {
      const QPointF unit = along / length;
      const QPointF across(-unit.y(), unit.x());
      const QPointF base = tip - unit * 4.0;
      painter.setPen(Qt::NoPen);
      painter.drawPolygon(QPolygonF({base + across * 4.0, base - across * 4.0, tip + unit * 5.0}));
      const QPointF at = tip + unit * 12.0;
      paint_text(painter, look.bold, axis.colour, {at.x() - 8.0, at.y() - 8.0, 16.0, 16.0},
                 Qt::AlignCenter, axis.name);
    } else {
      // Seen along its length: a disc, with its name beside it when it points at the viewer.
      painter.setPen(Qt::NoPen);
      painter.drawEllipse(tip, 4.0, 4.0);
      if (axis.direction.z() > 0.0) {
        paint_text(painter, look.bold, axis.colour, {tip.x() - 18.0, tip.y() + 3.0, 16.0, 16.0},
                   Qt::AlignCenter, axis.name);
      }
    }
  }
  return room;
}

}  // namespace

QString short_number(double value) {
  if (value == 0.0) return QStringLiteral("0");
  if (!std::isfinite(value)) return value > 0.0 ? QStringLiteral("∞") : QStringLiteral("−∞");
  const double size = std::abs(value);
  QString text;
  if (size >= 0.001 && size < 99999.5) {
    const int digits = 2 - static_cast<int>(std::floor(std::log10(size * 1.00001)));
    const double unit = std::pow(10.0, -digits);
    text = QString::number(std::round(size / unit) * unit, 'f', std::max(0, digits));
    if (digits > 0) {
      while (text.endsWith('0')) text.chop(1);
      if (text.endsWith('.')) text.chop(1);
    }
  } else {
    int exponent = static_cast<int>(std::floor(std::log10(size)));
    QString mantissa = QString::number(size / std::pow(10.0, exponent), 'f', 1);
    if (mantissa == QStringLiteral("10.0")) {
      mantissa = QStringLiteral("1.0");
      ++exponent;
    }
    if (mantissa.endsWith(QStringLiteral(".0"))) mantissa.chop(2);
    static const QString raised = QStringLiteral("⁰¹²³⁴⁵⁶⁷⁸⁹");
    text = (mantissa == QStringLiteral("1") ? QString() : mantissa + QStringLiteral("·")) +
           QStringLiteral("10");
    if (exponent < 0) text += QStringLiteral("⁻");
    for (const QChar digit : QString::number(std::abs(exponent))) {
      text += raised[digit.digitValue()];
    }
  }
  return value < 0.0 ? QStringLiteral("−") + text : text;
}

std::vector<double> tick_values(const ColourScale& scale, int wanted) {
  std::vector<double> result;
  const double low = value_at(scale, 0.0);
  const double high = value_at(scale, 1.0);
  if (!(high > low) || wanted < 1 || !std::isfinite(high - low)) return result;
  if (scale.logarithmic && low > 0.0) {
    const double decades = std::log10(high / low);
    const int first = static_cast<int>(std::floor(std::log10(low)));
    const int last = static_cast<int>(std::ceil(std::log10(high)));
    const int every = std::max(1, static_cast<int>(std::ceil(decades / wanted)));
    const bool halves = decades * 3.0 <= wanted + 1.0;
    for (int exponent = first; exponent <= last; ++exponent) {
      if (exponent % every != 0) continue;
      for (const double factor : {1.0, 2.0, 5.0}) {
        const double value = factor * std::pow(10.0, exponent);
        if ((factor == 1.0 || halves) && value >= low && value <= high) result.push_back(value);
      }
    }
    return result;
  }
  double step = round_length((high - low) / wanted);
  while ((high - low) / step > wanted + 0.5) step = round_length(2.51 * step);
  for (double k = std::ceil(low / step); k * step <= high; ++k) result.push_back(k * step);
  return result;
}

double round_length(double most) {
  if (!(most > 0.0) || !std::isfinite(most)) return 0.0;
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= most * (1.0 + 1e-12)) return factor * power;
  }
  return power <= most ? power : power / 2.0;
}

namespace {

/// Scalar bar or legend of classes, then legend of lines; where they are.
std::array<QRectF, 2> paint_panels(QPainter& painter, const Look& look, QSizeF size,
                                   const Overlay& overlay) {
  QRectF bar;
  if (overlay.field) {
    bar = overlay.field->class_names.isEmpty() ? paint_scalar_bar(painter, look, size, overlay)
                                               : paint_class_legend(painter, look, size, overlay);
  }
  QRectF legend;
  if (!overlay.line_types.empty()) legend = paint_line_legend(painter, look, size, overlay, bar);
  return {bar, legend};
}

}  // namespace

std::array<QRectF, 2> overlay_panels(QSizeF size, const Overlay& overlay) {
  QImage nowhere(1, 1, QImage::Format_RGBA8888_Premultiplied);
  QPainter painter(&nowhere);
  return paint_panels(painter, Look(overlay.dark), size, overlay);
}

Overlay part_of(const Overlay& overlay, OverlayPiece piece) {
  Overlay part;
  part.dark = overlay.dark;
  part.scale_bar = overlay.scale_bar;
  part.orientation_marker = overlay.orientation_marker;
  switch (piece) {
    case OverlayPiece::panels:
      part.field = overlay.field;
      part.field_has_undefined = overlay.field_has_undefined;
      part.line_types = overlay.line_types;
      part.unit = overlay.unit;
      break;
    case OverlayPiece::orientation:
      part.axes = overlay.axes;
      break;
    case OverlayPiece::scale_bar:
      part.units_per_pixel = overlay.units_per_pixel;
      part.unit = overlay.unit;
      break;
    case OverlayPiece::hint:
      part.hint = overlay.hint;
      break;
  }
  return part;
}

QRectF paint_piece(QPainter& painter, QSizeF size, const Overlay& overlay, OverlayPiece piece,
                   const std::array<QRectF, 2>& panels) {
  const Look look(overlay.dark);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing |
                         QPainter::SmoothPixmapTransform);
  const auto& [bar, legend] = panels;
  switch (piece) {
    case OverlayPiece::panels: {
      const auto painted = paint_panels(painter, look, size, overlay);
      return painted[0].united(painted[1]);
    }
    case OverlayPiece::orientation:
      return overlay.orientation_marker ? paint_orientation(painter, look, size, overlay, legend)
                                        : QRectF();
    case OverlayPiece::scale_bar:
      return overlay.scale_bar
                 ? paint_scale_bar(painter, look, size, overlay, bar.adjusted(0.0, 0.0, 0.0, 6.0))
                 : QRectF();
    case OverlayPiece::hint:
      return overlay.hint.isEmpty() ? QRectF() : paint_hint(painter, look, size, overlay);
  }
  return {};
}

void paint_overlay(QPainter& painter, QSizeF size, const Overlay& overlay) {
  const std::array<QRectF, 2> panels = overlay_panels(size, overlay);
  for (const OverlayPiece piece : overlay_pieces)
    paint_piece(painter, size, overlay, piece, panels);
}

}  // namespace arris::ui
