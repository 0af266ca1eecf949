#pragma once

#include <functional>

#include <QImage>
#include <QList>
#include <QObject>
#include <QString>
#include <QStringList>

#include "ui/view/mesh_view.h"
#include "ui/window/saved_view.h"
#include "ui/window/session.h"

class QAction;
class QMenu;

namespace arris::ui {

class ComparisonPresenter;
class NamedViewsPresenter;

/// Pictures of the part: of what is shown, or of each named view.
class PicturesPresenter : public QObject {
  Q_OBJECT
 public:
  /// `shown`: the widget whose size a picture has at first.
  PicturesPresenter(Session* session, std::function<ViewKeepers()> keepers,
                    ComparisonPresenter* comparison, NamedViewsPresenter* views, QWidget* shown,
                    QWidget* window);

  void add_actions(QMenu* menu);
  /// Saves and copies; they need an open part.
  QList<QAction*> actions() const { return {save_, copy_}; }
  QAction* save_action() const { return save_; }
  /// Saves the view, or both views while versions are compared. False: not written, and why.
  bool save(const QString& path, const PictureOptions& options, QString* error = nullptr);

 signals:
  void message(const QString& text, int milliseconds);

 private:
  void choose();
  /// A picture of each named view.
  void choose_each();
  /// The error, or nothing; the part is looked at as before then.
  QString save_each(const QString& folder, const QStringList& names);
  QImage picture(const PictureOptions& options);

  Session* session_;
  std::function<ViewKeepers()> keepers_;
  ComparisonPresenter* comparison_;
  NamedViewsPresenter* views_;
  QWidget* shown_;
  QWidget* window_;
  QAction *save_ = nullptr, *copy_ = nullptr;
  PictureOptions options_;
};

}  // namespace arris::ui
