#include "ui/window/steps_presenter.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/base/number_text.h"
#include "core/document/flow.h"
#include "core/document/treatments/treatment.h"
#include "core/mesh/face_quality.h"
#include "core/partitions/intervals.h"
#include "core/sharp_lines/sharp_lines.h"
#include "ui/panels/controls.h"
#include "ui/window/unit_suffix.h"

namespace arris::ui {

namespace {

QString seconds_text(double seconds) {
  if (seconds <= 0.0) return {};
  return QString::fromStdString(seconds < 0.0095 ? "< 0.01" : arris::number_text(seconds, 2)) +
         " s";
}

/// The steps that can be run, in the order of figure 2.
constexpr const char* chain[] = {"simplify",       "swap_edges",       "find_sharp_lines",
                                 "equilateralize", "smooth_curvature", "find_partitions"};

/// Never run unless asked for: lines and partitions of a scan can be had without.
bool is_optional(std::string_view step) {
  return step != "find_sharp_lines" && step != "find_partitions";
}

StepCard card(const QString& name, const QString& title, const QString& tooltip) {
  StepCard result;
  result.name = name;
  result.title = title;
  result.tooltip = tooltip;
  return result;
}

StepParameter choice(const QString& key, const QString& label, const QString& tooltip,
                     const std::string& value, const QStringList& choices,
                     const QStringList& choice_labels) {
  StepParameter result;
  result.key = key;
  result.label = label;
  result.tooltip = tooltip;
  result.kind = StepParameter::Kind::choice;
  result.choices = choices;
  result.choice_labels = choice_labels;
  result.value = QString::fromStdString(value);
  return result;
}

StepParameter real(const QString& key, const QString& label, const QString& tooltip, double value,
                   double least, double most, int decimals, const QString& suffix) {
  StepParameter p;
  p.key = key;
  p.label = label;
  p.tooltip = tooltip;
  p.value = value;
  p.least = least;
  p.most = most;
  p.decimals = decimals;
  p.suffix = suffix;
  return p;
}

StepParameter whole(const QString& key, const QString& label, const QString& tooltip, int value,
                    int least, int most) {
  StepParameter p = real(key, label, tooltip, 0.0, least, most, 0, {});
  p.kind = StepParameter::Kind::whole;
  p.value = value;
  return p;
}

/// "11,730 → 5,266 vertices"
QString vertices_text(const Mesh& before, const Mesh& after) {
  const auto used = [](const Mesh& mesh) {
    std::size_t count = 0;
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) count += !mesh.is_isolated(v);
    return count_text(static_cast<qint64>(count));
  };
  return used(before) + " → " + used(after) + " " + QObject::tr("vertices");
}

/// Edges of a mesh that another one does not have.
std::size_t count_new_edges(const Mesh& mesh, const Mesh& before) {
  std::vector<EdgeVertices> fresh;  // both lists are sorted
  std::set_difference(mesh.edges().begin(), mesh.edges().end(), before.edges().begin(),
                      before.edges().end(), std::back_inserter(fresh));
  return fresh.size();
}

StepState state_of(const std::optional<Step>& step) {
  return !step ? StepState::not_run : step->out_of_date ? StepState::out_of_date : StepState::done;
}

int magnitude_of(const Mesh& mesh) {
  const double diagonal = mesh.diagonal();
  return diagonal > 0.0 ? static_cast<int>(std::floor(std::log10(diagonal))) : 0;
}

/// As many as show a millionth of a percent of the part in whatever unit, 6 for one of 200.
int length_decimals_of(const Mesh& mesh) { return std::clamp(8 - magnitude_of(mesh), 0, 15); }

double longest_of(const Mesh& mesh) { return 1000.0 * mesh.diagonal(); }

QString wide_angles_text(const Mesh& mesh) {
  return QString::fromStdString(fixed_text(100.0 * share_of_angles_above(mesh, 120.0), 1));
}

}  // namespace

