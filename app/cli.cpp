// arris-cli: the core without a window.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>
#include <set>

#include <CLI/CLI.hpp>

#ifdef _WIN32
#include <io.h>
#else
#include <sys/resource.h>
#include <unistd.h>
#endif

#include "app/cli_manual.h"
#include "core/base/number_text.h"
#include "core/base/write_file.h"
#include "core/document/comparison.h"
#include "core/document/document.h"
#include "core/document/export.h"
#include "core/document/flow.h"
#include "core/document/history.h"
#include "core/document/journal.h"
#include "core/document/results.h"
#include "core/document/session_file.h"
#include "core/mesh/write_ply.h"
#include "core/partitions/partition_surfaces.h"
#include "core/partitions/sides.h"
#include "core/partitions/tangent_lines.h"
#include "core/report/report.h"
#include "core/samples/mould.h"
#include "core/sharp_lines/face_table.h"
#include "core/sharp_lines/normal_noise.h"
#include "core/sharp_lines/sharp_lines.h"

namespace {

using namespace arris;

constexpr int bad_input = 1;
constexpr int bad_usage = 2;

double peak_memory_mb() {
#ifdef _WIN32
  return 0.0;
#else
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
#endif
}

/// Progress on standard error, only where that is a terminal.
Context progress_context() {
#ifdef _WIN32
  if (!_isatty(2)) return {};
#else
  if (!isatty(2)) return {};
#endif
  return Context([last = -1](double fraction, std::string_view what) mutable {
    const int percent = static_cast<int>(100.0 * fraction);
    if (percent == last) return;
    last = percent;
    std::fprintf(stderr, "\r%3d %% %-24.*s%s", percent, static_cast<int>(what.size()), what.data(),
                 percent >= 100 ? "\r                              \r" : "");
  });
}

int complain(const Error& error) {
  std::cerr << "arris-cli: " << error.message << "\n";
  return bad_input;
}

/// How a scan is opened.
struct Opening {
  std::string scan;
  bool weld = true;
  std::string unit;  ///< Empty: as the file says.

  std::vector<Operation> operations() const {
    std::vector<Operation> list{open_file(scan, weld)};
    if (!unit.empty()) list.push_back({"set_unit", {{"unit", unit}}});
    return list;
  }
};

/// Runs operations one after the other and takes the time of each.
struct Run {
  History history;
  nlohmann::json seconds = nlohmann::json::object();

