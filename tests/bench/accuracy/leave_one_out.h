#pragma once

#include <vector>

#include "core/base/result.h"
#include "tests/bench/accuracy/part.h"
#include "tests/bench/accuracy/table.h"

namespace arris::accuracy {

/// How much the default's constants were tuned to the parts they were tuned on: each of them,
/// alone, at some shares of its value; and what a part would take if the best share were chosen on
/// the other parts only. A row for each constant, in corrections over all parts: of lines for
/// constants that lines follow from, of partitions for the others. Parts whose truth does not tell
/// what is to be corrected are left out. Errors: a method that failed.
Result<Table> leave_one_out(const std::vector<Case>& cases, bool quiet);

}  // namespace arris::accuracy
