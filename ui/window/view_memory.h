#pragma once

#include <functional>
#include <string>

#include <QObject>

#include "ui/window/saved_view.h"
#include "ui/window/session.h"

class QTimer;

namespace arris::ui {

class NamedViewsPresenter;

/// How the part is looked at, and its named views, in the session: kept with it, for after a crash,
/// and taken up again when it is opened.
class ViewMemory : public QObject {
  Q_OBJECT
 public:
  /// `show_partitions`: makes partitions, or the field, colour the surface.
  ViewMemory(Session* session, std::function<ViewKeepers()> keepers,
             std::function<void(bool)> show_partitions, NamedViewsPresenter* named,
             QObject* parent);

  /// What a session keeps beside its history, with a small picture for the list of recent files.
  SessionExtras extras();
  /// Follows what changes the view.
  void follow();

 private:
  std::string kept() const;
  void keep();
  /// Shows what was opened, and how it was looked at.
  void take_opened();

  Session* session_;
  std::function<ViewKeepers()> keepers_;
  std::function<void(bool)> show_partitions_;
  NamedViewsPresenter* named_;
  QTimer* rest_;  // until the view is kept for after a crash
};

}  // namespace arris::ui
