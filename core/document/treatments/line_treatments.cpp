// The interactive treatments of sharp lines (section 6.3.2).

#include <algorithm>

#include "core/base/words.h"
#include "core/document/treatments/treatments.h"

namespace arris {

namespace {

using nlohmann::json;

bool after_lines(const json&, Round round) { return round == Round::after_lines; }

/// TV_IH in force; before lines were found, what an engineer calls sharp.
double angle_in_force(const Document& document) {
  return document.find_sharp_lines ? document.find_sharp_lines->parameters.value("angle", 30.0)
                                   : SharpLineOptions().angle;
}

double read_angle(ParameterReader& reader, const Document& document) {
  return reader.real("angle", angle_in_force(document), 0.1, 179.9);
}

std::string of_line(const char* done, const json& parameters) {
  return std::string(done) + " " + targets_in_words(parameters, "line", "lines");
}

std::string words_of_delete(const json& parameters) { return of_line("Delete", parameters); }
std::string words_of_trim(const json& parameters) { return of_line("Trim", parameters); }
std::string words_of_split(const json& parameters) { return of_line("Split", parameters); }
std::string words_of_reroute(const json& parameters) { return of_line("Reroute", parameters); }

// delete_lines: {lines: [ids]}

Result<json> resolve_delete(const Document& document, const json& given) {
  ParameterReader reader("delete_lines", given);
  read_lines(reader, document, "lines", "paths", false);
  reader.raw("spared");
  if (const auto checked = reader.check(); !checked) return tl::unexpected<Error>(checked.error());
  read_spared(reader, document, paths_of(reader.resolved("paths")));
  return reader.finish();
}

Result<Outcome> delete_lines(Ground& ground, const json& parameters, Round round) {
  remove_paths(ground, paths_of(parameters.at("paths")), parameters.at("spared"), round);
  return Outcome{};
}

// extend_line: {line: id, angle: degrees, ends: both | first | last, candidates: 3}

Result<json> resolve_extend(const Document& document, const json& given) {
  ParameterReader reader("extend_line", given);
  read_lines(reader, document, "line", "path", true);
  read_angle(reader, document);
  reader.choice("ends", "both", {"both", "first", "last"});
  reader.whole("candidates", SharpLineOptions().candidates, 1, 32);
  return reader.finish();
}

Result<Outcome> extend(Ground& ground, const json& parameters, Round round) {
  Outcome outcome;
  const Path anchor = path_of(parameters.at("path"));
  const Result<LinePtr> line = find_line(ground, parameters.at("line"), anchor, round, outcome);
  if (!line) return tl::unexpected<Error>(line.error());
  if ((*line)->closed) return fail("A closed line has no end to extend.");
  const std::string wanted = parameters.at("ends");
  EndsToExtend ends = wanted == "both"    ? EndsToExtend::both
                      : wanted == "first" ? EndsToExtend::first
                                          : EndsToExtend::last;
  // Which end is which is decided by the anchor.
  const auto distance = [&](VertexId a, VertexId b) {
    return (ground.mesh.point(a) - ground.mesh.point(b)).norm();
  };
  const VertexId first = (*line)->vertices.front(), last = (*line)->vertices.back();
  if (ends != EndsToExtend::both && round != Round::first &&
      distance(anchor.front(), last) + distance(anchor.back(), first) <
          distance(anchor.front(), first) + distance(anchor.back(), last))
    ends = ends == EndsToExtend::first ? EndsToExtend::last : EndsToExtend::first;
  ground.change(extend_line(ground.mesh, ground.measures(), ground.lines, **line, ends,
                            parameters.at("angle"), parameters.at("candidates")));
  return outcome;
}

std::string words_of_extend(const json& parameters) {
  return of_line("Extend", parameters) +
         (parameters.contains("angle")
              ? " down to " + degrees_in_words(parameters["angle"].get<double>())
              : "");
}

// trim_line: {line: id, vertex: v, side: first | last}: the part on that side of the vertex goes

Result<json> resolve_trim(const Document& document, const json& given) {
  ParameterReader reader("trim_line", given);
  read_lines(reader, document, "line", "path", false);
  const VertexId vertex = read_vertex(reader, document, "vertex");
  const std::string side = reader.choice("side", "last", {"first", "last"});
  reader.raw("spared");
  if (const auto checked = reader.check(); !checked) return tl::unexpected<Error>(checked.error());
  const Path path = path_of(reader.resolved("path"));
  const auto place = std::find(path.begin(), path.end(), vertex);
  if (path.front() == path.back() || place == path.end() ||
      (side == "first" ? place == path.begin() : place + 1 == path.end())) {
    reader.fault("vertex", "a vertex of the open line, not its end on that side");
    return reader.finish();
  }
  const Path section = side == "first" ? Path(path.begin(), place + 1) : Path(place, path.end());
  read_spared(reader, document, {section});
  return reader.finish();
}

Result<Outcome> trim(Ground& ground, const json& parameters, Round round) {
  const Path path = path_of(parameters.at("path"));
  const auto place = std::find(path.begin(), path.end(), parameters.at("vertex").get<VertexId>());
  remove_paths(
      ground,
      {parameters.at("side") == "first" ? Path(path.begin(), place + 1) : Path(place, path.end())},
      parameters.at("spared"), round);
  return Outcome{};
}

// split_line: {line: id, vertex: v}

Result<json> resolve_split(const Document& document, const json& given) {
  ParameterReader reader("split_line", given);
  read_lines(reader, document, "line", "path", false);
  const VertexId vertex = read_vertex(reader, document, "vertex");
  if (const auto checked = reader.check(); !checked) return tl::unexpected<Error>(checked.error());
  const Path path = path_of(reader.resolved("path"));
  const bool on_line = std::find(path.begin(), path.end(), vertex) != path.end();
  if (!on_line ||
      (path.front() != path.back() && (vertex == path.front() || vertex == path.back())))
    reader.fault("vertex", "a vertex inside the line");
  return reader.finish();
}

Result<Outcome> split(Ground& ground, const json& parameters, Round) {
  const VertexId vertex = parameters.at("vertex");
  if (sharp_edges_at(ground.mesh, ground.lines, vertex).size() != 2)
    return fail("No single line runs through that point, so there is none to split.");
  ground.change(LineChanges{{}, {vertex}});
  return Outcome{};
}

// merge_lines: {a: id, b: id, angle: degrees}

Result<json> resolve_merge(const Document& document, const json& given) {
  ParameterReader reader("merge_lines", given);
  read_lines(reader, document, "a", "path_a", true);
  read_lines(reader, document, "b", "path_b", true);
  read_angle(reader, document);
  if (const auto checked = reader.check(); !checked) return tl::unexpected<Error>(checked.error());
  if (reader.resolved("a") == reader.resolved("b")) reader.fault("b", "another line than \"a\"");
  return reader.finish();
}

Result<Outcome> merge(Ground& ground, const json& parameters, Round round) {
  Outcome outcome;
  const Result<LinePtr> a =
      find_line(ground, parameters.at("a"), path_of(parameters.at("path_a")), round, outcome);
  if (!a) return tl::unexpected<Error>(a.error());
  const Result<LinePtr> b =
      find_line(ground, parameters.at("b"), path_of(parameters.at("path_b")), round, outcome);
  if (!b) return tl::unexpected<Error>(b.error());
  if (*a == *b) return Outcome{"They are one line already."};
  const Result<Path> path = bridge_between(ground.mesh, ground.measures(), ground.lines, **a, **b,
                                           parameters.at("angle"));
  if (!path) return tl::unexpected<Error>(path.error());
  ground.change(add_path(ground.mesh, ground.lines, *path, Origin::merged));
  return outcome;
}

std::string words_of_merge(const json& parameters) {
  if (!parameters.contains("a") || !parameters.contains("b")) return "Merge lines";
  return "Merge lines " + parameters["a"].dump() + " and " + parameters["b"].dump();
}

// draw_line: {vertices: [v, ...], or paths: [[v, ...], ...] for several lines, angle: degrees,
// part: whether partitions that the lines part fall into their pieces at once}

Result<json> resolve_draw(const Document& document, const json& given) {
  ParameterReader reader("draw_line", given);
  if (reader.has("vertices") == reader.has("paths")) {
    reader.fault("vertices", "either the vertices of a line or the paths of several");
  } else if (reader.has("vertices")) {
    read_path(reader, document, "vertices", 2);
  } else {
    const json paths = reader.raw("paths");
    if (!paths.is_array() || paths.empty()) reader.fault("paths", "a list of paths");
    for (std::size_t k = 0; paths.is_array() && k < paths.size(); ++k) {
      const json one{{"path", paths[k]}};
      ParameterReader path("draw_line", one);
      read_path(path, document, "path", 2);
      if (!path.check()) reader.fault("paths", "paths of two or more vertices of the working mesh");
    }
    reader.set("paths", paths);
  }
  read_angle(reader, document);
  reader.flag("part", true);
  return reader.finish();
}

Result<Outcome> draw(Ground& ground, const json& parameters, Round round) {
  Outcome outcome;
  std::vector<Path> lines = parameters.contains("paths")
                                ? paths_of(parameters.at("paths"))
                                : std::vector<Path>{path_of(parameters.at("vertices"))};
  if (round != Round::first) {
    std::size_t before = 0, after = 0;
    for (Path& points : lines) {
      before += points.size();
      std::erase_if(points, [&](VertexId v) {
        return v >= ground.mesh.vertex_count() || ground.mesh.is_isolated(v);
      });
      after += points.size();
    }
    if (after < before)
      outcome.adapted = std::to_string(before - after) + " of its " + std::to_string(before) +
                        " points are no longer in the working mesh.";
  }
  for (Path& points : lines) {
    Result<Path> path =
        path_through(ground.mesh, ground.measures(), points, parameters.at("angle"));
    if (!path) return tl::unexpected<Error>(path.error());
    points = std::move(*path);
  }
  for (const Path& path : lines)
    ground.change(add_path(ground.mesh, ground.lines, path, Origin::drawn));
  if (round == Round::first && parameters.at("part")) ground.part_along(lines);
  return outcome;
}

/// Version 1 left partitions as they were.
json upgrade_draw(int, json parameters) {
  parameters["part"] = false;
  return parameters;
}

std::string words_of_draw(const json& parameters) {
  if (const auto paths = parameters.find("paths"); paths != parameters.end() && paths->is_array())
    return paths->size() == 1 ? std::string("Draw a line")
                              : "Draw " + counted(paths->size(), "line", "lines");
  return parameters.contains("vertices")
             ? "Draw a line through " + counted(parameters["vertices"].size(), "point", "points")
             : "Draw a line";
}

// reroute_line: {line: id, from: v, to: v, via: v}: between `from` and `to` it runs through `via`

Result<json> resolve_reroute(const Document& document, const json& given) {
  ParameterReader reader("reroute_line", given);
  read_lines(reader, document, "line", "path", false);
  const VertexId from = read_vertex(reader, document, "from");
  const VertexId to = read_vertex(reader, document, "to");
  read_vertex(reader, document, "via");
  read_angle(reader, document);
  reader.raw("spared");
  if (const auto checked = reader.check(); !checked) return tl::unexpected<Error>(checked.error());
  const Path path = path_of(reader.resolved("path"));
  const auto a = std::find(path.begin(), path.end(), from);
  const auto b = std::find(path.begin(), path.end(), to);
  if (a == path.end() || b == path.end() || a >= b) {
    reader.fault("from", "vertices of the line, \"from\" before \"to\" along it");
    return reader.finish();
  }
  read_spared(reader, document, {Path(a, b + 1)});
  return reader.finish();
}

Result<Outcome> reroute(Ground& ground, const json& parameters, Round round) {
  const Path path = path_of(parameters.at("path"));
  const VertexId from = parameters.at("from"), to = parameters.at("to");
  const auto a = std::find(path.begin(), path.end(), from);
  const auto b = std::find(path.begin(), path.end(), to);
  const VertexId via = parameters.at("via");
  // Not back along the stretch that it leaves.
  const auto is_left = [&](VertexId v) { return v != via && std::find(a + 1, b, v) != b; };
  const Result<Path> way = path_through(
      ground.mesh, ground.measures(), {from, via, to}, parameters.at("angle"), [&](EdgeId e) {
        return !is_left(ground.mesh.edge(e)[0]) && !is_left(ground.mesh.edge(e)[1]);
      });
  if (!way) return tl::unexpected<Error>(way.error());
  remove_paths(ground, {Path(a, b + 1)}, parameters.at("spared"), round);
  ground.change(add_path(ground.mesh, ground.lines, *way, Origin::drawn));
  return Outcome{};
}

// recompute_lines: {lines: [ids] or region, angle, max_angle, convexity, candidates, min_length}

Result<json> resolve_recompute(const Document& document, const json& given) {
  ParameterReader reader("recompute_lines", given);
  if (reader.has("lines") == reader.has("region"))
    reader.fault("lines", "either lines or a region");
  else if (reader.has("lines"))
    read_lines(reader, document, "lines", "paths", false);
  else
    read_region(reader, document, "region");
  read_angle(reader, document);
  read_bounds(reader);
  reader.whole("candidates", SharpLineOptions().candidates, 1, 32);
  const double longest = 1000.0 * document.mesh->diagonal();
  reader.real("min_length", 0.0, 0.0, longest);
  return reader.finish();
}

Result<Outcome> recompute(Ground& ground, const json& parameters, Round) {
  SharpLineOptions options = line_options_of(parameters);
  if (ground.evidence) {
    options.method = LineMethod::normal_jump;
    options.bridge_gap = default_bridge_gap(ground.mesh, options.method);
  }
  BrushedRegion region;
  if (parameters.contains("region")) {
    region = region_of(parameters.at("region"));
  } else {
    constexpr double beside = 2.0;  // mean edges: a strip in which the line may run otherwise
    region.radius = beside * ground.mesh.mean_edge_length();
    for (const Path& path : paths_of(parameters.at("paths")))
      region.stroke.insert(region.stroke.end(), path.begin(), path.end());
  }
  const auto vertices = vertices_of(ground.mesh, region);
  if (vertices.empty()) return fail("No vertex of the region is in the working mesh.");
  ground.change(recompute_region(ground.mesh, ground.measures(), ground.evidence.get(),
                                 ground.lines, vertices, options));
  return Outcome{};
}

std::string words_of_recompute(const json& parameters) {
  const std::string what = parameters.contains("region") ? "Find lines again in a region"
                                                         : of_line("Recompute", parameters);
  if (!parameters.contains("angle")) return what;
  return what + ", " + degrees_in_words(parameters["angle"].get<double>());
}

}  // namespace

const Treatment delete_lines_treatment{"delete_lines", after_lines, delete_lines};
const Treatment extend_line_treatment{"extend_line", after_lines, extend};
const Treatment trim_line_treatment{"trim_line", after_lines, trim};
const Treatment split_line_treatment{"split_line", after_lines, split};
const Treatment merge_lines_treatment{"merge_lines", after_lines, merge};
const Treatment draw_line_treatment{"draw_line", after_lines, draw};
const Treatment reroute_line_treatment{"reroute_line", after_lines, reroute};
const Treatment recompute_lines_treatment{"recompute_lines", after_lines, recompute};

const OperationKind delete_lines_operation{
    "delete_lines", "Delete lines", 1, resolve_delete, perform_once<delete_lines_treatment>,
    words_of_delete};
const OperationKind extend_line_operation{
    "extend_line",  "Extend line", 1, resolve_extend, perform_once<extend_line_treatment>,
    words_of_extend};
const OperationKind trim_line_operation{
    "trim_line", "Trim line", 1, resolve_trim, perform_once<trim_line_treatment>, words_of_trim};
const OperationKind split_line_operation{
    "split_line",  "Split line", 1, resolve_split, perform_once<split_line_treatment>,
    words_of_split};
const OperationKind merge_lines_operation{
    "merge_lines", "Merge lines", 1, resolve_merge, perform_once<merge_lines_treatment>,
    words_of_merge};
const OperationKind draw_line_operation{
    "draw_line",   "Draw line", 2, resolve_draw, perform_once<draw_line_treatment>,
    words_of_draw, upgrade_draw};
const OperationKind reroute_line_operation{
    "reroute_line",  "Reroute line", 1, resolve_reroute, perform_once<reroute_line_treatment>,
    words_of_reroute};
const OperationKind recompute_lines_operation{"recompute_lines",
                                              "Recompute lines",
                                              1,
                                              resolve_recompute,
                                              perform_once<recompute_lines_treatment>,
                                              words_of_recompute};

}  // namespace arris
