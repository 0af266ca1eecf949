#include "ui/window/worker.h"

#include <utility>

#include "core/base/vector_state.h"

namespace arris::ui {

Worker::Worker(QObject* parent) : QObject(parent), thread_([this] { work(); }) {}

Worker::~Worker() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void Worker::start(std::function<void()> work) {
  {
    const std::lock_guard lock(mutex_);
    works_.push_back(std::move(work));
  }
  wake_.notify_one();
}

void Worker::tell(std::function<void()> message) {
  {
    const std::lock_guard lock(mutex_);
    messages_.push_back(std::move(message));
  }
  QMetaObject::invokeMethod(
      this, [this] { hear(); }, Qt::QueuedConnection);
}

void Worker::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return over_ || !works_.empty(); });
    if (over_) return;
    std::function<void()> next = std::move(works_.front());
    works_.pop_front();
    lock.unlock();
    clear_vector_state();
    next();
    next = nullptr;  // what it holds goes while nobody waits
    lock.lock();
  }
}

void Worker::hear() {
  std::function<void()> message;
  {
    const std::lock_guard lock(mutex_);
    if (messages_.empty()) return;
    message = std::move(messages_.front());
    messages_.pop_front();
  }
  message();
}

}  // namespace arris::ui