StepsPresenter::StepsPresenter(Session* session, StepsPanel* panel, QObject* parent)
    : QObject(parent), session_(session), panel_(panel) {
  connect(session_, &Session::changed, this, &StepsPresenter::refresh);
  connect(session_, &Session::done, this, &StepsPresenter::refresh);
  connect(session_, &Session::busy_changed, panel_, &StepsPanel::set_busy);
  connect(panel_, &StepsPanel::run_requested, this,
          [this](const QString& step, const QVariantMap& values) {
            session_->run({operation_from(step, values)});
          });
  connect(panel_, &StepsPanel::dragged, this,
          [this](const QString& step, const QVariantMap& values) {
            if (!session_->busy()) session_->preview(operation_from(step, values));
          });
  connect(panel_, &StepsPanel::settled, this,
          [this](const QString& step, const QVariantMap& values) {
            session_->commit_preview(operation_from(step, values));
          });
  connect(panel_, &StepsPanel::edited, this, &StepsPresenter::edited);
  // Where a step takes no time, what is entered is run at once.
  connect(panel_, &StepsPanel::entered, this,
          [this](const QString& step, const QVariantMap& values) {
            constexpr double at_once = 0.1;  // s
            const std::string name = step.toStdString();
            const double seconds = session_->seconds_of(name);
            if (session_->current().document.step(name) && !session_->busy() &&
                !session_->is_previewing() && seconds > 0.0 && seconds < at_once)
              session_->run({operation_from(step, values)});
          });
  connect(panel_, &StepsPanel::run_out_of_date_requested, this, &StepsPresenter::run_out_of_date);
  refresh();
}

Operation StepsPresenter::operation_from(const QString& step, const QVariantMap& values) const {
  Operation operation{step.toStdString(), session_->current_parameters(step.toStdString())};
  for (auto it = values.begin(); it != values.end(); ++it) {
    const std::string key = it.key().toStdString();
    if (key == "intervals") {
      nlohmann::json intervals = nlohmann::json::array();
      for (const QVariant& row : it.value().toList()) {
        const QVariantList ends = row.toList();
        const double max = ends.at(1).toDouble();
        intervals.push_back(
            {ends.at(0).toDouble(), std::isfinite(max) ? nlohmann::json(max) : nlohmann::json()});
      }
      operation.parameters[key] = intervals;
    } else if (it.value().typeId() == QMetaType::QString) {
      operation.parameters[key] = it.value().toString().toStdString();
    } else if (it.value().typeId() == QMetaType::Int) {
      operation.parameters[key] = it.value().toInt();
    } else {
      operation.parameters[key] = it.value().toDouble();
    }
  }
  return operation;
}

void StepsPresenter::run(const QString& step) {
  session_->run({operation_from(step, panel_->values(step))});
}

/// Whether "run all that is out of date" means this step.
bool StepsPresenter::wants_run(const char* name) const {
  const std::optional<Step>& step = session_->current().document.step(name);
  return step ? step->out_of_date || panel_->is_edited(name) : !is_optional(name);
}

bool StepsPresenter::anything_out_of_date() const {
  return !session_->current().document.empty() &&
         std::any_of(std::begin(chain), std::end(chain),
                     [&](const char* name) { return wants_run(name); });
}

void StepsPresenter::run_out_of_date() {
  const Document& document = session_->current().document;
  if (document.empty()) return;
  std::vector<Operation> operations;
  for (const char* name : chain) {
    const std::optional<Step>& step = document.step(name);
    // Once one step is run, the later ones that were run are out of date, too.
    if (!wants_run(name) && !(step && !operations.empty())) continue;
    // A step never run takes its defaults from what the steps before it leave; those of the lines
    // come from the scan, so that what was chosen on their card counts.
    const bool by_card = step || std::string_view(name) == "find_sharp_lines";
    operations.push_back(by_card ? operation_from(name, panel_->values(name))
                                 : Operation{name, nlohmann::json::object()});
  }
  session_->run(std::move(operations));
}

void StepsPresenter::run_paper_flow() {
  const Document& document = session_->current().document;
  if (document.empty()) return;
  const std::vector<Operation> flow = operations_of(Flow::paper);
  std::vector<Operation> operations;
  for (const char* name : chain) {
    const auto own = std::ranges::find(flow, name, &Operation::name);
    if (own != flow.end())
      operations.push_back(*own);
    else if (document.step(name))
      operations.push_back(operation_from(name, panel_->values(name)));
  }
  session_->run(std::move(operations));
}

