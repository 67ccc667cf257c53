#include "settings/time_limit.hpp"

#include <utility>

#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {
namespace {

thread_local TimeLimit* innermost = nullptr;
thread_local BesideWork* beside = nullptr;

/// Longer ones would leave the clock's range [s].
constexpr double kLongest = 1e9;

}  // namespace

TimeLimit::TimeLimit(double seconds, const char* setting, double spent)
    : outer_(innermost), end_(Clock::time_point::max()), seconds_(seconds), setting_(setting) {
  if (seconds < kLongest) {
    end_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                              std::chrono::duration<double>(seconds - spent));
  }
  if (outer_ != nullptr && outer_->end_ < end_) {
    end_ = outer_->end_;
    seconds_ = outer_->seconds_;
    setting_ = outer_->setting_;
  }
  innermost = this;
}

TimeLimit::~TimeLimit() { innermost = outer_; }

void TimeLimit::check() {
  if (beside != nullptr) beside->work_();
  if (innermost == nullptr || Clock::now() < innermost->end_) return;
  throw TimeLimitError("the scan was given up after " + numberText(innermost->seconds_) + " s (" +
                       innermost->setting_ +
                       "): a smaller region, a coarser grid or less noise take less time");
}

BesideWork::BesideWork(std::function<void()> work) : outer_(beside), work_(std::move(work)) {
  beside = this;
}

BesideWork::~BesideWork() { beside = outer_; }

}  // namespace mems_stiction
