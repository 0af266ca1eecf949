#pragma once

#include <vector>

#include <QDialog>

#include "ui/window/named_views_presenter.h"

class QListWidget;
class QPushButton;

namespace arris::ui {

/// Renames, deletes and reorders named views.
class NamedViewsDialog : public QDialog {
  Q_OBJECT
 public:
  NamedViewsDialog(const std::vector<NamedViewsPresenter::NamedView>& views, QWidget* parent);

  /// As arranged; a name that is empty or stands twice is as it was.
  std::vector<NamedViewsPresenter::NamedView> views() const;

 private:
  void move(int by);

  std::vector<NamedViewsPresenter::NamedView> given_;
  QListWidget* list_;
  QPushButton *up_, *down_, *remove_;
};

}  // namespace arris::ui
