#pragma once

/// @file
/// Which surfaces have been scanned of one part? Several parts at once, in bounded memory.
///
/// Scans belong together that state the same part_id and the same serial_id, whatever they were
/// predicted with: a load does not change what was scanned. A scan that states neither is a part of
/// its own, and the next such scan takes its place. Where a part has more scans than are kept, the
/// oldest of those with the commonest grid goes: one coarse wide scan among many fine ones stays.
///
///     PartSurfaces parts({16, 1000000000});
///     parts.add({part_id, serial_id}, stamp, statement, prepared);
///     const DeviceForce force = parts.of({part_id, serial_id})->together(configuration).force();

#include <cstddef>
#include <cstdint>
#include <list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "evaluation/device_scans.hpp"
#include "mems_stiction/evaluation/prepared_scan.hpp"
#include "verdict/part_verdict.hpp"

namespace mems_stiction {

/// part_id and serial_id.
using PartName = std::pair<std::string, std::string>;

/// How much may stay.
struct SurfaceLimits {
  std::size_t scans = 0;  ///< of each part, > 0
  std::size_t bytes = 0;  ///< of all parts together; the newest scan stays whatever it takes
};

/// One of them. Copies share their pixels.
struct ScannedSurface {
  std::uint64_t id = 0;      ///< of the scan; 0 = it has none
  std::uint64_t number = 0;  ///< no two surfaces have the same
  ScanStatement
      statement;      ///< what it says by itself, newest; no two scans of a part have the same name
  PreparedScan scan;  ///< its surfaces alone, which can be predicted again
};

/// What is kept of one part.
struct ScannedPart {
  std::vector<ScannedSurface> scans;  ///< in the order in which they came
  std::size_t taken = 0;              ///< with those that were forgotten

  /// What the device's force is found from.
  DeviceScans together(const Configuration& configuration) const;
  /// Tells the surfaces from every others: what is made of the same numbers is the same.
  std::vector<std::uint64_t> numbers() const;
  /// As pooledVerdictOf() takes them.
  std::vector<ScanStatement> statements() const;
};

/// Not for several threads at once.
class PartSurfaces {
 public:
  explicit PartSurfaces(const SurfaceLimits& most) : most_(most) {}

  /// - @p scan_id a scan of the same part with the same number takes the place of the one before;
  /// one
  ///   without a number (0) is known by its pixels
  /// - @p statement what the scan says by itself, with its name
  /// @return parts that had to go for it
  std::vector<PartName> add(const PartName& part, std::uint64_t scan_id, ScanStatement statement,
                            const PreparedScan& scan);

  /// Nothing if the part is not there.
  std::optional<ScannedPart> of(const PartName& part) const;

  std::size_t scans() const;
  std::size_t bytes() const { return bytes_; }

 private:
  struct Entry {
    PartName name;
    ScannedPart part;
  };

  void drop(ScannedPart& part, std::vector<ScannedSurface>::iterator scan);

  SurfaceLimits most_;
  std::list<Entry> parts_;  ///< that which had a scan last at the end
  std::size_t bytes_ = 0;
  std::uint64_t numbers_ = 0;
};

}  // namespace mems_stiction
