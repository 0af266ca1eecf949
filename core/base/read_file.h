#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "core/base/context.h"
#include "core/base/result.h"

namespace arris {

/// The bytes of a file.
struct FileContent {
  std::unique_ptr<char[]> bytes;
  std::size_t size = 0;
  std::string_view view() const { return {bytes.get(), size}; }
};

/// Reads a whole file. It is copied rather than mapped: a mapped file that another program shortens
/// kills us. Errors: there is none, it is empty, a directory or no ordinary file (nothing is opened
/// that could make us wait), cannot be read, cancelled.
Result<FileContent> read_file(const std::string& path, const Context& context = {});

/// The hash that names a file's content (Hasher).
std::string hash_of_content(std::string_view bytes);

}  // namespace arris
