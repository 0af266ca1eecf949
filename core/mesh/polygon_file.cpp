#include "core/mesh/polygon_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string_view>

#include "core/base/hash.h"
#include "core/mesh/readers.h"
#include "core/mesh/text_scanner.h"
#include "core/mesh/within_memory.h"

namespace arris {

namespace {

struct FileContent {
  std::unique_ptr<char[]> bytes;
  std::size_t size = 0;
};

std::string in_lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

/// The file is copied rather than mapped: a mapped file that another program shortens kills us.
Result<FileContent> read_bytes(const std::string& path, const Context& context) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    return fail(path + ": there is no such file.");
  if (error) return fail(path + " cannot be read: " + error.message() + ".");
  if (std::filesystem::is_directory(status)) return fail(path + " is a directory, not a file.");
  if (!std::filesystem::is_regular_file(status)) return fail(path + " is not an ordinary file.");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) return fail(path + " cannot be read: " + error.message() + ".");
  if (size == 0) return fail(path + " is empty.");

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
  if (!file) return fail(path + " cannot be opened: " + std::strerror(errno) + ".");
  FileContent content{std::make_unique_for_overwrite<char[]>(size), size};
  constexpr std::size_t block = std::size_t{1} << 24;
  for (std::size_t done = 0; done < size;) {
    if (context.cancelled()) return cancelled();
    const std::size_t wanted = std::min(block, size - done);
    if (std::fread(content.bytes.get() + done, 1, wanted, file.get()) != wanted)
      return fail(path + " could not be read to its end.");
    done += wanted;
    context.report(0.3 * static_cast<double>(done) / static_cast<double>(size), "reading");
  }
  return content;
}

using Reader = Result<void> (*)(const FileBytes&, PolygonFile&, const Context&);

bool has_control_characters(std::string_view bytes) {
  return std::any_of(bytes.begin(), bytes.end(),
                     [](char c) { return (c >= 0 && c < '\t') || (c > '\r' && c < ' '); });
}

/// Chooses by content, then by the ending of the name; null for no mesh file.
Reader choose_reader(const FileBytes& file) {
  const std::string_view bytes = file.bytes;
  if (bytes.starts_with("ply") && bytes.size() > 3 && (bytes[3] == '\n' || bytes[3] == '\r'))
    return read_ply;
  // Many binary STL files begin with "solid" too, so their size speaks first.
  if (has_size_of_binary_stl(bytes)) return read_stl_binary;

  TextScanner text(bytes, {.hash_comments = true});
  const std::string_view first = text.word();
  if (is_off_header(first)) return read_off;
  if (in_lower_case(first) == "solid")
    return has_control_characters(bytes.substr(0, 1024)) ? read_stl_binary : read_stl_ascii;
  for (const std::string_view keyword :
       {"v", "vn", "vt", "vp", "f", "g", "o", "s", "l", "p", "mtllib", "usemtl"})
    if (first == keyword) return read_obj;

  const std::string ending = in_lower_case(std::filesystem::path(file.path).extension().string());
  if (ending == ".stl")
    return has_control_characters(bytes.substr(0, 1024)) ? read_stl_binary : read_stl_ascii;
  if (ending == ".ply") return read_ply;
  if (ending == ".obj") return read_obj;
  if (ending == ".off") return read_off;
  return nullptr;
}

Result<PolygonFile> read_any(const std::string& path, const Context& context) {
  const Result<FileContent> content = read_bytes(path, context);
  if (!content) return tl::unexpected(content.error());
  const FileBytes whole{path, {content->bytes.get(), content->size}};

  PolygonFile out;
  out.bytes = content->size;
  Hasher hasher;
  hasher.bytes(whole.bytes.data(), whole.bytes.size());
  out.content_hash = hasher.hex();

  FileBytes file = whole;
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (file.bytes.starts_with(byte_order_mark)) file.bytes.remove_prefix(byte_order_mark.size());
  const Reader read = choose_reader(file);
  if (!read) return fail(path + " is not a mesh file that can be read (STL, PLY, OBJ or OFF).");
  const Result<void> done = read(file, out, context.part(0.3, 1.0));
  if (!done) return tl::unexpected(done.error());
  if (out.polygon_count() == 0)
    return fail(path + " holds no faces (" + std::to_string(out.points.size()) + " points).");
  if (out.points.size() > most_elements || out.polygon_count() > most_elements)
    return fail(path + " has more than 2^31 vertices or faces.");
  context.report(1.0, "reading");
  return out;
}

}  // namespace

Result<PolygonFile> read_polygon_file(const std::string& path, const Context& context) {
  return within_memory(path, [&] { return read_any(path, context); });
}

}  // namespace arris
