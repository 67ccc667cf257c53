#include "bag_scans.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {

std::unique_ptr<BagScans> openBag(const std::string& path, const std::string& /*height_topic*/,
                                  const ScanOptions& /*parameters*/) {
  throw FileError(path + ": this stiction_batch was built without ROS and reads no bags");
}

}  // namespace mems_stiction
