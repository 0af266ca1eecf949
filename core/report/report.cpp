#include "core/report/report.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include "core/base/json.h"
#include "core/base/number_text.h"
#include "core/base/read_file.h"
#include "core/base/words.h"
#include "core/base/write_file.h"
#include "core/curvature/fields.h"
#include "core/document/comparison.h"
#include "core/document/result_table.h"
#include "core/guidance/worklist.h"
#include "core/partitions/sides.h"
#include "core/report/histogram_picture.h"
#include "core/report/markup.h"

namespace arris {

namespace {

constexpr std::string_view style =
    "body{font-family:'Segoe UI','Helvetica Neue',Arial,sans-serif;color:#23282d;max-width:60em;"
    "margin:2em auto;padding:0 1.5em;line-height:1.45}\n"
    "h1{font-size:22pt;font-weight:600;margin:0.2em 0 0 0}\n"
    "h2{font-size:14pt;font-weight:600;color:#1f4e79;margin:1.8em 0 0.5em 0;"
    "border-bottom:1px solid #c9d3dd}\n"
    "h3{font-size:11pt;font-weight:600;margin:1.2em 0 0.3em 0}\n"
    "p.under{color:#69727b;margin:0.2em 0 1.2em 0}\n"
    "p.note{color:#69727b}\n"
    "p.caption{color:#50575f;font-size:9.5pt;margin:0.3em 0 1.4em 0}\n"
    "p.picture{line-height:100%;margin:0.8em 0 0 0}\n"
    "img.picture{width:100%;height:auto;border:1px solid #dde2e7}\n"
    "img.histogram{max-width:100%;height:auto}\n"
    "table{border-collapse:collapse;font-size:8.5pt;width:100%}\n"
    "table.figures td{background-color:#f2f5f8;padding:8px 12px;border:3px solid #ffffff;"
    "width:25%}\n"
    "table.figures span.value{font-size:16pt;font-weight:600}\n"
    "span.was{color:#9a5b00}\n"
    "table.rows th{background-color:#e8edf2;padding:4px 6px;font-weight:600}\n"
    "table.rows td{padding:3px 6px;border-bottom:1px solid #e6eaee}\n"
    "table.rows tr.changed td{background-color:#fff4dc}\n"
    "li{margin:0.15em 0}\n"
    "p.foot{color:#8a929a;font-size:9pt;margin-top:3em}\n"
    "@media print{body{max-width:none;margin:0}h2{page-break-after:avoid}"
    "table.rows tr,img{page-break-inside:avoid}}\n";

constexpr std::string_view page =
    "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    "<title>{{title}}</title>\n<style>\n{{style}}</style>\n</head>\n<body>\n"
    "{{logo}}<h1>{{title}}</h1>\n<p class=\"under\">{{company}}Segmentation report, {{date}}</p>\n"
    "{{figures}}\n{{pictures}}\n{{scan}}\n{{steps}}\n{{distributions}}\n{{partitions}}\n{{lines}}\n"
    "{{boundaries}}\n{{corrections}}\n{{left}}\n{{versions}}\n{{operations}}\n"
    "<p class=\"foot\">Made with {{program}}.</p>\n</body>\n</html>\n";

/// Rows of a table in a report, at most: the rest is in the exported tables.
constexpr std::size_t most_rows = 400;
constexpr std::size_t most_items = 60;
constexpr int picture_width = 640;

std::string heading(const std::string& text) { return "<h2>" + escaped(text) + "</h2>\n"; }
std::string paragraph(const std::string& text, const char* kind = "") {
  return "<p" + (*kind ? std::string(" class=\"") + kind + "\"" : std::string()) + ">" +
         escaped(text) + "</p>\n";
}
std::string cell(const std::string& text, bool number, const char* tag = "td") {
  return std::string("<") + tag + " align=\"" + (number ? "right" : "left") + "\">" +
         escaped(text) + "</" + tag + ">";
}

/// "find_sharp_lines" asks for "min_length": "min length".
/// "Target vertices"
std::string spaced(std::string key) {
  std::ranges::replace(key, '_', ' ');
  key[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(key[0])));
  return key;
}

std::string value_text(const nlohmann::json& value) {
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) return number_text(value.get<double>(), 4);
  if (value.is_string()) return value.get<std::string>();
  if (value.is_null()) return "no end";
  if (!value.is_array()) return value.dump();
  std::string text;
  const bool interval = value.size() == 2 && !value[0].is_array();
  for (const nlohmann::json& part : value)
    text += (text.empty() ? "" : interval ? " to " : "; ") + value_text(part);
  return text;
}

