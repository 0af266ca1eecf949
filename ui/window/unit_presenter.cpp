#include "ui/window/unit_presenter.h"

#include <algorithm>

#include <QActionGroup>
#include <QMenu>
#include <QSettings>

#include "ui/panels/controls.h"
#include "ui/panels/unit_bar.h"
#include "ui/window/actions.h"

namespace arris::ui {

namespace {

constexpr const char* dismissed_key = "unit/dismissed";
constexpr int most_dismissed = 200;  // scans that are remembered, the last ones

QString name_of(LengthUnit unit) {
  const std::string_view name = info_of(unit).name;
  QString text = shown_text(name);
  text[0] = text[0].toUpper();
  return text;
}

/// "millimetres", "inches or centimetres", "metres, inches or centimetres".
QString alternatives(const std::vector<LengthUnit>& units) {
  QString text;
  for (std::size_t k = 0; k < units.size(); ++k)
    text += (k == 0                 ? QString()
             : k + 1 < units.size() ? QStringLiteral(", ")
                                    : UnitPresenter::tr(" or ")) +
            name_of(units[k]).toLower();
  return text;
}

}  // namespace

UnitPresenter::UnitPresenter(Session* session, UnitBar* bar, QObject* parent)
    : QObject(parent), session_(session), bar_(bar) {
  connect(bar_, &UnitBar::answered, this, [this](const QString& name) {
    if (const auto unit = find_length_unit(name.toStdString())) tell(*unit);
  });
  connect(bar_, &UnitBar::dismissed, this, [this] {
    QSettings settings;
    QStringList scans = settings.value(dismissed_key).toStringList();
    scans.removeAll(scan());
    scans.prepend(scan());
    settings.setValue(dismissed_key, scans.mid(0, most_dismissed));
    refresh();
  });
  connect(session_, &Session::opened, this, [this] {
    answered_.clear();
    refresh();
  });
  connect(session_, &Session::changed, this, [this] {
    if (!session_->is_previewing()) refresh();
  });
  connect(session_, &Session::busy_changed, this, [this](bool busy) {
    bar_->set_answerable(!busy);
    update_actions();
  });
}

void UnitPresenter::add_actions(QMenu* menu) {
  units_ = new QActionGroup(this);
  for (const LengthUnitInfo& info : length_unit_table()) {
    const bool known = info.unit != LengthUnit::unknown;
    QAction* a = action(menu, known ? name_of(info.unit) : tr("Not known"), {},
                        known ? tr("Lengths of the scan are %1; nothing is computed from that")
                                    .arg(name_of(info.unit).toLower())
                              : tr("Lengths are told without a unit"));
    a->setCheckable(true);
    a->setData(static_cast<int>(info.unit));
    units_->addAction(a);
    connect(a, &QAction::triggered, this, [this, unit = info.unit] { tell(unit); });
  }
  refresh();
}

QString UnitPresenter::scan() const {
  const Document& document = session_->current().document;
  return document.empty() ? QString() : QString::fromStdString(document.scan->report.content_hash);
}

bool UnitPresenter::is_dismissed() const {
  return QSettings().value(dismissed_key).toStringList().contains(scan());
}

void UnitPresenter::tell(LengthUnit unit) {
  if (session_->busy() || session_->current().document.empty()) return;
  if (unit == length_unit_of(session_->current().document)) return refresh();
  answered_ = scan();
  const std::string_view key = info_of(unit).key;
  session_->run({Operation{"set_unit", {{"unit", key}}}});
}

void UnitPresenter::update_actions() {
  if (!units_) return;
  const Document& document = session_->current().document;
  const LengthUnit unit = length_unit_of(document);
  const bool part = !document.empty();
  for (QAction* a : units_->actions()) {
    a->setChecked(part && a->data().toInt() == static_cast<int>(unit));
    set_available(a, part && !session_->busy(),
                  part ? tr("Wait until the work that runs is done.") : tr("Open a part first."));
  }
}

void UnitPresenter::refresh() {
  update_actions();
  const Document& document = session_->current().document;
  const LengthUnit unit = length_unit_of(document);
  const bool ask = !document.empty() && unit == LengthUnit::unknown && !document.unit &&
                   answered_ != scan() && !is_dismissed();
  if (!ask) {
    asked_.clear();
    bar_->hide();
    return;
  }
  if (asked_ == scan()) return;
  asked_ = scan();
  const Mesh& mesh = *document.scan->mesh;
  const Point size = mesh.box_max() - mesh.box_min();
  const std::vector<LengthUnit> likely = likely_units(size);
  QStringList names, others;
  for (const LengthUnit one : likely) names << name_of(one);
  for (const LengthUnitInfo& info : length_unit_table())
    if (info.unit != LengthUnit::unknown && !std::ranges::count(likely, info.unit))
      others << name_of(info.unit);
  bar_->ask(tr("In %2: %1?").arg(QString::fromStdString(size_in_words(size)), alternatives(likely)),
            names, others);
}

}  // namespace arris::ui
