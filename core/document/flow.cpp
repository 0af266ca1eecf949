#include "core/document/flow.h"

namespace arris {

std::vector<Operation> operations_of(Flow flow) {
  if (flow == Flow::scan) return {{"find_sharp_lines"}, {"find_partitions"}};
  return {{"simplify"},
          {"find_sharp_lines", {{"method", "walk"}}},
          {"equilateralize"},
          {"find_partitions", {{"method", "fronts"}}}};
}

}  // namespace arris
