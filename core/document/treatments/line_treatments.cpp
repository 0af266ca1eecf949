// The interactive treatments of sharp lines (section 6.3.2).

#include <algorithm>

#include "core/base/words.h"
#include "core/document/operations/operations.h"
#include "core/document/treatments/treatment.h"

namespace arris {

namespace {

using nlohmann::json;

bool after_lines(const json&, Round round) { return round == Round::after_lines; }

/// TV_IH in force; before lines were found, what an engineer calls sharp.
double angle_in_force(const Document& document) {
  return document.step("find_sharp_lines")
             ? document.step("find_sharp_lines")->parameters.value("angle", 30.0)
             : SharpLineOptions().angle;
}

json angle_of_lines(const DefaultFrom& from) { return angle_in_force(from.document); }

std::string of_line(const char* done, const json& parameters) {
  return std::string(done) + " " + targets_in_words(parameters, "line", "lines");
}

std::string words_of_delete(const json& parameters) { return of_line("Delete", parameters); }
std::string words_of_trim(const json& parameters) { return of_line("Trim", parameters); }
std::string words_of_line_split(const json& parameters) { return of_line("Split", parameters); }
std::string words_of_reroute(const json& parameters) { return of_line("Reroute", parameters); }

void complete_delete(ParameterReader& reader) {
  complete_spared(reader, paths_of(reader.resolved("paths")));
}

Result<TreatmentOutcome> delete_lines(Ground& ground, const json& parameters, Round round) {
  remove_paths(ground, paths_of(parameters.at("paths")), parameters.at("spared"), round);
  return TreatmentOutcome{};
}

Result<TreatmentOutcome> extend_line(Ground& ground, const json& parameters, Round round) {
  TreatmentOutcome outcome;
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

std::string words_of_line_extend(const json& parameters) {
  return of_line("Extend", parameters) +
         (parameters.contains("angle")
              ? " down to " + degrees_in_words(parameters.at("angle").get<double>())
              : "");
}

/// The part on that side of the vertex goes.
void complete_trim(ParameterReader& reader) {
  const bool first = reader.resolved("side") == "first";
  const Path path = path_of(reader.resolved("path"));
  const auto place = std::find(path.begin(), path.end(), reader.resolved("vertex").get<VertexId>());
  if (path.front() == path.back() || place == path.end() ||
      (first ? place == path.begin() : place + 1 == path.end()))
    return reader.fault("vertex", "a vertex of the open line, not its end on that side");
  complete_spared(reader, {first ? Path(path.begin(), place + 1) : Path(place, path.end())});
}

Result<TreatmentOutcome> trim(Ground& ground, const json& parameters, Round round) {
  const Path path = path_of(parameters.at("path"));
  const auto place = std::find(path.begin(), path.end(), parameters.at("vertex").get<VertexId>());
  remove_paths(
      ground,
      {parameters.at("side") == "first" ? Path(path.begin(), place + 1) : Path(place, path.end())},
      parameters.at("spared"), round);
  return TreatmentOutcome{};
}

void complete_split(ParameterReader& reader) {
  const VertexId vertex = reader.resolved("vertex");
  const Path path = path_of(reader.resolved("path"));
  const bool on_line = std::find(path.begin(), path.end(), vertex) != path.end();
  if (!on_line ||
      (path.front() != path.back() && (vertex == path.front() || vertex == path.back())))
    reader.fault("vertex", "a vertex inside the line");
}

Result<TreatmentOutcome> split_line(Ground& ground, const json& parameters, Round) {
  const VertexId vertex = parameters.at("vertex");
  if (sharp_edges_at(ground.mesh, ground.lines, vertex).size() != 2)
    return fail("No single line runs through that point, so there is none to split.");
  ground.change(LineChanges{{}, {vertex}});
  return TreatmentOutcome{};
}

void complete_merge(ParameterReader& reader) {
  if (reader.resolved("a") == reader.resolved("b")) reader.fault("b", "another line than \"a\"");
}

Result<TreatmentOutcome> merge(Ground& ground, const json& parameters, Round round) {
  TreatmentOutcome outcome;
  const Result<LinePtr> a =
      find_line(ground, parameters.at("a"), path_of(parameters.at("path_a")), round, outcome);
  if (!a) return tl::unexpected<Error>(a.error());
  const Result<LinePtr> b =
      find_line(ground, parameters.at("b"), path_of(parameters.at("path_b")), round, outcome);
  if (!b) return tl::unexpected<Error>(b.error());
  if (*a == *b) return TreatmentOutcome{"They are one line already."};
  const Result<Path> path = bridge_between(ground.mesh, ground.measures(), ground.lines, **a, **b,
                                           parameters.at("angle"));
  if (!path) return tl::unexpected<Error>(path.error());
  ground.change(add_path(ground.mesh, ground.lines, *path, Origin::merged));
  return outcome;
}

std::string words_of_merge(const json& parameters) {
  if (!parameters.contains("a") || !parameters.contains("b")) return "Merge lines";
  return "Merge lines " + parameters.at("a").dump() + " and " + parameters.at("b").dump();
}

Result<TreatmentOutcome> draw(Ground& ground, const json& parameters, Round round) {
  TreatmentOutcome outcome;
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
             ? "Draw a line through " + counted(parameters.at("vertices").size(), "point", "points")
             : "Draw a line";
}

void complete_reroute(ParameterReader& reader) {
  const Path path = path_of(reader.resolved("path"));
  const auto a = std::find(path.begin(), path.end(), reader.resolved("from").get<VertexId>());
  const auto b = std::find(path.begin(), path.end(), reader.resolved("to").get<VertexId>());
  if (a == path.end() || b == path.end() || a >= b)
    return reader.fault("from", "vertices of the line, \"from\" before \"to\" along it");
  complete_spared(reader, {Path(a, b + 1)});
}

Result<TreatmentOutcome> reroute(Ground& ground, const json& parameters, Round round) {
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
  return TreatmentOutcome{};
}

Result<TreatmentOutcome> recompute_line(Ground& ground, const json& parameters, Round) {
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
  return TreatmentOutcome{};
}

std::string words_of_line_recompute(const json& parameters) {
  const std::string what = parameters.contains("region") ? "Find lines again in a region"
                                                         : of_line("Recompute", parameters);
  if (!parameters.contains("angle")) return what;
  return what + ", " + degrees_in_words(parameters.at("angle").get<double>());
}

// What rows have in common.

Parameter line_parameter(bool may_be_locked) {
  return {.name = "line",
          .kind = ParameterKind::line,
          .help = "The line that is meant.",
          .may_be_locked = may_be_locked,
          .anchors = "path"};
}

Parameter lines_parameter() {
  return {.name = "lines",
          .kind = ParameterKind::lines,
          .help = "The lines that are meant.",
          .anchors = "paths"};
}

Parameter vertex_parameter(std::string_view name, std::string_view help) {
  return {.name = name, .kind = ParameterKind::vertex, .help = help};
}

Parameter angle_parameter(std::string_view help) {
  return {.name = "angle",
          .kind = ParameterKind::real,
          .label = "Angle",
          .help = help,
          .unit = "°",
          .least = 0.1,
          .most = 179.9,
          .otherwise = {"the angle that lines were found with", angle_of_lines},
          .from = 1.0,
          .to = 90.0};
}

constexpr std::string_view edges_follow = "Exterior angle an edge must have.";

OperationKind recompute_lines_row() {
  Parameter lines = lines_parameter();
  lines.one_of = "where";
  std::vector<Parameter> parameters{
      lines,
      {.name = "region",
       .kind = ParameterKind::region,
       .help = "What was brushed.",
       .one_of = "where"},
      angle_parameter(edges_follow),
  };
  const std::vector<Parameter> of_edges = kinds_of_edges();
  parameters.insert(parameters.end(), of_edges.begin(), of_edges.end());
  parameters.push_back({.name = "min_length",
                        .kind = ParameterKind::real,
                        .help = "Isolated lines shorter than this are not kept.",
                        .unit = unit_of_part,
                        .most = longest_length,
                        .otherwise = 0.0});
  for (Parameter& parameter : parameters) parameter.method = {};  // it has none of its own
  return {.name = "recompute_lines",
          .title = "Recompute lines",
          .help = "Finds lines again, or in a region, under an angle of their own.",
          .parameters = parameters,
          .words = words_of_line_recompute,
          .treat = recompute_line,
          .belongs = after_lines};
}

}  // namespace

std::vector<OperationKind> line_treatment_rows() {
  return {
      {.name = "delete_lines",
       .title = "Delete lines",
       .help = "Takes lines away; they stay away when lines are found again.",
       .parameters = {lines_parameter(), spared_parameter()},
       .words = words_of_delete,
       .complete = complete_delete,
       .treat = delete_lines,
       .belongs = after_lines},
      {.name = "extend_line",
       .title = "Extend line",
       .help = "The ends of a line go on under an angle of their own.",
       .parameters =
           {line_parameter(true),
            angle_parameter(edges_follow),
            {.name = "ends",
             .kind = ParameterKind::choice,
             .label = "Ends",
             .help = "Which ends of the line go on",
             .choices = {{"both", "Both ends"}, {"first", "First end"}, {"last", "Last end"}},
             .otherwise = "both"},
            {.name = "candidates",
             .kind = ParameterKind::whole,
             .help = "Edges kept at a vertex by the candidate rule (figure 26).",
             .least = 1,
             .most = 32,
             .otherwise = SharpLineOptions().candidates}},
       .words = words_of_line_extend,
       .treat = extend_line,
       .belongs = after_lines},
      {.name = "trim_line",
       .title = "Trim line",
       .help = "Takes away the part of a line beyond a vertex.",
       .parameters = {line_parameter(false),
                      vertex_parameter("vertex", "Where it is cut, on the line."),
                      {.name = "side",
                       .kind = ParameterKind::choice,
                       .help = "Which part goes, by the direction of the line.",
                       .choices = {{"first", "First side"}, {"last", "Last side"}},
                       .otherwise = "last"},
                      spared_parameter()},
       .words = words_of_trim,
       .complete = complete_trim,
       .treat = trim,
       .belongs = after_lines},
      {.name = "split_line",
       .title = "Split line",
       .help = "Makes two lines of one at a vertex.",
       .parameters = {line_parameter(false),
                      vertex_parameter("vertex", "Where it is split, inside the line.")},
       .words = words_of_line_split,
       .complete = complete_split,
       .treat = split_line,
       .belongs = after_lines},
      {.name = "merge_lines",
       .title = "Merge lines",
       .help = "Joins two lines over the gap between them.",
       .parameters = {{.name = "a",
                       .kind = ParameterKind::line,
                       .help = "The one line.",
                       .may_be_locked = true,
                       .anchors = "path_a"},
                      {.name = "b",
                       .kind = ParameterKind::line,
                       .help = "The other line.",
                       .may_be_locked = true,
                       .anchors = "path_b"},
                      angle_parameter("What counts as sharp for the way between them.")},
       .words = words_of_merge,
       .complete = complete_merge,
       .treat = merge,
       .belongs = after_lines},
      {.name = "draw_line",
       .title = "Draw line",
       .help = "Draws a line, or several, through vertices; it runs along sharp edges.",
       .version = 2,
       .parameters = {{.name = "vertices",
                       .kind = ParameterKind::path,
                       .help = "The points of one line.",
                       .count = 2,
                       .one_of = "points"},
                      {.name = "paths",
                       .kind = ParameterKind::paths,
                       .help = "Those of several.",
                       .one_of = "points"},
                      angle_parameter("What counts as sharp for the way between points."),
                      {.name = "part",
                       .kind = ParameterKind::flag,
                       .help = "Partitions that it parts fall into their pieces at once.",
                       .otherwise = true}},
       .words = words_of_draw,
       .upgrade = upgrade_draw,
       .treat = draw,
       .belongs = after_lines},
      {.name = "reroute_line",
       .title = "Reroute line",
       .help = "Between two of its vertices the line runs through a third.",
       .parameters = {line_parameter(false), vertex_parameter("from", "Where it leaves its way."),
                      vertex_parameter("to", "Where it is back on it."),
                      vertex_parameter("via", "Where it is to run."),
                      angle_parameter("What counts as sharp for the new way."), spared_parameter()},
       .words = words_of_reroute,
       .complete = complete_reroute,
       .treat = reroute,
       .belongs = after_lines},
      recompute_lines_row()};
}

}  // namespace arris