const nlohmann::json& StepsPresenter::line_defaults(const char* method) {
  const Document& document = session_->shown().document;
  LineDefaults& known = line_defaults_;
  if (known.scan == document.opened.mesh && known.method == method) return known.parameters;
  const Result<Operation> resolved = resolve(document, {"find_sharp_lines", {{"method", method}}});
  known = {document.opened.mesh, method,
           resolved ? resolved->parameters : nlohmann::json::object()};
  return known.parameters;
}

StepCard StepsPresenter::lines_card() {
  const Document& document = session_->shown().document;
  StepCard lines;
  lines.name = "find_sharp_lines";
  lines.title = tr("Sharp lines");
  lines.tooltip =
      tr("Finds the sharp lines of the part: where its mean normal jumps, or by the paper's walk "
         "along edges (section 6).");
  if (document.empty()) return lines;
  const nlohmann::json p = session_->parameters("find_sharp_lines");
  const bool by_walk = line_options_of(p).method == LineMethod::walk;
  const nlohmann::json& other = line_defaults(by_walk ? "normal_jump" : "walk");
  const nlohmann::json& jump = by_walk ? other : p;
  const nlohmann::json& walk = by_walk ? p : other;
  lines.state = state_of(document.find_sharp_lines);
  lines.time = seconds_text(session_->seconds_of("find_sharp_lines"));
  // Angles and lengths by one method say nothing about the other.
  const auto by_method = [&](StepParameter parameter) {
    const std::string key = parameter.key.toStdString();
    parameter.hangs_on = "method";
    parameter.value_of = {{"normal_jump", jump.value(key, 0.0)}, {"walk", walk.value(key, 0.0)}};
    return parameter;
  };
  const auto of_walk = [&](StepParameter parameter) {
    parameter.hangs_on = "method";
    parameter.value_of = {{"walk", walk.value(parameter.key.toStdString(), 0)}};
    return parameter;
  };
  const double longest = longest_of(*document.mesh);
  const int length_decimals = length_decimals_of(*document.mesh);
  lines.parameters = {
      choice("method", tr("Method"),
             tr("Normal jump: lines between regions across which the mean normal jumps; it stands "
                "the noise of scans. Walk: the paper's way along edges, by exterior angle and "
                "IKabs; for simplified meshes."),
             by_walk ? "walk" : "normal_jump", {"normal_jump", "walk"},
             {tr("Normal jump"), tr("Walk along edges (paper)")}),
      by_method(real("angle", tr("Angle TV_IH"),
                     tr("Least angle across a sharp line: the jump of the normals, or by the walk "
                        "the exterior angle of an edge, from which TV_IK follows."),
                     0.0, 0.1, 179.9, 2, " °")),
      real("max_angle", tr("Angle up to"),
           tr("Greatest angle across a sharp line; 180: no upper bound."),
           p.value("max_angle", 180.0), 0.1, 180.0, 2, " °"),
      choice("convexity", tr("Edges"), tr("Which edges may be sharp."), p.value("convexity", "any"),
             {"any", "convex", "concave"}, {tr("Both"), tr("Convex"), tr("Concave")}),
      of_walk(whole("candidates", tr("Candidates"),
                    tr("Edges kept at a vertex by the candidate rule (figure 26); 3 suits most "
                       "parts."),
                    0, 1, 32)),
      by_method(real("min_length", tr("Least length"),
                     tr("Isolated lines shorter than this are removed; 0 keeps them."), 0.0, 0.0,
                     longest, length_decimals, unit_suffix(document))),
      of_walk(whole("parallel_distance", tr("Parallel within"),
                    tr("Of two parallel lines of one sign this many edges apart the weaker is "
                       "removed; 0 keeps both."),
                    0, 0, 4)),
      by_method(real("bridge_gap", tr("Bridge gaps"),
                     tr("Loose ends with at most this distance between them are joined; 0 joins "
                        "none."),
                     0.0, 0.0, longest, length_decimals, unit_suffix(document)))};
  if (document.find_sharp_lines) {
    double length = 0.0;
    for (const LinePtr& line : document.lines.lines) length += line->length;
    lines.result = shown_count(document.lines.lines.size(), tr("line"), tr("lines")) + ", " +
                   QString::fromStdString(length_in_words(length, length_unit_of(document)));
  }
  return lines;
}

