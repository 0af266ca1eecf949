#include "ui/view/space_mouse.h"

#include <algorithm>

#include <QSocketNotifier>

#ifdef ARRIS_SPNAV
#include <spnav.h>
#endif

namespace arris::ui {

#ifdef ARRIS_SPNAV

namespace {

constexpr double full_push = 350.0;    // what the daemon tells of a cap held as far as it goes
constexpr double longest_gap = 100.0;  // ms; after a pause the cap begins anew

}  // namespace

bool SpaceMouse::supported() { return true; }

SpaceMouse::SpaceMouse(QObject* parent) : QObject(parent) {
  if (spnav_open() == -1) return;
  notifier_ = std::make_unique<QSocketNotifier>(spnav_fd(), QSocketNotifier::Read);
  connect(notifier_.get(), &QSocketNotifier::activated, this, &SpaceMouse::hear);
}

SpaceMouse::~SpaceMouse() {
  if (!notifier_) return;
  notifier_.reset();
  spnav_close();
}

void SpaceMouse::hear() {
  bool any = false;
  spnav_event event;
  while (spnav_poll_event(&event) != 0) {
    any = true;
    if (event.type == SPNAV_EVENT_MOTION) {
      const auto share = [](int value) { return std::clamp(value / full_push, -2.0, 2.0); };
      const auto& m = event.motion;
      emit moved(share(m.x), share(m.y), share(-m.z), share(m.rx), share(m.ry),
                 std::min<double>(m.period, longest_gap) / 1000.0);
    } else if (event.type == SPNAV_EVENT_BUTTON && event.button.press != 0) {
      emit pressed(event.button.bnum);
    }
  }
  // Something to read that is no event: the daemon is gone.
  if (!any) {
    notifier_->setEnabled(false);
    notifier_.release()->deleteLater();
    spnav_close();
  }
}

#else

bool SpaceMouse::supported() { return false; }
SpaceMouse::SpaceMouse(QObject* parent) : QObject(parent) {}
SpaceMouse::~SpaceMouse() = default;
void SpaceMouse::hear() {}

#endif

}  // namespace arris::ui
