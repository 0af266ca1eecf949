#pragma once

#include <memory>

#include <QObject>

class QSocketNotifier;

namespace arris::ui {

/// A SpaceMouse, heard through the daemon of spacenav where libspnav was there when Arris was built
/// and the daemon runs; else there is none, and nothing happens.
class SpaceMouse : public QObject {
  Q_OBJECT
 public:
  explicit SpaceMouse(QObject* parent = nullptr);
  ~SpaceMouse() override;

  bool connected() const { return notifier_ != nullptr; }
  static bool supported();  ///< Arris was built with libspnav.

 signals:
  /// The cap is held away from its rest for `seconds`: pushed right, up, towards the user, and
  /// turned about these axes. 1 is about as far as it goes.
  void moved(double right, double up, double towards, double about_right, double about_up,
             double seconds);
  void pressed(int button);

 private:
  void hear();

  std::unique_ptr<QSocketNotifier> notifier_;
};

}  // namespace arris::ui
