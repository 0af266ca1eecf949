#include <algorithm>
#include <optional>

#include "core/mesh/readers.h"
#include "core/mesh/text_scanner.h"

namespace arris {

namespace {

/// The vertex number of a corner: the part before the first slash of "7", "7/2", "7//4", "-1/2/3".
std::optional<std::int64_t> vertex_number(std::string_view corner) {
  const std::size_t slash = corner.find('/');
  if (slash != std::string_view::npos &&
      corner.find_first_not_of("0123456789+-/", slash) != std::string_view::npos)
    return std::nullopt;
  return parse_integer(corner.substr(0, slash));
}

}  // namespace

Result<void> read_obj(const FileBytes& file, PolygonFile& out, const Context& context) {
  out.format = "OBJ";
  out.starts.push_back(0);
  TextScanner text(file.bytes, {.hash_comments = true, .continued_lines = true});
  std::uint64_t lines = 0;
  for (std::string_view word = text.word(); !word.empty(); text.skip_line(), word = text.word()) {
    if (is_pause(++lines)) {
      if (context.cancelled()) return cancelled();
      context.report(
          1.0 - static_cast<double>(text.remaining()) / static_cast<double>(file.bytes.size()),
          "reading");
    }
    if (word == "v") {
      Point point;
      for (int axis = 0; axis < 3; ++axis) {
        const std::string_view number = text.word_in_line();
        const std::optional<double> value = parse_listed_number(number);
        if (!value)
          return fail_at_line(file, text.line(),
                              "vertex " + std::to_string(out.points.size()) +
                                  " needs three coordinates, " + found_instead(number));
        point[axis] = *value;
      }
      out.points.push_back(point);
    } else if (word == "f" || word == "fo") {  // "fo" is the old word for it
      for (std::string_view corner = text.word_in_line(); !corner.empty();
           corner = text.word_in_line()) {
        const std::optional<std::int64_t> number = vertex_number(corner);
        if (!number || *number == 0)
          return fail_at_line(file, text.line(),
                              "expected a vertex number, found " + quoted(corner) + ".");
        // Negative numbers count back from the vertex read last.
        const std::int64_t index =
            *number > 0 ? *number - 1 : *number + static_cast<std::int64_t>(out.points.size());
        if (index < 0 || static_cast<std::uint64_t>(index) > most_elements)
          return fail_at_line(file, text.line(),
                              "the face names vertex " + std::to_string(*number) + ", but " +
                                  std::to_string(out.points.size()) + " vertices precede it.");
        out.corners.push_back(static_cast<VertexId>(index));
      }
      out.starts.push_back(out.corners.size());
    }
    if (out.points.size() > most_elements) return fail(file.path + " has more than 2^31 vertices.");
  }

  // Vertices may follow the faces that name them, so the upper bound is known only now.
  const auto wrong = std::find_if(out.corners.begin(), out.corners.end(),
                                  [&](VertexId v) { return v >= out.points.size(); });
  if (wrong != out.corners.end()) {
    const std::uint64_t corner = static_cast<std::uint64_t>(wrong - out.corners.begin());
    const auto face = std::upper_bound(out.starts.begin(), out.starts.end(), corner) - 1;
    return fail(file.path + ": " +
                out_of_range(static_cast<std::uint64_t>(face - out.starts.begin()), *wrong,
                             out.points.size()));
  }
  return {};
}

}  // namespace arris
