#include "app/window_manual.h"

#include <QCoreApplication>

#include "core/base/manual_page.h"

namespace arris {

std::string window_manual(const QCommandLineParser& parser,
                          const QList<QCommandLineOption>& options) {
  ManualPage page("arris", QCoreApplication::applicationVersion().toStdString(),
                  "workbench for the segmentation of scanned moulds");
  page.section("SYNOPSIS");
  page.example("arris [OPTIONS] [SCAN]");
  page.section("DESCRIPTION");
  page.paragraph(parser.applicationDescription().toStdString());
  page.section("OPTIONS");
  for (const QCommandLineOption& option : options) {
    if (option.flags() & QCommandLineOption::HiddenFromHelp) continue;
    QStringList names;
    for (const QString& name : option.names()) names << (name.size() == 1 ? "-" : "--") + name;
    const QString value = option.valueName().isEmpty() ? "" : " " + option.valueName();
    page.entry((names.join(", ") + value).toStdString(), option.description().toStdString());
  }
  page.section("SEE ALSO");
  page.paragraph("arris-cli(1)");
  return page.text();
}

}  // namespace arris