/// "CONVEX", a layer in CAD programs, as people write it; C0 and Gn as the paper does.
std::string kind_in_words(std::string layer) {
  for (std::size_t k = layer.size() == 2 ? 1 : 0; k < layer.size(); ++k)
    layer[k] = static_cast<char>(std::tolower(static_cast<unsigned char>(layer[k])));
  return layer;
}

/// How wide a column is beside others.
int share_of(const ResultColumn& column) {
  switch (column.measure) {
    case Measure::text:
      return column.key.empty() ? 18 : 11;
    case Measure::length:
    case Measure::area:
    case Measure::share:
    case Measure::id:
      return 10;
    default:
      return 9;
  }
}

class ReportMaker {
 public:
  ReportMaker(const History& history, const ReportOptions& options, const Context& context)
      : history_(history), document_(history.current()), options_(options), context_(context) {
    const nlohmann::json before = nlohmann::json::parse(options.before, nullptr, false);
    if (before.is_object()) before_ = before;
  }

  Result<std::vector<ReportFile>> make() {
    if (document_.empty()) return fail("There is nothing to report: no part is open.");
    const auto table = partition_table(document_, context_.part(0.0, 0.4));
    if (!table) return tl::unexpected<Error>(table.error());
    const auto items = worklist(document_, {}, context_.part(0.4, 0.8));
    if (!items) return tl::unexpected<Error>(items.error());
    std::map<std::string, std::string> places;
    places["title"] = escaped(options_.title);
    places["date"] = escaped(options_.date);
    places["company"] = options_.company.empty() ? "" : escaped(options_.company) + " · ";
    places["logo"] = options_.logo.empty()
                         ? ""
                         : "<p><img src=\"" + escaped(options_.logo) + "\" height=\"48\"></p>\n";
    places["program"] = escaped(options_.program);
    places["style"] = std::string(style);
    places["partitions"] = partitions(*table);
    places["figures"] = figures(*table, *items);
    places["pictures"] = pictures();
    places["scan"] = scan();
    places["steps"] = steps();
    places["distributions"] = distributions();
    places["lines"] = listed("Sharp lines", "line", table_of(handed_lines(document_)));
    places["boundaries"] =
        listed("Boundaries", "boundary", table_of(handed_boundaries(document_)), false);
    places["corrections"] = corrections();
    places["left"] = left(*items);
    if (auto done = versions(context_.part(0.8, 1.0)); done)
      places["versions"] = *done;
    else
      return tl::unexpected<Error>(done.error());
    places["operations"] = operations();
    return filled(options_.page.empty() ? std::string(page) : options_.page, places)
        .map([&](std::string text) {
          files_.insert(files_.begin(), {report_name, std::move(text)});
          files_.push_back({report_state, now_.dump(1) + "\n"});
          return std::move(files_);
        });
  }

 private:
  static Result<std::string> filled(const std::string& frame,
                                    const std::map<std::string, std::string>& places) {
    std::string text;
    for (std::size_t from = 0;;) {
      const std::size_t open = frame.find("{{", from), close = frame.find("}}", open);
      if (open == std::string::npos || close == std::string::npos) return text + frame.substr(from);
      const std::string name = frame.substr(open + 2, close - open - 2);
      const auto place = places.find(name);
      if (place == places.end()) {
        std::string known;
        for (const auto& [other, content] : places)
          known += (known.empty() ? "" : ", ") + ("{{" + other + "}}");
        return fail("The page for reports has a place {{" + name +
                    "}} that nothing belongs to; there are " + known + ".");
      }
      text += frame.substr(from, open - from) + place->second;
      from = close + 2;
    }
  }

