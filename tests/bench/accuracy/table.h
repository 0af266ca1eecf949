#pragma once

#include <string>
#include <vector>

namespace arris::accuracy {

/// A table printed to standard output, plain or as Markdown. The first two columns are text.
class Table {
 public:
  explicit Table(std::vector<std::string> header) : rows_{std::move(header)} {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  void print(bool markdown) const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace arris::accuracy
