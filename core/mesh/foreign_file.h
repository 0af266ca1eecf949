#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace arris {

/// A file that is no mesh file of those read here.
struct ForeignFile {
  std::string what;    ///< "a STEP file".
  std::string advice;  ///< What to do about it: "export its surface as STL"; may be empty.
};

/// By its first bytes; nothing where it is none of the kinds that are known.
std::optional<ForeignFile> name_foreign_file(std::string_view bytes);

/// Whether a text is rows of three or more numbers, as scanners write points.
bool is_list_of_points(std::string_view bytes);

}  // namespace arris