  /// A figure by its name, with what it was in the report before where that was another.
  std::string figure(const std::string& name, const std::string& value) {
    now_["figures"][name] = value;
    std::string text =
        "<td><span class=\"value\">" + escaped(value) + "</span><br>" + escaped(name);
    if (before_.contains("figures") && before_["figures"].is_object())
      if (const auto was = before_["figures"].find(name);
          was != before_["figures"].end() && was->is_string() && *was != value)
        text += "<br><span class=\"was\">was " + escaped(was->get<std::string>()) + "</span>";
    return text + "</td>";
  }

  std::string figures(const ResultTable& table, const std::vector<WorkItem>& items) {
    const auto percent = [](double share) { return fixed_text(100.0 * share, 1) + " %"; };
    double length = 0.0, within = 0.0, area = 0.0;
    for (const LinePtr& line : document_.lines.lines) length += line->length;
    std::size_t fitted = 0;
    const auto at = [&](std::string_view key) {
      return static_cast<std::size_t>(std::ranges::find(table.columns, key, &ResultColumn::key) -
                                      table.columns.begin());
    };
    for (const std::vector<ResultCell>& row : table.rows)
      if (const double* share = std::get_if<double>(&row[at("within_tolerance")])) {
        const double own = std::get<double>(row[at("area")]);
        within += own * *share;
        area += own;
        ++fitted;
      }
    const auto outlines = outlines_of(*document_.mesh, document_.lines, document_.partitions);
    const auto open = std::ranges::count_if(items, is_left);
    const std::array cells{
        figure("partitions", std::to_string(document_.partitions.partitions.size())),
        figure("of the area in partitions", percent(assigned_share(document_))),
        figure("of that four-sided", percent(four_sided_share(document_.partitions, outlines))),
        figure("left to do", std::to_string(open)),
        figure("sharp lines", std::to_string(document_.lines.lines.size())),
        figure("of sharp line", length_in_words(length, length_unit_of(document_))),
        figure("partitions with a fitted surface", std::to_string(fitted)),
        figure("of their area within tolerance", area > 0.0 ? percent(within / area) : "–")};
    std::string text = "<table class=\"figures\">\n";
    for (std::size_t k = 0; k < cells.size(); ++k) {
      if (k % 4 == 0) text += "<tr>";
      text += cells[k];
      if (k % 4 == 3) text += "</tr>\n";
    }
    text += "</table>\n";
    if (!before_.is_null())
      text += paragraph("What changed since the report before is marked.", "note");
    return text;
  }

  std::string pictures() const {
    std::string text;
    for (const ReportPicture& picture : options_.pictures)
      text += "<p class=\"picture\"><img class=\"picture\" src=\"" + escaped(picture.file) +
              "\" width=\"" + std::to_string(picture_width) + "\" height=\"" +
              fixed_text(picture_width / std::max(picture.proportion, 0.1), 0) + "\" alt=\"" +
              escaped(picture.caption) + "\"></p>\n" + paragraph(picture.caption, "caption");
    return text.empty() ? "" : heading("Pictures") + text;
  }

  std::string scan() const {
    const LoadReport& report = document_.scan->report;
    const Mesh& mesh = *document_.scan->mesh;
    const LengthUnit unit = length_unit_of(document_);
    const Point size = mesh.box_max() - mesh.box_min();
    const std::string name = std::filesystem::path(report.file).filename().string();
    std::string text = heading("Scan") + "<table class=\"rows\">\n";
    const auto row = [&](const std::string& what, const std::string& value) {
      text += "<tr>" + cell(what, false) + cell(value, false) + "</tr>\n";
    };
    row("File", name + " (" + report.format + ")");
    row("Content", "XXH3 " + report.content_hash);
    row("Size", with_unit(size_in_words(size), unit));
    row("Mesh", counted(report.faces, "triangle", "triangles") + ", " +
                    counted(report.vertices, "vertex", "vertices") + ", " +
                    counted(report.components, "component", "components") + ", " +
                    counted(report.border_edges, "border edge", "border edges"));
    row("Mean edge", with_unit(number_text(mesh.mean_edge_length(), 4), unit));
    if (document_.mesh != document_.scan->mesh)
      row("Working mesh", counted(document_.mesh->face_count(), "triangle", "triangles"));
    text += "</table>\n";
    if (report.clean()) return text + paragraph("Nothing had to be mended.", "note");
    text += "<ul>\n";
    for (const std::string& sentence : report.sentences())
      text += "<li>" + escaped(sentence) + "</li>\n";
    return text + "</ul>\n";
  }

