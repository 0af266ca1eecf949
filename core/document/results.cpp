#include "core/document/results.h"

#include <array>

#include "core/base/write_file.h"
#include "core/document/export.h"
#include "core/document/journal.h"
#include "core/mesh/write_ply.h"

namespace arris {

std::span<const ResultFile> result_files() {
  static constexpr std::array files{
      ResultFile{"lines.obj",
                 [](const std::string& path, const History& history) {
                   return write_file_whole(path, lines_obj(history.current()));
                 }},
      ResultFile{"boundaries.obj",
                 [](const std::string& path, const History& history) {
                   return write_file_whole(path, boundaries_obj(history.current()));
                 }},
      ResultFile{"scan_partitions.ply",
                 [](const std::string& path, const History& history) {
                   const Document& document = history.current();
                   return write_labelled_scan(path, *document.scan, labels_on_scan(document),
                                              length_unit_of(document));
                 }},
      ResultFile{"operations.jsonl", [](const std::string& path, const History& history) {
                   return write_file_whole(path, journal_text(history));
                 }}};
  return files;
}

}  // namespace arris
