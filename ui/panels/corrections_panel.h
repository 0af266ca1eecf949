#pragma once

#include <cstdint>
#include <vector>

#include <QString>
#include <QWidget>

class QCheckBox;
class QPushButton;

namespace arris::ui {

class WrappedTree;

/// A treatment made by hand, as the list shows it.
struct CorrectionRow {
  enum class State { applied, adapted, failed, off };
  std::uint32_t id = 0;
  QString text;
  State state = State::applied;
  QString state_text;
  QString message;  ///< May be empty.
};

/// Corrections in the order in which they are done again, and what became of them.
class CorrectionsPanel : public QWidget {
  Q_OBJECT
 public:
  explicit CorrectionsPanel(QWidget* parent = nullptr);

  void set_rows(std::vector<CorrectionRow> rows);  ///< Keeps the current row.
  void set_applied_again(bool applied);            ///< The check box, without a signal.
  void set_busy(bool busy);

 signals:
  void lift_wanted(std::uint32_t id);
  void show_wanted(std::uint32_t id);
  void applied_again_changed(bool applied);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void refresh_colours();
  void refresh_buttons();
  std::uint32_t current() const;  ///< Id; no_correction: none.

  WrappedTree* list_;
  QPushButton* lift_;
  QPushButton* show_;
  QCheckBox* again_;
  bool busy_ = false;
};

}  // namespace arris::ui