  std::string steps() const {
    std::string rows;
    for (std::size_t k = 0; k < chain_steps.size(); ++k) {
      const std::optional<Step>& step = document_.steps[k];
      if (!step) continue;
      const OperationKind& kind = *find_operation(chain_steps[k].name);
      std::string parameters;
      for (const Parameter& parameter : kind.parameters)
        if (counts_in(step->parameters, parameter))
          parameters += (parameters.empty() ? "" : "; ") +
                        parameter_in_words(parameter, step->parameters.at(parameter.name));
      rows += "<tr>" + cell(std::string(chain_steps[k].title), false) + cell(parameters, false) +
              cell(step->out_of_date ? "out of date" : kind.outcome(document_), false) + "</tr>\n";
    }
    if (rows.empty()) return "";
    return heading("Steps") + "<table class=\"rows\">\n<tr>" + cell("Step", false, "th") +
           cell("Parameters", false, "th") + cell("Result", false, "th") + "</tr>\n" + rows +
           "</table>\n";
  }

  /// "Least length: 0.6 mm", "Method: Fitted surfaces"
  std::string parameter_in_words(const Parameter& parameter, const nlohmann::json& value) const {
    std::string label(parameter.label);
    std::string text = value_text(value);
    if (label.empty()) label = spaced(std::string(parameter.name));
    for (const ParameterChoice& choice : parameter.choices)
      if (choice.key == text) text = choice.label;
    if (parameter.unit == "°")
      text = degrees_in_words(value.get<double>());
    else if (parameter.unit == unit_of_part)
      text = with_unit(text, length_unit_of(document_));
    else if (!parameter.unit.empty())
      text += " " + std::string(parameter.unit);
    return label + ": " + text;
  }

  std::string distributions() {
    const Mesh& mesh = *document_.mesh;
    std::string text;
    const auto add = [&](const char* file, const Distribution& distribution,
                         const HistogramPicture& picture) {
      files_.push_back({file, histogram_svg(distribution, picture)});
      text += std::string("<p class=\"picture\"><img class=\"histogram\" src=\"") + file +
              "\" width=\"640\" height=\"240\" alt=\"" + escaped(picture.title) + "\"></p>\n";
    };
    if (document_.step("find_sharp_lines")) {
      std::vector<double> angles = field_values(*line_measures(document_), Field::ihe);
      for (double& angle : angles) angle = std::abs(angle);
      HistogramPicture picture{document_.line_method() == LineMethod::normal_jump
                                   ? "Jump of the normals across edges (°), shares of the area"
                                   : "Exterior angle at edges (°), shares of the area",
                               0.0,
                               90.0,
                               {}};
      const double threshold = document_.step("find_sharp_lines")->parameters.value("angle", 0.0);
      picture.marks.push_back({threshold, "sharp from " + degrees_in_words(threshold)});
      add("histogram_lines.svg", Distribution(angles, field_weights(mesh, Field::ihe)), picture);
    }
    const Distribution kabs(field_values(*document_.shown_curvatures(), Field::kabs),
                            field_weights(mesh, Field::kabs));
    const std::string unit = unit_of(Field::kabs, length_unit_of(document_));
    HistogramPicture picture{
        "Kabs" + (unit.empty() ? "" : " (" + unit + ")") + ", shares of the area",
        0.0,
        kabs.quantile(0.98),
        {}};
    if (document_.step("find_partitions") &&
        document_.partition_method() == PartitionMethod::fronts)
      for (const nlohmann::json& interval :
           document_.step("find_partitions")
               ->parameters.value("intervals", nlohmann::json::array()))
        if (interval.size() == 2 && interval[1].is_number())
          picture.marks.push_back(
              {interval[1].get<double>(), "interval to " + value_text(interval[1])});
    add("histogram_kabs.svg", kabs, picture);
    return heading("Distributions") + text;
  }

