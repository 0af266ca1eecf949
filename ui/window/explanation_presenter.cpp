#include "ui/window/explanation_presenter.h"

#include <cmath>
#include <utility>
#include <vector>

#include "core/base/words.h"
#include "core/guidance/explain.h"
#include "ui/panels/controls.h"
#include "ui/window/actions.h"

namespace arris::ui {

namespace {

QString with_unit(double value, const std::string& unit) {
  if (std::isnan(value)) return QStringLiteral("–");
  if (unit == "°") return QString::fromStdString(degrees_in_words(value));
  const QString text = shown_number(value, 3);
  return unit.empty() ? text : text + " " + QString::fromStdString(unit);
}

ExplanationSection section_of(const QString& title, const Explanation& explanation) {
  ExplanationSection section;
  section.title = title;
  section.headline = QString::fromStdString(explanation.headline);
  section.holds = explanation.holds;
  for (const ExplainedTest& test : explanation.tests)
    section.rows.push_back({QString::fromStdString(test.name), with_unit(test.value, test.unit),
                            with_unit(test.threshold, test.unit), test.passed,
                            QString::fromStdString(test.sentence)});
  section.profile = explanation.profile;
  return section;
}

}  // namespace

ExplanationPresenter::ExplanationPresenter(Session* session, MeshView* view,
                                           ExplanationPanel* panel, QObject* parent)
    : QObject(parent), session_(session), panel_(panel), work_(new LatestWork(this)) {
  connect(view, &MeshView::clicked, this, [this](const std::optional<Pick>& pick) {
    if (!pick) return;
    pick_ = pick;
    current_ = false;
    refresh();
  });
  connect(session_, &Session::changed, this, [this](bool other_mesh) {
    if (other_mesh) pick_.reset();
    work_->cancel();
    current_ = false;
    if (!session_->is_previewing()) refresh();
  });
  refresh();
}

void ExplanationPresenter::add_actions(QMenu* menu) {
  connect(action(menu, tr("&Explain what is clicked"), QKeySequence("F8"),
                 tr("Why the edge and the face clicked last are, or are not, on a line and in a "
                    "partition")),
          &QAction::triggered, this, &ExplanationPresenter::wanted);
}

void ExplanationPresenter::set_shown(bool shown) {
  shown_ = shown;
  if (shown_)
    refresh();
  else
    work_->cancel();
}

void ExplanationPresenter::explain(const Pick& pick) {
  pick_ = pick;
  current_ = false;
  emit wanted();
  refresh();
}

void ExplanationPresenter::refresh() {
  if (current_) return;
  const Document& document = session_->current().document;
  if (!pick_ || document.empty()) {
    panel_->set_note(
        tr("Click the part: here you read why the edge and the face under the pointer "
           "are, or are not, on a line and in a partition."));
    return;
  }
  if (!shown_) return;
  panel_->set_note(tr("Working it out …"));
  work_->start(
      [document, pick = *pick_](const Context&) {
        std::vector<ExplanationSection> sections;
        if (pick.edge < document.mesh->edge_count())
          sections.push_back(
              section_of(tr("Edge %1").arg(pick.edge), explain_edge(document, pick.edge)));
        if (pick.face < document.mesh->face_count())
          sections.push_back(
              section_of(tr("Face %1").arg(pick.face), explain_face(document, pick.face)));
        return sections;
      },
      [this](std::vector<ExplanationSection> sections) {
        current_ = true;
        panel_->set_sections(std::move(sections));
      });
}

}  // namespace arris::ui
