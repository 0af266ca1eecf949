#include "ui/window/help_pages.h"

#include <functional>

#include <QAction>
#include <QFile>
#include <QMenu>
#include <QMenuBar>
#include <QRegularExpression>

#include "core/curvature/fields.h"
#include "core/document/operation.h"
#include "ui/panels/controls.h"

namespace arris::ui {

namespace {

constexpr const char* shortcuts_page = "shortcuts";

const QRegularExpression& place() {
  static const QRegularExpression pattern(R"(\{\{(\w+)\}\})");
  return pattern;
}

QString file_of(const QString& name) {
  QFile file(":/manual/" + name + ".md");
  return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

/// Text of a command without the mark of its key, for a table.
QString plain(QString text) {
  text.remove('&');
  if (text.endsWith(QChar(0x2026))) text.chop(1);
  return text.replace('|', "\\|");
}

/// "## Extend line", what it does, and what can be set.
QString operation_text(const OperationKind& kind) {
  QString text = "## " + shown_text(kind.title) + "\n\n" + shown_text(kind.help) + "\n";
  for (const Parameter& parameter : kind.parameters) {
    if (parameter.label.empty()) continue;
    text += "\n- **" + shown_text(parameter.label) + "**: " + shown_text(parameter.help);
    if (!parameter.help.ends_with('.')) text += '.';
    if (!parameter.otherwise.from().empty())
      text += QObject::tr(" By default: %1.").arg(shown_text(parameter.otherwise.from()));
    if (!parameter.method.empty())
      for (const ParameterChoice& method : kind.find("method")->choices)
        if (method.key == parameter.method)
          text += QObject::tr(" With the method “%1”.").arg(shown_text(method.label));
  }
  return text + "\n";
}

QString fields_text() {
  QString text;
  for (const FieldInfo& info : field_table()) {
    text += "- **" + shown_text(info.name) + "**";
    if (!info.own_unit.empty()) text += " (" + shown_text(info.own_unit) + ")";
    text += ": " + shown_text(info.meaning) + ". Alt+" + QLatin1Char(info.key) + "\n";
  }
  return text;
}

QString shortcuts_text(const QMenuBar& menus) {
  QString text = "# " + QObject::tr("Shortcuts") + "\n\n";
  const std::function<void(const QMenu*)> list = [&](const QMenu* menu) {
    for (const QAction* action : menu->actions()) {
      if (action->menu())
        list(action->menu());
      else if (!action->shortcut().isEmpty())
        text += "| " + action->shortcut().toString(QKeySequence::NativeText).replace('|', "\\|") +
                " | " + plain(action->iconText()) + " | " + plain(action->statusTip()) + " |\n";
    }
  };
  for (const QAction* action : menus.actions()) {
    if (!action->menu()) continue;
    text += "## " + plain(action->text()) + "\n\n| " + QObject::tr("Keys") + " | " +
            QObject::tr("Command") + " | " + QObject::tr("What it does") + " |\n|:--|:--|:--|\n";
    list(action->menu());
    text += "\n";
  }
  return text;
}

}  // namespace

std::vector<HelpPage> help_pages() {
  return {{"overview", QObject::tr("From a scan to CAD")},
          {"view", QObject::tr("The view")},
          {"steps", QObject::tr("Steps")},
          {"histogram", QObject::tr("Histogram and thresholds")},
          {"lines", QObject::tr("Tools for lines")},
          {"partitions", QObject::tr("Tools for partitions")},
          {"worklist", QObject::tr("Worklist")},
          {"explanation", QObject::tr("Explain")},
          {"corrections", QObject::tr("Corrections")},
          {"history", QObject::tr("History and versions")},
          {"colour_map", QObject::tr("Fields and colours")},
          {"tables", QObject::tr("Tables")},
          {"results", QObject::tr("Pictures, reports and files")},
          {shortcuts_page, QObject::tr("Shortcuts")},
          {"glossary", QObject::tr("Glossary")}};
}

QString help_text(const QString& name, const QMenuBar& menus) {
  if (name == shortcuts_page) return shortcuts_text(menus);
  QString text = file_of(name);
  for (auto found = place().match(text); found.hasMatch(); found = place().match(text)) {
    const QString what = found.captured(1);
    const OperationKind* kind = find_operation(what.toStdString());
    text.replace(found.capturedStart(), found.capturedLength(),
                 what == "fields" ? fields_text()
                 : kind           ? operation_text(*kind)
                                  : QString());
  }
  return text;
}

QStringList help_operations(const QString& name) {
  QStringList names;
  const QString text = file_of(name);
  for (auto found = place().globalMatch(text); found.hasNext();) {
    const QString what = found.next().captured(1);
    if (what != "fields") names << what;
  }
  return names;
}

}  // namespace arris::ui
