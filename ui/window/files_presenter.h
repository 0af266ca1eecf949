#pragma once

#include <functional>

#include <QImage>
#include <QList>
#include <QObject>
#include <QString>
#include <QStringList>

#include "ui/window/session.h"

class QAction;
class QMenu;

namespace arris::ui {

/// Scans and sessions as files: opening, saving, what was open before, what a crash left behind.
class FilesPresenter : public QObject {
  Q_OBJECT
 public:
  /// `extras`: what a session keeps beside its history, as it is now.
  FilesPresenter(Session* session, std::function<SessionExtras()> extras, QWidget* window);

  void add_actions(QMenu* menu);
  /// Those that need an open part.
  QList<QAction*> part_actions() const { return {save_, save_as_}; }

  /// Opens a scan or a session; asks first where edits would be lost.
  void open(const QString& path);
  void open_sample();
  void choose_file();
  /// Offers to go on with sessions that a crash left behind. True: the user goes on with one.
  bool offer_recovery();
  /// Saves the session where it is; asks where it is to be only where it is nowhere. It goes on
  /// meanwhile. False: nobody said where.
  bool save();
  bool save_as();
  /// True where the open session may go: nothing unsaved, or the user said so.
  bool may_leave();
  void refresh_recent();

 signals:
  /// Empty: what was said before no longer holds.
  void message(const QString& text, int milliseconds);
  void recent_changed(const QStringList& paths, const QList<QImage>& pictures);

 private:
  void save_to(const QString& path);
  void tell_saved(const QString& path, const Result<void>& written);
  /// Asks for a scan that a session was made on, and opens the session again with it.
  void ask_for_scan(const QString& session, const QString& scan);
  void remember_recent(const QString& path);

  Session* session_;
  std::function<SessionExtras()> extras_;
  QWidget* window_;
  QMenu* recent_menu_ = nullptr;
  QAction *save_ = nullptr, *save_as_ = nullptr;
  /// Opens what was asked for last, once more, with scans that were pointed at.
  std::function<void(const QStringList& located)> open_again_;
  QStringList located_;
};

}  // namespace arris::ui
