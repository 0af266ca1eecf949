// The bytes as operations, a line each, on a document that has lines, partitions and corrections.
// Each is a value or an error that is a sentence, and what it leads to can be written down.

#include "core/base/thread_limit.h"
#include "core/document/document_bytes.h"
#include "core/document/journal.h"
#include "core/document/operation.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/part.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arris;
  static const ThreadLimit one_thread(1);
  static const Document start = fuzz::divided_part();
  Document document = start;
  std::string_view rest = fuzz::text_of(data, size);
  for (int k = 0; k < 6 && !rest.empty(); ++k) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    const nlohmann::json json = parse_record(line);
    if (json.is_discarded()) continue;
    const Result<Operation> operation = Operation::from_json(json);
    if (!operation) {
      fuzz::require_sentence(operation.error().message);
      continue;
    }
    if (operation->name == "open") continue;
    fuzz::require_none(describe(*operation).empty() ? "it has no words" : "");
    const Result<Document> done = apply(document, *operation);
    if (!done) {
      fuzz::require_sentence(done.error().message);
      continue;
    }
    static_cast<void>(hash_of(*done));
    document = *done;
  }
  return 0;
}
