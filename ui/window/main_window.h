#pragma once

#include <functional>

#include <QMainWindow>

#include "ui/window/comparison_presenter.h"
#include "ui/window/corrections_presenter.h"
#include "ui/window/elements_presenter.h"
#include "ui/window/explanation_presenter.h"
#include "ui/window/field_presenter.h"
#include "ui/window/saved_view.h"
#include "ui/window/section_presenter.h"
#include "ui/window/session.h"
#include "ui/window/stability_presenter.h"
#include "ui/window/steps_presenter.h"
#include "ui/window/threshold_presenter.h"
#include "ui/window/tour_presenter.h"
#include "ui/window/treatments_presenter.h"
#include "ui/window/unit_presenter.h"
#include "ui/window/view_presenter.h"
#include "ui/window/worklist_presenter.h"

class QAction;
class QActionGroup;
class QDockWidget;
class QLabel;
class QMenu;
class QProgressBar;
class QPushButton;
class QStackedWidget;
class QTimer;

namespace arris::ui {

class FocusRing;

class HistoryPanel;
class SectionBar;
class LatestWork;
class NamedViewsPresenter;
class ReportPresenter;
class StartPage;

/// The workbench: the part in the centre, steps on the left, tables on the right, the histogram
/// with its thresholds below. Put together from panels (which show) and presenters (which decide).
class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  explicit MainWindow(QWidget* parent = nullptr);
  ~MainWindow() override;

  /// Opens a scan or a session; asks first where edits would be lost.
  void open(const QString& path);
  void open_sample();
  /// Offers to go on with sessions that a crash left behind. Called once after show(). True: the
  /// user goes on with one.
  bool offer_recovery();
  void set_field(Field field);
  void show_partitions(bool shown);
  /// Saves the view; errors are shown to the user where `quiet` is not set. True: written.
  bool save_picture(const QString& path, const PictureOptions& options, QString* error = nullptr);

  Session& session() { return *session_; }
  MeshView& view() { return *view_; }
  HistogramPanel& histogram() { return *histogram_; }
  FieldPresenter& fields() { return *fields_; }
  ElementsPresenter& elements() { return *elements_; }
  WorklistPresenter& worklist() { return *worklist_; }
  ExplanationPresenter& explanations() { return *explanations_; }
  TourPresenter& tour() { return *tour_; }
  ComparisonPresenter& comparison() { return *comparison_; }
  ReportPresenter& reports() { return *reports_; }
  NamedViewsPresenter& named_views() { return *named_views_; }
  bool exporting() const;  ///< Files are being written.

 protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void closeEvent(QCloseEvent* event) override;
  /// Tab goes through what is on the screen, in its order.
  bool focusNextPrevChild(bool next) override;

 private:
  void make_docks();
  /// What helps to find what is left: worklist, explanations, corrections, stability curve.
  void make_guidance();
  void make_actions();
  void make_file_menu();
  void make_edit_menu();
  void make_part_menu();
  void make_view_menu();
  void make_field_menu(QMenu* menu);
  void add_toggles(QMenu* look);
  void make_standard_views(QMenu* standard);
  void make_help_menu();
  void make_tool_bars();
  void make_status_bar();
  void choose_file();
  void choose_picture();
  /// A picture of each named view.
  void choose_pictures();
  /// The error, or nothing; the part is looked at as before then.
  QString save_pictures(const QString& folder, const QStringList& names);
  bool may_replace(const QStringList& names, const QString& folder);
  void export_results();
  /// Saves the session where it is; asks where it is to be only where it is nowhere. It goes on
  /// meanwhile. False: nobody said where.
  bool save();
  bool save_as();
  void save_to(const QString& path);
  void tell_saved(const QString& path, const Result<void>& written);
  SessionExtras extras_to_save();
  ViewKeepers view_keepers();
  /// How the part is looked at, and the named views.
  std::string views_to_keep();
  /// True where the open session may go: nothing unsaved, or the user said so.
  bool may_leave_session();
  /// Asks for a scan that a session was made on, and opens the session again with it.
  void ask_for_scan(const QString& session, const QString& scan);
  /// Shows what was opened, and how it was looked at.
  void take_opened();
  void refresh_title();
  void show_load_report();
  /// Makes the window no larger than its screen, and puts it there.
  void fit_screen();
  void reset_layout();
  void show_about();
  void remember_recent(const QString& path);
  void refresh_recent();
  void refresh_actions();
  /// Shows progress while something takes its time, and Cancel where it can be.
  void show_working();
  void refresh_history();
  void refresh_counts();
  void show_hover(const Document& document, const std::optional<Pick>& pick);
  /// The view, or both views while versions are compared.
  QImage picture(const PictureOptions& options);
  /// What can be done with what is selected, to a menu on the view or a table.
  void add_selection_actions(QMenu& menu);
  void context_menu(const QPoint& global, const std::optional<Pick>& pick);
  /// What can be done with the rows that are selected in a table.
  void table_menu(const QPoint& global);
  QDockWidget* add_dock(const QString& name, const QString& title, QWidget* content,
                        Qt::DockWidgetArea area);

  Session* session_;
  QStackedWidget* stack_;
  StartPage* start_page_;
  SideBySide* side_by_side_;
  MeshView* view_;
  ColourMapPanel* colour_map_;
  StepsPanel* steps_panel_;
  HistogramPanel* histogram_;
  HistoryPanel* history_panel_;
  ElementTable* lines_table_;
  ElementTable* partitions_table_;
  ElementTable* boundaries_table_;
  FieldPresenter* fields_;
  ElementsPresenter* elements_;
  ThresholdPresenter* thresholds_;
  ViewPresenter* view_presenter_;
  ComparisonPresenter* comparison_;
  SectionPresenter* section_;
  SectionBar* section_bar_;
  TreatmentsPresenter* treatments_;
  TreatmentBar* treatment_bar_;
  StepsPresenter* steps_;
  WorklistPresenter* worklist_;
  ExplanationPresenter* explanations_;
  CorrectionsPresenter* corrections_;
  StabilityPresenter* stability_;
  TourPresenter* tour_;
  UnitPresenter* units_;
  ReportPresenter* reports_;
  NamedViewsPresenter* named_views_;

  QMenu* recent_menu_;
  QMenu* panels_menu_;
  QAction* save_picture_;
  QAction* copy_picture_;
  QAction* export_;
  QAction* write_report_;
  QAction* save_session_;
  QAction* save_session_as_;
  QAction* undo_;
  QAction* redo_;
  QAction* run_lines_;
  QAction* run_partitions_;
  QAction* run_all_;
  QAction* run_paper_;
  QAction* flip_;
  QAction* drop_;
  QAction* report_;
  QAction* fit_;
  QAction* zoom_;
  QAction* show_field_;
  QAction* show_partitions_;
  QActionGroup* field_actions_;
  std::vector<QAction*> part_actions_;  // need an open part
  std::vector<QAction*> toggles_;       // what is visible
  /// Opens what was asked for last, once more, with scans that were pointed at.
  std::function<void(const QStringList& located)> open_again_;
  QStringList located_;

  FocusRing* focus_ring_;
  QByteArray first_layout_;
  QLabel* hover_label_;
  QLabel* counts_label_;
  QProgressBar* progress_;
  QPushButton* cancel_;
  QTimer* progress_delay_;
  LatestWork* export_work_;
  QTimer* view_rest_;  // until the view is kept for after a crash
  PictureOptions picture_options_;
};

}  // namespace arris::ui
