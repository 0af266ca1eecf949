#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/accuracy/score.h"
#include "tests/bench/accuracy/table.h"

namespace arris::accuracy {

/// What one method reached on one case.
struct Row {
  std::string case_name;
  std::vector<std::string> groups;
  std::string method;
  Score score;
  double seconds;
};

/// A row for each case and method. Columns in which the part tells nothing hold a dash.
Table case_table(const std::vector<Row>& rows);

/// A row for each group of cases and method, the first groups of all cases first: means over the
/// cases that tell (of F1, corrections for each target and proposals that are right the worst,
/// too), counts and seconds as sums.
Table group_table(const std::vector<Row>& rows);

/// How many proposals the worklist makes and how many of them are right, by kind: a row for each
/// case, then for each group of cases, and method. What makes none has no row; absent where there
/// is no row.
std::optional<Table> proposal_table(const std::vector<Row>& rows);

/// What the headings of the tables mean, in lines of up to 100 characters.
std::string legend();

}  // namespace arris::accuracy
