#pragma once

#include <vector>

#include <QList>
#include <QString>

class QMenuBar;

namespace arris::ui {

/// A page of the manual in resources/manual, or one made from what it is about.
struct HelpPage {
  const char* name;  ///< As links say it: "glossary".
  QString title;
};

/// All pages in the order in which they are listed.
std::vector<HelpPage> help_pages();

/// A page as Markdown. Operations and fields are put in from their tables, the sheet of shortcuts
/// from the commands of the menus. Empty: there is no such page.
QString help_text(const QString& name, const QMenuBar& menus);

/// The names of a page's operations: {{extend_line}} in its file.
QStringList help_operations(const QString& name);

}  // namespace arris::ui
