#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/manual_page.h"
#include "core/document/operation.h"

namespace arris {

/// What is known of a parameter from the operation that reads it.
struct ParameterManual {
  std::string name;
  /// What a value must be: "a number from 0.1 to 179.9". Empty: no value is refused by itself.
  std::string expected;
  bool range_depends_on_part = false;  ///< `expected` is that of the sample mould.
  /// What is missing where neither it nor another in its place is given; empty: it may be left out.
  std::string required;
  /// What stands for it where it is left out; nothing: nothing does.
  std::optional<nlohmann::json> otherwise;
  bool depends_on_part = false;  ///< `otherwise` is that of the sample mould.
};

struct OperationManual {
  const OperationKind* kind;
  std::vector<ParameterManual> parameters;  ///< In the order in which they are read.
};

/// All operations of the table with their parameters. They are asked, not described a second time:
/// each is resolved on two sample moulds, with values that it refuses and without. Errors: the
/// sample cannot be made.
Result<std::vector<OperationManual>> operation_manual();

/// The same as sections of a page.
void add_operations(ManualPage& page, const std::vector<OperationManual>& operations);

}  // namespace arris
