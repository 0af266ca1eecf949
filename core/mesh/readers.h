#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/mesh/polygon_file.h"

/// The readers behind read_polygon_file(). Each takes the whole file, fills in format, points,
/// polygons and welded corners of `out`, and names `path` in its errors.
namespace arris {

struct FileBytes {
  const std::string& path;
  std::string_view bytes;
};

Result<void> read_stl_binary(const FileBytes& file, PolygonFile& out, const Context& context);
Result<void> read_stl_ascii(const FileBytes& file, PolygonFile& out, const Context& context);
Result<void> read_ply(const FileBytes& file, PolygonFile& out, const Context& context);
Result<void> read_obj(const FileBytes& file, PolygonFile& out, const Context& context);
Result<void> read_off(const FileBytes& file, PolygonFile& out, const Context& context);
/// The parts of a 3MF package that its build asks for, each where its transforms put it, in one
/// list; their unit as the file names it.
Result<void> read_3mf(const FileBytes& file, PolygonFile& out, const Context& context);

/// True when a binary STL of just this size would have the triangle count these bytes hold.
bool has_size_of_binary_stl(std::string_view bytes);

/// True for a word that opens an OFF file: OFF, COFF, NOFF, STOFF, STCNOFF, 4OFF, nOFF..., also
/// with the number of vertices glued to it (OFF490).
bool is_off_header(std::string_view word);

/// Ids are 32 bits and OpenMesh's are signed.
inline constexpr std::uint64_t most_elements = 0x7FFFFFFEu;

inline tl::unexpected<Error> fail_at_line(const FileBytes& file, std::size_t line,
                                          const std::string& what) {
  return fail(file.path + ", line " + std::to_string(line) + ": " + what);
}

inline std::string out_of_range(std::uint64_t face, std::int64_t vertex,
                                std::uint64_t vertex_count) {
  return "face " + std::to_string(face) + " names vertex " + std::to_string(vertex) +
         " (counted from 0), but there are only " + std::to_string(vertex_count) + " vertices.";
}

/// Whether element i is one before which to ask for cancellation.
inline bool is_pause(std::uint64_t i) { return (i & 0xFFFF) == 0xFFFF; }

}  // namespace arris
