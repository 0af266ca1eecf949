#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/mesh/length_unit.h"
#include "core/mesh/readers.h"
#include "core/mesh/text_scanner.h"

namespace arris {

namespace {

enum class Encoding { ascii, little_endian, big_endian };

template <class T, bool swapped>
T load(const char* bytes) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes, raw.size());
  if constexpr (swapped) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<T>(raw);
}

/// How to read one scalar type of a binary file.
struct Scalar {
  std::size_t size;
  bool whole;
  double (*number[2])(const char*);         // as stored in this machine's order, swapped
  std::int64_t (*integer[2])(const char*);  // only of whole types
};

template <class T, bool swapped>
double number(const char* bytes) {
  return static_cast<double>(load<T, swapped>(bytes));
}
template <class T, bool swapped>
std::int64_t integer(const char* bytes) {
  if constexpr (std::is_integral_v<T>) return load<T, swapped>(bytes);
  return 0;
}
template <class T>
constexpr Scalar scalar_of{sizeof(T),
                           std::is_integral_v<T>,
                           {number<T, false>, number<T, true>},
                           {integer<T, false>, integer<T, true>}};

const Scalar* find_scalar(std::string_view name) {
  static constexpr std::pair<std::string_view, const Scalar*> names[] = {
      {"float", &scalar_of<float>},        {"uchar", &scalar_of<std::uint8_t>},
      {"int", &scalar_of<std::int32_t>},   {"uint", &scalar_of<std::uint32_t>},
      {"double", &scalar_of<double>},      {"char", &scalar_of<std::int8_t>},
      {"short", &scalar_of<std::int16_t>}, {"ushort", &scalar_of<std::uint16_t>},
      {"float32", &scalar_of<float>},      {"float64", &scalar_of<double>},
      {"int8", &scalar_of<std::int8_t>},   {"uint8", &scalar_of<std::uint8_t>},
      {"int16", &scalar_of<std::int16_t>}, {"uint16", &scalar_of<std::uint16_t>},
      {"int32", &scalar_of<std::int32_t>}, {"uint32", &scalar_of<std::uint32_t>},
      {"int64", &scalar_of<std::int64_t>}, {"uint64", &scalar_of<std::uint64_t>},
  };
  for (const auto& [known, scalar] : names)
    if (known == name) return scalar;
  return nullptr;
}

constexpr std::string_view strips_name = "tristrips";

struct Property {
  std::string name;
  const Scalar* scalar = nullptr;
  const Scalar* count = nullptr;  // of a list; else null
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  std::optional<std::size_t> find(std::string_view wanted, bool list) const {
    for (std::size_t k = 0; k < properties.size(); ++k)
      if (properties[k].name == wanted && (properties[k].count != nullptr) == list) return k;
    return std::nullopt;
  }
  bool has_lists() const {
    return std::any_of(properties.begin(), properties.end(),
                       [](const Property& p) { return p.count != nullptr; });
  }
  /// The fewest bytes one of these can take.
  std::uint64_t least_bytes(Encoding encoding) const {
    if (encoding == Encoding::ascii) return 2 * properties.size();  // a digit, a blank
    std::uint64_t sum = 0;
    for (const Property& p : properties) sum += p.count ? p.count->size : p.scalar->size;
    return sum;
  }
};

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
  std::size_t size = 0;   // bytes up to the data
  std::size_t lines = 0;  // lines up to the data
  std::string unit;       // of lengths, as write_ply() names it in a comment

  const Element* find(std::string_view name) const {
    for (const Element& element : elements)
      if (element.name == name) return &element;
    return nullptr;
  }
};

