#include "core/report/histogram_picture.h"

#include <algorithm>
#include <cmath>

#include "core/base/number_text.h"
#include "core/base/words.h"
#include "core/report/markup.h"

namespace arris {

namespace {

// The drawing, in its own units.
constexpr double width = 640.0, height = 240.0;
constexpr double left = 62.0, right = 14.0, top = 26.0, bottom = 44.0;
constexpr std::size_t bins = 72;
constexpr double least_share = 1e-5, most_share = 1.0;

std::string at(double value) { return fixed_text(value, 1); }

double y_of(double share) {
  const double part = (std::log10(std::max(share, least_share)) - std::log10(least_share)) /
                      (std::log10(most_share) - std::log10(least_share));
  return height - bottom - part * (height - bottom - top);
}

/// A round number near a fifth of the range.
double tick_step(double range) {
  const double raw = range / 5.0, power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= raw) return factor * power;
  return 10.0 * power;
}

std::string text(double x, double y, const char* anchor, const std::string& words,
                 const char* colour = "#50575f") {
  return "<text x=\"" + at(x) + "\" y=\"" + at(y) + "\" text-anchor=\"" + anchor + "\" fill=\"" +
         colour + "\">" + escaped(words) + "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, const char* style) {
  return "<line x1=\"" + at(x1) + "\" y1=\"" + at(y1) + "\" x2=\"" + at(x2) + "\" y2=\"" + at(y2) +
         "\" " + style + "/>\n";
}

}  // namespace

std::string histogram_svg(const Distribution& distribution, const HistogramPicture& picture) {
  const double range = picture.high - picture.low;
  const auto x_of = [&](double value) {
    return left + (value - picture.low) / range * (width - left - right);
  };
  // Three times as large for paper; a page gives it its size.
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " +
                    fixed_text(width, 0) + " " + fixed_text(height, 0) + "\" width=\"" +
                    fixed_text(3.0 * width, 0) + "\" height=\"" + fixed_text(3.0 * height, 0) +
                    "\" font-family=\"sans-serif\" font-size=\"12\">\n";
  constexpr std::pair<double, const char*> shares[] = {
      {1e-5, "0.001 %"}, {1e-4, "0.01 %"}, {1e-3, "0.1 %"}, {1e-2, "1 %"}, {0.1, "10 %"}};
  for (const auto& [share, words] : shares) {
    svg += line(left, y_of(share), width - right, y_of(share), "stroke=\"#e3e6e9\"");
    svg += text(left - 6.0, y_of(share) + 4.0, "end", words);
  }
  if (!distribution.empty() && range > 0.0 && std::isfinite(range)) {
    const Distribution::Bins found = distribution.bins(picture.low, picture.high, bins, false);
    for (std::size_t k = 0; k < found.shares.size(); ++k) {
      if (!(found.shares[k] > least_share)) continue;
      const double x = x_of(found.edges[k]), y = y_of(found.shares[k]);
      svg += "<rect x=\"" + at(x) + "\" y=\"" + at(y) + "\" width=\"" +
             at(x_of(found.edges[k + 1]) - x) + "\" height=\"" + at(height - bottom - y) +
             "\" fill=\"#5b84b1\"/>\n";
    }
    const double step = tick_step(range);
    for (double value = std::ceil(picture.low / step) * step; value <= picture.high + 1e-9 * range;
         value += step) {
      svg += line(x_of(value), height - bottom, x_of(value), height - bottom + 4.0,
                  "stroke=\"#9aa1a8\"");
      svg += text(x_of(value), height - bottom + 17.0, "middle",
                  number_text(std::abs(value) < 1e-9 * step ? 0.0 : value, 4));
    }
    for (const MarkedValue& mark : picture.marks) {
      if (mark.value < picture.low || mark.value > picture.high) continue;
      const double x = x_of(mark.value);
      const bool late = x > 0.7 * width;
      svg += line(x, top - 8.0, x, height - bottom, "stroke=\"#c0392b\" stroke-width=\"1.5\"");
      svg += text(x + (late ? -5.0 : 5.0), top - 2.0, late ? "end" : "start", mark.text, "#c0392b");
    }
  }
  svg += line(left, height - bottom, width - right, height - bottom, "stroke=\"#9aa1a8\"");
  svg += text(left + 0.5 * (width - left - right), height - 8.0, "middle", picture.title);
  return svg + "</svg>\n";
}

}  // namespace arris
