#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "tests/bench/accuracy/part.h"

namespace arris::accuracy {

/// A way from a scan to lines and partitions.
struct Method {
  std::string name;
  std::function<Result<Found>(const ScanPtr&)> run;
};

/// The methods every run compares. A new row is a name and a list of operations. `with_ideas`: the
/// default method with each of its ideas switched off, too.
std::vector<Method> method_table(bool with_ideas);

/// Operations of the document in their order, as JSON objects with parameters; what is left out
/// takes its default from the part. The labels are those carried to the scan.
/// Errors: not a JSON array of operations.
Result<Method> operations_method(const std::string& name, std::string_view operations);

}  // namespace arris::accuracy
