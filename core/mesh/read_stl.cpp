#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/readers.h"
#include "core/mesh/text_scanner.h"
#include "core/mesh/weld.h"

namespace arris {

namespace {

constexpr std::size_t header_size = 84;  // 80 bytes of text and the number of triangles
constexpr std::size_t record_size = 50;  // normal, three corners, two bytes of attributes

/// Bytes as a little-endian number, whatever the machine.
std::uint32_t number_at(const char* bytes) {
  std::array<unsigned char, 4> b;
  std::memcpy(b.data(), bytes, b.size());
  return b[0] | b[1] << 8 | b[2] << 16 | static_cast<std::uint32_t>(b[3]) << 24;
}

double coordinate_at(const char* bytes) { return std::bit_cast<float>(number_at(bytes)); }

void finish(PolygonFile& out) {
  const std::size_t triangles = out.corners.size() / 3;
  out.starts.resize(triangles + 1);
  for (std::size_t k = 0; k <= triangles; ++k) out.starts[k] = 3 * k;
  out.welded_corners = out.corners.size() - out.points.size();
}

bool begins_with(std::string_view word, std::string_view lower_case) {
  if (word.size() < lower_case.size()) return false;
  for (std::size_t i = 0; i < lower_case.size(); ++i) {
    const char c = word[i];
    if ((c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c) != lower_case[i])
      return false;
  }
  return true;
}

bool is_word(std::string_view word, std::string_view lower_case) {
  return word.size() == lower_case.size() && begins_with(word, lower_case);
}

/// Whether triangle k of a binary file has finite corners on three places and a normal that is one
/// (length 1, or 0 where it was left out): hardly ever so by chance.
bool is_facet(const FileBytes& file, std::uint64_t k) {
  const char* const record = file.bytes.data() + header_size + record_size * k;
  Point at[4];
  for (int i = 0; i < 4; ++i)
    at[i] = {coordinate_at(record + 12 * i), coordinate_at(record + 12 * i + 4),
             coordinate_at(record + 12 * i + 8)};
  const double length = at[0].norm();
  return at[1].allFinite() && at[2].allFinite() && at[3].allFinite() && at[1] != at[2] &&
         at[2] != at[3] && at[3] != at[1] && (length < 1e-3 || std::abs(length - 1.0) < 0.1);
}

/// How many triangles to read where the header and the size do not agree; tells in `out.notes`.
Result<std::uint64_t> settle_count(const FileBytes& file, std::uint64_t announced,
                                   PolygonFile& out) {
  const std::uint64_t room = file.bytes.size() - header_size;
  const std::uint64_t held = room / record_size;
  const std::string header = "its header announces " + std::to_string(announced) + " triangles, ";
  // Most of the triangles that the header does not know, or all there are, must look like some.
  const std::uint64_t first = announced < held ? announced : 0;
  std::uint64_t good = 0, seen = 0;
  const std::uint64_t stride = 1 + (held - first) / 1000;
  for (std::uint64_t k = first; k < held; k += stride, ++seen) good += is_facet(file, k);
  const bool whole = held > 0 && room % record_size == 0 && 10 * good >= 9 * seen;
  if (whole) {
    out.notes.push_back("The header announces " + std::to_string(announced) +
                        " triangles, but the file has the length of " + std::to_string(held) +
                        ", which were read" +
                        (announced > held && announced != 0xFFFFFFFFu
                             ? "; if the number is right, the file was cut off."
                             : "."));
    return held;
  }
  if (held < announced)
    return fail(file.path + " is truncated or no STL file: " + header + "but it ends in triangle " +
                std::to_string(held) + ".");
  if (announced == 0)
    return fail(file.path + " is damaged: " + header + "but " + std::to_string(room) +
                " bytes follow, which is not the length of whole triangles.");
  // Less than a triangle of zeros or blanks is padding.
  const std::string_view rest =
      file.bytes.substr(header_size + static_cast<std::size_t>(record_size * announced));
  if (rest.find_first_not_of(std::string_view("\0 \r\n", 4)) != std::string_view::npos)
    out.notes.push_back("After the " + std::to_string(announced) +
                        " triangles that the header announces, " + std::to_string(rest.size()) +
                        " more bytes follow that are no triangles; they were left alone.");
  return announced;
}

}  // namespace

bool has_size_of_binary_stl(std::string_view bytes) {
  if (bytes.size() <= header_size) return false;
  const std::uint64_t count = number_at(bytes.data() + header_size - 4);
  return bytes.size() == header_size + record_size * count;
}

Result<void> read_stl_binary(const FileBytes& file, PolygonFile& out, const Context& context) {
  out.format = "STL (binary)";
  if (file.bytes.size() < header_size)
    return fail(file.path + " is truncated: a binary STL file has a header of " +
                std::to_string(header_size) + " bytes, this one ends after " +
                std::to_string(file.bytes.size()) + ".");
  std::uint64_t count = number_at(file.bytes.data() + header_size - 4);
  if (file.bytes.size() != header_size + record_size * count) {
    const Result<std::uint64_t> settled = settle_count(file, count, out);
    if (!settled) return tl::unexpected(settled.error());
    count = *settled;
  }
  if (count > most_elements / 3) return fail(file.path + " has more than 2^31 corners.");

  out.corners.resize(3 * count);
  out.points.reserve(count / 2 + 16);
  Welder welder(out.points, count / 2 + 16);
  for (std::uint64_t k = 0; k < count; ++k) {
    if (is_pause(k)) {
      if (context.cancelled()) return cancelled();
      context.report(static_cast<double>(k) / static_cast<double>(count), "reading");
    }
    const char* corner = file.bytes.data() + header_size + record_size * k + 12;
    for (int c = 0; c < 3; ++c, corner += 12)
      out.corners[3 * k + c] = welder.vertex(
          {coordinate_at(corner), coordinate_at(corner + 4), coordinate_at(corner + 8)});
  }
  finish(out);
  return {};
}

namespace {

/// Reads STL as text, also as many programs write it: keywords in two words or glued to a name,
/// any number of solids, some without an end, normals left out.
class AsciiStl {
 public:
  AsciiStl(const FileBytes& file, PolygonFile& out, const Context& context)
      : file_(file),
        out_(out),
        context_(context),
        text_(file.bytes, {}),
        welder_(out.points, file.bytes.size() / 512) {}

