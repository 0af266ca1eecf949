#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/context.h"
#include "core/document/document.h"

namespace arris {

/// What makes a document beside its scan, packed: meshes, zones, lines, partitions, corrections and
/// steps. Not what is derived from them and not needed at once, as evidence for lines, and not
/// smoothed curvatures: nothing where there are some.
std::optional<std::string> bytes_of(const Document& document);

/// The document that bytes_of() was made of; `opened` is the document as its scan was opened. The
/// bytes may be a stranger's: nothing where they are damaged, or say what cannot be, as an element
/// that the mesh does not have. Whether it is the document that was meant tells its hash.
std::optional<Document> document_from(std::string_view bytes, const Document& opened,
                                      const Context& context = {});

}  // namespace arris
