#include <charconv>
#include <optional>
#include <string>
#include <utility>

#include "core/document/operations/operations.h"
#include "core/document/perform.h"
#include "core/mesh/scan_content.h"

namespace arris {

namespace {

std::string to_hexadecimal(const std::string& bytes) {
  constexpr char digits[] = "0123456789abcdef";
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    text += {digits[byte >> 4], digits[byte & 15]};
  }
  return text;
}

/// Nothing where the text is not pairs of hexadecimal digits.
std::optional<std::string> from_hexadecimal(const std::string& text) {
  if (text.size() % 2 != 0) return std::nullopt;
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); i += 2) {
    unsigned value = 0;
    const auto [end, error] = std::from_chars(text.data() + i, text.data() + i + 2, value, 16);
    if (error != std::errc() || end != text.data() + i + 2) return std::nullopt;
    bytes += static_cast<char>(value);
  }
  return bytes;
}

Result<nlohmann::json> resolve_open(const Document&, const nlohmann::json& given) {
  ParameterReader reader("open", given);
  const std::string file = reader.text("file", "");
  // A journal and every report are UTF-8: a name that is not could not be written down.
  if (!is_utf8(file))
    return fail("open: the name of the file is not valid UTF-8; it is given by \"file_bytes\".");
  if (file.empty()) reader.fault("file", "the path of a mesh file");
  if (reader.has("file_bytes") &&
      from_hexadecimal(reader.text("file_bytes", "")).value_or("").empty())
    reader.fault("file_bytes", "the bytes of a path in hexadecimal digits");
  reader.flag("weld", true);
  // Known only once the file is read; perform() adds it then.
  if (reader.has("hash")) reader.text("hash", "");
  return reader.finish();
}

/// Before version 2 nothing was joined but the corners of STL.
nlohmann::json upgrade_open(int, nlohmann::json parameters) {
  parameters["weld"] = false;
  return parameters;
}

Result<Document> apply_open(const Document& document, const nlohmann::json& parameters,
                            const Context& context) {
  return open_scan_of(document, parameters, nullptr, context);
}

std::string words_of_open(const nlohmann::json& parameters) {
  const std::string path = parameters.value("file", "");
  const std::size_t slash = path.find_last_of("/\\");
  return "Open " + (slash == std::string::npos ? path : path.substr(slash + 1));
}

}  // namespace

const OperationKind open_operation{"open",     "Open",        2,           resolve_open,
                                   apply_open, words_of_open, upgrade_open};

std::string opened_path(const nlohmann::json& parameters) {
  if (parameters.contains("file_bytes"))
    return from_hexadecimal(parameters["file_bytes"]).value_or("");
  return parameters.at("file");
}

Result<Document> open_scan_of(const Document& document, const nlohmann::json& parameters,
                              const FileSource* files, const Context& context) {
  const std::string path = opened_path(parameters);
  const ScanOptions options{.weld = parameters.at("weld")};
  const auto load = [&]() -> Result<ScanPtr> {
    if (!files || !parameters.contains("hash"))
      return load_scan(path, context.part(0.0, 0.7), options);
    Result<FileContent> content = files->find(path, parameters["hash"], context.part(0.0, 0.2));
    if (!content) return tl::unexpected<Error>(content.error());
    return load_scan_content(path, std::move(*content), context.part(0.2, 0.7), options);
  };
  const Result<ScanPtr> scan = load();
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

Operation open_file(const std::string& path, bool weld) {
  nlohmann::json parameters{{"file", path}};
  if (!is_utf8(path)) {
    using nlohmann::json;
    parameters["file"] =
        json::parse(json(path).dump(-1, ' ', false, json::error_handler_t::replace));
    parameters["file_bytes"] = to_hexadecimal(path);
  }
  if (!weld) parameters["weld"] = false;
  return {"open", std::move(parameters)};
}

}  // namespace arris