Result<Header> read_header(const FileBytes& file) {
  Header header;
  bool has_format = false;
  const std::string_view bytes = file.bytes;
  const std::size_t first_end = bytes.find_first_of("\r\n");
  // Where lines end with CR alone, a LF after the header would be data.
  const bool lone_cr = first_end != std::string_view::npos && bytes[first_end] == '\r' &&
                       (first_end + 1 == bytes.size() || bytes[first_end + 1] != '\n');
  const char line_end = lone_cr ? '\r' : '\n';
  for (std::size_t begin = 0; begin < bytes.size();) {
    const std::size_t end = bytes.find(line_end, begin);
    ++header.lines;
    if (end == std::string_view::npos) break;
    std::string_view line = bytes.substr(begin, end - begin);
    if (line.ends_with('\r')) line.remove_suffix(1);
    begin = end + 1;
    TextScanner words(line, {});
    const std::string_view keyword = words.word();
    const auto wrong = [&](const std::string& what) {
      return fail_at_line(file, header.lines, what);
    };
    if (header.lines == 1) {
      if (keyword != "ply") return wrong("a PLY file begins with \"ply\".");
    } else if (keyword == "end_header") {
      if (!has_format) return wrong("the header has no line \"format\".");
      header.size = begin;
      return header;
    } else if (keyword == "format") {
      const std::string_view name = words.word();
      if (name == "ascii") {
        header.encoding = Encoding::ascii;
      } else if (name == "binary_little_endian") {
        header.encoding = Encoding::little_endian;
      } else if (name == "binary_big_endian") {
        header.encoding = Encoding::big_endian;
      } else {
        return wrong("unknown PLY format " + arris::quoted(name) + ".");
      }
      has_format = true;
    } else if (keyword == "element") {
      Element element;
      element.name = words.word();
      const std::string_view count = words.word();
      const std::optional<std::int64_t> value = parse_integer(count);
      if (!value || *value < 0)
        return wrong("expected how many elements " + arris::quoted(element.name) +
                     " there are, found " + arris::quoted(count) + ".");
      if (header.find(element.name))
        return wrong("the element " + arris::quoted(element.name) + " is declared twice.");
      element.count = static_cast<std::uint64_t>(*value);
      header.elements.push_back(std::move(element));
    } else if (keyword == "property") {
      if (header.elements.empty()) return wrong("a property precedes the first element.");
      Property property;
      std::string_view type = words.word();
      if (type == "list") {
        type = words.word();
        property.count = find_scalar(type);
        if (!property.count || !property.count->whole)
          return wrong(arris::quoted(type) + " is no type for the length of a list.");
        type = words.word();
      }
      property.scalar = find_scalar(type);
      if (!property.scalar) return wrong("unknown property type " + arris::quoted(type) + ".");
      property.name = words.word();
      if (property.name.empty()) return wrong("the property has no name.");
      header.elements.back().properties.push_back(std::move(property));
    } else if (keyword == "comment") {
      // PLY has no units; that which write_ply() names comes back.
      if (words.word() == "lengths" && words.word() == "in")
        if (const std::string_view name = words.word(); find_length_unit(name)) header.unit = name;
    } else if (keyword != "obj_info" && !keyword.empty()) {
      return wrong("unknown word " + arris::quoted(keyword) + " in the header.");
    }
  }
  return fail(file.path + " is truncated: its header has no line \"end_header\".");
}

/// The one place where elements of any encoding become points and polygons. `Source` has
/// number(), integer(), skip() for the next scalar, fail() for an error there, and room().
template <class Source>
class Body {
 public:
  Body(Source source, const Header& header, PolygonFile& out, const Context& context)
      : source_(std::move(source)),
        header_(header),
        out_(out),
        context_(context),
        vertex_count_(header.find("vertex")->count) {}

  Result<void> read() {
    for (const Element& element : header_.elements) {
      if (element.properties.empty()) continue;
      const bool vertices = element.name == "vertex", faces = element.name == "face";
      const bool strips = element.name == strips_name;
      std::array<std::size_t, 3> axes{};
      std::size_t list = element.properties.size();
      if (vertices) {
        axes = {*element.find("x", false), *element.find("y", false), *element.find("z", false)};
        out_.points.resize(element.count);
      }
      if (faces) {
        list = face_list(element);
        out_.starts.reserve(element.count + 1);
        out_.corners.reserve(std::min<std::uint64_t>(3 * element.count, source_.room()));
      }
      if (strips) list = face_list(element);
      if (!vertices && !faces && !element.has_lists() && source_.skip_all(element)) continue;
      for (std::uint64_t i = 0; i < element.count; ++i) {
        if (is_pause(i)) {
          if (context_.cancelled()) return cancelled();
          context_.report(source_.fraction(), "reading");
        }
        for (std::size_t k = 0; k < element.properties.size(); ++k) {
          const Property& property = element.properties[k];
          bool ok = true;
          if (vertices && (k == axes[0] || k == axes[1] || k == axes[2]))
            ok = source_.number(*property.scalar, out_.points[i][k == axes[0]   ? 0
                                                                 : k == axes[1] ? 1
                                                                                : 2]);
          else if (!property.count)
            ok = source_.skip(*property.scalar);
          else if (const Result<void> done = read_list(property, element, i,
                                                       k != list ? List::other
                                                       : faces   ? List::corners
                                                       : strips  ? List::strips
                                                                 : List::other);
                   !done)
            return done;
          if (!ok) return source_.fail(element, i);
        }
        if (faces) out_.starts.push_back(out_.corners.size());
      }
    }
    return source_.finish();
  }

  static std::size_t face_list(const Element& face) {
    const std::optional<std::size_t> list = face.find("vertex_indices", true);
    return list ? *list : face.find("vertex_index", true).value_or(face.properties.size());
  }

 private:
  enum class List { other, corners, strips };