  Result<void> step(const Operation& operation) {
    const auto start = std::chrono::steady_clock::now();
    const Result<void> done = history.run(operation, progress_context());
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    seconds[operation.name] = rounded(spent.count(), 3);
    // As where a unit is named that the file names, too.
    if (!done && done.error().nothing_to_do) return {};
    return done;
  }
  Result<void> open(const Opening& opening) {
    for (const Operation& operation : opening.operations())
      if (const auto done = step(operation); !done) return done;
    return {};
  }
};

/// Of the scan, from which the default threshold comes.
double normal_noise_of(const Document& document) {
  const Mesh& scan = *document.opened.mesh;
  return normal_noise(scan, FaceTable(scan));
}

double default_angle_of(const Document& document) {
  return default_sharp_angle(*document.opened.mesh, *document.opened.curvatures,
                             LineMethod::normal_jump);
}

/// The surface of each partition by its id, and the boundaries along which surfaces touch.
void add_surfaces(const Document& document, nlohmann::json& summary) {
  const auto surfaces = fit_partition_surfaces(*document.mesh, document.lines, document.partitions);
  if (!surfaces) return;
  nlohmann::json listed = nlohmann::json::object(), tangent = nlohmann::json::array();
  for (std::size_t k = 0; k < surfaces->size(); ++k) {
    const PartitionSurface& fit = (*surfaces)[k];
    nlohmann::json& one = listed[std::to_string(document.partitions.partitions[k]->id)];
    one["type"] = name_of(fit.surface.type);
    if (!fit.fitted) continue;
    one["size"] = size_text(fit.surface, length_unit_of(document));
    one["mean_deviation"] = rounded(fit.mean_deviation, 4);
    one["max_deviation"] = rounded(fit.max_deviation, 4);
    one["within"] = rounded(fit.within, 4);
  }
  const auto lines =
      find_tangent_lines(*document.mesh, document.partitions, *document.boundaries, *surfaces);
  if (!lines) return;
  for (const TangentLine& line : *lines)
    tangent.push_back({{"boundary", line.boundary + 1},
                       {"fillet", line.fillet},
                       {"radius", rounded(line.radius, 4)},
                       {"kink", rounded(line.kink, 3)}});
  summary["partitions"]["surfaces"] = listed;
  summary["tangent_lines"] = tangent;
}

nlohmann::json summary_of(const History& history) {
  const Document& document = history.current();
  nlohmann::json summary;
  summary["scan"] = document.scan->report.to_json();
  summary["unit"] = info_of(length_unit_of(document)).key;
  summary["mean_edge_length"] = document.mesh->mean_edge_length();
  summary["angle_noise_degrees"] = angle_noise(*document.curvatures);
  summary["normal_noise_degrees"] = rounded(normal_noise_of(document), 4);
  summary["default_sharp_angle"] = default_angle_of(document);
  summary["mixed_area_vertices"] = document.curvatures->mixed_area_vertices;
  nlohmann::json thresholds = nlohmann::json::object();
  for (const char* step : {"simplify", "swap_edges", "find_sharp_lines", "equilateralize",
                           "smooth_curvature", "find_partitions"})
    if (document.step(step)) thresholds[step] = document.step(step)->parameters;
  summary["thresholds"] = thresholds;

  double length = 0.0;
  std::size_t edges = 0, convex = 0, closed = 0;
  for (const LinePtr& line : document.lines.lines) {
    length += line->length;
    edges += line->vertices.size() - 1;
    convex += line->convex();
    closed += line->closed;
  }
  summary["lines"] = {{"count", document.lines.lines.size()},
                      {"edges", edges},
                      {"length", length},
                      {"convex", convex},
                      {"concave", document.lines.lines.size() - convex},
                      {"closed", closed}};
  const std::vector<PartitionPtr>& partitions = document.partitions.partitions;
  const std::vector<Outline> outlines =
      outlines_of(*document.mesh, document.lines, document.partitions);
  std::size_t four_sided = 0;
  nlohmann::json sides = nlohmann::json::object();
  for (std::size_t k = 0; k < outlines.size(); ++k) {
    four_sided += outlines[k].is_four_sided();
    sides[std::to_string(partitions[k]->id)] = outlines[k].sides();
  }
  summary["partitions"] = {{"count", partitions.size()},
                           {"assigned_area_share", assigned_share(document)},
                           {"four_sided", four_sided},
                           {"four_sided_share", four_sided_share(document.partitions, outlines)},
                           {"sides", sides}};
  std::map<std::string, std::size_t> types;
  for (const BoundaryPtr& boundary : *document.boundaries)
    ++types[std::string(name_of(boundary->type))];
  summary["boundaries"] = types;
  add_surfaces(document, summary);
  summary["document_hash"] = hash_of(document);
  nlohmann::json versions = nlohmann::json::object();
  for (const auto& [sequence, name] : history.names()) versions[name] = sequence;
  summary["versions"] = versions;
  return summary;
}

constexpr const char* summary_name = "summary.json";

/// Where a run leaves what it found.
struct ResultPlaces {
  std::string folder;
  std::string session;  // *.arris; empty: none
};

/// Whether write_results() could write there now: asked before the work, which may take minutes.
Result<void> check_results(const ResultPlaces& places) {
  const std::string& folder = places.folder;
  if (const auto ready = check_folder_writable(folder); !ready) return ready;
  // Beside the results it lies in a folder that may have to be made with them.
  std::error_code unknown;
  const auto above = std::filesystem::path(places.session).parent_path();
  const bool beside = std::filesystem::weakly_canonical(above, unknown) ==
                          std::filesystem::weakly_canonical(folder, unknown) &&
                      !std::filesystem::exists(folder, unknown);
  if (!places.session.empty() && !beside)
    if (const auto ready = check_writable(places.session); !ready) return ready;
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) return {};
  const auto check = [&](std::string_view name) {
    return check_writable((std::filesystem::path(folder) / name).string());
  };
  for (const ResultFile& file : result_files())
    if (file.usual)
      if (const auto ready = check(file.name); !ready) return ready;
  return check(summary_name);
}

/// The result files, the summary and the session.
Result<void> write_results(const ResultPlaces& places, const History& history,
                           nlohmann::json summary) {
  const std::string& folder = places.folder;
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (code) return fail("The folder " + folder + " cannot be made: " + code.message() + ".");
  const Document& document = history.current();
  const auto path = [&](std::string_view name) {
    return (std::filesystem::path(folder) / name).string();
  };
  for (const ResultFile& file : result_files())
    if (file.usual)
      if (auto r = file.write(path(file.name), history); !r) return r;
  if (!places.session.empty()) {
    SessionExtras extras;
    extras.part = std::filesystem::path(document.scan_path).filename().string();
    if (auto r = save_session(places.session, history, extras, progress_context()); !r) return r;
  }
  summary["peak_memory_mb"] = rounded(peak_memory_mb(), 4);
  return write_file_whole(path(summary_name), summary.dump(2) + "\n");
}

void print_outcome(const std::string& folder, const nlohmann::json& summary) {
  std::cout << summary["lines"]["count"] << " lines, " << summary["partitions"]["count"]
            << " partitions ("
            << fixed_text(100.0 * summary["partitions"]["assigned_area_share"].get<double>(), 1)
            << " % of the area, "
            << fixed_text(100.0 * summary["partitions"]["four_sided_share"].get<double>(), 1)
            << " % of that four-sided) written to " << folder << "\n";
}

