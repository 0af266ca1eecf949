#include "core/mesh/polygon_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "core/base/read_file.h"
#include "core/mesh/foreign_file.h"
#include "core/mesh/gunzip.h"
#include "core/mesh/readers.h"
#include "core/mesh/scan_content.h"
#include "core/mesh/text_scanner.h"
#include "core/mesh/within_memory.h"

namespace arris {

namespace {

std::string in_lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

using Reader = Result<void> (*)(const FileBytes&, PolygonFile&, const Context&);

bool has_control_characters(std::string_view bytes) {
  return std::any_of(bytes.begin(), bytes.end(),
                     [](char c) { return (c >= 0 && c < '\t') || (c > '\r' && c < ' '); });
}

constexpr std::string_view zip_mark("PK\3\4", 4);
constexpr const char* known_formats =
    "not a mesh file that can be read (STL, PLY, OBJ, OFF or 3MF)";

/// Whether a text that begins with "solid" or "solidNAME" goes on as STL does.
bool is_ascii_stl(std::string_view first, std::string_view bytes) {
  const std::string word = in_lower_case(first);
  return word == "solid" ||
         (word.starts_with("solid") &&
          in_lower_case(bytes.substr(0, 2048)).find("facet") != std::string::npos);
}

/// Chooses by content, then by the ending of the name; null for no mesh file.
Reader choose_reader(const FileBytes& file) {
  const std::string_view bytes = file.bytes;
  if (bytes.starts_with("ply") && bytes.size() > 3 &&
      bytes.substr(3, 1).find_first_of("\r\n \t") == 0)
    return read_ply;
  // Many binary STL files begin with "solid" too, so their size speaks first.
  if (has_size_of_binary_stl(bytes)) return read_stl_binary;
  if (bytes.starts_with(zip_mark)) return read_3mf;
  if (name_foreign_file(bytes)) return nullptr;

  TextScanner text(bytes, {.hash_comments = true, .hash_ends_words = true});
  const std::string_view first = text.word();
  if (is_off_header(first)) return read_off;
  const bool has_control = has_control_characters(bytes.substr(0, 1024));
  if (is_ascii_stl(first, bytes)) return has_control ? read_stl_binary : read_stl_ascii;
  if (in_lower_case(first) == "facet" && !has_control) return read_stl_ascii;
  for (const std::string_view keyword :
       {"v", "vn", "vt", "vp", "f", "g", "o", "s", "l", "p", "mtllib", "usemtl"})
    if (first == keyword) return read_obj;

  std::string ending = in_lower_case(std::filesystem::path(file.path).extension().string());
  if (ending == ".gz")
    ending = in_lower_case(std::filesystem::path(file.path).stem().extension().string());
  if (ending != ".off" && is_list_of_points(bytes)) return nullptr;
  if (ending == ".stl") return has_control ? read_stl_binary : read_stl_ascii;
  if (ending == ".ply") return read_ply;
  if (ending == ".obj") return read_obj;
  if (ending == ".off") return read_off;
  return nullptr;
}

tl::unexpected<Error> fail_foreign(const std::string& path, std::string_view bytes) {
  std::optional<ForeignFile> foreign = name_foreign_file(bytes);
  if (!foreign && is_list_of_points(bytes))
    foreign = {"a list of points without faces", "make a surface of its points first"};
  if (!foreign) return fail(path + " is " + known_formats + ".");
  return fail(path + " is " + foreign->what + ", " + known_formats +
              (foreign->advice.empty() ? "." : ": " + foreign->advice + "."));
}

tl::unexpected<Error> fail_no_faces(const std::string& path, const PolygonFile& file) {
  const std::size_t points = file.points.size();
  return fail(path + " holds no faces (" + std::to_string(points) +
              (points == 1 ? " point)" : " points)") +
              (points > 0 ? "; a surface must be made of its points first." : "."));
}

Result<PolygonFile> read_any(const std::string& path, FileContent content, const Context& context) {
  const FileBytes whole{path, content.view()};

  PolygonFile out;
  out.bytes = content.size;
  out.content_hash = hash_of_content(content.view());

  FileBytes file = whole;
  std::string unpacked;
  const bool compressed = is_gzip(whole.bytes);
  if (compressed) {
    Result<std::string> result = gunzip(path, whole.bytes, context);
    if (!result) return tl::unexpected(result.error());
    unpacked = std::move(*result);
    content.bytes.reset();
    file.bytes = unpacked;
  }
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (file.bytes.starts_with(byte_order_mark)) file.bytes.remove_prefix(byte_order_mark.size());
  if (file.bytes.find_first_not_of(std::string_view("\0 \t\r\n", 5)) == std::string_view::npos &&
      !has_size_of_binary_stl(file.bytes))
    return fail(path + " is empty" + (file.bytes.empty() ? "." : ": it holds nothing but blanks."));
  const Reader read = choose_reader(file);
  if (!read) return fail_foreign(path, file.bytes);
  const Result<void> done = read(file, out, context);
  if (!done) return tl::unexpected(done.error());
  if (compressed) out.format += ", gzip";
  if (out.polygon_count() == 0) return fail_no_faces(path, out);
  if (out.points.size() > most_elements || out.polygon_count() > most_elements)
    return fail(path + " has more than 2^31 vertices or faces.");
  context.report(1.0, "reading");
  return out;
}

}  // namespace

Result<PolygonFile> read_polygon_file(const std::string& path, const Context& context) {
  return within_memory(path, [&]() -> Result<PolygonFile> {
    Result<FileContent> content = read_file(path, context.part(0.0, 0.3));
    if (!content) return tl::unexpected(content.error());
    return read_any(path, std::move(*content), context.part(0.3, 1.0));
  });
}

Result<PolygonFile> read_polygon_content(const std::string& path, FileContent content,
                                         const Context& context) {
  return within_memory(path, [&] { return read_any(path, std::move(content), context); });
}

}  // namespace arris
