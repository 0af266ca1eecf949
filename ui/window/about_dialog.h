#pragma once

#include <QDialog>

class QPushButton;

namespace arris::ui {

class Session;

/// What Arris is, what it is made of and runs on, and where its log lies; with a report of that to
/// be copied into a message, in which no path and no name of a file stands.
class AboutDialog : public QDialog {
  Q_OBJECT
 public:
  AboutDialog(const Session& session, QWidget* parent);

  /// As copied.
  static QString report(const Session& session);
};

/// "Arris 0.1", "Qt 6.4.2", ...: what this program is made of, one a line.
QStringList made_of();

}  // namespace arris::ui
