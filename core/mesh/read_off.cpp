#include <algorithm>

#include "core/mesh/readers.h"
#include "core/mesh/text_scanner.h"

namespace arris {

bool is_off_header(std::string_view word) {
  if (word == "off") return true;
  for (const std::string_view prefix : {"ST", "C", "N", "4", "n"})
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  return word == "OFF";
}

Result<void> read_off(const FileBytes& file, PolygonFile& out, const Context& context) {
  out.format = "OFF";
  TextScanner text(file.bytes, {.hash_comments = true});
  std::string_view word = text.word();
  if (is_off_header(word)) {
    if (word.find_first_of("4n") != std::string_view::npos)
      return fail(file.path + " is an OFF file whose points are not in three dimensions.");
    word = text.word();
    if (word == "BINARY")
      return fail(file.path + " is a binary OFF file; only OFF files in text form can be read.");
  }
  std::uint64_t counts[2];
  for (std::uint64_t& count : counts) {
    const std::optional<std::int64_t> value = parse_integer(word);
    if (!value || *value < 0)
      return fail_at_line(file, text.line(),
                          "expected the numbers of vertices and faces, found " +
                              (word.empty() ? "the end of the file." : quoted(word) + "."));
    count = static_cast<std::uint64_t>(*value);
    if (&count == counts) word = text.word();
  }
  text.skip_line();  // the number of edges, which nobody keeps right

  // "0 0 0\n" and "0\n" are the shortest vertex and face; the last line may lack its end.
  const auto [vertex_count, face_count] = counts;
  const std::uint64_t room = text.remaining() + 1;
  if (vertex_count > room / 6 || face_count > (room - 6 * vertex_count) / 2)
    return fail(file.path + " is truncated or damaged: its header announces " +
                std::to_string(vertex_count) + " vertices and " + std::to_string(face_count) +
                " faces, which its " + std::to_string(file.bytes.size()) + " bytes cannot hold.");

  out.points.resize(vertex_count);
  for (std::uint64_t v = 0; v < vertex_count; ++v) {
    if (is_pause(v)) {
      if (context.cancelled()) return cancelled();
      context.report(0.5 * static_cast<double>(v) / static_cast<double>(vertex_count), "reading");
    }
    for (int axis = 0; axis < 3; ++axis) {
      word = text.word();
      if (word.empty())
        return fail_at_line(file, text.line(),
                            "the file is truncated, it ends in vertex " + std::to_string(v) +
                                " of " + std::to_string(vertex_count) + ".");
      const std::optional<double> value = parse_number(word);
      if (!value)
        return fail_at_line(file, text.line(),
                            "expected a coordinate of vertex " + std::to_string(v) + ", found " +
                                quoted(word) + ".");
      out.points[v][axis] = *value;
    }
    text.skip_line();  // normals, colours, texture coordinates
  }

  out.starts.reserve(face_count + 1);
  out.starts.push_back(0);
  out.corners.reserve(std::min<std::uint64_t>(3 * face_count, text.remaining() / 2 + 1));
  for (std::uint64_t f = 0; f < face_count; ++f) {
    if (is_pause(f)) {
      if (context.cancelled()) return cancelled();
      context.report(0.5 + 0.5 * static_cast<double>(f) / static_cast<double>(face_count),
                     "reading");
    }
    const auto integer = [&]() -> Result<std::int64_t> {
      word = text.word();
      if (word.empty())
        return fail_at_line(file, text.line(),
                            "the file is truncated, it ends in face " + std::to_string(f) + " of " +
                                std::to_string(face_count) + ".");
      const std::optional<std::int64_t> value = parse_integer(word);
      if (!value)
        return fail_at_line(file, text.line(),
                            "expected a whole number in face " + std::to_string(f) + ", found " +
                                quoted(word) + ".");
      return *value;
    };
    const Result<std::int64_t> corner_count = integer();
    if (!corner_count) return tl::unexpected(corner_count.error());
    if (*corner_count < 0)
      return fail_at_line(file, text.line(),
                          "face " + std::to_string(f) + " has a negative number of corners.");
    for (std::int64_t k = 0; k < *corner_count; ++k) {
      const Result<std::int64_t> vertex = integer();
      if (!vertex) return tl::unexpected(vertex.error());
      if (*vertex < 0 || static_cast<std::uint64_t>(*vertex) >= vertex_count)
        return fail_at_line(file, text.line(), out_of_range(f, *vertex, vertex_count));
      out.corners.push_back(static_cast<VertexId>(*vertex));
    }
    out.starts.push_back(out.corners.size());
    text.skip_line();  // the colour of the face
  }
  if (!text.word().empty())
    return fail_at_line(file, text.line(),
                        "there is more after the " + std::to_string(face_count) +
                            " faces that the header announces.");
  return {};
}

}  // namespace arris
