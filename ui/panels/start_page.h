#pragma once

#include <memory>

#include <QStringList>
#include <QWidget>

namespace arris::ui {

/// Shown while no part is open: open, the sample mould, recent files, the steps of the tour.
class StartPage : public QWidget {
  Q_OBJECT
 public:
  explicit StartPage(QWidget* parent = nullptr);
  ~StartPage() override;
  void set_recent(const QStringList& files);
  /// One more step of the tour at the end of the list.
  void add_step(const QString& title, const QString& gist);

 signals:
  void open_wanted();
  void sample_wanted();
  void tour_wanted();  ///< On the sample mould.
  void recent_wanted(const QString& file);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  class Private;
  std::unique_ptr<Private> p_;
};

}  // namespace arris::ui
