#include "scan_bag_reader.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "mems_stiction/base/child_process.hpp"
#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/ros/topic_names.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;

/// Of the messages recorded nearest to a scan, so many are looked at for one of its stamp.
constexpr std::ptrdiff_t kNearest = 32;
/// For `rosbag reindex` [s].
constexpr double kMendingTimeout = 3600.0;

std::string withoutSlash(const std::string& topic) { return topic.rfind('/', 0) == 0 ? topic.substr(1) : topic; }

/// The topic called `name` in the namespace of `topic`.
std::string sibling(const std::string& topic, const char* name) {
  const std::size_t slash = topic.find_last_of('/');
  return slash == std::string::npos ? name : topic.substr(0, slash + 1) + name;
}

/// @throw SurfaceError if the message is of another type
template <typename Message>
boost::shared_ptr<const Message> instantiate(const rosbag::MessageInstance& message) {
  boost::shared_ptr<const Message> content = message.instantiate<Message>();
  if (!content) {
    throw SurfaceError("topic '" + message.getTopic() + "' carries " + message.getDataType() + ", must be " +
                       ros::message_traits::DataType<Message>::value());
  }
  return content;
}

}  // namespace

ScanBagReader::ScanBagReader(const std::string& path, const std::string& height_topic, const ScanOptions& parameters)
    : path_(path), parameters_(parameters) {
  if (!fs::exists(path)) throw FileError(path + ": no such file");
  try {
    bag_.open(path, rosbag::bagmode::Read);
  } catch (const rosbag::BagUnindexedException&) {
    openMended();
  } catch (const rosbag::BagIOException&) {  // the index should stand behind the file's end
    openMended();
  } catch (const std::exception& error) {
    throw FileError(path + ": not a bag that can be read: " + error.what());
  }
  heights_ = messagesOf(height_topic);
  if (heights_.empty()) {
    rosbag::View everything(bag_);
    std::set<std::string> topics;
    for (const rosbag::ConnectionInfo* connection : everything.getConnections()) topics.insert(connection->topic);
    std::string names;
    for (const std::string& topic : topics) names += (names.empty() ? "" : ", ") + topic;
    throw FileError(path + ": no message on topic '" + height_topic + "'; the bag has " +
                    (names.empty() ? "no messages" : names) + (wasCutOff() ? " (it was cut off)" : ""));
  }
  infos_ = messagesOf(sibling(height_topic, kScanInfoTopic));
  counter_heights_ = messagesOf(sibling(height_topic, kCounterHeightTopic));
  counter_infos_ = messagesOf(sibling(height_topic, kCounterScanInfoTopic));
}

void ScanBagReader::openMended() {
  bag_.close();
  mended_folder_ = std::make_unique<PrivateFolder>();
  const std::string folder = mended_folder_->path().string();
  const std::string cut = path_ + ": the bag was cut off; ";
  const ChildResult result = runChild({"rosbag", "reindex", "--quiet", "--output-dir=" + folder, path_},
                                      environmentWithout({}, {}), folder + "/log", kMendingTimeout);
  if (!result.started) throw FileError(cut + "the program rosbag, which mends it, was not found");
  const fs::path mended = fs::path(folder) / fs::path(path_).filename();
  if (!fs::exists(mended)) throw FileError(cut + "rosbag reindex could not mend it");
  try {
    bag_.open(mended.string(), rosbag::bagmode::Read);
  } catch (const std::exception& error) {
    throw FileError(cut + "nothing before the cut can be read: " + error.what());
  }
}

ScanBagReader::Messages ScanBagReader::messagesOf(const std::string& topic) {
  const std::string name = withoutSlash(topic);
  views_.push_back(std::make_unique<rosbag::View>(bag_, rosbag::TopicQuery({name, "/" + name})));
  Messages messages;
  for (const rosbag::MessageInstance& message : *views_.back()) messages.push_back(message);
  return messages;
}

ReceivedScan ScanBagReader::pair(const rosbag::MessageInstance& message, const Messages& infos) const {
  const auto image = instantiate<sensor_msgs::Image>(message);
  if (infos.empty()) return receiveScan(image, parameters_);

  // Partners are recorded one after the other: look outwards from the time of the image.
  const auto after = std::lower_bound(
      infos.begin(), infos.end(), message.getTime(),
      [](const rosbag::MessageInstance& info, const ros::Time& time) { return info.getTime() < time; });
  const std::ptrdiff_t middle = after - infos.begin();
  const auto size = static_cast<std::ptrdiff_t>(infos.size());
  for (std::ptrdiff_t distance = 0; distance < kNearest; ++distance) {
    for (const std::ptrdiff_t place : {middle + distance, middle - distance - 1}) {
      if (place < 0 || place >= size) continue;
      const auto info = instantiate<ScanInfo>(infos[static_cast<std::size_t>(place)]);
      if (info->header.stamp == image->header.stamp) return receiveScan(image, scanOptions(*info, parameters_));
    }
  }
  throw SurfaceError("the bag has no scan_info with the stamp of the scan");
}

BagScan ScanBagReader::read(std::size_t index, bool with_counter_surface) const {
  const rosbag::MessageInstance& message = heights_.at(index);
  BagScan result{pair(message, infos_), std::nullopt};
  if (!with_counter_surface) return result;
  const auto after = std::upper_bound(
      counter_heights_.begin(), counter_heights_.end(), message.getTime(),
      [](const ros::Time& time, const rosbag::MessageInstance& counter) { return time < counter.getTime(); });
  if (after == counter_heights_.begin()) {
    throw SurfaceError("no counter-surface was recorded before the scan (counter_surface/type is topic)");
  }
  result.counter_surface = pair(*(after - 1), counter_infos_);
  return result;
}

}  // namespace mems_stiction
