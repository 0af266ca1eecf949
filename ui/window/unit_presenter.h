#pragma once

#include <set>
#include <string>

#include <QObject>

#include "ui/window/session.h"

class QActionGroup;
class QMenu;

namespace arris::ui {

class UnitBar;

/// What the lengths of the part are told in: asked for once where neither its file nor the user has
/// said so, and said in the menu at any time. It is an operation of the document as any other, so
/// that undo, journals and sessions have it.
class UnitPresenter : public QObject {
  Q_OBJECT
 public:
  UnitPresenter(Session* session, UnitBar* bar, QObject* parent);

  /// The units, of which the part's is checked.
  void add_actions(QMenu* menu);

 private:
  /// Which unit is ticked, and whether another can be.
  void update_actions();
  void refresh();
  void tell(LengthUnit unit);
  /// The scan of the part, by what is in its file.
  QString scan() const;
  /// Whether the user said of this scan that its unit is not known: never asked again.
  bool is_dismissed() const;

  Session* session_;
  UnitBar* bar_;
  QActionGroup* units_ = nullptr;
  QString answered_;  // the scan of which it was said here: undoing that asks nothing
  QString asked_;     // the scan that the bar asks about
};

}  // namespace arris::ui
