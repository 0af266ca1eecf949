#include "tests/bench/accuracy/table.h"

#include <algorithm>
#include <cstdio>

namespace arris::accuracy {

namespace {

constexpr std::size_t text_columns = 2;

}  // namespace

void Table::print(bool markdown) const {
  std::vector<std::size_t> widths(rows_.front().size(), 0);
  for (const auto& row : rows_)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  const char* between = markdown ? " | " : "  ";
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    std::string line = markdown ? "| " : "";
    for (std::size_t k = 0; k < widths.size(); ++k) {
      const std::string& cell = rows_[r][k];
      const std::string padding(widths[k] - cell.size(), ' ');
      line += (k ? between : "") + (k < text_columns ? cell + padding : padding + cell);
    }
    std::printf("%s%s\n", line.c_str(), markdown ? " |" : "");
    if (markdown && r == 0) {
      std::string rule = "|";
      for (std::size_t k = 0; k < widths.size(); ++k) rule += k < text_columns ? "---|" : "---:|";
      std::printf("%s\n", rule.c_str());
    }
  }
  std::fflush(stdout);
}

}  // namespace arris::accuracy