StepCard StepsPresenter::partitions_card() {
  const Document& document = session_->shown().document;
  StepCard partitions;
  partitions.name = "find_partitions";
  partitions.title = tr("Partitions");
  partitions.tooltip =
      tr("Splits the part into areas that one surface explains, or into areas of slowly varying "
         "curvature by the paper's fronts (section 7).");
  if (document.empty()) return partitions;
  const nlohmann::json q = session_->parameters("find_partitions");
  const bool by_fronts = q.value("method", "surfaces") == "fronts";
  partitions.state = state_of(document.find_partitions);
  partitions.time = seconds_text(session_->seconds_of("find_partitions"));
  const auto only = [](StepParameter parameter, const char* method) {
    parameter.hangs_on = "method";
    parameter.value_of = {{method, parameter.value}};
    return parameter;
  };
  StepParameter detail = real(
      "detail", tr("Detail"),
      tr("From few large partitions to many small ones; 1 is what the noise of the scan allows "
         "to tell apart. The partitions follow the slider."),
      q.value("detail", 1.0), 0.05, 20.0, 3, "");
  detail.kind = StepParameter::Kind::scale;
  StepParameter intervals;
  intervals.key = "intervals";
  intervals.label = tr("Intervals");
  intervals.tooltip =
      tr("Curvature intervals Kmin – Kmax, run one after the other over what is "
         "left.");
  intervals.kind = StepParameter::Kind::intervals;
  QVariantList list;
  for (const auto& interval : q.value("intervals", nlohmann::json::array()))
    list << QVariant(QVariantList{interval[0].get<double>(),
                                  interval[1].is_null() ? qInf() : interval[1].get<double>()});
  intervals.value = list;
  intervals.least = 0.0;
  intervals.most = 1e12;
  intervals.decimals = std::clamp(5 + 2 * magnitude_of(*document.mesh), 3, 15);
  StepParameter least =
      whole("min_faces", tr("Least faces"),
            tr("Smaller partitions are not kept; those of surfaces join the one beside them."), 0,
            1, 999999);
  least.hangs_on = "method";
  const int own = q.value("min_faces", 1);
  const auto default_of = [&](PartitionMethod method) {
    return static_cast<int>(default_min_faces(*document.mesh, method));
  };
  least.value_of = {{"surfaces", by_fronts ? default_of(PartitionMethod::surfaces) : own},
                    {"fronts", by_fronts ? own : default_of(PartitionMethod::fronts)}};
  partitions.parameters = {
      choice(
          "method", tr("Method"),
          tr("Surfaces: areas that one plane, sphere, cylinder, cone, torus or free-form surface "
             "explains within the noise. Fronts: the paper's, under intervals of curvature."),
          by_fronts ? "fronts" : "surfaces", {"surfaces", "fronts"},
          {tr("Fitted surfaces"), tr("Fronts of curvature (paper)")}),
      only(detail, "surfaces"),
      only(choice("criterion", tr("Criterion"),
                  tr("Kabs on dense meshes, its invariant IKabs on sparse ones."),
                  q.value("criterion", "kabs"), {"kabs", "ikabs"}, {"Kabs", "IKabs"}),
           "fronts"),
      only(intervals, "fronts"),
      least,
      only(whole("fill_holes", tr("Fill under"),
                 tr("Unassigned areas with fewer faces join the partition around them; 0 fills "
                    "none."),
                 q.value("fill_holes", 0), 0, 999999),
           "fronts")};
  if (document.find_partitions)
    partitions.result =
        shown_count(document.partitions.partitions.size(), tr("partition"), tr("partitions")) +
        ", " +
        tr("%1 % of the area")
            .arg(QString::fromStdString(fixed_text(100.0 * assigned_share(document), 1)));
  return partitions;
}

QString StepsPresenter::swaps_text(const MeshPtr& before, const MeshPtr& after) {
  for (const Swaps& known : swaps_)
    if (known.before == before && known.after == after) return known.text;
  const QString text =
      shown_count(count_new_edges(*after, *before), tr("edge swapped"), tr("edges swapped")) +
      tr(", angles above 120°: %1 → %2 %").arg(wide_angles_text(*before), wide_angles_text(*after));
  if (swaps_.size() > 3) swaps_.erase(swaps_.begin());  // no meshes are kept for nothing
  swaps_.push_back({before, after, text});
  return text;
}

