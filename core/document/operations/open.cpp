#include "core/document/operations/operations.h"

namespace arris {

namespace {

Result<nlohmann::json> resolve_open(const Document&, const nlohmann::json& given) {
  ParameterReader reader("open", given);
  const std::string file = reader.text("file", "");
  // A journal and every report are UTF-8: a name that is not could not be written down.
  if (!is_utf8(file))
    return fail("open: the name of the file is not valid UTF-8; rename it, then open it again.");
  if (file.empty()) reader.fault("file", "the path of a mesh file");
  // Known only once the file is read; perform() adds it then.
  if (reader.has("hash")) reader.text("hash", "");
  return reader.finish();
}

Result<Document> apply_open(const Document& document, const nlohmann::json& parameters,
                            const Context& context) {
  const std::string path = parameters.at("file");
  Result<ScanPtr> scan = load_scan(path, context.part(0.0, 0.7));
  if (!scan) return tl::unexpected<Error>(scan.error());
  if (parameters.contains("hash") && parameters["hash"] != (*scan)->report.content_hash)
    return fail(path + " is not the file that was opened then: its content has changed.");
  Document result;
  result.scan = *scan;
  result.scan_path = path;
  result.mesh = (*scan)->mesh;
  const Result<CurvaturesPtr> curvatures =
      compute_curvatures(*result.mesh, {}, context.part(0.7, 1.0));
  if (!curvatures) return tl::unexpected<Error>(curvatures.error());
  result.curvatures = *curvatures;
  result.evidence = std::make_shared<const SharedLineEvidence>(result.mesh, result.curvatures);
  result.opened = {result.mesh, result.curvatures, nullptr, result.evidence};
  result.next_id = document.next_id;  // ids are never used twice in one history
  return result;
}

std::string gist_open(const nlohmann::json& parameters) {
  const std::string path = parameters.value("file", "");
  const std::size_t slash = path.find_last_of("/\\");
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

}  // namespace

const OperationKind open_operation{"open", "Open", 1, resolve_open, apply_open, gist_open};

}  // namespace arris
