#include "ui/window/stability_presenter.h"

#include <numbers>
#include <utility>

#include "core/document/operations/stages.h"
#include "core/document/treatments/treatment.h"
#include "core/guidance/stability.h"
#include "ui/panels/controls.h"
#include "ui/window/actions.h"

namespace arris::ui {

namespace {

/// Above this the curve takes seconds of both cores and has to be asked for.
constexpr std::size_t most_faces = 300000;

struct Found {
  StabilityCurve curve;
  std::optional<Plateau> plateau;
};

Result<Found> with_plateau(Result<StabilityCurve> curve) {
  if (!curve) return tl::unexpected<Error>(curve.error());
  Found found{std::move(*curve), std::nullopt};
  found.plateau = plateau(found.curve);
  return found;
}

}  // namespace

StabilityPresenter::StabilityPresenter(Session* session, FieldPresenter* fields,
                                       HistogramPanel* histogram, QObject* parent)
    : QObject(parent),
      session_(session),
      fields_(fields),
      histogram_(histogram),
      work_(new LatestWork(this)) {
  connect(session_, &Session::changed, this, [this] {
    // While a threshold is dragged the curve stays; it does not depend on it.
    if (!session_->is_previewing()) refresh();
  });
  connect(fields_, &FieldPresenter::changed, this, [this] {
    if (!session_->is_previewing()) refresh();
  });
}

void StabilityPresenter::add_actions(QMenu* menu) {
  toggle_ =
      action(menu, tr("&Stability curve"), QKeySequence("Shift+C"),
             tr("Over the histogram: how many lines, or partitions, each threshold would give; "
                "where the curve is flat is a good place to stop"));
  toggle_->setCheckable(true);
  connect(toggle_, &QAction::triggered, this, [this](bool on) {
    chosen_ = on;
    refresh();
  });
  histogram_->addAction(toggle_);
  histogram_->setContextMenuPolicy(Qt::ActionsContextMenu);
  refresh();
}

bool StabilityPresenter::is_on() const {
  const MeshPtr& mesh = session_->current().document.mesh;
  return chosen_.value_or(!mesh || mesh->face_count() <= most_faces);
}

StabilityPresenter::Basis StabilityPresenter::basis() const {
  const Document& document = session_->current().document;
  Basis basis;
  if (document.empty() || !is_on()) return basis;
  const Field field = fields_->field();
  if (field != Field::normal_jump && field != Field::ihe && field != Field::ikabs &&
      field != Field::kabs)
    return basis;
  nlohmann::json partitions = session_->current_parameters("find_partitions");
  // What surfaces decide by is no interval of curvature.
  const bool by_surfaces =
      document.step("find_partitions") && document.partition_method() == PartitionMethod::surfaces;
  const bool by_criterion =
      !by_surfaces && ((field == Field::kabs && partitions["criterion"] == "kabs") ||
                       (field == Field::ikabs && partitions["criterion"] == "ikabs"));
  if (by_criterion) {
    basis.kind = Kind::partitions;
    basis.mesh = document.mesh;
    basis.curvatures = document.shown_curvatures();
    basis.lines = document.lines.lines;
    const double least =
        partitions["intervals"].empty() ? 0.0 : partitions["intervals"][0][0].get<double>();
    basis.parameters = {{"criterion", partitions["criterion"]},
                        {"min_faces", partitions["min_faces"]},
                        {"least", least}};
    return basis;
  }
  nlohmann::json lines = session_->current_parameters("find_sharp_lines");
  const bool by_jump = line_options_of(lines).method == LineMethod::normal_jump;
  if (field == Field::kabs || by_jump != (field == Field::normal_jump)) return basis;
  const Stage stage = stage_before(document, "find_sharp_lines");
  if (!stage.mesh || !stage.curvatures || (by_jump && !stage.evidence)) return basis;
  basis.kind = field == Field::ikabs ? Kind::lines_by_ikabs : Kind::lines_by_angle;
  basis.mesh = stage.mesh;
  basis.curvatures = stage.curvatures;
  if (by_jump) basis.evidence = stage.evidence;
  basis.parameters = std::move(lines);
  for (const char* name : {"angle", "corrections", "version"}) basis.parameters.erase(name);
  return basis;
}

void StabilityPresenter::refresh() {
  if (toggle_) toggle_->setChecked(is_on());
  Basis wanted = basis();
  if (wanted == basis_) return;
  basis_ = std::move(wanted);
  work_->cancel();
  HistogramCurve to_come;
  const bool of_lines = basis_.kind != Kind::partitions;
  if (basis_.kind != Kind::none) to_come.label = of_lines ? tr("lines") : tr("partitions");
  histogram_->set_curve(std::move(to_come));
  if (basis_.kind == Kind::none) return;
  const SharpLines lines = of_lines ? SharpLines() : session_->current().document.lines;
  work_->start(
      [basis = basis_, lines, of_lines](const Context& context) {
        const nlohmann::json& p = basis.parameters;
        if (of_lines) {
          LineEvidencePtr evidence;
          if (basis.evidence) {
            Result<LineEvidencePtr> known = basis.evidence->get(context);
            if (!known) return Result<Found>(tl::unexpected<Error>(known.error()));
            evidence = std::move(*known);
          }
          return with_plateau(line_stability(*basis.mesh, *basis.curvatures, evidence.get(),
                                             line_options_of(p), {}, 24, context));
        }
        PartitionOptions options;
        options.bare_areas = true;
        options.criterion = p.at("criterion") == "kabs" ? Criterion::kabs : Criterion::ikabs;
        options.min_faces = p.at("min_faces");
        const double least = p.at("least");
        options.intervals = {{least, least}};
        return with_plateau(partition_stability(*basis.mesh,
                                                values_of(*basis.curvatures, options.criterion),
                                                lines, options, {}, 48, context));
      },
      [this, kind = basis_.kind](Result<Found> found) {
        if (!found) return;
        HistogramCurve curve;
        curve.label = histogram_->curve().label;
        const auto on_axis = [kind](double threshold) {
          return kind == Kind::lines_by_ikabs
                     ? ikabs_of_straight_edge(threshold * std::numbers::pi / 180.0)
                     : threshold;
        };
        for (const StabilityPoint& point : found->curve.points)
          curve.points.emplace_back(on_axis(point.threshold), static_cast<double>(point.count));
        if (found->plateau) {
          const double from = on_axis(found->plateau->from), to = on_axis(found->plateau->to);
          const QString unit = kind == Kind::lines_by_angle ? QStringLiteral("°") : QString();
          curve.plateau = {from, to};
          curve.plateau_text = tr("steady from %1 to %2")
                                   .arg(shown_number(from, 3) + unit, shown_number(to, 3) + unit);
        }
        histogram_->set_curve(std::move(curve));
      });
}

}  // namespace arris::ui
