#pragma once

#include <string>

#include "core/base/context.h"
#include "core/base/read_file.h"
#include "core/base/result.h"
#include "core/mesh/polygon_file.h"
#include "core/mesh/scan.h"

/// Scans from the content of files that were read already; `path` stands for the file's name.
namespace arris {

/// As read_polygon_file().
Result<PolygonFile> read_polygon_content(const std::string& path, FileContent content,
                                         const Context& context = {});
/// As load_scan().
Result<ScanPtr> load_scan_content(const std::string& path, FileContent content,
                                  const Context& context = {}, const ScanOptions& options = {});

}  // namespace arris
