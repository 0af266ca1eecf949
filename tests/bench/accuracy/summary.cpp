#include "tests/bench/accuracy/summary.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "core/base/number_text.h"

namespace arris::accuracy {

namespace {

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
  const auto of_row = [](auto value) {
    return [value](const Row& row) { return value(row.score.lines, row.score.partitions); };
  };
  using L = LineScore;
  using P = PartitionScore;
  static const std::vector<Column> table{
      {"prec", of_row([](const L& l, const P&) { return l.precision; }), 3, Fold::mean},
      {"recall", of_row([](const L& l, const P&) { return l.recall; }), 3, Fold::mean},
      {"F1", of_row([](const L& l, const P&) { return l.f1; }), 3, Fold::mean},
      {"ratio", of_row([](const L& l, const P&) { return l.length_ratio; }), 2, Fold::mean},
      {"lines", of_row([](const L& l, const P&) { return counted(true, l.lines); }), 0, Fold::sum},
      {"/curve", of_row([](const L& l, const P&) { return l.lines_per_curve; }), 2, Fold::mean},
      {"false", of_row([](const L& l, const P&) { return l.long_false_lines; }), 0, Fold::sum},
      {"IoU", of_row([](const L&, const P& p) { return p.mean_iou; }), 3, Fold::mean},
      {"Rand", of_row([](const L&, const P& p) { return p.rand; }), 3, Fold::mean},
      {"asgd", of_row([](const L&, const P& p) { return p.assigned; }), 3, Fold::mean},
      {"large", of_row([](const L&, const P& p) { return p.largest; }), 2, Fold::mean},
      {"turn", of_row([](const L&, const P& p) { return p.turning; }), 2, Fold::mean},
      {"waves", of_row([](const L&, const P& p) { return p.smoothed_turning; }), 2, Fold::mean},
      {"add", of_lines(&L::adds), 0, Fold::sum},
      {"del", of_lines(&L::deletes), 0, Fold::sum},
      {"merge", of_lines(&L::merges), 0, Fold::sum},
      {"conn", of_partitions(&P::connects), 0, Fold::sum},
      {"split", of_partitions(&P::splits), 0, Fold::sum},
      {"rest", of_partitions(&P::restarts), 0, Fold::sum},
      {"corr",
       [](const Row& row) { return counted(row.score.has_corrections(), row.score.corrections()); },
       0, Fold::sum},
      {"/target",
       [](const Row& row) {
         return row.score.has_corrections() ? row.score.corrections_per_target() : unknown;
       },
       2, Fold::mean},
      {"prop",
       [](const Row& row) {
         return counted(row.score.proposals.has_value(), row.score.proposals_made());
       },
       0, Fold::sum},
      {"right", [](const Row& row) { return row.score.right_share(); }, 2, Fold::mean},
      {"sec", [](const Row& row) { return row.seconds; }, 2, Fold::sum},
  };
  return table;
}

double folded(const std::vector<const Row*>& rows, const Column& column) {
  double sum = 0.0, count = 0.0;
  for (const Row* row : rows)
    if (const double value = column.value(*row); !std::isnan(value)) {
      sum += value;
      ++count;
    }
  return count == 0.0 ? unknown : column.fold == Fold::sum ? sum : sum / count;
}

// Worst of the cases that tell: fmin and fmax pass NaN over.

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

double worst_right(const std::vector<const Row*>& rows) {
  double worst = unknown;
  for (const Row* row : rows) worst = std::fmin(worst, row->score.right_share());
  return worst;
}

/// Each group with each method, and their rows: the first groups of all cases first.
struct Group {
  std::string name, method;
  std::vector<const Row*> rows;
};

std::vector<Group> groups_of(const std::vector<Row>& rows) {
  std::vector<std::string> names, methods;
  const auto note = [](std::vector<std::string>& list, const std::string& name) {
    if (std::ranges::find(list, name) == list.end()) list.push_back(name);
  };
  std::size_t levels = 0;
  for (const Row& row : rows) {
    levels = std::max(levels, row.groups.size());
    note(methods, row.method);
  }
  for (std::size_t level = 0; level < levels; ++level)
    for (const Row& row : rows)
      if (level < row.groups.size()) note(names, row.groups[level]);
  std::vector<Group> groups;
  for (const std::string& name : names)
    for (const std::string& method : methods) {
      Group group{name, method, {}};
      for (const Row& row : rows)
        if (row.method == method && std::ranges::find(row.groups, name) != row.groups.end())
          group.rows.push_back(&row);
      if (!group.rows.empty()) groups.push_back(std::move(group));
    }
  return groups;
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
  header.insert(header.end(), {"worst F1", "worst /target", "worst right"});
  Table table(std::move(header));
  for (const Group& group : groups_of(rows)) {
    std::vector<std::string> cells{group.name, group.method, std::to_string(group.rows.size())};
    for (const Column& column : columns())
      cells.push_back(cell(folded(group.rows, column), column.decimals));
    cells.push_back(cell(worst_f1(group.rows), 3));
    cells.push_back(cell(worst_per_target(group.rows), 2));
    cells.push_back(cell(worst_right(group.rows), 2));
    table.add(std::move(cells));
  }
  return table;
}

std::optional<Table> proposal_table(const std::vector<Row>& rows) {
  std::vector<WorkKind> kinds;
  for (const Row& row : rows)
    if (row.score.proposals)
      for (const ProposalCount& count : *row.score.proposals)
        if (std::ranges::find(kinds, count.kind) == kinds.end()) kinds.push_back(count.kind);
  if (kinds.empty()) return std::nullopt;
  std::ranges::sort(kinds);
  std::vector<std::string> header{"case", "method"};
  for (const WorkKind kind : kinds) {
    header.emplace_back(name_of(kind));
    header.emplace_back("right");
  }
  Table table(std::move(header));
  const auto add = [&](const std::string& name, const std::string& method,
                       const std::vector<const Row*>& own) {
    std::map<WorkKind, ProposalCount> sums;
    for (const Row* row : own)
      if (row->score.proposals)
        for (const ProposalCount& count : *row->score.proposals) {
          sums[count.kind].made += count.made;
          sums[count.kind].right += count.right;
        }
    if (sums.empty()) return;
    std::vector<std::string> cells{name, method};
    for (const WorkKind kind : kinds) {
      cells.push_back(std::to_string(sums[kind].made));
      cells.push_back(std::to_string(sums[kind].right));
    }
    table.add(std::move(cells));
  };
  for (const Row& row : rows) add(row.case_name, row.method, {&row});
  for (const Group& group : groups_of(rows)) add(group.name, group.method, group.rows);
  return table;
}

std::string legend() {
  return "Lines, by length: prec(ision), recall, F1, ratio of found to true length, lines found,\n"
         "  lines for each true curve, false: lines over ten edges where there is no true one.\n"
         "Partitions, by area: IoU of the true patches, Rand index, asgd: share assigned, large:\n"
         "  share of the largest; of borders that are no lines against the truth's: turn, along\n"
         "  the edges of the mesh, and waves, with the zigzag of the mesh averaged away.\n"
         "Corrections: lines to add, del(ete), merge; partitions to conn(ect), split, rest(art);\n"
         "  corr: all of them, /target: for each true curve and patch.\n"
         "Worklist: prop(osals), right: share of them that the truth agrees with. sec(onds).\n";
}

}  // namespace arris::accuracy
