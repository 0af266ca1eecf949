#pragma once

#include <string>
#include <string_view>

#include "core/base/context.h"
#include "core/base/result.h"

namespace arris {

/// Whether the bytes begin as a gzip file does.
bool is_gzip(std::string_view bytes);

/// The content of a gzip file (of several parts one after the other, too). `path` is for errors:
/// damaged or cut off data, and content of more than most_growth() bytes.
Result<std::string> gunzip(const std::string& path, std::string_view bytes, const Context& context);

/// How large the content of a compressed file of `size` bytes may be: a mesh packs to a tenth or
/// so, what packs to less than a 200th part is none and could fill the memory.
constexpr std::size_t most_growth(std::size_t size) { return 200 * size + (std::size_t{1} << 20); }

}  // namespace arris
