#include "tests/bench/accuracy/summary.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/base/number_text.h"

namespace arris::accuracy {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

std::string cell(double value, int decimals) {
  return std::isnan(value) ? "-" : fixed_text(value, decimals);
}

double counted(bool is_known, std::size_t count) {
  return is_known ? static_cast<double>(count) : unknown;
}

enum class Fold { mean, sum };

struct Column {
  const char* title;
  std::function<double(const Row&)> value;  // NaN: not known
  int decimals;
  Fold fold;
};

const std::vector<Column>& columns() {
  using Lines = std::size_t LineScore::*;
  using Partitions = std::size_t PartitionScore::*;
  const auto of_lines = [](Lines member) {
    return [member](const Row& row) {
      const LineScore& lines = row.score.lines;
      return counted(lines.has_corrections, lines.*member);
    };
  };
  const auto of_partitions = [](Partitions member) {
    return [member](const Row& row) {
      const PartitionScore& partitions = row.score.partitions;
      return counted(partitions.has_corrections, partitions.*member);
    };
  };
  static const std::vector<Column> table{
      {"precision", [](const Row& row) { return row.score.lines.precision; }, 3, Fold::mean},
      {"recall", [](const Row& row) { return row.score.lines.recall; }, 3, Fold::mean},
      {"F1", [](const Row& row) { return row.score.lines.f1; }, 3, Fold::mean},
      {"ratio", [](const Row& row) { return row.score.lines.length_ratio; }, 2, Fold::mean},
      {"lines", [](const Row& row) { return counted(true, row.score.lines.lines); }, 0, Fold::sum},
      {"a curve", [](const Row& row) { return row.score.lines.lines_per_curve; }, 2, Fold::mean},
      {"false >10", [](const Row& row) { return row.score.lines.long_false_lines; }, 0, Fold::sum},
      {"IoU", [](const Row& row) { return row.score.partitions.mean_iou; }, 3, Fold::mean},
      {"assigned", [](const Row& row) { return row.score.partitions.assigned; }, 2, Fold::mean},
      {"add", of_lines(&LineScore::adds), 0, Fold::sum},
      {"delete", of_lines(&LineScore::deletes), 0, Fold::sum},
      {"merge", of_lines(&LineScore::merges), 0, Fold::sum},
      {"connect", of_partitions(&PartitionScore::connects), 0, Fold::sum},
      {"split", of_partitions(&PartitionScore::splits), 0, Fold::sum},
      {"restart", of_partitions(&PartitionScore::restarts), 0, Fold::sum},
      {"corrections",
       [](const Row& row) { return counted(row.score.has_corrections(), row.score.corrections()); },
       0, Fold::sum},
      {"a target",
       [](const Row& row) {
         return row.score.has_corrections() ? row.score.corrections_per_target() : unknown;
       },
       2, Fold::mean},
      {"seconds", [](const Row& row) { return row.seconds; }, 2, Fold::sum},
  };
  return table;
}

double fold(const std::vector<const Row*>& rows, const Column& column) {
  double sum = 0.0, count = 0.0;
  for (const Row* row : rows)
    if (const double value = column.value(*row); !std::isnan(value)) {
      sum += value;
      ++count;
    }
  return count == 0.0 ? unknown : column.fold == Fold::sum ? sum : sum / count;
}

/// fmin and fmax pass NaN over.
double worst_f1(const std::vector<const Row*>& rows) {
  double worst = unknown;
  for (const Row* row : rows) worst = std::fmin(worst, row->score.lines.f1);
  return worst;
}

double worst_per_target(const std::vector<const Row*>& rows) {
  double worst = unknown;
  for (const Row* row : rows)
    if (row->score.has_corrections()) worst = std::fmax(worst, row->score.corrections_per_target());
  return worst;
}

}  // namespace

Table case_table(const std::vector<Row>& rows) {
  std::vector<std::string> header{"case", "method"};
  for (const Column& column : columns()) header.emplace_back(column.title);
  Table table(std::move(header));
  for (const Row& row : rows) {
    std::vector<std::string> cells{row.case_name, row.method};
    for (const Column& column : columns())
      cells.push_back(cell(column.value(row), column.decimals));
    table.add(std::move(cells));
  }
  return table;
}

Table group_table(const std::vector<Row>& rows) {
  std::vector<std::string> header{"group", "method", "cases"};
  for (const Column& column : columns()) header.emplace_back(column.title);
  header.insert(header.end(), {"worst F1", "worst a target"});
  Table table(std::move(header));

  std::vector<std::string> groups, methods;
  const auto note = [](std::vector<std::string>& names, const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  std::size_t levels = 0;
  for (const Row& row : rows) {
    levels = std::max(levels, row.groups.size());
    note(methods, row.method);
  }
  for (std::size_t level = 0; level < levels; ++level)
    for (const Row& row : rows)
      if (level < row.groups.size()) note(groups, row.groups[level]);
  for (const std::string& group : groups)
    for (const std::string& method : methods) {
      std::vector<const Row*> own;
      for (const Row& row : rows)
        if (row.method == method && std::ranges::find(row.groups, group) != row.groups.end())
          own.push_back(&row);
      if (own.empty()) continue;
      std::vector<std::string> cells{group, method, std::to_string(own.size())};
      for (const Column& column : columns())
        cells.push_back(cell(fold(own, column), column.decimals));
      cells.push_back(cell(worst_f1(own), 3));
      cells.push_back(cell(worst_per_target(own), 2));
      table.add(std::move(cells));
    }
  return table;
}

}  // namespace arris::accuracy
