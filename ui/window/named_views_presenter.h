#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <QObject>
#include <QString>

#include "ui/window/saved_view.h"

class QAction;
class QMenu;

namespace arris::ui {

/// Ways of looking at the part that were given names: a session keeps them, keys lead through them,
/// and pictures and reports show the part in each.
class NamedViewsPresenter : public QObject {
  Q_OBJECT
 public:
  struct NamedView {
    QString name;
    std::string view;  ///< As saved_view() gives it.
  };

  /// `keepers`: how the part is looked at.
  NamedViewsPresenter(std::function<ViewKeepers()> keepers, QWidget* window);

  void add_actions(QMenu* menu);
  const std::vector<NamedView>& views() const { return views_; }
  /// The place of the view of this name; absent: there is none.
  std::optional<std::size_t> find(const QString& name) const;
  void show(std::size_t place);
  /// Keeps how the part is looked at now, in the place of one that has this name.
  void keep(const QString& name);
  void set_views(std::vector<NamedView> views);

  /// As a session keeps them; what a stranger's file says that cannot be is passed over.
  nlohmann::json saved() const;
  void restore(const nlohmann::json& saved);
  /// Whether there is a part to look at.
  void set_part(bool part);

 signals:
  /// Another list of views, by the user.
  void edited();
  void message(const QString& text);

 private:
  void ask_name();
  void arrange();
  void step(int by);
  void refresh();

  std::function<ViewKeepers()> keepers_;
  QWidget* window_;
  QMenu* menu_ = nullptr;
  QAction *keep_ = nullptr, *next_ = nullptr, *previous_ = nullptr, *arrange_ = nullptr;
  std::vector<QAction*> listed_;
  std::vector<NamedView> views_;
  std::optional<std::size_t> shown_;  // last
  bool part_ = false;
};

}  // namespace arris::ui
