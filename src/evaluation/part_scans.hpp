#pragma once

/// @file
/// Which scans are of one part, and what they say together (part_verdict.hpp).
///
/// Scans belong together that state the same part_id and the same serial_id and were predicted with
/// the same settings, whatever comes between them: a part that comes back goes on. Other settings
/// (another load, another device) are another pool, since their margins do not compare. A scan that
/// states neither id belongs to none.
///
///     PartScans parts(100, 1000);
///     if (const auto verdict = parts.add({part_id, serial_id, settings_hash}, stamp, statement))
///         publish(*verdict);

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "verdict/part_verdict.hpp"

namespace mems_stiction {

/// What the scans of one pool share.
struct PartKey {
  std::string part_id;
  std::string serial_id;
  std::string settings_hash;

  bool isStated() const { return !part_id.empty() || !serial_id.empty(); }
  bool operator<(const PartKey& other) const {
    return std::tie(part_id, serial_id, settings_hash) <
           std::tie(other.part_id, other.serial_id, other.settings_hash);
  }
};

/// The scans of several parts.
class PartScans {
 public:
  /// - @p most_parts more are not kept: that which has waited longest for a scan is forgotten
  /// - @p most_scans of one part: the oldest are forgotten, and the verdict says so
  PartScans(std::size_t most_parts, std::size_t most_scans)
      : most_parts_(most_parts), most_scans_(most_scans) {}

  /// - @p scan_id a scan of the same part with the same number takes the place of the one before,
  /// as when a recording is
  ///   played again; 0 = of its own
  /// @return what all scans of its part say with this one; nothing if the scan states no part.
  std::optional<PooledVerdict> add(const PartKey& key, std::uint64_t scan_id,
                                   ScanStatement statement);

  /// Another verdict on a scan that has been added; which part had a scan last stays as it is.
  /// @return what all scans of its part say now; nothing if the scan is not, or no longer, there.
  std::optional<PooledVerdict> judgeAgain(const PartKey& key, std::uint64_t scan_id,
                                          const Verdict& verdict);

  /// Of every part, in the order in which their first scans came.
  std::vector<std::pair<PartKey, PooledVerdict>> verdicts() const;

 private:
  struct Part {
    std::vector<std::uint64_t> ids;
    std::vector<ScanStatement> scans;  ///< as many; names differ
    std::size_t first = 0;             ///< when its first scan came
    std::size_t last = 0;              ///< when its last scan came
    std::size_t taken = 0;             ///< scans, with those that were forgotten
  };

  static PooledVerdict verdictOf(const Part& part);
  void forgetOldest();

  std::size_t most_parts_;
  std::size_t most_scans_;
  std::size_t clock_ = 0;
  std::map<PartKey, Part> parts_;
};

}  // namespace mems_stiction
