#include "ui/window/steps_presenter.h"

#include <algorithm>
#include <cmath>

#include "core/base/number_text.h"
#include "core/document/flow.h"
#include "ui/panels/controls.h"
#include "ui/window/unit_suffix.h"

namespace arris::ui {

namespace {

QString seconds_text(double seconds) {
  if (seconds <= 0.0) return {};
  return QString::fromStdString(seconds < 0.0095 ? "< 0.01" : arris::number_text(seconds, 2)) +
         " s";
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

QVariantList intervals_of(const nlohmann::json& intervals) {
  QVariantList list;
  for (const auto& interval : intervals)
    list << QVariant(QVariantList{interval[0].get<double>(),
                                  interval[1].is_null() ? qInf() : interval[1].get<double>()});
  return list;
}

/// A value of a parameter as its editor takes it.
QVariant editor_value(const Parameter& parameter, const nlohmann::json& value) {
  switch (parameter.kind) {
    case ParameterKind::choice:
      return QString::fromStdString(value.get<std::string>());
    case ParameterKind::intervals:
      return intervals_of(value);
    case ParameterKind::whole:
      return value.get<int>();
    default:
      return value.get<double>();
  }
}

/// With what a step that an older version ran did not know.
nlohmann::json complete(const OperationKind& kind, const Document& document, nlohmann::json given) {
  if (std::ranges::all_of(kind.parameters, [&](const Parameter& parameter) {
        return given.contains(parameter.name);
      }))
    return given;
  const Result<nlohmann::json> resolved = kind.resolve(document, given);
  return resolved ? *resolved : given;
}

/// The editor of a parameter of the operation table, without its value.
StepParameter editor_of(const Parameter& parameter, const Document& document) {
  constexpr double most_shown = 999999.0, most_curvature = 1e12;
  const Mesh& mesh = *document.mesh;
  StepParameter editor;
  editor.key = shown_text(parameter.name);
  editor.label = shown_text(parameter.label);
  editor.tooltip = shown_text(parameter.help);
  if (const std::string_view from = parameter.otherwise.from(); !from.empty())
    editor.tooltip += StepsPresenter::tr(" By default: %1.").arg(shown_text(from));
  editor.least = parameter.least;
  editor.most = parameter.most;
  editor.decimals = 3;
  switch (parameter.kind) {
    case ParameterKind::choice:
      editor.kind = StepParameter::Kind::choice;
      for (const ParameterChoice& choice : parameter.choices) {
        editor.choices << shown_text(choice.key);
        editor.choice_labels << shown_text(choice.label);
      }
      break;
    case ParameterKind::intervals:
      editor.kind = StepParameter::Kind::intervals;
      editor.most = most_curvature;
      editor.decimals = std::clamp(5 + 2 * magnitude_of(mesh), 3, 15);
      break;
    case ParameterKind::whole:
      editor.kind = StepParameter::Kind::whole;
      editor.most = std::min(parameter.most, most_shown);
      editor.decimals = 0;
      break;
    default:
      editor.kind = parameter.logarithmic ? StepParameter::Kind::scale : StepParameter::Kind::real;
  }
  if (parameter.unit == unit_of_part) {
    editor.most = parameter.most * mesh.diagonal();
    editor.decimals = length_decimals_of(mesh);
    editor.suffix = unit_suffix(document);
  } else if (parameter.unit == "°") {
    editor.decimals = 2;
    editor.suffix = " °";
  }
  return editor;
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

Operation StepsPresenter::from_card(const std::string& step) const {
  const QString name = QString::fromStdString(step);
  return operation_from(name, panel_->values(name));
}

void StepsPresenter::run(const QString& step) { session_->run({from_card(step.toStdString())}); }

/// Whether "run all that is out of date" means this step.
bool StepsPresenter::wants_run(const ChainStep& one) const {
  const std::optional<Step>& step = session_->current().document.step(one.name);
  return step ? step->out_of_date || panel_->is_edited(shown_text(one.name)) : !one.on_demand;
}

bool StepsPresenter::anything_out_of_date() const {
  return !session_->current().document.empty() &&
         std::ranges::any_of(chain_steps, [&](const ChainStep& one) { return wants_run(one); });
}

void StepsPresenter::run_out_of_date() {
  const Document& document = session_->current().document;
  if (document.empty()) return;
  std::vector<Operation> operations;
  for (const ChainStep& one : chain_steps) {
    const std::string name(one.name);
    const std::optional<Step>& step = document.step(name);
    // Once one step is run, the later ones that were run are out of date, too.
    if (!wants_run(one) && !(step && !operations.empty())) continue;
    // A step never run takes its defaults from what the steps before it leave; those of the lines
    // come from the scan, so that what was chosen on their card counts.
    const bool by_card = step || name == "find_sharp_lines";
    operations.push_back(by_card ? from_card(name) : Operation{name, nlohmann::json::object()});
  }
  session_->run(std::move(operations));
}

void StepsPresenter::run_paper_flow() {
  const Document& document = session_->current().document;
  if (document.empty()) return;
  StepParameters besides;
  for (std::size_t k = 0; k < chain_steps.size(); ++k)
    if (document.steps[k]) besides[std::string(chain_steps[k].name)] = nlohmann::json::object();
  std::vector<Operation> operations = operations_of(Flow::paper, besides);
  const std::vector<Operation> flow = operations_of(Flow::paper);
  for (Operation& operation : operations)
    if (std::ranges::find(flow, operation.name, &Operation::name) == flow.end())
      operation = from_card(operation.name);
  session_->run(std::move(operations));
}

const nlohmann::json& StepsPresenter::defaults(const std::string& step, const std::string& method) {
  const Document& document = session_->shown().document;
  const std::string scan = document.opened.mesh->hash();
  for (const MethodDefaults& known : defaults_)
    if (known.scan == scan && known.step == step && known.method == method) return known.parameters;
  // Only what depends on the method is worked out.
  nlohmann::json given = session_->parameters(step);
  for (const Parameter& parameter : find_operation(step)->parameters)
    if (parameter.by_method) given.erase(std::string(parameter.name));
  given["method"] = method;
  const Result<Operation> resolved = resolve(document, {step, given});
  std::erase_if(defaults_, [&](const MethodDefaults& known) { return known.scan != scan; });
  defaults_.push_back(
      {scan, step, method, resolved ? resolved->parameters : nlohmann::json::object()});
  return defaults_.back().parameters;
}

std::vector<StepParameter> StepsPresenter::editors_of(const OperationKind& kind) {
  const Document& document = session_->shown().document;
  const std::string step(kind.name);
  const nlohmann::json own = complete(kind, document, session_->parameters(step));
  std::vector<StepParameter> editors;
  for (const Parameter& parameter : kind.parameters) {
    if (parameter.label.empty()) continue;
    const std::string name(parameter.name);
    StepParameter editor = editor_of(parameter, document);
    editor.value = editor_value(parameter, own.at(name));
    if (!parameter.method.empty()) {
      editor.hangs_on = "method";
      editor.value_of = {{shown_text(parameter.method), editor.value}};
    } else if (parameter.by_method) {
      // Angles and lengths by one method say nothing about the other.
      editor.hangs_on = "method";
      for (const ParameterChoice& method : kind.find("method")->choices)
        editor.value_of[shown_text(method.key)] =
            method.key == own.at("method")
                ? editor.value
                : editor_value(parameter, defaults(step, std::string(method.key)).at(name));
    }
    editors.push_back(std::move(editor));
  }
  return editors;
}

QString StepsPresenter::outcome_of(std::size_t place) {
  const Document& document = session_->shown().document;
  const OperationKind& kind = *find_operation(chain_steps[place].name);
  if (!chain_steps[place].changes_mesh) return QString::fromStdString(kind.outcome(document));
  // Takes a look at whole meshes.
  const Stage& output = document.outputs[place];
  const std::string of = document.opened.mesh->hash() + document.mesh->hash() +
                         (output.mesh ? output.mesh->hash() : "") +
                         document.steps[place]->parameters.dump() +
                         (document.steps[place]->out_of_date ? "out of date" : "") +
                         std::string(info_of(length_unit_of(document)).key);
  auto& known = outcomes_[place];
  if (known.first != of) known = {of, QString::fromStdString(kind.outcome(document))};
  return known.second;
}

StepCard StepsPresenter::scan_card() const {
  const Document& document = session_->shown().document;
  StepCard card;
  card.name = "open";
  card.title = tr("Scan");
  card.runnable = false;
  card.tooltip = tr("The loaded mesh and what had to be mended in it.");
  if (document.empty()) return card;
  const Mesh& mesh = *document.opened.mesh;
  card.state = StepState::done;
  card.result =
      shown_count(mesh.face_count(), tr("face"), tr("faces")) + ", " +
      tr("edges %1, %2")
          .arg(QString::fromStdString(arris::number_text(mesh.mean_edge_length(), 3)) +
                   unit_suffix(document),
               shown_count(mesh.border_edge_count(), tr("border edge"), tr("border edges")));
  if (!document.scan->report.clean()) card.result += "; " + tr("mended, see the load report");
  card.time = seconds_text(session_->seconds_of("open"));
  return card;
}

void StepsPresenter::refresh() {
  const Document& document = session_->shown().document;
  std::vector<StepCard> cards{scan_card()};
  for (std::size_t k = 0; k < chain_steps.size(); ++k) {
    const OperationKind& kind = *find_operation(chain_steps[k].name);
    StepCard card;
    card.name = shown_text(kind.name);
    card.title = shown_text(chain_steps[k].title);
    card.tooltip = shown_text(kind.help);
    if (!document.empty()) {
      card.state = state_of(document.steps[k]);
      card.time = seconds_text(session_->seconds_of(std::string(kind.name)));
      card.parameters = editors_of(kind);
      if (document.steps[k]) card.result = outcome_of(k);
    }
    cards.push_back(std::move(card));
  }
  panel_->set_cards(cards);
}

}  // namespace arris::ui