  /// A table of the document, rows that the report before did not have marked.
  std::string listed(const std::string& title, const std::string& what, const ResultTable& table,
                     bool mark = true) {
    std::string text = heading(title);
    if (table.rows.empty()) return text + paragraph("None.", "note");
    const bool marks = mark && before_.contains(what) && before_[what].is_object();
    text += "<table class=\"rows\">\n<tr>";
    int whole = 0;
    for (const ResultColumn& column : table.columns)
      if (!column.title.empty()) whole += share_of(column);
    for (const ResultColumn& column : table.columns)
      if (!column.title.empty())
        text += "<th align=\"" + std::string(column.measure != Measure::text ? "right" : "left") +
                "\" width=\"" + std::to_string(100 * share_of(column) / whole) + "%\">" +
                escaped(heading_of(column, table.unit)) + "</th>";
    text += "</tr>\n";
    const auto id_column = static_cast<std::size_t>(
        std::ranges::find(table.columns, what, &ResultColumn::key) - table.columns.begin());
    std::size_t shown = 0;
    for (const std::vector<ResultCell>& row : table.rows) {
      std::string cells;
      for (std::size_t k = 0; k < row.size(); ++k) {
        const ResultColumn& column = table.columns[k];
        if (column.title.empty()) continue;
        std::string words = text_of(row[k], column.measure);
        if (column.key == "kind") words = kind_in_words(words);
        cells += cell(words, column.measure != Measure::text);
      }
      const std::string id = text_of(row[id_column], Measure::id);
      if (mark) now_[what][id] = cells;
      const bool changed =
          marks && (!before_[what].contains(id) || before_[what][id] != nlohmann::json(cells));
      if (++shown <= most_rows || changed)
        text += std::string(changed ? "<tr class=\"changed\">" : "<tr>") + cells + "</tr>\n";
    }
    text += "</table>\n";
    if (table.rows.size() > most_rows)
      text += paragraph("The first " + std::to_string(most_rows) + " of " +
                            std::to_string(table.rows.size()) + "; the exported table has all.",
                        "note");
    return text;
  }

  std::string partitions(const ResultTable& table) {
    return listed("Partitions", "partition", table) +
           paragraph(
               "Off: how far vertices lie from the fitted surface, in the mean and at most. "
               "Within: the share that lies within three times the noise of the scan.",
               "note");
  }

  std::string corrections() const {
    std::string text = heading("Corrected by hand");
    if (document_.corrections.empty())
      return text + paragraph("Nothing was corrected by hand.", "note");
    text += "<ul>\n";
    for (const CorrectionPtr& correction : document_.corrections) {
      std::string line = describe(correction->operation);
      if (correction->state != CorrectionState::applied)
        line += " (" + std::string(name_of(correction->state)) +
                (correction->message.empty() ? "" : ": " + correction->message) + ")";
      text += "<li>" + escaped(line) + "</li>\n";
    }
    return text + "</ul>\n";
  }

  std::string left(const std::vector<WorkItem>& items) const {
    std::string text = heading("Left to do"), list;
    std::size_t count = 0;
    for (const WorkItem& item : items)
      if (is_left(item) && ++count <= most_items)
        list += "<li>" + escaped(item.sentence) + "</li>\n";
    if (count == 0) return text + paragraph("Nothing on the worklist.", "note");
    text += "<ul>\n" + list + "</ul>\n";
    if (count > most_items)
      text += paragraph("And " + std::to_string(count - most_items) + " more.", "note");
    return text;
  }

