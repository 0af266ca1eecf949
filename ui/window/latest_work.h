#pragma once

#include <cstdint>
#include <memory>
#include <stop_token>
#include <utility>

#include <QCoreApplication>
#include <QEventLoop>
#include <QObject>
#include <QThreadPool>

#include "core/base/context.h"
#include "core/base/vector_state.h"

namespace arris::ui {

/// Work beside the UI thread of which only the latest counts: starting anew, or cancelling, asks
/// what runs to stop and throws its result away. All calls are on the UI thread.
class LatestWork : public QObject {
 public:
  explicit LatestWork(QObject* parent) : QObject(parent) { pool_.setMaxThreadCount(1); }
  ~LatestWork() override {
    cancel();
    pool_.waitForDone();
  }

  /// `work`(Context) runs on a thread of its own; `take` gets its result on the UI thread.
  /// `report` hears of its progress, on the work's thread.
  template <class Work, class Take>
  void start(Work work, Take take, Context::Progress report = nullptr) {
    cancel();
    stop_ = std::stop_source();
    running_ = true;
    pool_.start([this, work = std::move(work), take = std::move(take), report = std::move(report),
                 stop = stop_.get_token(), round = round_] {
      if (stop.stop_requested()) return;
      clear_vector_state();
      const auto result = std::make_shared<decltype(work(Context()))>(work(Context(report, stop)));
      QMetaObject::invokeMethod(this, [this, result, take, round] {
        if (round != round_) return;
        running_ = false;
        take(std::move(*result));
      });
    });
  }

  void cancel() {
    stop_.request_stop();
    ++round_;
    running_ = false;
  }
  bool running() const { return running_; }
  /// Returns once nothing runs. The window is drawn meanwhile, and takes no input but that of a
  /// question that a result leads to.
  void wait() const {
    while (running())
      QCoreApplication::processEvents(QEventLoop::ExcludeUserInputEvents |
                                      QEventLoop::WaitForMoreEvents);
  }

 private:
  QThreadPool pool_;
  std::stop_source stop_;
  std::uint64_t round_ = 0;  // results of earlier rounds are stale
  bool running_ = false;
};

}  // namespace arris::ui
