#pragma once

/// Scans out of a bag, one by one and by their number, without a ROS master: what the node would
/// have paired.

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "bag_scans.hpp"
#include "files/interruption.hpp"
#include "mems_stiction/height_map/raw_scan.hpp"
#include "ros/image_conversion.hpp"

namespace mems_stiction {

/// A bag that was cut off (a recorder that was killed) has lost its index: it is read from a copy
/// that `rosbag reindex` mends in a folder for temporary files, and wasCutOff() says so.
class ScanBagReader : public BagScans {
 public:
  /// @param height_topic with or without the leading slash; scan_info, counter_height and
  /// counter_scan_info are looked
  ///        for in its namespace.
  /// @throw FileError naming the bag if it cannot be opened or has no such topic.
  ScanBagReader(const std::string& path, const std::string& height_topic,
                const ScanOptions& parameters);

  std::size_t count() const override { return heights_.size(); }
  bool wasCutOff() const override { return mended_folder_ != nullptr; }

  /// A scan without a scan_info of its stamp is refused, unless the bag has no scan_info at all:
  /// then the parameters serve for every scan.
  BagScan read(std::size_t index, bool with_counter_surface) const override;

 private:
  using Messages = std::vector<rosbag::MessageInstance>;

  void openMended();
  Messages messagesOf(const std::string& topic);
  ReceivedScan pair(const rosbag::MessageInstance& image, const Messages& infos) const;

  std::string path_;
  ScanOptions parameters_;
  std::unique_ptr<PrivateFolder> mended_folder_;
  rosbag::Bag bag_;
  std::vector<std::unique_ptr<rosbag::View>> views_;  ///< that the messages below belong to
  Messages heights_, infos_, counter_heights_, counter_infos_;
};

}  // namespace mems_stiction