  Result<void> read() {
    bool in_solid = false;
    for (next(); !word_.empty();) {
      if (begins_solid()) {
        in_solid = true;
        after_name();
      } else if (ends_solid()) {
        in_solid = false;
        after_name();
      } else if (begins_facet()) {
        if (const Result<void> ok = read_facet(); !ok) return ok;
        if (!in_solid) ++outside_;
        if (out_.corners.size() > most_elements)
          return fail(file_.path + " has more than 2^31 corners.");
        if (is_pause(triangle())) {
          if (context_.cancelled()) return cancelled();
          context_.report(1.0 - static_cast<double>(text_.remaining()) /
                                    static_cast<double>(file_.bytes.size()),
                          "reading");
        }
      } else if (in_solid) {
        return fail_expected("\"facet\" or \"endsolid\"");
      } else {
        if (strays_++ == 0) first_stray_ = {text_.line(), word_};
        text_.skip_line();
        next();
      }
    }
    if (strays_ > 0 && triangle() == 0)
      return fail_at_line(file_, first_stray_.first,
                          "expected \"solid\", found " + quoted(first_stray_.second) + ".");
    if (strays_ > 0)
      out_.notes.push_back("Outside of its solids the file says something else, first in line " +
                           std::to_string(first_stray_.first) + ": " + quoted(first_stray_.second) +
                           "; that was left alone.");
    if (in_solid && triangle() > 0)
      out_.notes.push_back("The file ends without \"endsolid\" after triangle " +
                           std::to_string(triangle()) + "; if more should follow, it was cut off.");
    note_count(unended_, "lacks", "lack", " its \"endfacet\" or \"endloop\"");
    note_count(outside_, "stands", "stand", " outside of any \"solid\"");
    finish(out_);
    return {};
  }

