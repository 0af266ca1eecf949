#pragma once

#include <QDialog>
#include <QString>

class QLineEdit;
class QListWidget;
class QMainWindow;
class QTextBrowser;

namespace arris::ui {

/// The manual: its pages, one at a time, beside the window that it is about.
class HelpWindow : public QDialog {
  Q_OBJECT
 public:
  explicit HelpWindow(QMainWindow* window);

  /// Shows a page, and of it the part under a heading where there is such a one.
  void show_page(const QString& name, const QString& heading = {});
  /// The page of an operation; false: no page tells of it.
  bool show_operation(const QString& operation);
  /// The page of what a widget belongs to: a panel, a step, the view.
  void show_place(const QWidget* widget);
  const QString& page() const { return page_; }

 private:
  void go_to_heading(const QString& heading);
  void find_next();

  QMainWindow* window_;
  QListWidget* list_;
  QTextBrowser* text_;
  QLineEdit* find_;
  QString page_;
};

}  // namespace arris::ui
