#include "ui/window/named_views_presenter.h"

#include <algorithm>
#include <utility>

#include <QInputDialog>
#include <QMenu>

#include "core/document/journal.h"
#include "ui/window/actions.h"
#include "ui/window/named_views_dialog.h"

namespace arris::ui {

namespace {

constexpr std::size_t with_keys = 9;    // Ctrl+1 to Ctrl+9
constexpr std::size_t most = 200;       // of a stranger's session
constexpr qsizetype longest_name = 80;  // characters

}  // namespace

NamedViewsPresenter::NamedViewsPresenter(std::function<ViewKeepers()> keepers, QWidget* window)
    : QObject(window), keepers_(std::move(keepers)), window_(window) {}

void NamedViewsPresenter::add_actions(QMenu* menu) {
  menu_ = menu;
  keep_ = action(menu, tr("&Keep this view…"), QKeySequence("Ctrl+Shift+V"),
                 tr("Give a name to how the part is looked at: camera, field, section, what is "
                    "shown"));
  connect(keep_, &QAction::triggered, this, &NamedViewsPresenter::ask_name);
  next_ = action(menu, tr("&Next"), QKeySequence("Ctrl+PgDown"), tr("The next named view"));
  connect(next_, &QAction::triggered, this, [this] { step(1); });
  previous_ = action(menu, tr("&Previous"), QKeySequence("Ctrl+PgUp"), tr("The named view before"));
  connect(previous_, &QAction::triggered, this, [this] { step(-1); });
  arrange_ = action(menu, tr("&Arrange…"), {}, tr("Rename named views, delete or reorder them"));
  connect(arrange_, &QAction::triggered, this, &NamedViewsPresenter::arrange);
  menu->addSeparator();
  refresh();
}

std::optional<std::size_t> NamedViewsPresenter::find(const QString& name) const {
  const auto found = std::ranges::find(views_, name, &NamedView::name);
  if (found == views_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - views_.begin());
}

void NamedViewsPresenter::show(std::size_t place) {
  if (place >= views_.size()) return;
  restore_view(keepers_(), views_[place].view);
  shown_ = place;
  emit message(views_[place].name);
}

void NamedViewsPresenter::keep(const QString& name) {
  const QString trimmed = name.simplified().left(longest_name);
  if (trimmed.isEmpty()) return;
  const std::string view = saved_view(keepers_());
  shown_ = find(trimmed);
  if (shown_) {
    views_[*shown_].view = view;
  } else {
    shown_ = views_.size();
    views_.push_back({trimmed, view});
  }
  refresh();
  emit message(tr("View “%1” kept").arg(trimmed));
  emit edited();
}

void NamedViewsPresenter::set_views(std::vector<NamedView> views) {
  views_ = std::move(views);
  shown_.reset();
  refresh();
  emit edited();
}

nlohmann::json NamedViewsPresenter::saved() const {
  nlohmann::json list = nlohmann::json::array();
  for (const NamedView& view : views_)
    list.push_back({{"name", view.name.toStdString()}, {"view", parse_record(view.view)}});
  return list;
}

void NamedViewsPresenter::restore(const nlohmann::json& saved) {
  views_.clear();
  shown_.reset();
  if (saved.is_array())
    for (const nlohmann::json& one : saved) {
      if (views_.size() == most || !one.is_object()) break;
      const auto name = one.find("name"), view = one.find("view");
      if (name == one.end() || view == one.end() || !name->is_string() || !view->is_object())
        continue;
      const QString text =
          QString::fromStdString(name->get<std::string>()).simplified().left(longest_name);
      if (!text.isEmpty() && !find(text)) views_.push_back({text, view->dump()});
    }
  refresh();
}

void NamedViewsPresenter::set_part(bool part) {
  part_ = part;
  refresh();
}

void NamedViewsPresenter::ask_name() {
  QString proposed = shown_ ? views_[*shown_].name : QString();
  for (std::size_t k = views_.size() + 1; proposed.isEmpty() || (!shown_ && find(proposed)); ++k)
    proposed = tr("View %1").arg(k);
  bool given = false;
  const QString name = QInputDialog::getText(window_, tr("Keep this view"),
                                             tr("Name (a view of that name is replaced):"),
                                             QLineEdit::Normal, proposed, &given);
  if (given) keep(name);
}

void NamedViewsPresenter::arrange() {
  NamedViewsDialog dialog(views_, window_);
  if (dialog.exec() == QDialog::Accepted) set_views(dialog.views());
}

void NamedViewsPresenter::step(int by) {
  const auto count = static_cast<int>(views_.size());
  if (count == 0) return;
  const int from = shown_ ? static_cast<int>(*shown_) : by > 0 ? -1 : 0;
  show(static_cast<std::size_t>((from + by + count) % count));
}

void NamedViewsPresenter::refresh() {
  if (!menu_) return;
  for (QAction* old : listed_) delete old;
  listed_.clear();
  for (std::size_t k = 0; k < views_.size(); ++k) {
    QString text = views_[k].name;
    text.replace('&', "&&");
    QAction* one = action(
        menu_, text, k < with_keys ? QKeySequence(QString("Ctrl+%1").arg(k + 1)) : QKeySequence(),
        tr("Look at the part like that"));
    connect(one, &QAction::triggered, this, [this, k] { show(k); });
    set_available(one, part_, tr("Open a part first."));
    listed_.push_back(one);
  }
  const QString why = part_ ? tr("No view was kept yet.") : tr("Open a part first.");
  set_available(keep_, part_, why);
  for (QAction* one : {next_, previous_, arrange_})
    set_available(one, part_ && !views_.empty(), why);
}

}  // namespace arris::ui