/// "The file names no unit; by its size these are millimetres or inches (--unit mm, --unit in)."
std::string unit_question(const Point& size) {
  std::string names, options;
  const std::vector<LengthUnit> units = likely_units(size);
  for (std::size_t k = 0; k < units.size(); ++k) {
    const std::string between = k == 0 ? "" : k + 1 < units.size() ? ", " : " or ";
    names += between + std::string(info_of(units[k]).name);
    options += (k == 0 ? "" : ", ") + ("--unit " + std::string(info_of(units[k]).key));
  }
  return "the file names no unit; by its size these may be " + names + " (" + options + ")";
}

int info(const Opening& opening, bool as_json) {
  const std::string& scan = opening.scan;
  Run run;
  if (const auto opened = run.open(opening); !opened) return complain(opened.error());
  const Document& document = run.history.current();
  const LoadReport& report = document.scan->report;
  const Mesh& mesh = *document.mesh;
  const Point size = mesh.box_max() - mesh.box_min();
  if (as_json) {
    nlohmann::json json = report.to_json();
    json["size"] = {size.x(), size.y(), size.z()};
    const LengthUnit unit = length_unit_of(document);
    json["length_unit"] = info_of(unit).key;
    if (unit == LengthUnit::unknown)
      for (const LengthUnit likely : likely_units(size))
        json["likely_units"].push_back(info_of(likely).key);
    json["mean_edge_length"] = mesh.mean_edge_length();
    json["angle_noise_degrees"] = angle_noise(*document.curvatures);
    json["normal_noise_degrees"] = rounded(normal_noise_of(document), 4);
    json["default_sharp_angle"] = default_angle_of(document);
    json["mixed_area_vertices"] = document.curvatures->mixed_area_vertices;
    json["sentences"] = report.sentences();
    std::cout << json.dump(2) << "\n";
    return 0;
  }
  const LengthUnit unit = length_unit_of(document);
  std::cout << scan << ": " << report.format << ", " << report.file_faces << " faces, "
            << report.file_vertices << " vertices"
            << (report.unit.empty() ? "" : ", in " + report.unit) << "\n"
            << "mesh: " << report.faces << " triangles, " << report.vertices << " vertices, "
            << report.components << (report.components == 1 ? " component, " : " components, ")
            << report.border_edges << " border edges in " << report.border_loops
            << (report.border_loops == 1 ? " loop" : " loops") << ", Euler number "
            << report.euler_number << "\n"
            << "size: " << number_text(size.x(), 5) << " x " << number_text(size.y(), 5) << " x "
            << with_unit(number_text(size.z(), 5), unit) << ", mean edge "
            << with_unit(number_text(mesh.mean_edge_length(), 4), unit) << "\n"
            << (unit == LengthUnit::unknown ? unit_question(size) + "\n" : std::string())
            << "noise turns normals by " << fixed_text(normal_noise_of(document), 1)
            << " degrees and edges by " << fixed_text(angle_noise(*document.curvatures), 1)
            << "; sharp lines are looked for where normals jump by more than "
            << fixed_text(default_angle_of(document), 1) << " degrees\n";
  if (report.clean()) std::cout << "nothing had to be mended\n";
  for (const std::string& sentence : report.sentences()) std::cout << "- " << sentence << "\n";
  return 0;
}

int curvature(const Opening& opening, const std::string& output) {
  if (const auto ready = check_writable(output); !ready) return complain(ready.error());
  Run run;
  if (const auto opened = run.open(opening); !opened) return complain(opened.error());
  if (const auto written = write_curvature_ply(output, run.history.current()); !written)
    return complain(written.error());
  return 0;
}

/// From one scan to its partitions.
struct Segmentation {
  Flow flow = Flow::scan;
  bool swap = false;  // costs more of the weak lines than it mends of the noise
  int smoothing_passes = 0;
  nlohmann::json simplification = nlohmann::json::object();
  nlohmann::json lines = nlohmann::json::object();
  nlohmann::json partitions = nlohmann::json::object();
};

int segment(const Opening& opening, const ResultPlaces& places, const Segmentation& wanted) {
  if (const auto ready = check_results(places); !ready) return complain(ready.error());
  std::vector<Operation> operations = opening.operations();
  for (Operation& operation : operations_of(wanted.flow)) {
    if (operation.name == "simplify") operation.parameters = wanted.simplification;
    if (operation.name == "find_sharp_lines") {
      if (wanted.swap) operations.push_back({"swap_edges"});
      operation.parameters.update(wanted.lines);
    }
    if (operation.name == "find_partitions") {
      if (wanted.smoothing_passes > 0)
        operations.push_back({"smooth_curvature", {{"passes", wanted.smoothing_passes}}});
      operation.parameters.update(wanted.partitions);
    }
    operations.push_back(std::move(operation));
  }
  Run run;
  for (const Operation& operation : operations)
    if (const auto done = run.step(operation); !done) return complain(done.error());
  nlohmann::json summary = summary_of(run.history);
  summary["seconds"] = run.seconds;
  if (const auto written = write_results(places, run.history, summary); !written)
    return complain(written.error());
  print_outcome(places.folder, summary);
  return 0;
}

