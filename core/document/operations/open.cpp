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

/// A journal and every report are UTF-8: a name that is not could not be written down.
bool is_writable_name(nlohmann::json& value, const Document&) {
  const std::string& name = value.get_ref<const std::string&>();
  return !name.empty() && is_utf8(name);
}

bool is_hexadecimal(nlohmann::json& value, const Document&) {
  return !from_hexadecimal(value.get<std::string>()).value_or("").empty();
}

/// Before version 2 nothing was joined but the corners of STL.
nlohmann::json upgrade_open(int, nlohmann::json parameters) {
  parameters["weld"] = false;
  return parameters;
}

std::string words_of_open(const nlohmann::json& parameters) {
  const std::string path = parameters.value("file", "");
  const std::size_t slash = path.find_last_of("/\\");
  return "Open " + (slash == std::string::npos ? path : path.substr(slash + 1));
}

}  // namespace

std::vector<OperationKind> open_rows() {
  return {{.name = "open",
           .title = "Open",
           .help = "Reads a scan: STL, PLY, OBJ, OFF (also as .gz) or 3MF.",
           .version = 2,
           .parameters = {{.name = "file",
                           .kind = ParameterKind::text,
                           .help = "Where it is.",
                           .form = "the path of a mesh file in UTF-8 (one that is not is given by "
                                   "\"file_bytes\")",
                           .accepts = is_writable_name},
                          {.name = "file_bytes",
                           .kind = ParameterKind::text,
                           .help = "The same where its name is not UTF-8; \"file\" is for people "
                                   "then.",
                           .optional = true,
                           .form = "the bytes of a path in hexadecimal digits",
                           .accepts = is_hexadecimal},
                          {.name = "weld",
                           .kind = ParameterKind::flag,
                           .help = "Vertices on one place become one.",
                           .otherwise = true},
                          // Known only once the file is read; perform() adds it then.
                          {.name = "hash",
                           .kind = ParameterKind::text,
                           .help = "XXH3 (128 bits) of what it has to hold.",
                           .optional = true}},
           .words = words_of_open,
           .upgrade = upgrade_open}};
}

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
