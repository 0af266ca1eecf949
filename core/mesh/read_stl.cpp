#include <array>
#include <bit>
#include <cstring>
#include <vector>

#include "core/mesh/readers.h"
#include "core/mesh/text_scanner.h"

namespace arris {

namespace {

constexpr std::size_t header_size = 84;  // 80 bytes of text and the number of triangles
constexpr std::size_t record_size = 50;  // normal, three corners, two bytes of attributes

/// Joins corners with equal coordinates (-0 is 0): open addressing over the points themselves.
class Welder {
 public:
  Welder(std::vector<Point>& points, std::size_t expected) : points_(points) {
    slots_.assign(std::bit_ceil(std::max<std::size_t>(16, 2 * expected)), no_id);
  }

  VertexId vertex(const Point& point) {
    if (2 * (points_.size() + 1) > slots_.size()) grow();
    const Key key = key_of(point);
    std::size_t slot = hash(key) & (slots_.size() - 1);
    while (slots_[slot] != no_id) {
      if (key_of(points_[slots_[slot]]) == key) return slots_[slot];
      slot = (slot + 1) & (slots_.size() - 1);
    }
    slots_[slot] = static_cast<VertexId>(points_.size());
    points_.push_back(point);
    return slots_[slot];
  }

 private:
  // By bits, so that NaN equals itself and many of them cannot fill the table.
  using Key = std::array<std::uint64_t, 3>;

  static Key key_of(const Point& point) {
    return {std::bit_cast<std::uint64_t>(point.x() + 0.0),
            std::bit_cast<std::uint64_t>(point.y() + 0.0),
            std::bit_cast<std::uint64_t>(point.z() + 0.0)};
  }
  static std::size_t hash(const Key& key) {
    std::uint64_t h = 0;
    for (const std::uint64_t part : key) {
      h = (h ^ part) * 0x9E3779B97F4A7C15u;
      h ^= h >> 32;
    }
    return static_cast<std::size_t>(h);
  }
  void grow() {
    slots_.assign(2 * slots_.size(), no_id);
    for (std::size_t v = 0; v < points_.size(); ++v) {
      std::size_t slot = hash(key_of(points_[v])) & (slots_.size() - 1);
      while (slots_[slot] != no_id) slot = (slot + 1) & (slots_.size() - 1);
      slots_[slot] = static_cast<VertexId>(v);
    }
  }

  std::vector<Point>& points_;
  std::vector<VertexId> slots_;
};

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

bool is_word(std::string_view word, std::string_view lower_case) {
  if (word.size() != lower_case.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const char c = word[i];
    if ((c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c) != lower_case[i])
      return false;
  }
  return true;
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
  const std::uint64_t count = number_at(file.bytes.data() + header_size - 4);
  const std::uint64_t held = (file.bytes.size() - header_size) / record_size;
  if (held < count)
    return fail(file.path + " is truncated or no STL file: its header announces " +
                std::to_string(count) + " triangles, but it ends in triangle " +
                std::to_string(held) + ".");
  // Less than a triangle at the end is padding; more would be lost without a word.
  if (held > count)
    return fail(file.path + " is damaged: its header announces " + std::to_string(count) +
                " triangles, but there is room for " + std::to_string(held) + ".");
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

Result<void> read_stl_ascii(const FileBytes& file, PolygonFile& out, const Context& context) {
  out.format = "STL (ASCII)";
  TextScanner text(file.bytes, {});
  Welder welder(out.points, file.bytes.size() / 512);
  const auto truncated = [&] {
    return fail_at_line(file, text.line(),
                        "the file is truncated, it ends in triangle " +
                            std::to_string(out.corners.size() / 3) + ".");
  };
  const auto expect = [&](std::string_view wanted) -> Result<void> {
    const std::string_view word = text.word();
    if (word.empty()) return truncated();
    if (!is_word(word, wanted))
      return fail_at_line(file, text.line(),
                          "expected " + quoted(wanted) + ", found " + quoted(word) + ".");
    return {};
  };

  bool in_solid = false;
  for (std::string_view word = text.word(); !word.empty(); word = text.word()) {
    if (is_word(word, "solid") || is_word(word, "endsolid")) {
      in_solid = word.size() == 5;
      text.skip_line();
      continue;
    }
    if (!in_solid || !is_word(word, "facet"))
      return fail_at_line(file, text.line(),
                          std::string("expected ") +
                              (in_solid ? "\"facet\" or \"endsolid\"" : "\"solid\"") + ", found " +
                              quoted(word) + ".");
    // The normal is not used; some programs leave it out or write words in it.
    int skipped = 0;
    for (word = text.word(); !is_word(word, "outer"); word = text.word()) {
      if (word.empty()) return truncated();
      if (++skipped > 4)
        return fail_at_line(file, text.line(),
                            "expected \"outer loop\", found " + quoted(word) + ".");
    }
    if (const Result<void> ok = expect("loop"); !ok) return ok;
    std::array<VertexId, 3> corners;
    for (VertexId& corner : corners) {
      if (const Result<void> ok = expect("vertex"); !ok) return ok;
      Point point;
      for (int axis = 0; axis < 3; ++axis) {
        word = text.word();
        if (word.empty()) return truncated();
        const std::optional<double> value = parse_number(word);
        if (!value)
          return fail_at_line(file, text.line(),
                              "expected a coordinate, found " + quoted(word) + ".");
        point[axis] = *value;
      }
      corner = welder.vertex(point);
    }
    if (const Result<void> ok = expect("endloop"); !ok) return ok;
    if (const Result<void> ok = expect("endfacet"); !ok) return ok;
    out.corners.insert(out.corners.end(), corners.begin(), corners.end());
    if (out.corners.size() > most_elements) return fail(file.path + " has more than 2^31 corners.");
    if (is_pause(out.corners.size() / 3)) {
      if (context.cancelled()) return cancelled();
      context.report(
          1.0 - static_cast<double>(text.remaining()) / static_cast<double>(file.bytes.size()),
          "reading");
    }
  }
  if (in_solid)
    return fail_at_line(file, text.line(),
                        "the file is truncated, it ends without \"endsolid\" after triangle " +
                            std::to_string(out.corners.size() / 3) + ".");
  finish(out);
  return {};
}

}  // namespace arris
