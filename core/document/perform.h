#pragma once

#include <string>

#include "core/base/file_source.h"
#include "core/document/document.h"
#include "core/document/operation.h"

namespace arris {

/// perform() of operation.h where the files that were opened may be elsewhere by now: `open` with a
/// hash takes them from `files`. Null: they are where they were.
Result<Performed> perform(const Document& document, const Operation& operation,
                          const FileSource* files, const Context& context);

/// The path that a resolved `open` names, whatever its bytes.
std::string opened_path(const nlohmann::json& parameters);

}  // namespace arris