  Result<void> read_list(const Property& property, const Element& element, std::uint64_t i,
                         List use) {
    std::int64_t length = 0;
    if (!source_.integer(*property.count, length)) return source_.fail(element, i);
    if (length < 0 || static_cast<std::uint64_t>(length) > source_.room(*property.scalar))
      return source_.fail_length(element, i, length);
    std::array<VertexId, 2> last{};  // the two corners before, in a strip
    std::int64_t in_strip = 0;
    for (std::int64_t k = 0; k < length; ++k) {
      if (use == List::other) {
        if (!source_.skip(*property.scalar)) return source_.fail(element, i);
        continue;
      }
      std::int64_t vertex = 0;
      if (!source_.integer(*property.scalar, vertex)) return source_.fail(element, i);
      if (use == List::strips && is_strip_end(*property.scalar, vertex)) {
        in_strip = 0;
        if (is_pause(k) && context_.cancelled()) return cancelled();
        continue;
      }
      if (vertex < 0 || static_cast<std::uint64_t>(vertex) >= vertex_count_)
        return source_.fail_text(out_of_range(i, vertex, vertex_count_));
      const VertexId corner = static_cast<VertexId>(vertex);
      if (use == List::corners) {
        out_.corners.push_back(corner);
        continue;
      }
      if (++in_strip >= 3) add_strip_triangle(last, corner, in_strip % 2 == 0);
      last = {last[1], corner};
    }
    return {};
  }

  /// -1 ends a strip, also where the type has no sign.
  static bool is_strip_end(const Scalar& scalar, std::int64_t vertex) {
    return vertex == -1 || (scalar.size == 4 && vertex == 0xFFFFFFFF);
  }

  /// Every second triangle of a strip runs the other way round. One with a repeated corner only
  /// leads on to the next and is none.
  void add_strip_triangle(const std::array<VertexId, 2>& last, VertexId corner, bool turned) {
    if (last[0] == last[1] || last[1] == corner || corner == last[0]) return;
    out_.corners.insert(out_.corners.end(), {last[turned ? 1 : 0], last[turned ? 0 : 1], corner});
    out_.starts.push_back(out_.corners.size());
  }

  Source source_;
  const Header& header_;
  PolygonFile& out_;
  const Context& context_;
  std::uint64_t vertex_count_;
};

std::string place(const Element& element, std::uint64_t i) {
  return element.name + " " + std::to_string(i) + " of " + std::to_string(element.count);
}

template <bool swapped>
class BinarySource {
 public:
  BinarySource(const FileBytes& file, std::size_t begin)
      : file_(file), at_(file.bytes.data() + begin), end_(file.bytes.data() + file.bytes.size()) {}

  std::uint64_t room() const { return static_cast<std::uint64_t>(end_ - at_); }
  std::uint64_t room(const Scalar& scalar) const { return room() / scalar.size; }
  double fraction() const {
    return 1.0 - static_cast<double>(room()) / static_cast<double>(file_.bytes.size());
  }
  bool number(const Scalar& scalar, double& value) {
    if (room() < scalar.size) return false;
    value = scalar.number[swapped](at_);
    at_ += scalar.size;
    return true;
  }
  bool integer(const Scalar& scalar, std::int64_t& value) {
    if (room() < scalar.size) return false;
    value = scalar.integer[swapped](at_);
    at_ += scalar.size;
    return true;
  }
  bool skip(const Scalar& scalar) {
    if (room() < scalar.size) return false;
    at_ += scalar.size;
    return true;
  }
  /// All elements of a kind without lists; false leaves it to find the one that is missing.
  bool skip_all(const Element& element) {
    const std::uint64_t size = element.least_bytes(Encoding::little_endian);
    if (room() / size < element.count) return false;
    at_ += size * element.count;
    return true;
  }
  Result<void> finish() const {
    // Zeros and blanks at the end are padding; anything else would be lost without a word.
    const bool padding = std::all_of(
        at_, end_, [](char c) { return c == '\0' || c == ' ' || c == '\n' || c == '\r'; });
    if (padding) return {};
    return arris::fail(file_.path + " is damaged: there are " + std::to_string(room()) +
                       " bytes after the elements that its header announces.");
  }
  tl::unexpected<Error> fail(const Element& element, std::uint64_t i) const {
    return arris::fail(file_.path + " is truncated, it ends in " + place(element, i) + ".");
  }
  tl::unexpected<Error> fail_length(const Element& element, std::uint64_t i,
                                    std::int64_t length) const {
    return arris::fail(file_.path + " is truncated or damaged: " + place(element, i) +
                       " should have a list of " + std::to_string(length) + " values, but only " +
                       std::to_string(room()) + " bytes follow.");
  }
  tl::unexpected<Error> fail_text(const std::string& what) const {
    return arris::fail(file_.path + ": " + what);
  }

 private:
  const FileBytes& file_;
  const char* at_;
  const char* end_;
};

