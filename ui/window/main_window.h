#pragma once

#include <QMainWindow>

#include "core/curvature/fields.h"
#include "ui/view/mesh_view.h"
#include "ui/window/saved_view.h"
#include "ui/window/workbench.h"

class QStackedWidget;

namespace arris::ui {

class FocusRing;
class MainMenus;

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
  /// Saves the view. True: written.
  bool save_picture(const QString& path, const PictureOptions& options, QString* error = nullptr);

  Session& session() { return *parts_.session; }
  MeshView& view() { return *parts_.view; }
  HistogramPanel& histogram() { return *parts_.histogram; }
  FieldPresenter& fields() { return *parts_.fields; }
  ElementsPresenter& elements() { return *parts_.elements; }
  WorklistPresenter& worklist() { return *parts_.worklist; }
  ExplanationPresenter& explanations() { return *parts_.explanations; }
  TourPresenter& tour() { return *parts_.tour; }
  ComparisonPresenter& comparison() { return *parts_.comparison; }
  ReportPresenter& reports() { return *parts_.reports; }
  NamedViewsPresenter& named_views() { return *parts_.named_views; }
  bool exporting() const;  ///< Files are being written.

 protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void closeEvent(QCloseEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  /// Tab goes through what is on the screen, in its order.
  bool focusNextPrevChild(bool next) override;

 private:
  void make_centre();
  /// The one table of panels, with those who fill them.
  void make_panels();
  /// Those who look after what the window reads and writes.
  void make_keepers();
  void follow();
  void follow_start_page();
  void restore_layout();
  void reset_layout();
  /// Makes the window no larger than its screen, and puts it there.
  void fit_screen();
  /// At least half of the width is the view's, as far as panels can give way.
  void give_view_room(int rounds);
  void refresh_title();
  ViewKeepers view_keepers() const;

  Workbench parts_;
  MainMenus* menus_ = nullptr;
  QStackedWidget* stack_ = nullptr;
  FocusRing* focus_ring_ = nullptr;
  QByteArray first_layout_;
};

}  // namespace arris::ui
