#pragma once

#include <functional>
#include <stop_token>
#include <string_view>
#include <utility>

namespace arris {

/// Progress and cancellation of one piece of long work. Cheap to copy. A default-made context
/// reports to nobody and is never cancelled.
class Context {
 public:
  /// `fraction` runs from 0 to 1; `what` names the phase ("reading", "sharp lines").
  using Progress = std::function<void(double fraction, std::string_view what)>;

  Context() = default;
  explicit Context(Progress progress, std::stop_token stop = {})
      : progress_(std::move(progress)), stop_(std::move(stop)) {}

  /// True once the user asked to stop. Long loops look every few thousand elements and then return
  /// cancelled().
  bool cancelled() const { return stop_.stop_requested(); }

  void report(double fraction, std::string_view what) const {
    if (progress_) progress_(begin_ + (end_ - begin_) * fraction, what);
  }

  /// The same without reports, for parts of the work that run side by side.
  Context silent() const {
    Context result = *this;
    result.progress_ = nullptr;
    return result;
  }

  /// The share of this context from `begin` to `end` (fractions of it), for one part of the work.
  Context part(double begin, double end) const {
    Context result = *this;
    result.begin_ = begin_ + (end_ - begin_) * begin;
    result.end_ = begin_ + (end_ - begin_) * end;
    return result;
  }

 private:
  Progress progress_;
  std::stop_token stop_;
  double begin_ = 0.0;
  double end_ = 1.0;
};

}  // namespace arris
