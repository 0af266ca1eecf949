#pragma once

#include <optional>
#include <vector>

#include <QObject>

#include "core/curvature/fields.h"
#include "ui/view/mesh_view.h"
#include "ui/window/workbench.h"

class QAction;
class QActionGroup;
class QMainWindow;
class QMenu;

namespace arris::ui {

class HelpWindow;

/// The menus and tool bars of the window, and when each of their commands is to be had. Commands of
/// a presenter are its own; here they get their places, and those that belong to nobody.
class MainMenus : public QObject {
  Q_OBJECT
 public:
  /// `parts` stays where it is; those made after this are there once a menu is opened.
  MainMenus(const Workbench& parts, QMainWindow* window);

  void set_field(Field field);
  /// Partitions colour the surface, else the field.
  void show_partitions(bool shown);
  QAction* partitions_action() const { return show_partitions_; }
  /// What is visible, each known by its object name.
  const std::vector<QAction*>& toggles() const { return toggles_; }

 signals:
  void layout_reset_wanted();
  /// The start page, or the part.
  void start_page_wanted(bool shown);

 private:
  QMenu* add_menu(const QString& title);
  void make_file_menu();
  void make_edit_menu();
  void make_part_menu();
  void make_view_menu();
  void make_field_menu(QMenu* menu);
  void add_toggles(QMenu* look);
  void make_standard_views(QMenu* standard);
  void make_navigation(QMenu* menu);
  void make_help_menu();
  HelpWindow* open_help();
  void show_help();
  void make_tool_bar();
  void follow();
  void refresh();
  /// What can be done with what is selected, to a menu on the view or a table.
  void add_selection_actions(QMenu& menu);
  void context_menu(const QPoint& global, const std::optional<Pick>& pick);
  /// What can be done with the rows that are selected in a table.
  void table_menu(const QPoint& global);

  const Workbench& parts_;
  QMainWindow* window_;
  HelpWindow* help_ = nullptr;  // once it was asked for
  QAction* export_ = nullptr;
  QAction* write_report_ = nullptr;
  QAction* run_lines_ = nullptr;
  QAction* run_partitions_ = nullptr;
  QAction* run_all_ = nullptr;
  QAction* run_paper_ = nullptr;
  QAction* flip_ = nullptr;
  QAction* drop_ = nullptr;
  QAction* load_report_ = nullptr;
  QAction* fit_ = nullptr;
  QAction* zoom_ = nullptr;
  QAction* show_field_ = nullptr;
  QAction* show_partitions_ = nullptr;
  QActionGroup* field_actions_ = nullptr;
  std::vector<QAction*> part_actions_;  // need an open part
  std::vector<QAction*> toggles_;
};

}  // namespace arris::ui