class AsciiSource {
 public:
  AsciiSource(const FileBytes& file, const Header& header)
      : file_(file), text_(file.bytes.substr(header.size), {}, header.lines + 1) {}

  std::uint64_t room() const { return text_.remaining() / 2 + 1; }
  std::uint64_t room(const Scalar&) const { return room(); }
  double fraction() const {
    return 1.0 - static_cast<double>(text_.remaining()) / static_cast<double>(file_.bytes.size());
  }
  bool number(const Scalar&, double& value) {
    word_ = text_.word();
    const std::optional<double> parsed = parse_number(word_);
    value = parsed.value_or(0.0);
    return parsed.has_value();
  }
  bool integer(const Scalar&, std::int64_t& value) {
    word_ = text_.word();
    const std::optional<std::int64_t> parsed = parse_integer(word_);
    value = parsed.value_or(0);
    return parsed.has_value();
  }
  bool skip(const Scalar&) {
    word_ = text_.word();
    return !word_.empty();
  }
  bool skip_all(const Element&) { return false; }
  Result<void> finish() {
    word_ = text_.word();
    if (word_.empty()) return {};
    return fail_text("there is more after the elements that the header announces.");
  }
  tl::unexpected<Error> fail(const Element& element, std::uint64_t i) const {
    if (word_.empty())
      return fail_text("the file is truncated, it ends in " + place(element, i) + ".");
    return fail_text("expected a number in " + place(element, i) + ", " + found_instead(word_));
  }
  tl::unexpected<Error> fail_length(const Element& element, std::uint64_t i,
                                    std::int64_t length) const {
    return fail_text(place(element, i) + " should have a list of " + std::to_string(length) +
                     " values, which the rest of the file cannot hold.");
  }
  tl::unexpected<Error> fail_text(const std::string& what) const {
    return fail_at_line(file_, text_.line(), what);
  }

 private:
  const FileBytes& file_;
  TextScanner text_;
  std::string_view word_;
};

/// What the header must have for a mesh, and whether the file is large enough for its counts.
Result<void> check(const FileBytes& file, const Header& header) {
  const Element* const vertex = header.find("vertex");
  const Element* const face = header.find("face");
  if (!vertex) return fail(file.path + " has no vertices: its header has no element \"vertex\".");
  for (const char* axis : {"x", "y", "z"})
    if (!vertex->find(axis, false))
      return fail(file.path + ": its vertices have no coordinate \"" + axis + "\".");
  const Element* const strips = header.find(strips_name);
  if (!face && !strips)
    return fail(file.path + " holds no faces (" + std::to_string(vertex->count) +
                " points): its header has no element \"face\".");
  for (const Element* const element : {face, strips}) {
    if (!element) continue;
    const std::string what = element == face ? "faces" : "strips";
    const std::size_t list = Body<AsciiSource>::face_list(*element);
    if (list == element->properties.size())
      return fail(file.path + ": its " + what + " have no list \"vertex_indices\".");
    if (!element->properties[list].scalar->whole)
      return fail(file.path + ": its " + what +
                  " name their vertices by numbers that are not whole.");
  }

  // The last number of a text may lack the blank after it.
  const std::uint64_t held =
      file.bytes.size() - header.size + (header.encoding == Encoding::ascii ? 1 : 0);
  std::uint64_t needed = 0;
  for (const Element& element : header.elements) {
    const std::uint64_t each = element.least_bytes(header.encoding);
    if (each == 0) continue;
    if (element.count > (held - needed) / each)
      return fail(file.path + " is truncated or damaged: its header announces " +
                  std::to_string(element.count) + " elements \"" + element.name + "\", which its " +
                  std::to_string(file.bytes.size()) + " bytes cannot hold.");
    needed += element.count * each;
  }
  return {};
}

}  // namespace

Result<void> read_ply(const FileBytes& file, PolygonFile& out, const Context& context) {
  out.format = "PLY";
  const Result<Header> header = read_header(file);
  if (!header) return tl::unexpected(header.error());
  if (const Result<void> ok = check(file, *header); !ok) return ok;
  out.unit = header->unit;
  out.starts.push_back(0);
  constexpr bool little_machine = std::endian::native == std::endian::little;
  const Result<void> done =
      header->encoding == Encoding::ascii
          ? Body(AsciiSource(file, *header), *header, out, context).read()
      : (header->encoding == Encoding::little_endian) == little_machine
          ? Body(BinarySource<false>(file, header->size), *header, out, context).read()
          : Body(BinarySource<true>(file, header->size), *header, out, context).read();
  if (done && out.polygon_count() == 0 && header->find(strips_name))
    return fail(file.path + " holds no faces (" + std::to_string(out.points.size()) +
                " points): there is no triangle in its strips.");
  return done;
}

}  // namespace arris
