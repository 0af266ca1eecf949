#pragma once

#include <optional>
#include <vector>

#include <QString>
#include <QWidget>

#include "core/sharp_lines/jump_profile.h"

class QTextBrowser;

namespace arris::ui {

class ProfileChart;

/// One test that an edge or face went through, ready to be read.
struct ExplanationRow {
  QString name, value, threshold;  ///< Value and threshold with units; a dash where there is none.
  bool passed = false;
  QString sentence;
};

/// Why one edge, or face, is or is not part of something.
struct ExplanationSection {
  QString title;     ///< "Edge 1204"
  QString headline;  ///< "On line 12, found; convex 34.2 degrees."
  bool holds = false;
  std::vector<ExplanationRow> rows;
  std::optional<JumpProfile> profile;  ///< Across the edge, where there is one to show.
};

/// Explanations, as tables of tests that passed or failed, with the profile across the edge.
class ExplanationPanel : public QWidget {
  Q_OBJECT
 public:
  explicit ExplanationPanel(QWidget* parent = nullptr);

  void set_sections(std::vector<ExplanationSection> sections);
  /// Shown instead of explanations.
  void set_note(const QString& note);
  QString text() const;  ///< All that is shown, plain.

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void refresh();

  QTextBrowser* browser_;
  ProfileChart* chart_;
  std::vector<ExplanationSection> sections_;
  QString note_;
};

}  // namespace arris::ui
