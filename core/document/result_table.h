#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/document/document.h"
#include "core/document/handed_curves.h"

namespace arris {

/// What the values of a column are.
enum class Measure { text, id, count, length, area, degrees, share, flag };

struct ResultColumn {
  std::string_view key;    ///< As in files: "half_angle_degrees"; empty: nothing for files.
  std::string_view title;  ///< As people read it: "Half angle"; empty: nothing for people.
  Measure measure;
};

/// Text, number, or nothing.
using ResultCell = std::variant<std::monostate, std::string, double>;

/// Lines, boundaries or partitions, a row each: what the CSV files and the report say of them.
struct ResultTable {
  LengthUnit unit;
  std::vector<ResultColumn> columns;
  std::vector<std::vector<ResultCell>> rows;  ///< A cell for each column.
};

/// A row for each curve: name, kind, its values.
ResultTable table_of(const HandedCurves& curves);

/// A row for each partition: size, sides, the surface fitted to it and how far off it lies. Errors:
/// cancelled.
Result<ResultTable> partition_table(const Document& document, const Context& context = {});

/// Comma separated, keys first; numbers with 12 digits.
std::string csv_of(const ResultTable& table);

/// A cell as people read it: "12.3", "27°", "yes", "–" for nothing. Lengths and areas without their
/// unit, which heading_of() names.
std::string text_of(const ResultCell& cell, Measure measure);
std::string heading_of(const ResultColumn& column, LengthUnit unit);  ///< "Length (mm)".

}  // namespace arris