int simplify_scan(const Opening& opening, const std::string& output,
                  const nlohmann::json& parameters) {
  if (const auto ready = check_writable(output); !ready) return complain(ready.error());
  Run run;
  if (const auto opened = run.open(opening); !opened) return complain(opened.error());
  if (const auto done = run.step({"simplify", parameters}); !done) return complain(done.error());
  const Document& document = run.history.current();
  // Vertices that went are not written; the ids of the scan are in the journal, not in a PLY.
  std::vector<Point> points;
  std::vector<VertexId> number(document.mesh->vertex_count(), no_id);
  std::vector<Triangle> triangles = document.mesh->triangles();
  for (VertexId v = 0; v < number.size(); ++v)
    if (!document.mesh->is_isolated(v)) {
      number[v] = static_cast<VertexId>(points.size());
      points.push_back(document.mesh->point(v));
    }
  for (Triangle& t : triangles)
    for (VertexId& v : t) v = number[v];
  const std::size_t left = points.size();
  const Result<MeshPtr> compact = Mesh::create(std::move(points), std::move(triangles));
  if (!compact) return complain(compact.error());
  if (const auto written = write_ply(output, **compact, {}, length_unit_of(document)); !written)
    return complain(written.error());
  std::cout << document.opened.mesh->vertex_count() << " -> " << left << " vertices, all within "
            << with_unit(number_text(document.simplify->parameters["error_zone"].get<double>(), 3),
                         length_unit_of(document))
            << " of the scan, written to " << output << "\n";
  return 0;
}

Result<Replay> replay_loudly(const std::string& operations, const std::string& scan) {
  Result<Replay> done = replay(operations, {scan}, progress_context());
  if (done)
    for (const std::string& warning : done->warnings) std::cerr << "arris-cli: " << warning << "\n";
  return done;
}

/// The row of a version by its name. Errors: there is none; says which there are.
Result<std::uint32_t> row_of(const History& history, const std::string& name,
                             const std::string& operations) {
  if (const auto row = history.find_name(name)) return *row;
  std::string known;
  for (const auto& [sequence, other] : history.names())
    known += (known.empty() ? "“" : ", “") + other + "”";
  return fail(operations + " has no version “" + name + "”; " +
              (known.empty() ? "none is named." : "there is " + known + "."));
}

/// A session or list of operations run again, at a version of it, in a unit. Errors: it cannot be,
/// there is no such version, it ends with no part open.
Result<Replay> replay_at(const std::string& operations, const std::string& scan,
                         const std::string& version, const std::string& unit) {
  Result<Replay> done = replay_loudly(operations, scan);
  if (!done) return done;
  if (!version.empty()) {
    const Result<std::uint32_t> row = row_of(done->history, version, operations);
    if (!row) return tl::unexpected<Error>(row.error());
    if (const auto moved = done->history.travel(*row, progress_context()); !moved)
      return tl::unexpected<Error>(moved.error());
  }
  if (done->history.current().empty())
    return fail(operations + " ends with no part open; there is nothing to write.");
  if (!unit.empty())
    if (const auto told = done->history.run({"set_unit", {{"unit", unit}}});
        !told && !told.error().nothing_to_do)
      return tl::unexpected<Error>(told.error());
  return done;
}

int replay_file(const std::string& operations, const std::string& scan, const std::string& version,
                const std::string& unit, const ResultPlaces& places) {
  if (const auto ready = check_results(places); !ready) return complain(ready.error());
  const auto start = std::chrono::steady_clock::now();
  Result<Replay> done = replay_at(operations, scan, version, unit);
  if (!done) return complain(done.error());
  nlohmann::json summary = summary_of(done->history);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  summary["seconds"] = {{"replay", rounded(spent.count(), 3)}};
  summary["warnings"] = done->warnings;
  if (const auto written = write_results(places, done->history, summary); !written)
    return complain(written.error());
  print_outcome(places.folder, summary);
  return 0;
}

/// The names of what can be exported, each once, or the endings of one of them.
std::string exports_text(const std::string& what) {
  std::string text;
  std::set<std::string_view> listed;
  for (const ResultFile& file : result_files()) {
    const std::string_view word = what.empty() ? file.what() : file.ending();
    if ((!what.empty() && file.what() != what) || !listed.insert(word).second) continue;
    text += text.empty() ? "" : ", ";
    text += word;
  }
  return text;
}

