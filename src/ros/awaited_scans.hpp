#pragma once

/// @file
/// Scans that were offered to a stream, until whoever gets its answers has taken the one on them.
/// Between the end of the work and the turn of the answer lies a moment: in it, too, the answer on
/// a part may still change. Not for several threads at once.

#include <algorithm>
#include <vector>

#include "ros/predicted_scan.hpp"

namespace mems_stiction {

/// Each as often as it was offered: under other settings it is another question.
class AwaitedScans {
 public:
  void add(const ScanOfPart& scan) { scans_.push_back(scan); }

  /// Its answer was taken, or none is to come. Nothing happens if it is not awaited.
  void remove(const ScanOfPart& scan) {
    const auto found = std::find_if(scans_.begin(), scans_.end(),
                                    [&](const ScanOfPart& other) { return other.id == scan.id; });
    if (found != scans_.end()) scans_.erase(found);
  }

  /// Whether one of its part is awaited; of a scan without a part, it itself.
  bool has(const ScanOfPart& scan) const {
    return std::any_of(scans_.begin(), scans_.end(),
                       [&](const ScanOfPart& other) { return areOfOnePart(other, scan); });
  }

 private:
  std::vector<ScanOfPart> scans_;
};

}  // namespace mems_stiction
