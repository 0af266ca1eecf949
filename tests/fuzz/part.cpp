#include "tests/fuzz/part.h"

#include "tests/fuzz/fuzz.h"
#include "tests/support/documents.h"
#include "tests/support/whole_flow.h"

namespace arris::fuzz {

std::string part_bytes() {
  testing::Triangles part = testing::divided_cube(10.0, 3);
  part.triangles.resize(part.triangles.size() - 4);  // open
  return testing::ply_bytes(testing::noisy(part, 0.05, 7));
}

Document opened_part() {
  return testing::applied(Document(), {"open", {{"file", file_with("part.ply", part_bytes())}}});
}

Document divided_part() {
  Document document = testing::divided_at_edges(opened_part());
  const auto& lines = document.lines.lines;
  if (!lines.empty())
    document = testing::applied(document, {"delete_lines", {{"lines", {lines.front()->id}}}});
  const auto& partitions = document.partitions.partitions;
  if (!partitions.empty())
    document = testing::applied(document,
                                {"remove_partitions", {{"partitions", {partitions.back()->id}}}});
  return document;
}

}  // namespace arris::fuzz
