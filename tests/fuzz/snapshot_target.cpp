// The bytes as the snapshot of a document in a session, packed here: whoever has the user's key
// could still have a damaged disk.

#include <zlib.h>

#include "core/base/thread_limit.h"
#include "core/document/document_bytes.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/part.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arris;
  static const ThreadLimit one_thread(1);
  static const Document opened = fuzz::opened_part();
  uLongf made = compressBound(size);
  std::string packed(made, '\0');
  compress2(reinterpret_cast<Bytef*>(packed.data()), &made, data, size, 0);
  packed.resize(made);
  std::string bytes;
  const std::uint32_t layout = 1;
  const std::uint64_t length = size;
  bytes.append(reinterpret_cast<const char*>(&layout), sizeof layout);
  bytes.append(reinterpret_cast<const char*>(&length), sizeof length);
  bytes += packed;
  if (const std::optional<Document> document = document_from(bytes, opened))
    static_cast<void>(hash_of(*document));
  return 0;
}
