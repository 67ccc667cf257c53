#pragma once

/// @file
/// A line of scans and counter-surfaces in the order of arrival. When it has too many, some leave
/// it before their turn.
///
/// The oldest scans go first. A counter-surface goes once no scan stands between it and a newer
/// one: those behind it are pressed against it. The newest scan and the newest counter-surface
/// stay.

#include <algorithm>
#include <deque>
#include <utility>
#include <vector>

namespace mems_stiction {

enum class LineMember { kScan, kCounterSurface, kOther };  ///< others take nothing and never go

/// What may wait in one line.
struct LineLimits {
  std::size_t scans = 0;  ///< 0 = any number
  std::size_t bytes = 0;  ///< that scans and counter-surfaces may take together; 0 = any number
  bool does_first_stay = false;  ///< whoever is first in line never goes
};

/// Jobs in a line of limited length and memory. Not for several threads at once.
template <typename Job>
class WaitingLine {
 public:
  explicit WaitingLine(const LineLimits& limits) : limits_(limits) {}

  /// - @p bytes that the job takes
  /// @return who had to go for it, the oldest first.
  std::vector<Job> push(Job job, LineMember member, std::size_t bytes = 0) {
    line_.push_back({std::move(job), member, bytes});
    add(line_.back());
    std::vector<Job> gone;
    for (auto next = nextToGo(); next != line_.end(); next = nextToGo()) {
      remove(*next);
      gone.push_back(std::move(next->job));
      line_.erase(next);
    }
    return gone;
  }

  const Job& front() const { return line_.front().job; }
  Job pop() {
    remove(line_.front());
    Job job = std::move(line_.front().job);
    line_.pop_front();
    return job;
  }

  bool empty() const { return line_.empty(); }
  std::size_t size() const { return line_.size(); }
  std::size_t scans() const { return scans_; }
  std::size_t bytes() const { return bytes_; }

 private:
  struct Waiting {
    Job job;
    LineMember member;
    std::size_t bytes;
  };
  using Place = typename std::deque<Waiting>::iterator;

  void add(const Waiting& waiting) {
    scans_ += waiting.member == LineMember::kScan ? 1 : 0;
    bytes_ += waiting.bytes;
  }
  void remove(const Waiting& waiting) {
    scans_ -= waiting.member == LineMember::kScan ? 1 : 0;
    bytes_ -= waiting.bytes;
  }

  Place nextToGo() {
    const auto is_scan = [](const Waiting& waiting) { return waiting.member == LineMember::kScan; };
    const auto is_no_other = [](const Waiting& waiting) {
      return waiting.member != LineMember::kOther;
    };
    const bool has_too_many = limits_.scans > 0 && scans_ > limits_.scans;
    if (!has_too_many && (limits_.bytes == 0 || bytes_ <= limits_.bytes)) return line_.end();
    const Place first = line_.begin() + (limits_.does_first_stay ? 1 : 0);
    if (has_too_many) return std::find_if(first, line_.end(), is_scan);
    for (Place place = std::find_if(first, line_.end(), is_no_other); place != line_.end();) {
      const Place next = std::find_if(place + 1, line_.end(), is_no_other);
      const bool may_go = is_scan(*place)
                              ? std::any_of(next, line_.end(), is_scan)
                              : next != line_.end() && next->member == LineMember::kCounterSurface;
      if (may_go) return place;
      place = next;
    }
    return line_.end();
  }

  LineLimits limits_;
  std::deque<Waiting> line_;
  std::size_t scans_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace mems_stiction
