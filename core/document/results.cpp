#include "core/document/results.h"

#include <array>

#include "core/base/write_file.h"
#include "core/document/curve_files.h"
#include "core/document/journal.h"
#include "core/document/partition_files.h"
#include "core/document/result_table.h"
#include "core/mesh/write_ply.h"

namespace arris {

namespace {

using Curves = HandedCurves (*)(const Document&);

template <Curves curves, std::string (*text)(const HandedCurves&)>
Result<void> write_curves(const std::string& path, const History& history) {
  return write_file_whole(path, text(curves(history.current())));
}

std::string curve_table(const HandedCurves& curves) { return csv_of(table_of(curves)); }

template <std::string (*text)(const Document&)>
Result<void> write_text(const std::string& path, const History& history) {
  return write_file_whole(path, text(history.current()));
}

Result<void> write_partition_table(const std::string& path, const History& history) {
  return partition_table(history.current()).and_then([&](const ResultTable& table) {
    return write_file_whole(path, csv_of(table));
  });
}

Result<void> write_scan_partitions(const std::string& path, const History& history) {
  const Document& document = history.current();
  return write_labelled_scan(path, *document.scan, labels_on_scan(document),
                             length_unit_of(document));
}

Result<void> write_operations(const std::string& path, const History& history) {
  return write_file_whole(path, journal_text(history));
}

}  // namespace

std::span<const ResultFile> result_files() {
  static constexpr std::array files{
      ResultFile{"lines.obj", "Sharp lines as polylines", true,
                 write_curves<handed_lines, curves_obj>},
      ResultFile{"lines.step", "Sharp lines for CAD, as curves", false,
                 write_curves<handed_lines, curves_step>},
      ResultFile{"lines.dxf", "Sharp lines for CAD, convex and concave on layers", false,
                 write_curves<handed_lines, curves_dxf>},
      ResultFile{"lines.vtp", "Sharp lines for ParaView, with their angles", false,
                 write_curves<handed_lines, curves_vtp>},
      ResultFile{"lines.csv", "Sharp lines point by point, for spreadsheets", false,
                 write_curves<handed_lines, curves_csv>},
      ResultFile{"boundaries.obj", "Boundaries of partitions as polylines", true,
                 write_curves<handed_boundaries, curves_obj>},
      ResultFile{"boundaries.step", "Boundaries for CAD, as curves", false,
                 write_curves<handed_boundaries, curves_step>},
      ResultFile{"boundaries.dxf", "Boundaries for CAD, their types on layers", false,
                 write_curves<handed_boundaries, curves_dxf>},
      ResultFile{"boundaries.vtp", "Boundaries for ParaView, with their partitions", false,
                 write_curves<handed_boundaries, curves_vtp>},
      ResultFile{"boundaries.csv", "Boundaries point by point, for spreadsheets", false,
                 write_curves<handed_boundaries, curves_csv>},
      ResultFile{"scan_partitions.ply", "The scan, each face with its partition", true,
                 write_scan_partitions},
      ResultFile{"partitions.obj", "Partitions as groups of one mesh", false,
                 write_text<partitions_obj>},
      ResultFile{"partitions.vtp", "Partitions for ParaView", false, write_text<partitions_vtp>},
      ResultFile{"line_table.csv", "Table of the sharp lines", false,
                 write_curves<handed_lines, curve_table>},
      ResultFile{"boundary_table.csv", "Table of the boundaries", false,
                 write_curves<handed_boundaries, curve_table>},
      ResultFile{"partition_table.csv", "Table of the partitions with their fitted surfaces", false,
                 write_partition_table},
      ResultFile{"operations.jsonl", "The operations, to be replayed", true, write_operations}};
  return files;
}

}  // namespace arris
