#pragma once

#include <QString>

#include "core/document/document.h"

namespace arris::ui {

/// What follows a length (power 1), an area (2) or a curvature (−1, −2): " mm", " mm²", …; nothing
/// where the unit is unknown.
inline QString unit_suffix(LengthUnit unit, int power = 1) {
  const std::string text = unit_text(unit, power);
  return text.empty() ? QString() : " " + QString::fromStdString(text);
}
inline QString unit_suffix(const Document& document, int power = 1) {
  return unit_suffix(length_unit_of(document), power);
}

/// The same in a sentence, where a bare number would hang in the air: " units", " units²".
inline QString unit_in_sentence(LengthUnit unit, int power = 1) {
  if (unit != LengthUnit::unknown) return unit_suffix(unit, power);
  return power == 2 ? QStringLiteral(" units²") : QStringLiteral(" units");
}

}  // namespace arris::ui
