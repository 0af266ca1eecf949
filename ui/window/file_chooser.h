#pragma once

#include <QFileInfo>
#include <QString>
#include <QStringList>

class QWidget;

namespace arris::ui {

/// Asks where to save; empty: nowhere. The folder that is taken is remembered for files of this
/// kind.
QString choose_path(QWidget* parent, const QString& title, const QFileInfo& proposed,
                    const QString& kind, const QString& filter);

/// Asks whether files that are in a folder from before may be replaced.
bool may_replace(QWidget* parent, const QStringList& names, const QString& folder);

/// A name without what file systems refuse.
QString as_file_name(QString name);

}  // namespace arris::ui
