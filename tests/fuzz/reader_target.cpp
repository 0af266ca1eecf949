// A reader: the bytes as a file of ARRIS_FUZZ_FORMAT. What is read is built into a mesh, too.

#include "core/mesh/scan.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/packing.h"
#include "tests/support/whole_flow.h"

namespace {

/// Checksums would find out any change of what is packed: bytes that are not packed are packed
/// here.
std::string as_file(std::string_view bytes) {
  const std::string_view format = ARRIS_FUZZ_FORMAT;
  if (format == "gz" && !bytes.starts_with("\x1F\x8B"))
    return arris::testing::gzipped(std::string(bytes));
  if (format == "3mf" && !bytes.starts_with("PK"))
    return arris::testing::zipped({{"3D/3dmodel.model", std::string(bytes)}});
  return std::string(bytes);
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arris;
  if (size == 0) return 0;
  static const std::string path = "part." ARRIS_FUZZ_FORMAT;
  Result<PolygonFile> file = fail("");
  fuzz::require_none(testing::fault_of_reading(path, as_file(fuzz::text_of(data, size)), file));
  if (!file || file->polygon_count() > 200) return 0;
  for (const bool weld : {true, false}) {
    const Result<ScanPtr> scan = make_scan(PolygonFile(*file), path, {}, {.weld = weld});
    if (!scan) fuzz::require_sentence(scan.error().message);
  }
  return 0;
}
