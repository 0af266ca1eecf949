#include "core/document/result_table.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include "core/base/number_text.h"
#include "core/base/words.h"
#include "core/mesh/geometry.h"
#include "core/partitions/partition_surfaces.h"
#include "core/partitions/sides.h"

namespace arris {

namespace {

/// All columns there are.
constexpr std::array known_columns{ResultColumn{"name", "", Measure::text},
                                   ResultColumn{"kind", "Kind", Measure::text},
                                   ResultColumn{"line", "Line", Measure::id},
                                   ResultColumn{"convex", "", Measure::flag},
                                   ResultColumn{"angle_degrees", "Angle", Measure::degrees},
                                   ResultColumn{"length", "Length", Measure::length},
                                   ResultColumn{"closed", "Closed", Measure::flag},
                                   ResultColumn{"boundary", "No.", Measure::id},
                                   ResultColumn{"left_partition", "Left", Measure::id},
                                   ResultColumn{"right_partition", "Right", Measure::id},
                                   ResultColumn{"partition", "No.", Measure::id},
                                   ResultColumn{"faces", "", Measure::count},
                                   ResultColumn{"area", "Area", Measure::area},
                                   ResultColumn{"area_share", "Share", Measure::share},
                                   ResultColumn{"sides", "Sides", Measure::count},
                                   ResultColumn{"holes", "Holes", Measure::count},
                                   ResultColumn{"surface", "Type", Measure::text},
                                   ResultColumn{"radius", "", Measure::length},
                                   ResultColumn{"tube_radius", "", Measure::length},
                                   ResultColumn{"half_angle_degrees", "", Measure::degrees},
                                   ResultColumn{"mean_deviation", "Mean off", Measure::length},
                                   ResultColumn{"max_deviation", "Most off", Measure::length},
                                   ResultColumn{"within_tolerance", "Within", Measure::share},
                                   ResultColumn{"approved", "", Measure::flag}};

ResultColumn column(std::string_view key) {
  const auto known = std::ranges::find(known_columns, key, &ResultColumn::key);
  return known != known_columns.end() ? *known : ResultColumn{key, key, Measure::count};
}

}  // namespace

ResultTable table_of(const HandedCurves& curves) {
  ResultTable table{curves.unit, {column("name"), column("kind")}, {}};
  for (const std::string_view key : curves.columns) table.columns.push_back(column(key));
  for (const HandedCurve& curve : curves.curves) {
    std::vector<ResultCell> row{curve.name, std::string(curve.layer)};
    row.insert(row.end(), curve.values.begin(), curve.values.end());
    table.rows.push_back(std::move(row));
  }
  return table;
}

Result<ResultTable> partition_table(const Document& document, const Context& context) {
  const Mesh& mesh = *document.mesh;
  const Partitions& partitions = document.partitions;
  const auto surfaces = fit_partition_surfaces(mesh, document.lines, partitions, context);
  if (!surfaces) return tl::unexpected<Error>(surfaces.error());
  const std::vector<Outline> outlines = outlines_of(mesh, document.lines, partitions);
  const double whole = mesh.area();
  ResultTable table{length_unit_of(document), {}, {}};
  for (const char* key : {"partition", "faces", "area", "area_share", "sides", "holes", "surface",
                          "radius", "tube_radius", "half_angle_degrees", "mean_deviation",
                          "max_deviation", "within_tolerance", "approved"})
    table.columns.push_back(column(key));
  const auto after_surface =
      std::ranges::find(table.columns, "surface", &ResultColumn::key) - table.columns.begin() + 1;
  table.columns.insert(table.columns.begin() + after_surface, {"", "Size", Measure::text});
  for (std::size_t k = 0; k < partitions.partitions.size(); ++k) {
    const Partition& partition = *partitions.partitions[k];
    const PartitionSurface& fit = (*surfaces)[k];
    const Surface& surface = fit.surface;
    const SurfaceType type = surface.type;
    const auto where = [](bool has, double value) {
      return has ? ResultCell(value) : ResultCell();
    };
    const std::size_t loops = outlines[k].loops.size();
    table.rows.push_back(
        {static_cast<double>(partition.id), static_cast<double>(partition.faces), partition.area,
         whole > 0.0 ? partition.area / whole : 0.0, static_cast<double>(outlines[k].sides()),
         static_cast<double>(loops == 0 ? 0 : loops - 1), std::string(name_of(type)),
         size_text(surface, table.unit),
         where(type == SurfaceType::sphere || type == SurfaceType::cylinder ||
                   type == SurfaceType::torus,
               surface.radius),
         where(type == SurfaceType::torus || type == SurfaceType::blend, surface.tube),
         where(type == SurfaceType::cone, surface.half_angle * 180.0 / std::numbers::pi),
         where(fit.fitted, fit.mean_deviation), where(fit.fitted, fit.max_deviation),
         where(fit.fitted, fit.within), partition.locked ? 1.0 : 0.0});
  }
  return table;
}

std::string csv_of(const ResultTable& table) {
  std::string text;
  const auto add_row = [&](const auto& cell_of) {
    bool first = true;
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      if (table.columns[k].key.empty()) continue;
      if (!std::exchange(first, false)) text += ",";
      text += cell_of(k);
    }
    text += "\n";
  };
  add_row([&](std::size_t k) { return std::string(table.columns[k].key); });
  for (const std::vector<ResultCell>& row : table.rows)
    add_row([&](std::size_t k) {
      const auto* word = std::get_if<std::string>(&row[k]);
      const auto* value = std::get_if<double>(&row[k]);
      return word ? *word : value ? number_text(*value, file_digits) : std::string();
    });
  return text;
}

std::string text_of(const ResultCell& cell, Measure measure) {
  constexpr const char* nothing = "–";
  if (const auto* word = std::get_if<std::string>(&cell)) return word->empty() ? nothing : *word;
  const auto* value = std::get_if<double>(&cell);
  if (!value) return nothing;
  switch (measure) {
    case Measure::id:
      return *value == 0.0 ? nothing : fixed_text(*value, 0);
    case Measure::count:
      return fixed_text(*value, 0);
    case Measure::degrees:
      return degrees_in_words(*value);
    case Measure::share:
      return (*value >= 0.9995 ? "100" : fixed_text(100.0 * *value, 1)) + "\u00a0%";
    case Measure::flag:
      return *value != 0.0 ? "yes" : nothing;
    default:
      return measure_text(*value);
  }
}

std::string heading_of(const ResultColumn& column, LengthUnit unit) {
  std::string text(column.title);
  const int power = column.measure == Measure::length ? 1 : column.measure == Measure::area ? 2 : 0;
  const std::string suffix = power != 0 ? unit_text(unit, power) : std::string();
  return suffix.empty() ? text : text + " (" + suffix + ")";
}

}  // namespace arris