 private:
  std::size_t triangle() const { return out_.corners.size() / 3; }
  void next() { word_ = text_.word(); }

  bool begins_solid() const { return begins_with(word_, "solid"); }
  bool begins_facet() const { return is_word(word_, "facet") || is_word(word_, "facetnormal"); }

  /// "endsolid", "endsolidNAME" or "end solid"; leaves the last word of it.
  bool ends_solid() {
    if (begins_with(word_, "endsolid")) return true;
    if (!is_word(word_, "end")) return false;
    TextScanner ahead = text_;
    return begins_with(ahead.word_in_line(), "solid");
  }

  /// Skips the name of a solid: the rest of the line, but for a facet that begins there.
  void after_name() {
    const std::size_t line = text_.line();
    for (next(); !word_.empty() && text_.line() == line; next()) {
      TextScanner ahead = text_;
      const std::string_view after = ahead.word_in_line();
      if (is_word(word_, "facet") && (is_word(after, "normal") || is_word(after, "outer"))) return;
      if (begins_with(word_, "endsolid")) return;
    }
  }

  /// One keyword, glued or in two words: "endloop", "end loop".
  bool take(std::string_view first, std::string_view second) {
    if (begins_with(word_, first) && is_word(word_.substr(first.size()), second)) {
      next();
      return true;
    }
    if (!is_word(word_, first)) return false;
    const TextScanner back = text_;
    const std::string_view word = word_;
    next();
    if (is_word(word_, second)) {
      next();
      return true;
    }
    text_ = back;
    word_ = word;
    return false;
  }

  tl::unexpected<Error> fail_expected(const std::string& what) const {
    if (word_.empty())
      return fail_at_line(
          file_, text_.line(),
          "the file is truncated, it ends in triangle " + std::to_string(triangle()) + ".");
    return fail_at_line(file_, text_.line(), "expected " + what + ", found " + quoted(word_) + ".");
  }

  Result<void> read_facet() {
    next();
    // The normal is not used; some programs leave it out or write words in it.
    for (int skipped = 0; !take("outer", "loop"); next())
      if (word_.empty() || ++skipped > 4) return fail_expected("\"outer loop\"");
    std::array<VertexId, 3> corners;
    for (VertexId& corner : corners) {
      if (!is_word(word_, "vertex")) return fail_expected("\"vertex\"");
      Point point;
      for (int axis = 0; axis < 3; ++axis) {
        next();
        if (word_.empty()) return fail_expected("");
        const std::optional<double> value = parse_listed_number(word_);
        if (!value)
          return fail_at_line(file_, text_.line(),
                              "expected a coordinate, " + found_instead(word_));
        point[axis] = *value;
      }
      corner = welder_.vertex(point);
      next();
    }
    const bool loop = take("end", "loop");
    const bool facet = take("end", "facet");
    // Only where the next thing begins is it sure that nothing of this facet was lost.
    if (!facet && !begins_facet() && !ends_solid())
      return fail_expected(loop ? "\"endfacet\"" : "\"endloop\"");
    if (!loop || !facet) ++unended_;
    out_.corners.insert(out_.corners.end(), corners.begin(), corners.end());
    return {};
  }

  void note_count(std::uint64_t count, const char* one, const char* many, const char* what) {
    if (count == 0) return;
    out_.notes.push_back(std::to_string(count) + (count == 1 ? " triangle " : " triangles ") +
                         (count == 1 ? one : many) + what + "; nothing of it was lost.");
  }

  const FileBytes& file_;
  PolygonFile& out_;
  const Context& context_;
  TextScanner text_;
  Welder welder_;
  std::string_view word_;
  std::uint64_t unended_ = 0, outside_ = 0, strays_ = 0;
  std::pair<std::size_t, std::string_view> first_stray_;  // its line and first word
};

}  // namespace

Result<void> read_stl_ascii(const FileBytes& file, PolygonFile& out, const Context& context) {
  out.format = "STL (ASCII)";
  return AsciiStl(file, out, context).read();
}

}  // namespace arris