  Result<std::string> versions(const Context& context) const {
    std::string rows;
    for (const auto& [sequence, name] : history_.names()) {
      const bool here = sequence == history_.head();
      std::string difference = "this one";
      if (!here) {
        const Result<Document> other = history_.document_at(sequence, context);
        if (!other) return tl::unexpected<Error>(other.error());
        const Result<Comparison> found = compare(*other, document_, context);
        if (!found && context.cancelled()) return tl::unexpected<Error>(found.error());
        difference = found ? difference_text(*found) : found.error().message;
      }
      rows += "<tr>" + cell(name, false) + cell(difference, false) + "</tr>\n";
    }
    if (rows.empty()) return std::string();
    return heading("Versions") + "<table class=\"rows\">\n<tr>" + cell("Version", false, "th") +
           cell("Beside this report", false, "th") + "</tr>\n" + rows + "</table>\n";
  }

  std::string difference_text(const Comparison& found) const {
    const LengthUnit unit = length_unit_of(document_);
    const auto length = [&](std::size_t side) {
      return length_in_words(found.only[side].sharp_length + found.only[side].soft_length, unit);
    };
    std::string text = length(0) + " of borderlines only there, " + length(1) + " only here";
    if (found.divided_otherwise)
      text += ", " + fixed_text(100.0 * *found.divided_otherwise, 1) +
              " % of the area divided otherwise";
    return text;
  }

  std::string operations() const {
    std::string text = heading("Operations") + "<ol>\n";
    std::vector<std::string> lines;
    for (std::uint32_t at = history_.head(); at != 0; at = history_.entries()[at - 1].parent)
      lines.push_back(describe(history_.entries()[at - 1].operation));
    for (auto line = lines.rbegin(); line != lines.rend(); ++line)
      text += "<li>" + escaped(*line) + "</li>\n";
    return text + "</ol>\n";
  }

  const History& history_;
  const Document& document_;
  const ReportOptions& options_;
  const Context& context_;
  nlohmann::json before_, now_ = nlohmann::json::object();
  std::vector<ReportFile> files_;
};

}  // namespace

std::string report_page() { return std::string(page); }

Result<std::vector<ReportFile>> make_report(const History& history, const ReportOptions& options,
                                            const Context& context) {
  return ReportMaker(history, options, context).make();
}

Result<void> write_report(const History& history, ReportRequest request, const Context& context) {
  const std::filesystem::path folder = request.folder;
  if (auto ready = check_folder_writable(request.folder); !ready) return ready;
  const auto text_of_file = [](const std::string& path) {
    return read_file(path).map([](const FileContent& file) { return std::string(file.view()); });
  };
  if (!request.page.empty()) {
    Result<std::string> own = text_of_file(request.page);
    if (!own) return tl::unexpected<Error>(own.error());
    request.options.page = std::move(*own);
  }
  std::vector<ReportFile> beside;
  if (!request.logo.empty()) {
    Result<std::string> picture = text_of_file(request.logo);
    if (!picture) return tl::unexpected<Error>(picture.error());
    request.options.logo = "logo" + std::filesystem::path(request.logo).extension().string();
    beside.push_back({request.options.logo, std::move(*picture)});
  }
  // Without the last one, or where somebody made something else of it, nothing is marked.
  const std::string last = (folder / report_state).string();
  std::error_code ignored;
  if (std::filesystem::exists(last, ignored))
    request.options.before = text_of_file(last).value_or(std::string());
  Result<std::vector<ReportFile>> files = make_report(history, request.options, context);
  if (!files) return tl::unexpected<Error>(files.error());
  beside.insert(beside.end(), files->begin(), files->end());
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (code)
    return fail("The folder " + request.folder + " cannot be made: " + code.message() + ".");
  for (const ReportFile& file : beside)
    if (auto written = write_file_whole((folder / file.name).string(), file.content); !written)
      return written;
  return {};
}

std::string today() {
  const std::chrono::year_month_day day{
      std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now())};
  const auto two = [](unsigned value) { return (value < 10 ? "-0" : "-") + std::to_string(value); };
  return std::to_string(int{day.year()}) + two(unsigned{day.month()}) + two(unsigned{day.day()});
}

}  // namespace arris
