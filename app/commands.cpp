#include "app/commands.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>
#include <set>

#include "core/base/number_text.h"
#include "core/base/process.h"
#include "core/base/write_file.h"
#include "core/document/comparison.h"
#include "core/document/document.h"
#include "core/document/export.h"
#include "core/document/history.h"
#include "core/document/journal.h"
#include "core/document/operation_schema.h"
#include "core/document/results.h"
#include "core/document/session_file.h"
#include "core/mesh/write_ply.h"
#include "core/report/summary.h"
#include "core/samples/mould.h"
#include "core/sharp_lines/sharp_lines.h"

namespace arris::commands {

namespace {

/// Progress on standard error, only where that is a terminal.
Context progress_context() {
  if (!is_error_on_a_terminal()) return {};
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

constexpr const char* summary_name = "summary.json";

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
  summary["peak_memory_mb"] = rounded(static_cast<double>(peak_memory()) / (1u << 20), 4);
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

}  // namespace

std::vector<Operation> Opening::operations() const {
  std::vector<Operation> list{open_file(scan, weld)};
  if (!unit.empty()) list.push_back({"set_unit", {{"unit", unit}}});
  return list;
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

int segment(const Opening& opening, const ResultPlaces& places, Flow flow,
            const StepParameters& wanted) {
  if (const auto ready = check_results(places); !ready) return complain(ready.error());
  Run run;
  if (const auto opened = run.open(opening); !opened) return complain(opened.error());
  for (const Operation& operation : operations_of(flow, wanted))
    if (const auto done = run.step(operation); !done) return complain(done.error());
  nlohmann::json summary = summary_of(run.history);
  summary["seconds"] = run.seconds;
  if (const auto written = write_results(places, run.history, summary); !written)
    return complain(written.error());
  print_outcome(places.folder, summary);
  return 0;
}

int simplify(const Opening& opening, const std::string& output, const nlohmann::json& parameters) {
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
            << with_unit(number_text(
                             document.step("simplify")->parameters["error_zone"].get<double>(), 3),
                         length_unit_of(document))
            << " of the scan, written to " << output << "\n";
  return 0;
}

namespace {

Result<Replay> replay_loudly(const std::string& operations, const std::string& scan) {
  Result<Replay> done = arris::replay(operations, {scan}, progress_context());
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

/// Errors: it cannot be run, there is no such version, it ends with no part open.
Result<Replay> replay_at(const Replaying& replaying) {
  Result<Replay> done = replay_loudly(replaying.operations, replaying.scan);
  if (!done) return done;
  if (!replaying.version.empty()) {
    const Result<std::uint32_t> row =
        row_of(done->history, replaying.version, replaying.operations);
    if (!row) return tl::unexpected<Error>(row.error());
    if (const auto moved = done->history.travel(*row, progress_context()); !moved)
      return tl::unexpected<Error>(moved.error());
  }
  if (done->history.current().empty())
    return fail(replaying.operations + " ends with no part open; there is nothing to write.");
  if (!replaying.unit.empty())
    if (const auto told = done->history.run({"set_unit", {{"unit", replaying.unit}}});
        !told && !told.error().nothing_to_do)
      return tl::unexpected<Error>(told.error());
  return done;
}

}  // namespace

int replay(const Replaying& replaying, const ResultPlaces& places) {
  if (const auto ready = check_results(places); !ready) return complain(ready.error());
  const auto start = std::chrono::steady_clock::now();
  Result<Replay> done = replay_at(replaying);
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

int export_one(const Replaying& replaying, const std::string& what, const std::string& output) {
  std::string ending = std::filesystem::path(output).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto files = result_files();
  const auto file = std::ranges::find_if(
      files, [&](const ResultFile& f) { return f.what() == what && f.ending() == ending; });
  if (file == files.end())
    return complain({output + ": " + what + " can be written as " + exports_text(what) +
                         "; the ending of the file says which.",
                     false});
  if (const auto ready = check_writable(output); !ready) return complain(ready.error());
  const Result<Replay> done = replay_at(replaying);
  if (!done) return complain(done.error());
  if (const auto written = file->write(output, done->history); !written)
    return complain(written.error());
  std::cout << file->title << " written to " << output << "\n";
  return 0;
}

int report(const Replaying& replaying, ReportRequest request) {
  if (const auto ready = check_folder_writable(request.folder); !ready)
    return complain(ready.error());
  const Result<Replay> done = replay_at(replaying);
  if (!done) return complain(done.error());
  ReportOptions& options = request.options;
  options.program = "Arris " ARRIS_VERSION;
  options.date = today();
  if (options.title.empty())
    options.title = std::filesystem::path(done->history.current().scan_path).stem().string();
  if (const auto written = write_report(done->history, request, progress_context()); !written)
    return complain(written.error());
  std::cout << (std::filesystem::path(request.folder) / report_name).string()
            << " written; with pictures the window's program writes it: arris "
            << replaying.operations << " --report " << request.folder << "\n";
  return 0;
}

int compare(const std::string& operations, const std::array<std::string, 2>& versions,
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
  const Result<Comparison> comparison =
      arris::compare(documents[0], documents[1], progress_context());
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

int schema() {
  std::cout << operation_schema().dump(2) << "\n";
  return std::cout.flush() ? 0 : bad_input;
}

int report_page(const std::string& output) {
  const auto written = write_file_whole(output, arris::report_page());
  return written ? 0 : complain(written.error());
}

// Nothing is computed or drawn: the window leaves a small picture in what it saves.
int thumbnail(const std::string& session, const std::string& output) {
  const std::string picture = SessionFile::picture_of(session);
  if (!picture.starts_with("\x89PNG\r\n\x1a\n"))
    return complain({session + " holds no picture; the window leaves one when it saves."});
  if (const auto written = write_file_whole(output, picture); !written)
    return complain(written.error());
  return 0;
}

}  // namespace arris::commands