int export_file(const std::string& operations, const std::string& scan, const std::string& version,
                const std::string& unit, const std::string& what, const std::string& output) {
  const std::string ending =
      CLI::detail::to_lower(std::filesystem::path(output).extension().string());
  const auto files = result_files();
  const auto file = std::ranges::find_if(
      files, [&](const ResultFile& f) { return f.what() == what && f.ending() == ending; });
  if (file == files.end())
    return complain({output + ": " + what + " can be written as " + exports_text(what) +
                         "; the ending of the file says which.",
                     false});
  if (const auto ready = check_writable(output); !ready) return complain(ready.error());
  const Result<Replay> done = replay_at(operations, scan, version, unit);
  if (!done) return complain(done.error());
  if (const auto written = file->write(output, done->history); !written)
    return complain(written.error());
  std::cout << file->title << " written to " << output << "\n";
  return 0;
}

int report(const std::string& operations, const std::string& scan, const std::string& version,
           const std::string& unit, ReportRequest request) {
  if (const auto ready = check_folder_writable(request.folder); !ready)
    return complain(ready.error());
  const Result<Replay> done = replay_at(operations, scan, version, unit);
  if (!done) return complain(done.error());
  ReportOptions& options = request.options;
  options.program = "Arris " ARRIS_VERSION;
  options.date = today();
  if (options.title.empty())
    options.title = std::filesystem::path(done->history.current().scan_path).stem().string();
  if (const auto written = write_report(done->history, request, progress_context()); !written)
    return complain(written.error());
  std::cout << (std::filesystem::path(request.folder) / report_name).string()
            << " written; with pictures the window's program writes it: arris " << operations
            << " --report " << request.folder << "\n";
  return 0;
}

int compare_versions(const std::string& operations, const std::array<std::string, 2>& versions,
                     bool as_json) {
  Result<Replay> done = replay_loudly(operations, "");
  if (!done) return complain(done.error());
  const History& history = done->history;
  std::array<Document, 2> documents;
  std::array<nlohmann::json, 2> summaries;
  for (std::size_t side = 0; side < 2; ++side) {
    std::uint32_t row = history.head();
    if (!versions[side].empty()) {
      const Result<std::uint32_t> found = row_of(history, versions[side], operations);
      if (!found) return complain(found.error());
      row = *found;
    }
    Result<Document> document = history.document_at(row, progress_context());
    if (!document) return complain(document.error());
    double length = 0.0;
    for (const LinePtr& line : document->lines.lines) length += line->length;
    summaries[side] = {{"version", versions[side].empty() ? "the end" : versions[side]},
                       {"row", row},
                       {"lines", document->lines.lines.size()},
                       {"length", length},
                       {"partitions", document->partitions.partitions.size()},
                       {"assigned_area_share", assigned_share(*document)}};
    documents[side] = std::move(*document);
  }
  const Result<Comparison> comparison = compare(documents[0], documents[1], progress_context());
  if (!comparison) return complain(comparison.error());
  for (std::size_t side = 0; side < 2; ++side) {
    summaries[side]["only_here"] = {{"sharp_length", comparison->only[side].sharp_length},
                                    {"soft_length", comparison->only[side].soft_length}};
  }
  const nlohmann::json otherwise = comparison->divided_otherwise
                                       ? nlohmann::json(*comparison->divided_otherwise)
                                       : nlohmann::json();
  if (as_json) {
    std::cout << nlohmann::json{{"versions", summaries},
                                {"tolerance", comparison->tolerance},
                                {"divided_otherwise", otherwise}}
                     .dump(2)
              << "\n";
    return 0;
  }
  for (std::size_t side = 0; side < 2; ++side) {
    const nlohmann::json& s = summaries[side];
    const LengthUnit unit = length_unit_of(documents[side]);
    const auto length = [&](const nlohmann::json& value) {
      return with_unit(number_text(value, 4), unit);
    };
    std::cout << s["version"].get<std::string>() << ": " << s["lines"] << " lines ("
              << length(s["length"]) << "), " << s["partitions"] << " partitions; only here "
              << length(s["only_here"]["sharp_length"]) << " of sharp lines, "
              << length(s["only_here"]["soft_length"]) << " of other borders\n";
  }
  if (comparison->divided_otherwise)
    std::cout << fixed_text(100.0 * *comparison->divided_otherwise, 1)
              << " % of the area is divided otherwise\n";
  return 0;
}

int sample(const std::string& output) {
  SampleMould mould = make_mould();
  const Result<MeshPtr> mesh = Mesh::create(std::move(mould.points), std::move(mould.triangles));
  if (!mesh) return complain(mesh.error());
  if (const auto written = write_ply(output, **mesh, {}, LengthUnit::millimetre); !written)
    return complain(written.error());
  return 0;
}

int manual_page(const CLI::App& app) {
  const Result<std::string> page = cli_manual(app, ARRIS_VERSION);
  if (!page) return complain(page.error());
  std::cout << *page;
  return std::cout.flush() ? 0 : bad_input;
}

