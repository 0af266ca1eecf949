#include "core/mesh/foreign_file.h"

#include "core/mesh/text_scanner.h"

namespace arris {

namespace {

using namespace std::string_view_literals;

constexpr std::string_view surface = "export its surface as STL, PLY, OBJ or 3MF";
constexpr std::string_view points = "make a surface of its points first";
constexpr std::string_view unpack = "unpack it first";
constexpr std::string_view plain_text = "save it as plain (ASCII or UTF-8) text";

struct Mark {
  std::size_t at;  // byte where it stands
  std::string_view bytes, what, advice;
};

constexpr Mark marks[] = {
    {0, "\x89PNG"sv, "a PNG picture", {}},
    {0, "\xFF\xD8\xFF"sv, "a JPEG picture", {}},
    {0, "GIF8"sv, "a GIF picture", {}},
    {0, "II*\0"sv, "a TIFF picture", {}},
    {0, "MM\0*"sv, "a TIFF picture", {}},
    {0, "%PDF"sv, "a PDF document", {}},
    {0, "{\\rtf"sv, "a text document (RTF)", {}},
    {0, "\xD0\xCF\x11\xE0"sv, "an Office or SolidWorks document", surface},
    {0, "7z\xBC\xAF\x27\x1C"sv, "a 7z archive", unpack},
    {0, "Rar!"sv, "a RAR archive", unpack},
    {0, "BZh"sv, "compressed by bzip2", unpack},
    {0,
     "\xFD"
     "7zXZ\0"sv,
     "compressed by xz", unpack},
    {0, "\x28\xB5\x2F\xFD"sv, "compressed by zstd", unpack},
    {257, "ustar"sv, "a tar archive", unpack},
    {0, "SQLite format 3\0"sv, "an SQLite database", {}},
    {0,
     "\x7F"
     "ELF"sv,
     "a program",
     {}},
    {0, "MZ"sv, "a program", {}},
    {0, "\xFF\xFE"sv, "text in UTF-16", plain_text},
    {0, "\xFE\xFF"sv, "text in UTF-16", plain_text},
    {0, "version https://git-lfs"sv, "a pointer to a file in Git LFS", "fetch the file itself"},
    {0, "ISO-10303-21"sv, "a STEP file", surface},
    {0, "DBRep_DrawableShape"sv, "a BREP file", surface},
    {0, "CASCADE Topology"sv, "a BREP file", surface},
    {0, "**ABCDEFGHIJKLMNOPQRSTUVWXYZ"sv, "a Parasolid file", surface},
    {0, "3D Geometry File Format"sv, "a Rhino file", surface},
    {0, "AutoCAD Binary DXF"sv, "a DXF file", surface},
    {0, "AC10"sv, "a DWG drawing", surface},
    {0, "Kaydara FBX Binary"sv, "an FBX scene", surface},
    {0, "BLENDER"sv, "a Blender scene", surface},
    {0, "glTF"sv, "a glTF scene", surface},
    {0, "#VRML"sv, "a VRML scene", surface},
    {0, "#X3D"sv, "an X3D scene", surface},
    {0, "# vtk DataFile"sv, "a VTK file", surface},
    {0, ".PCD"sv, "a point cloud (PCD)", points},
    {0, "# .PCD"sv, "a point cloud (PCD)", points},
    {0, "LASF"sv, "a point cloud (LAS)", points},
    {0, "ASTM-E57"sv, "a point cloud (E57)", points},
    {0, "\x93NUMPY"sv, "a NumPy array", {}},
    {0, "\x89HDF"sv, "an HDF5 file", {}},
};

bool contains(std::string_view bytes, std::string_view word) {
  return bytes.find(word) != std::string_view::npos;
}

}  // namespace

std::optional<ForeignFile> name_foreign_file(std::string_view bytes) {
  const auto named = [](std::string_view what, std::string_view advice = {}) {
    return ForeignFile{std::string(what), std::string(advice)};
  };
  for (const Mark& mark : marks)
    if (bytes.size() >= mark.at && bytes.substr(mark.at).starts_with(mark.bytes))
      return named(mark.what, mark.advice);
  const std::string_view head = bytes.substr(0, 4096);
  TextScanner text(head, {});
  const std::string_view first = text.word();
  if (first.starts_with('<')) {
    if (contains(head, "<COLLADA")) return named("a COLLADA scene", surface);
    if (contains(head, "<X3D")) return named("an X3D scene", surface);
    if (contains(head, "<amf")) return named("an AMF file", surface);
    if (contains(head, "<VTKFile")) return named("a VTK file", surface);
    if (contains(head, "<svg")) return named("an SVG drawing");
    if (contains(head, "<html") || contains(head, "<HTML") || contains(head, "<!DOCTYPE html"))
      return named("a web page", "fetch the file itself");
    return named("an XML document");
  }
  if (first.starts_with('{') || first.starts_with('[')) {
    if (contains(head, "\"operation\"")) return named("a list of operations", "replay it");
    if (contains(head, "\"asset\"")) return named("a glTF scene", surface);
    return named("a JSON document");
  }
  if (first == "0" && text.word() == "SECTION") return named("a DXF file", surface);
  if (first == "$MeshFormat") return named("a Gmsh file", surface);
  // The letter that names a section of an IGES file stands in column 73.
  if (bytes.size() > 80 && bytes[72] == 'S' && bytes.substr(73, 7).find('1') != bytes.npos)
    return named("an IGES file", surface);
  return std::nullopt;
}

bool is_list_of_points(std::string_view bytes) {
  TextScanner text(bytes.substr(0, 4096), {.hash_comments = true});
  const bool whole = bytes.size() <= 4096;
  std::size_t rows = 0;
  for (std::string_view word = text.word(); !word.empty(); word = text.word()) {
    std::size_t numbers = 0;
    for (; !word.empty(); word = text.word_in_line(), ++numbers)
      if (!parse_listed_number(word)) return rows >= 3 && !whole && text.remaining() == 0;
    if (numbers == 1 && rows == 0) continue;  // how many there are
    if (numbers < 3 && (whole || text.remaining() > 0)) return false;
    ++rows;
  }
  return rows >= 3;
}

}  // namespace arris
