#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

#include <QObject>

namespace arris::ui {

/// A thread that does one thing after the other, and the way back from it to the UI thread. Things
/// are handed over under mutexes of the standard library, not in Qt's events, so that the thread
/// sanitizer can follow them (Debian's Qt is not instrumented).
class Worker : public QObject {
 public:
  explicit Worker(QObject* parent = nullptr);
  /// Waits for the work in hand; what was not begun is dropped, and so is what was not told yet.
  ~Worker() override;

  /// UI thread: `work` runs on the worker thread, after all that was asked for before.
  void start(std::function<void()> work);
  /// Worker thread (or any that the work made): `message` runs on the UI thread, in order.
  void tell(std::function<void()> message);

 private:
  void work();
  void hear();

  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::function<void()>> works_, messages_;
  bool over_ = false;
  std::thread thread_;
};

}  // namespace arris::ui
