// arris_fuzz_seeds FOLDER: for each target a folder of inputs to begin with, and a dictionary
// (TARGET.dict), all made by our own code.

#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <vector>

#include "core/base/keyed_hash.h"
#include "core/document/document_bytes.h"
#include "core/document/flow.h"
#include "core/document/journal.h"
#include "core/document/session_file.h"
#include "tests/core/read_mesh_fixture.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/part.h"
#include "tests/support/documents.h"
#include "tests/support/packing.h"
#include "tests/support/whole_flow.h"

namespace {

using namespace arris;
using namespace arris::testing;
using nlohmann::json;

std::filesystem::path top;
std::map<std::string, int> counts;

void seed(const std::string& target, const std::string& bytes) {
  std::filesystem::create_directories(top / target);
  std::ofstream(top / target / ("seed-" + std::to_string(++counts[target])), std::ios::binary)
      << bytes;
}

void dictionary(const std::string& target, const std::set<std::string>& words) {
  std::ofstream file(top / (target + ".dict"));
  for (const std::string& word : words) {
    file << '"';
    for (const char c : word)
      if (c == '"' || c == '\\')
        file << '\\' << c;
      else if (c < ' ')
        file << "\\x"
             << "0123456789abcdef"[(c >> 4) & 15] << "0123456789abcdef"[c & 15];
      else
        file << c;
    file << "\"\n";
  }
}

void seed_readers() {
  seed("stl", binary_stl(pyramid_points, pyramid));
  seed("stl", binary_stl(pyramid_points, pyramid, "solid"));
  seed("stl", ascii_stl(pyramid_points, {{0, 1, 4}, {1, 2, 4}}));
  seed("stl", ascii_stl(pyramid_points, {{0, 1, 4}}, "\r\n"));
  seed(
      "stl",
      "solid a\nfacet normal 0 0 1\nouterloop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nend loop\n"
      "end facet\nendsolidA\nsolid b\nfacet\nouter loop\nvertex 1e0 .5 -1\nvertex 1 0 0\nvertex 0 "
      "1 "
      "0\nendloop\nendfacet\n");
  dictionary("stl", {"solid ", "facet normal ", "outer loop\n", "outerloop", "vertex ", "endloop\n",
                     "end loop", "endfacet\n", "end facet", "endsolid", "end solid", "nan", "inf",
                     "1.#QNAN", "1e999", "1,5", "\r\n"});
  for (const char* text :
       {"OFF490 2 0\n", "nOFF 4\n2 1 0\n0 0 0 0\n1 1 1 1\n3 0 1 1\n",
        "COFF 4\n2\n0 0 0 0 1 1 1 1 1 0\n0 1 1 1 1 1 1 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0 1 2 9\n3 0\n2 "
        "3\n",
        "STNOFF\n3 1 3\n0 0 0 0 0 1 0 0\n1 0 0 0 0 1 0 0\n0 1 0 0 0 1 0 0\n3 0 1 2\n"})
    seed("off", text);
  seed("off", off);
  dictionary("off", {"OFF", "COFF", "NOFF", "STOFF", "4OFF", "nOFF", "BINARY", "# comment\n", "nan",
                     "1e999", "2147483648", "4294967296", "-1"});
  seed("ply", ascii_ply);
  seed("ply", rich_binary_ply(false));
  seed("ply", rich_binary_ply(true));
  seed("ply",
       "ply\nformat ascii 1.0\nelement vertex 4\nproperty char x\nproperty uint y\n"
       "property double z\nelement tristrips 1\nproperty list int int "
       "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 -1 2 1 3 -1\n");
  seed("ply", ply_bytes(cube(2.0)));
  dictionary("ply", {"ply\n",
                     "format ascii 1.0\n",
                     "format binary_little_endian 1.0\n",
                     "format binary_big_endian 1.0\n",
                     "element vertex ",
                     "element face ",
                     "element tristrips ",
                     "element x ",
                     "property list uchar int vertex_indices\n",
                     "property float x\n",
                     "property double ",
                     "property char ",
                     "property list int ",
                     "end_header\n",
                     "comment ",
                     "obj_info ",
                     "uint",
                     "ushort",
                     "int8",
                     "float64",
                     "4294967295",
                     "9223372036854775807"});
  seed("obj", obj);
  seed("obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 0.5 0\nv 0 2 0\nf 1 2 3 4 5\nf 1 4 5 1\n");
  seed("obj", "v 0,0,0\nv 1, 0, 0\nv 0 1 0\nf 1 2 3 2 1\nfo -1/-1 -2//-3 -3/1/1\n");
  dictionary("obj", {"v ", "f ", "fo ", "vn ", "vt ", "vp ", "l ", "\\\n", "usemtl ", "g ", "#",
                     "-1", "1/2/3", "1//2", "nan", "1e999"});
  const std::string triangle =
      "<vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/><vertex x=\"0\" "
      "y=\"1\" z=\"0\"/></vertices><triangles><triangle v1=\"0\" v2=\"1\" v3=\"2\"/></triangles>";
  const std::string model = model_3mf(
      "unit=\"inch\"",
      "<object id=\"1\"><mesh>" + triangle +
          "</mesh></object><object id=\"2\"><components><component objectid=\"1\"/><component "
          "objectid=\"1\" transform=\"1 0 0 0 -1 0 0 0 1 5 0 0\"/></components></object>",
      "<item objectid=\"2\"/><item objectid=\"1\" transform=\"0 1 0 1 0 0 0 0 1 0 0 0\"/>");
  seed("3mf", model);
  seed("3mf", zipped({{"3D/3dmodel.model", model}}));
  seed("3mf",
       zipped({{"_rels/.rels",
                "<Relationships><Relationship Type=\"x/3dmodel\" "
                "Target=\"/a.model\"/></Relationships>"},
               {"a.model", model_3mf("", "", "<item objectid=\"1\" p:path=\"/b.model\"/>")},
               {"b.model",
                model_3mf("", "<object id=\"1\"><mesh>" + triangle + "</mesh></object>", "")}}));
  dictionary("3mf",
             {"<object id=\"1\">", "</object>", "<mesh>", "</mesh>", "<vertices>", "<triangles>",
              "<vertex x=\"0\" y=\"0\" z=\"0\"/>", "<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>",
              "<components>", "<component objectid=\"2\"/>", "<item objectid=\"1\"/>",
              "p:path=\"/b.model\"", "transform=\"1 0 0 0 1 0 0 0 1 0 0 0\"", "<!DOCTYPE x>",
              "&amp;", "unit=\"", "1e999"});
  for (const std::string& text : {off, ascii_ply, obj}) {
    seed("gz", text);
    seed("gz", gzipped(text));
  }
  seed("gz", gzipped(off.substr(0, 20)) + gzipped(off.substr(20)));
  dictionary("gz", {"\x1F\x8B\x08", "OFF", "ply\n"});
  std::string soup{20, 0};
  for (int k = 0; k < 60; ++k) soup += static_cast<char>(100 + (k * 37) % 48);
  for (int k = 0; k < 90; ++k) soup += static_cast<char>((k * 7) % 20);
  seed("soup", soup);
  std::string flat{4, 0};
  for (const char c : {'|', '|', '|', '\x84', '|', '|', '|', '\x84', '|', '\x84', '\x84', '|'})
    flat += c;
  for (const char c : {0, 1, 2, 1, 3, 2, 0, 2, 3, 0, 1, 2}) flat += c;
  seed("soup", flat);
  dictionary("soup", {});
}

/// A history with most kinds of operation, as far as each has something to do.
History long_history(const std::string& file) {
  History history;
  const auto run = [&](const Operation& operation) {
    if (const auto done = history.run(operation); !done && operation.name == "open")
      throw std::logic_error(done.error().message);
  };
  run({"open", {{"file", file}}});
  run({"find_sharp_lines", {{"method", "walk"}, {"angle", 30.0}, {"min_length", 0.0}}});
  run({"find_partitions", {{"intervals", {{0.0, 1.0}}}, {"min_faces", 1}}});
  const auto line = [&] { return history.current().lines.lines.front(); };
  const auto partition = [&](std::size_t k) {
    return history.current().partitions.partitions.at(k)->id;
  };
  const VertexId at = history.current().mesh->triangle(0)[0];
  const json region{{"vertices", {at}}, {"radius", 4.0}};
  run({"split_line", {{"line", line()->id}, {"vertex", line()->vertices[1]}}});
  run({"trim_line", {{"line", line()->id}, {"vertex", line()->vertices[0]}, {"side", "last"}}});
  run({"delete_lines", {{"lines", {line()->id}}}});
  run({"extend_line", {{"line", line()->id}, {"angle", 10.0}}});
  run({"draw_line", {{"vertices", {0, 1}}}});
  run({"recompute_lines", {{"region", region}, {"angle", 20.0}}});
  run({"connect_partitions", {{"partitions", {partition(0), partition(1)}}, {"lines", "remove"}}});
  run({"paint_partition", {{"partition", partition(0)}, {"region", region}}});
  run({"remove_partitions", {{"partitions", {partition(1)}}}});
  run({"extend_partition", {{"partition", partition(0)}, {"interval", {0.0, 2.0}}}});
  run({"restart_partitions", {{"partitions", {partition(0)}}, {"interval", {0.0, 1.0}}}});
  run({"fill_unassigned"});
  run({"smooth_boundaries", {{"rounds", 2}}});
  run({"split_to_four_sides"});
  run({"remove_small_partitions", {{"faces", 3}, {"fill", true}}});
  run({"lock", {{"lines", {line()->id}}}});
  run({"find_sharp_lines"});
  run({"find_partitions"});
  run({"simplify"});
  run({"swap_edges"});
  run({"find_sharp_lines", {{"method", "walk"}}});
  run({"equilateralize"});
  run({"smooth_curvature", {{"passes", 2}}});
  run({"find_partitions", {{"method", "fronts"}}});
  run({"delete_faces", {{"faces", {history.current().mesh->triangle(3)}}}});
  run({"flip_orientation"});
  static_cast<void>(history.set_name(2, "lines"));
  return history;
}

void seed_operations() {
  const std::string file = fuzz::file_with("part.ply", fuzz::part_bytes());
  const History history = long_history(file);
  std::set<std::string> words{"true", "false", "null", "{", "}", "[", "]", ",", ":", "1e300", "-1"};
  for (const OperationKind& kind : operation_table()) {
    words.insert("\"" + std::string(kind.name) + "\"");
    seed("operations", json{{"operation", kind.name}}.dump() + "\n");
  }
  std::string recipe, rows;
  for (const HistoryEntry& entry : history.entries()) {
    for (const auto& [name, value] : entry.operation.parameters.items()) {
      words.insert("\"" + name + "\"");
      if (value.is_string() && value.get<std::string>().size() < 20) words.insert(value.dump());
    }
    const std::string line = entry.operation.text() + "\n";
    seed("operations", line);
    recipe += line;
    if (entry.operation.name != "open") rows += line;
  }
  seed("journal", recipe);
  seed("journal", journal_text(history));
  seed("journal", R"({"operation": "open", "file": "a.ply"}
{"operation": "find_sharp_lines", "angle": 30}
{"operation": "find_partitions"}
)");
  seed("rows", rows);
  seed("rows",
       "move 1\n{\"operation\": \"find_sharp_lines\"}\nparent 1\n{\"operation\": "
       "\"find_partitions\"}\nname 2 lines\nmove 0\nmove 3\nblocks 4000\n");
  dictionary("operations", words);
  words.insert({"\"sequence\"", "\"parent\"", "\"hash\"", "\"head\"", "\"row\"", "\"name\""});
  dictionary("journal", words);
  words.insert({"move ", "name ", "parent ", "blocks "});
  dictionary("rows", words);

  SessionExtras extras;
  extras.part = "part.ply";
  extras.view = "{}";
  extras.key = std::string(hash_key_size, 'k');
  History shorter;
  for (std::size_t k = 0; k < 4; ++k)
    static_cast<void>(shorter.run(history.entries()[k].operation));
  for (const History* one : {&static_cast<const History&>(shorter), &history}) {
    const std::string path = fuzz::file_with("seed.arris", "");
    if (const auto saved = save_session(path, *one, extras); !saved)
      throw std::logic_error(saved.error().message);
    std::ostringstream bytes;
    bytes << std::ifstream(path, std::ios::binary).rdbuf();
    seed("session", bytes.str());
  }
  dictionary("session", {"SQLite format 3", "ARRS", "CREATE TABLE ", "rows", "scan_blocks"});

  for (const Flow flow : {Flow::scan, Flow::paper}) {
    Document document = fuzz::opened_part();
    for (const Operation& operation : operations_of(flow))
      if (Result<Document> next = apply(document, operation)) document = std::move(*next);
    const std::optional<std::string> bytes = bytes_of(document);
    if (!bytes) continue;
    constexpr std::size_t header = sizeof(std::uint32_t) + sizeof(std::uint64_t);
    std::string plain(std::size_t{1} << 22, '\0');
    uLongf made = plain.size();
    if (uncompress(reinterpret_cast<Bytef*>(plain.data()), &made,
                   reinterpret_cast<const Bytef*>(bytes->data() + header),
                   bytes->size() - header) != Z_OK)
      throw std::logic_error("uncompress");
    plain.resize(made);
    seed("snapshot", plain);
  }
  dictionary("snapshot", {});
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: arris_fuzz_seeds FOLDER\n";
    return 2;
  }
  top = argv[1];
  seed_readers();
  seed_operations();
  return 0;
}
