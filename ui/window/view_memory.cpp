#include "ui/window/view_memory.h"

#include <utility>

#include <QAction>
#include <QBuffer>
#include <QImage>
#include <QTimer>

#include "core/document/journal.h"
#include "ui/view/mesh_view.h"
#include "ui/window/elements_presenter.h"
#include "ui/window/field_presenter.h"
#include "ui/window/named_views_presenter.h"

namespace arris::ui {

namespace {

constexpr int view_rest = 2000;  // ms without a change until a view is kept

}  // namespace

ViewMemory::ViewMemory(Session* session, std::function<ViewKeepers()> keepers,
                       std::function<void(bool)> show_partitions, NamedViewsPresenter* named,
                       QObject* parent)
    : QObject(parent),
      session_(session),
      keepers_(std::move(keepers)),
      show_partitions_(std::move(show_partitions)),
      named_(named),
      rest_(new QTimer(this)) {
  // The view of after a crash is the last one that rested for a moment.
  rest_->setSingleShot(true);
  connect(rest_, &QTimer::timeout, this, &ViewMemory::keep);
  connect(session_, &Session::opened, this, &ViewMemory::take_opened);
  connect(named_, &NamedViewsPresenter::edited, this, [this] {
    session_->keep_view(kept());
    session_->edit_extras();
  });
}

void ViewMemory::follow() {
  const ViewKeepers keepers = keepers_();
  const auto changed = [this] { rest_->start(view_rest); };
  connect(keepers.view, &MeshView::look_changed, this, changed);
  connect(keepers.fields, &FieldPresenter::changed, this, changed);
  connect(keepers.elements, &ElementsPresenter::visibility_changed, this, changed);
  connect(keepers.elements, &ElementsPresenter::partitions_shown_changed, this, changed);
  for (QAction* toggle : keepers.toggles) connect(toggle, &QAction::toggled, this, changed);
}

std::string ViewMemory::kept() const {
  nlohmann::json view = parse_record(saved_view(keepers_()));
  view["named"] = named_->saved();
  return view.dump();
}

void ViewMemory::keep() {
  if (!session_->current().document.empty()) session_->keep_view(kept());
}

SessionExtras ViewMemory::extras() {
  SessionExtras extras;
  extras.view = kept();
  // Small, for the list of recent files.
  PictureOptions options;
  options.size = {320, 240};
  options.scalar_bar = options.scale_bar = options.orientation_marker = false;
  QByteArray png;
  QBuffer buffer(&png);
  if (const QImage image = keepers_().view->picture(options);
      !image.isNull() && buffer.open(QIODevice::WriteOnly) && image.save(&buffer, "PNG"))
    extras.picture = png.toStdString();
  return extras;
}

void ViewMemory::take_opened() {
  const Document& document = session_->current().document;
  const ViewKeepers keepers = keepers_();
  // An open scan is shown from the side it was scanned from, a closed part from a corner.
  const Point side = mean_normal(*document.mesh);
  constexpr double open_scan = 0.15;
  if (side.norm() > open_scan)
    keepers.view->look_against(side);
  else
    keepers.view->look_from(MeshView::StandardView::isometric);
  show_partitions_(false);
  // A session that nobody looked at yet, as from the command line, shows what was found.
  if (!restore_view(keepers, session_->extras().view) && document.step("find_partitions"))
    show_partitions_(true);
  const nlohmann::json kept = parse_record(session_->extras().view);
  named_->restore(kept.is_object() && kept.contains("named") ? kept["named"] : nlohmann::json());
  named_->set_part(true);
  keepers.view->setFocus();
}

}  // namespace arris::ui
