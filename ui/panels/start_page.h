#pragma once

#include <memory>

#include <QImage>
#include <QList>
#include <QStringList>
#include <QWidget>

class QBoxLayout;

namespace arris::ui {

/// Shown while no part is open: open, the sample mould, recent files, the steps of the tour.
class StartPage : public QWidget {
  Q_OBJECT
 public:
  explicit StartPage(QWidget* parent = nullptr);
  ~StartPage() override;
  /// Sessions are told from scans by their names; `pictures`, where given, is one for each file,
  /// or a null one.
  void set_recent(const QStringList& files, const QList<QImage>& pictures = {});
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
  void make_ground();
  void make_buttons();
  QBoxLayout* make_recent();
  QBoxLayout* make_steps();

  class Private;
  std::unique_ptr<Private> p_;
};

}  // namespace arris::ui
