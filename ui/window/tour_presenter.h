#pragma once

#include <optional>
#include <vector>

#include <QObject>
#include <QString>
#include <QStringList>
#include <QTimer>

#include "ui/panels/histogram_panel.h"
#include "ui/panels/tour_card.h"
#include "ui/view/mesh_view.h"
#include "ui/window/field_presenter.h"
#include "ui/window/session.h"

class QAction;
class QMainWindow;

namespace arris::ui {

class TourPresenter;

/// One step of the tour. Texts are rich text but for title and gist.
struct TourStep {
  QString title;
  QString gist;       ///< One sentence; the start page shows it, and the card begins with it.
  QString text;       ///< What else there is to know; %1: how the mouse turns the part.
  QString task;       ///< What the user is to do.
  QString result;     ///< What is there once it is done.
  QString target;     ///< What the card points at: a dock's name, "view" or "save_picture".
  QStringList clear;  ///< What the task needs: the card hides little of it. The view always is.
  bool (TourPresenter::*is_done)() const;  ///< Null: the user says so, by Finish.
};

/// The tour for those who are new: five steps on the real window and part, each done by the user's
/// own hand. It watches what is done and goes on by itself; it changes nothing of the document.
class TourPresenter : public QObject {
  Q_OBJECT
 public:
  TourPresenter(Session* session, FieldPresenter* fields, HistogramPanel* histogram, MeshView* view,
                QMainWindow* window);

  static const std::vector<TourStep>& steps();

  /// Once the next part is open: offers the tour to those whom it was never offered to.
  void offer();
  /// Starts it on the open part; without one, on the sample mould.
  void take();
  void take_on_sample();
  /// Everything stays as the user made it.
  void end();
  bool is_running() const { return state_ == State::running; }
  /// Index of the step shown, while it is running.
  std::size_t step() const { return step_; }

 signals:
  void sample_wanted();
  void field_wanted(arris::Field field);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  enum class State { off, offering, running };

  void start();
  void begin(std::size_t step);
  void go_on();
  void take_opened();
  void answer_offer();
  void refresh();
  void show_page();
  void place();
  /// Of the step shown, or what has to come before it.
  QString task() const;
  QWidget* target() const;
  bool has_looked() const;
  bool has_found() const;
  bool has_tuned() const { return tuned_; }
  bool has_corrected() const { return corrected_; }

  Session* session_;
  FieldPresenter* fields_;
  MeshView* view_;
  QMainWindow* window_;
  TourCard* card_;
  QTimer advance_;  // from done to the next step
  QTimer follow_;   // once the window has settled: the card lies anew

  State state_ = State::off;
  std::size_t step_ = 0;
  bool done_ = false;
  bool offer_wanted_ = false;     // of the next part opened
  bool start_when_open_ = false;  // the sample mould is on its way
  Field field_at_begin_ = Field::kabs;
  bool dragged_ = false;                    // a threshold was moved and is not committed yet
  bool tuned_ = false, corrected_ = false;  // in this tour, on this part
};

}  // namespace arris::ui
