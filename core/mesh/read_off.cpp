#include <algorithm>
#include <optional>

#include "core/mesh/readers.h"
#include "core/mesh/text_scanner.h"

namespace arris {

namespace {

/// "STCNOFF" taken apart; what follows it in the same word ("OFF490") is left in `rest`.
struct OffKeyword {
  bool texture = false, colour = false, normal = false, four = false, dimensions = false;
  std::string_view rest;
};

std::optional<OffKeyword> parse_keyword(std::string_view word) {
  OffKeyword keyword;
  if (word.starts_with("off"))
    word.remove_prefix(3);
  else {
    const auto take = [&](std::string_view prefix) {
      if (!word.starts_with(prefix)) return false;
      word.remove_prefix(prefix.size());
      return true;
    };
    keyword.texture = take("ST");
    keyword.colour = take("C");
    keyword.normal = take("N");
    keyword.four = take("4");
    keyword.dimensions = take("n");
    if (!take("OFF")) return std::nullopt;
  }
  if (word.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
  keyword.rest = word;
  return keyword;
}

/// How the numbers of a file are taken. Geomview reads them one after the other, but lets a colour
/// end with its line, and many files have colours that their keyword does not announce.
struct Layout {
  bool lines;            ///< A vertex, a face has a line of its own, with whatever follows it.
  int counts;            ///< 3, or 2 where the number of edges is missing.
  int extras = 0;        ///< Not in lines: numbers after the coordinates of each vertex.
  bool colours = false;  ///< Not in lines: a face ends with the line of its last corner.
};

/// Reads the numbers after the keyword in one layout.
class OffBody {
 public:
  OffBody(const FileBytes& file, TextScanner text, std::string_view first, Layout layout,
          PolygonFile& out, const Context& context)
      : file_(file), text_(text), word_(first), layout_(layout), out_(out), context_(context) {}

  /// True once it is clear that the file is laid out like this, right or wrong.
  bool is_likely() const { return likely_; }

  Result<void> read() {
    out_.points.clear();
    out_.corners.clear();
    out_.starts.assign(1, 0);
    std::uint64_t counts[3] = {};
    const std::size_t count_line = text_.line();
    for (int k = 0; k < layout_.counts; ++k) {
      if (k > 0) word_ = layout_.lines ? text_.word_in_line() : text_.word();
      if (k == 2 && layout_.lines && word_.empty())
        break;  // nobody keeps the number of edges right
      const std::optional<std::int64_t> value = parse_integer(word_);
      if (!value || *value < 0)
        return fail_at_line(file_, text_.line(),
                            "expected the numbers of vertices and faces, found " +
                                (word_.empty() ? "the end." : quoted(word_) + "."));
      counts[k] = static_cast<std::uint64_t>(*value);
    }
    if (layout_.lines && !text_.word_in_line().empty())
      return fail_at_line(file_, count_line, "expected no more than three counts.");

    // "0 0 0\n" and "0\n" are the shortest vertex and face; the last line may lack its end.
    vertex_count_ = counts[0];
    face_count_ = counts[1];
    const std::uint64_t room = text_.remaining() + 1;
    if (vertex_count_ > room / 6 || face_count_ > (room - 6 * vertex_count_) / 2)
      return fail(file_.path + " is truncated or damaged: its header announces " +
                  std::to_string(vertex_count_) + " vertices and " + std::to_string(face_count_) +
                  " faces, which its " + std::to_string(file_.bytes.size()) +
                  " bytes cannot hold.");
    if (const Result<void> ok = read_vertices(); !ok) return ok;
    if (const Result<void> ok = read_faces(); !ok) return ok;
    if (!text_.word().empty())
      return fail_at_line(file_, text_.line(),
                          "there is more after the " + std::to_string(face_count_) +
                              " faces that the header announces.");
    return {};
  }

 private:
  Result<void> pause(std::uint64_t i, std::uint64_t count, double from) const {
    if (!is_pause(i)) return {};
    if (context_.cancelled()) return cancelled();
    context_.report(from + 0.5 * static_cast<double>(i) / static_cast<double>(count), "reading");
    return {};
  }

  Result<void> read_vertices() {
    out_.points.resize(vertex_count_);
    for (std::uint64_t v = 0; v < vertex_count_; ++v) {
      if (const Result<void> go_on = pause(v, vertex_count_, 0.0); !go_on) return go_on;
      for (int axis = 0; axis < 3; ++axis) {
        word_ = layout_.lines && axis > 0 ? text_.word_in_line() : text_.word();
        const std::optional<double> value = parse_listed_number(word_);
        if (!value) {
          likely_ = likely_ || axis == 2;
          if (at_end())
            return fail_at_line(file_, text_.line(),
                                "the file is truncated, it ends in vertex " + std::to_string(v) +
                                    " of " + std::to_string(vertex_count_) + ".");
          return fail_at_line(
              file_, text_.line(),
              "expected a coordinate of vertex " + std::to_string(v) + ", " + found_instead(word_));
        }
        out_.points[v][axis] = *value;
      }
      if (!layout_.lines) {
        for (int k = 0; k < layout_.extras; ++k) text_.word();
        continue;
      }
      // Normals, colours, texture coordinates: up to 3 + 4 + 2 numbers, and a fourth coordinate.
      int extras = 0;
      for (word_ = text_.word_in_line(); !word_.empty(); word_ = text_.word_in_line())
        if (++extras > 10 || !parse_number(word_))
          return fail_at_line(file_, text_.line(),
                              "vertex " + std::to_string(v) +
                                  " has more than coordinates, a "
                                  "normal, a colour and texture coordinates, " +
                                  found_instead(word_));
      likely_ = true;
    }
    return {};
  }

  Result<void> read_faces() {
    out_.starts.reserve(face_count_ + 1);
    out_.corners.reserve(std::min<std::uint64_t>(3 * face_count_, text_.remaining() / 2 + 1));
    for (std::uint64_t f = 0; f < face_count_; ++f) {
      if (const Result<void> go_on = pause(f, face_count_, 0.5); !go_on) return go_on;
      const Result<std::int64_t> corner_count = integer(f, false);
      if (!corner_count) return tl::unexpected(corner_count.error());
      if (*corner_count < 0)
        return fail_at_line(file_, text_.line(),
                            "face " + std::to_string(f) + " has a negative number of corners.");
      // Where the counts themselves are in doubt, only faces tell that they were taken right.
      if (layout_.counts == 2 && *corner_count < 3)
        return fail_at_line(file_, text_.line(),
                            "face " + std::to_string(f) + " has fewer than three corners.");
      for (std::int64_t k = 0; k < *corner_count; ++k) {
        const Result<std::int64_t> vertex = integer(f, layout_.lines);
        if (!vertex) return tl::unexpected(vertex.error());
        if (*vertex < 0 || static_cast<std::uint64_t>(*vertex) >= vertex_count_)
          return fail_at_line(file_, text_.line(), out_of_range(f, *vertex, vertex_count_));
        out_.corners.push_back(static_cast<VertexId>(*vertex));
      }
      out_.starts.push_back(out_.corners.size());
      if (!layout_.lines && !layout_.colours) continue;
      // The colour of the face: an index, three or four numbers, or a name.
      int extras = 0;
      for (word_ = text_.word_in_line(); !word_.empty(); word_ = text_.word_in_line())
        if (++extras > 4)
          return fail_at_line(file_, text_.line(),
                              "face " + std::to_string(f) + " has more than corners and a colour.");
    }
    return {};
  }

  Result<std::int64_t> integer(std::uint64_t f, bool same_line) {
    word_ = same_line ? text_.word_in_line() : text_.word();
    if (at_end())
      return fail_at_line(file_, text_.line(),
                          "the file is truncated, it ends in face " + std::to_string(f) + " of " +
                              std::to_string(face_count_) + ".");
    const std::optional<std::int64_t> value = parse_integer(word_);
    if (!value)
      return fail_at_line(
          file_, text_.line(),
          "expected a whole number in face " + std::to_string(f) + ", " + found_instead(word_));
    return *value;
  }

  /// Whether there was no word because the file ends.
  bool at_end() const { return word_.empty() && TextScanner(text_).word().empty(); }

  const FileBytes& file_;
  TextScanner text_;
  std::string_view word_;
  Layout layout_;
  PolygonFile& out_;
  const Context& context_;
  std::uint64_t vertex_count_ = 0, face_count_ = 0;
  bool likely_ = false;
};

}  // namespace

bool is_off_header(std::string_view word) { return parse_keyword(word).has_value(); }

Result<void> read_off(const FileBytes& file, PolygonFile& out, const Context& context) {
  out.format = "OFF";
  TextScanner text(file.bytes, {.hash_comments = true, .hash_ends_words = true});
  std::string_view word = text.word();
  OffKeyword keyword;
  if (const std::optional<OffKeyword> found = parse_keyword(word)) {
    keyword = *found;
    word = keyword.rest.empty() ? text.word() : keyword.rest;
    if (word == "BINARY")
      return fail(file.path + " is a binary OFF file; only OFF files in text form can be read.");
    if (keyword.dimensions && !keyword.four && word == "3")
      word = text.word();
    else if (keyword.four || keyword.dimensions)
      return fail(file.path + " is an OFF file whose points are not in three dimensions.");
  }
  const int plain = (keyword.normal ? 3 : 0) + (keyword.texture ? 2 : 0);
  std::vector<Layout> layouts{{.lines = true, .counts = 3}};
  for (const bool colours : {false, true})
    for (const int counts : {3, 2}) {
      layouts.push_back({false, counts, plain + (keyword.colour ? 4 : 0), colours});
      if (keyword.colour) layouts.push_back({false, counts, plain + 3, colours});
    }
  // The first layout in which everything falls into place, to the end of the file.
  std::optional<Error> error;
  for (const Layout& layout : layouts) {
    OffBody body(file, text, word, layout, out, context);
    const Result<void> done = body.read();
    if (done || done.error().cancelled) return done;
    // Lines that look like vertices were meant as such; else the simplest reading says best.
    if (layout.lines ? body.is_likely() : !error) error = done.error();
  }
  return tl::unexpected(*error);
}

}  // namespace arris
