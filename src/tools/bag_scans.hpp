#pragma once

/// The scans of a bag, for programs that are built with and without ROS.

#include <cstddef>
#include <memory>
#include <string>

#include "mems_stiction/configuration/provenance.hpp"
#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/height_map/raw_scan.hpp"

namespace mems_stiction {

struct BagScan {
  HeightMap surface;
  HeightMap counter_surface;  ///< the latest one recorded before the scan, if it was asked for;
                              ///< else empty
  ScanIdentity identity;
  std::string frame_id;
  std::string stamp;  ///< seconds.nanoseconds
};

class BagScans {
 public:
  BagScans() = default;
  virtual ~BagScans() = default;
  BagScans(const BagScans&) = delete;
  BagScans& operator=(const BagScans&) = delete;

  virtual std::size_t count() const = 0;
  virtual bool wasCutOff() const = 0;
  /// @param index from 0, in the order of recording
  /// @throw std::exception with the reason if the scan cannot be used
  virtual BagScan read(std::size_t index, bool with_counter_surface) const = 0;
};

/// @param height_topic with or without the leading slash
/// @throw FileError naming the bag if it cannot be opened, has no such topic, or ROS is not there
/// to read it
std::unique_ptr<BagScans> openBag(const std::string& path, const std::string& height_topic,
                                  const ScanOptions& parameters);

}  // namespace mems_stiction