/// Nothing is computed or drawn: the window leaves a small picture in what it saves.
int thumbnail(const std::string& session, const std::string& output) {
  const std::string picture = SessionFile::picture_of(session);
  if (!picture.starts_with("\x89PNG\r\n\x1a\n"))
    return complain({session + " holds no picture; the window leaves one when it saves."});
  if (const auto written = write_file_whole(output, picture); !written)
    return complain(written.error());
  return 0;
}

/// "MIN:MAX", "MIN:" or ":MAX" as [min, max]; max null for none.
bool parse_interval(const std::string& text, nlohmann::json& interval) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return false;
  const auto number = [](const std::string& part, double& value) {
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    return error == std::errc() && end == part.data() + part.size();
  };
  double min = 0.0, max = 0.0;
  const std::string low = text.substr(0, colon), high = text.substr(colon + 1);
  if (!low.empty() && !number(low, min)) return false;
  if (!high.empty() && !number(high, max)) return false;
  if (!std::isfinite(min) || !std::isfinite(max) || min < 0.0 || (!high.empty() && max <= min))
    return false;
  interval = {min, high.empty() ? nlohmann::json() : nlohmann::json(max)};
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Arris: sharp lines and partitions of scanned moulds.\n"
      "Exit codes: 0 done, 1 bad input, 2 bad usage.",
      "arris-cli");
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("arris-cli ") + ARRIS_VERSION);

  std::string scan, output, operations;
  bool as_json = false;
  CLI::App* info_command = app.add_subcommand("info", "What a scan holds and what was mended");
  info_command->add_option("SCAN", scan, "STL, PLY, OBJ, OFF (also as .gz) or 3MF")->required();
  info_command->add_flag("--json", as_json, "The whole load report as JSON");

  CLI::App* curvature_command =
      app.add_subcommand("curvature", "Write K H Kabs IK IH IKabs as vertex properties of a PLY");
  curvature_command->add_option("SCAN", scan, "STL, PLY, OBJ, OFF (also as .gz) or 3MF")
      ->required();
  curvature_command->add_option("-o,--output", output, "The PLY to write")->required();

  CLI::App* simplify_command =
      app.add_subcommand("simplify", "Remove vertices inside error zones and write a PLY");
  double error_zone = 0.0, max_edge = 0.0;
  int target = 0;
  std::string cost;
  simplify_command->add_option("SCAN", scan, "STL, PLY, OBJ, OFF (also as .gz) or 3MF")->required();
  simplify_command->add_option("-o,--output", output, "The PLY to write")->required();
  CLI::Option* cost_option =
      simplify_command->add_option("--cost", cost, "How stars are triangulated: flat, angle, area")
          ->check(CLI::IsMember({"flat", "angle", "area"}));
  CLI::Option* target_option =
      simplify_command->add_option("--target", target, "Stop when so many vertices are left")
          ->check(CLI::PositiveNumber);

  CLI::App* segment_command =
      app.add_subcommand("segment", "Find sharp lines and partitions; defaults come from the part");
  double sharp_angle = 0.0, min_length = 0.0;
  int candidates = 0;
  std::uint32_t min_faces = 0, fill_holes = 0;
  std::string criterion;
  std::vector<std::string> intervals;
  segment_command->add_option("SCAN", scan, "STL, PLY, OBJ, OFF (also as .gz) or 3MF")->required();
  segment_command->add_option("-o,--output", output, "The folder for the results")->required();
  CLI::Option* angle_option =
      segment_command
          ->add_option("--sharp-angle", sharp_angle,
                       "TV_IH in degrees: the least jump of the normals, or exterior angle (walk)")
          ->check(CLI::Range(0.1, 179.9));
  CLI::Option* candidates_option =
      segment_command
          ->add_option("--candidates", candidates, "Edges kept at a vertex by the walk (alpha, 3)")
          ->check(CLI::Range(1, 32));
  CLI::Option* length_option =
      segment_command
          ->add_option("--min-length", min_length,
                       "Isolated lines shorter than this go (in the scan's unit, as all lengths)")
          ->check(CLI::NonNegativeNumber);
  std::string partition_method;
  double detail = 1.0;
  CLI::Option* partition_method_option =
      segment_command
          ->add_option("--partitions", partition_method,
                       "surfaces (areas that one surface explains) or fronts (the paper's, which "
                       "--criterion, --interval and --fill-holes mean)")
          ->check(CLI::IsMember({"surfaces", "fronts"}));
  CLI::Option* detail_option =
      segment_command
          ->add_option("--detail", detail, "Of surfaces: below 1 fewer and larger, above 1 more")
          ->check(CLI::Range(0.05, 20.0));
  CLI::Option* criterion_option =
      segment_command->add_option("--criterion", criterion, "kabs or ikabs")
          ->check(CLI::IsMember({"kabs", "ikabs"}));
  segment_command
      ->add_option("--interval", intervals,
                   "MIN:MAX of the criterion; either may be left out; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  CLI::Option* faces_option =
      segment_command->add_option("--min-faces", min_faces, "Smaller partitions are not kept")
          ->check(CLI::PositiveNumber);
  CLI::Option* fill_option = segment_command->add_option(
      "--fill-holes", fill_holes, "Unassigned areas with fewer faces join a neighbour; 0: none");

  const auto add_zone = [&](CLI::App* command) {
    return command
        ->add_option("--error-zone", error_zone,
                     "Radius in the scan's unit; left out: three times the noise")
        ->check(CLI::NonNegativeNumber);
  };
  const auto add_edge = [&](CLI::App* command, const std::string& otherwise) {
    return command->add_option("--max-edge", max_edge, "No new edge longer than this; " + otherwise)
        ->check(CLI::NonNegativeNumber);
  };
  CLI::Option* zone_option = add_zone(simplify_command);
  CLI::Option* edge_option = add_edge(simplify_command, "left out: no limit");
  CLI::Option* segment_zone_option = add_zone(segment_command);
  CLI::Option* segment_edge_option = add_edge(segment_command, "0: no limit");
  for (CLI::Option* option : {segment_zone_option, segment_edge_option})
    option->description(option->get_description() + "; --flow paper");
  Segmentation segmentation;
  std::string flow, method;
  CLI::Option* flow_option =
      segment_command
          ->add_option("--flow", flow,
                       "scan: lines and partitions on the scan's own mesh (default); paper: figure "
                       "2, simplify, lines by the walk, equilateralise, partitions")
          ->check(CLI::IsMember({"scan", "paper"}));
  CLI::Option* method_option =
      segment_command
          ->add_option("--method", method,
                       "How lines are found: normal_jump (default of the flow scan) or walk (of "
                       "the flow paper)")
          ->check(CLI::IsMember({"normal_jump", "walk"}));
  bool no_prepare = false;
  CLI::Option* no_prepare_option =
      segment_command->add_flag("--no-prepare", no_prepare, "The same as --flow scan");
  CLI::Option* swap_option = segment_command->add_flag(
      "--swap", segmentation.swap, "Swap edges before finding lines; --flow paper");
  segment_command
      ->add_option("--smooth", segmentation.smoothing_passes,
                   "Passes of curvature smoothing before finding partitions (0)")
      ->check(CLI::Range(0, 100));

  bool no_weld = false;
  for (CLI::App* command : {info_command, curvature_command, simplify_command, segment_command})
    command->add_flag("--no-weld", no_weld,
                      "Vertices that lie on one place stay apart, as the file has them (not the "
                      "corners of STL)");

  std::string unit;
  const auto add_unit = [&](CLI::App* command) {
    command
        ->add_option("--unit", unit,
                     "What lengths of the scan are in: " + length_unit_keys() +
                         "; left out: as the file says. Told, not computed with")
        ->check([](const std::string& text) {
          return find_length_unit(text) ? std::string()
                                        : "'" + text + "' is not one of " + length_unit_keys();
        });
  };
  for (CLI::App* command : {info_command, curvature_command, simplify_command, segment_command})
    add_unit(command);

  CLI::App* replay_command = app.add_subcommand("replay", "Run a session or list of operations");
  replay_command
      ->add_option("OPERATIONS", operations,
                   "A session (*.arris), or a file of operations, one JSON a line")
      ->required();
  replay_command->add_option("-o,--output", output, "The folder for the results")->required();
  std::string other_scan;
  replay_command->add_option("--scan", other_scan, "Open this scan instead of the named one");
  std::string at;
  replay_command->add_option("--at", at, "Write the version of this name, not the last state");
  CLI::App* export_command =
      app.add_subcommand("export", "Write one thing of a session for another program");
  std::string what;
  const std::string exports = exports_text("");
  export_command
      ->add_option("OPERATIONS", operations,
                   "A session (*.arris), or a file of operations, one JSON a line")
      ->required();
  export_command->add_option("--what", what, exports)
      ->required()
      ->check([&](const std::string& given) {
        return exports_text(given).empty() ? "one of " + exports : std::string();
      });
  export_command->add_option("-o,--output", output, "The file to write; its ending says the format")
      ->required();
  export_command->add_option("--scan", other_scan, "Open this scan instead of the named one");
  export_command->add_option("--at", at, "Write the version of this name, not the last state");
  CLI::App* report_command =
      app.add_subcommand("report", "Write a report of a session: HTML with its histograms");
  ReportRequest request;
  report_command
      ->add_option("OPERATIONS", operations,
                   "A session (*.arris), or a file of operations, one JSON a line")
      ->required();
  report_command
      ->add_option("-o,--output", request.folder,
                   "The folder for it; what changed since a report there is marked")
      ->required();
  report_command->add_option("--scan", other_scan, "Open this scan instead of the named one");
  report_command->add_option("--at", at, "Of the version of this name, not the last state");
  report_command->add_option("--title", request.options.title, "Left out: the name of the part");
  report_command->add_option("--company", request.options.company, "Who reports");
  report_command->add_option("--logo", request.logo, "A picture, copied beside the report");
  report_command->add_option("--page", request.page,
                             "A page of one's own, HTML with places as {{partitions}}");
  for (CLI::App* command : {replay_command, export_command, report_command}) add_unit(command);
  CLI::App* page_command =
      app.add_subcommand("report-page", "Write the page of reports, to be changed for --page");
  page_command->add_option("-o,--output", output, "The HTML to write")->required();

  std::string session;
  for (CLI::App* command : {segment_command, replay_command})
    command->add_option("--session", session,
                        "Also write one file with scan and operations, for the window (*.arris)");

  CLI::App* compare_command = app.add_subcommand(
      "compare", "Where two named versions of a session divide the part otherwise");
  std::array<std::string, 2> versions;
  compare_command->add_option("OPERATIONS", operations, "A session (*.arris), or its operations")
      ->required();
  compare_command->add_option("VERSION", versions[0], "The name of a version")->required();
  compare_command->add_option("OTHER", versions[1], "Another one; left out: the last state");
  compare_command->add_flag("--json", as_json, "All numbers as JSON");

  CLI::App* sample_command = app.add_subcommand("sample", "Write the sample mould as a PLY");
  sample_command->add_option("-o,--output", output, "The PLY to write")->required();

  // For the build and the file manager; not in the help.
  CLI::App* manual_command = app.add_subcommand("manual-page", "Write arris-cli(1)")->group("");
  CLI::App* thumbnail_command =
      app.add_subcommand("thumbnail", "Write the picture that a session holds")->group("");
  thumbnail_command->add_option("SESSION", session, "A session (*.arris)")->required();
  thumbnail_command->add_option("-o,--output", output, "The PNG to write")->required();

  nlohmann::json& lines = segmentation.lines;
  nlohmann::json& partitions = segmentation.partitions;
  try {
    app.parse(argc, argv);
    if (std::isnan(sharp_angle) || std::isnan(min_length) || std::isnan(error_zone) ||
        std::isnan(max_edge))
      throw CLI::ValidationError("options", "a number was expected, not nan");
    if (*no_prepare_option && flow == "paper")
      throw CLI::ValidationError("--no-prepare", "it contradicts --flow paper");
    if (flow != "paper")
      for (const CLI::Option* option : {segment_zone_option, segment_edge_option, swap_option})
        if (*option)
          throw CLI::ValidationError(
              option->get_name(),
              "it changes the mesh before lines are found, which only the paper's flow does: add "
              "--flow paper");
    if (*candidates_option && (method.empty() ? flow != "paper" : method != "walk"))
      throw CLI::ValidationError("--candidates", "only the walk uses it: add --method walk");
    for (const std::string& text : intervals) {
      nlohmann::json interval;
      if (!parse_interval(text, interval))
        throw CLI::ValidationError("--interval", "'" + text + "' is not MIN:MAX with MIN < MAX");
      partitions["intervals"].push_back(interval);
    }
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : bad_usage;
  }
  if (*angle_option) lines["angle"] = sharp_angle;
  if (*method_option) lines["method"] = method;
  if (*candidates_option) lines["candidates"] = candidates;
  if (*length_option) lines["min_length"] = min_length;
  if (*criterion_option || *fill_option) partitions["method"] = "fronts";
  if (*partition_method_option) partitions["method"] = partition_method;
  if (*detail_option) partitions["detail"] = detail;
  if (*criterion_option) partitions["criterion"] = criterion;
  if (*faces_option) partitions["min_faces"] = min_faces;
  if (*fill_option) partitions["fill_holes"] = fill_holes;

  nlohmann::json& simplification = segmentation.simplification;
  if (*flow_option && flow == "paper") segmentation.flow = Flow::paper;
  if (*zone_option || *segment_zone_option) simplification["error_zone"] = error_zone;
  if (*edge_option || *segment_edge_option || *simplify_command)
    simplification["max_edge_length"] = max_edge;
  if (*cost_option) simplification["cost"] = cost;
  if (*target_option) simplification["target_vertices"] = target;

  const Opening opening{scan, !no_weld, unit};
  if (*info_command) return info(opening, as_json);
  if (*curvature_command) return curvature(opening, output);
  if (*simplify_command) return simplify_scan(opening, output, simplification);
  if (*segment_command) return segment(opening, {output, session}, segmentation);
  if (*replay_command) return replay_file(operations, other_scan, at, unit, {output, session});
  if (*export_command) return export_file(operations, other_scan, at, unit, what, output);
  if (*manual_command) return manual_page(app);
  if (*thumbnail_command) return thumbnail(session, output);
  if (*page_command) {
    const auto written = write_file_whole(output, report_page());
    return written ? 0 : complain(written.error());
  }
  if (*report_command) return report(operations, other_scan, at, unit, request);
  if (*compare_command) return compare_versions(operations, versions, as_json);
  return sample(output);
}