void StepsPresenter::refresh() {
  const Document& document = session_->shown().document;
  std::vector<StepCard> cards;
  StepCard open;
  open.name = "open";
  open.title = tr("Scan");
  open.runnable = false;
  open.tooltip = tr("The loaded mesh and what had to be mended in it.");
  if (!document.empty()) {
    const Mesh& mesh = *document.opened.mesh;
    open.state = StepState::done;
    open.result =
        shown_count(mesh.face_count(), tr("face"), tr("faces")) + ", " +
        tr("edges %1, %2")
            .arg(QString::fromStdString(arris::number_text(mesh.mean_edge_length(), 3)) +
                     unit_suffix(document),
                 shown_count(mesh.border_edge_count(), tr("border edge"), tr("border edges")));
    if (!document.scan->report.clean()) open.result += "; " + tr("mended, see the load report");
    open.time = seconds_text(session_->seconds_of("open"));
  }
  cards.push_back(open);
  StepCard simplify =
      card("simplify", tr("Simplification"),
           tr("Removes vertices inside error zones, which takes out the noise (section 4.1). Every "
              "vertex of the scan stays within the zone's radius of the surface. Part of the "
              "paper's flow; lines by the normal jump do without."));
  StepCard swap = card("swap_edges", tr("Edge swapping"),
                       tr("Swaps edges, inside the error zones, so that sharp lines run along "
                          "edges (section 4.2)."));
  StepCard equilateral =
      card("equilateralize", tr("Equilateralisation"),
           tr("Swaps edges, inside the error zones, so that faces are nearly equilateral (section "
              "4.3). Sharp lines stay."));
  StepCard smoothing;
  smoothing.name = "smooth_curvature";
  smoothing.title = tr("Curvature smoothing");
  smoothing.tooltip = tr("Averages curvature over neighbours, never across a line (section 4.4).");
  if (!document.empty()) {
    const double longest = longest_of(*document.mesh);
    const int length_decimals = length_decimals_of(*document.mesh);
    const QString suffix = unit_suffix(document);
    const nlohmann::json z = session_->parameters("simplify");
    simplify.state = state_of(document.simplify);
    simplify.time = seconds_text(session_->seconds_of("simplify"));
    simplify.parameters = {
        real("error_zone", tr("Error zone"),
             tr("Radius of the sphere round each vertex of the scan that the surface has to meet. "
                "The default is three times the noise of the scan."),
             z.value("error_zone", 0.0), 0.0, longest, length_decimals, suffix),
        real("max_edge_length", tr("Longest edge"),
             tr("No new edge becomes longer than this, so that flat areas stay populated; 0: no "
                "limit."),
             z.value("max_edge_length", 0.0), 0.0, longest, length_decimals, suffix)};
    if (document.simplified.mesh)
      simplify.result =
          vertices_text(*document.opened.mesh, *document.simplified.mesh) +
          tr(", all within %1")
              .arg(QString::fromStdString(arris::number_text(z.value("error_zone", 0.0), 3)) +
                   suffix);
    swap.state = state_of(document.swap_edges);
    swap.time = seconds_text(session_->seconds_of("swap_edges"));
    const MeshPtr before_swaps =
        document.simplified.mesh ? document.simplified.mesh : document.opened.mesh;
    if (document.swapped.mesh) swap.result = swaps_text(before_swaps, document.swapped.mesh);
    equilateral.state = state_of(document.equilateralize);
    equilateral.time = seconds_text(session_->seconds_of("equilateralize"));
    if (document.equilateralize && !document.equilateralize->out_of_date)
      equilateral.result =
          swaps_text(document.swapped.mesh ? document.swapped.mesh : before_swaps, document.mesh);

    const nlohmann::json s = session_->parameters("smooth_curvature");
    smoothing.state = state_of(document.smooth_curvature);
    smoothing.time = seconds_text(session_->seconds_of("smooth_curvature"));
    smoothing.parameters = {whole("passes", tr("Passes"),
                                  tr("Passes of eq. 20 over the whole part."), s.value("passes", 3),
                                  1, 100)};
    if (document.smooth_curvature)
      smoothing.result =
          shown_count(static_cast<std::size_t>(s.value("passes", 0)), tr("pass"), tr("passes"));
  }
  cards.push_back(simplify);
  cards.push_back(swap);
  cards.push_back(lines_card());
  cards.push_back(equilateral);
  cards.push_back(smoothing);
  cards.push_back(partitions_card());
  panel_->set_cards(cards);
}

}  // namespace arris::ui
