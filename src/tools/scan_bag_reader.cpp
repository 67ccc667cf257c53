#include "scan_bag_reader.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <set>
#include <vector>

#include <ros/serialization.h>
#include <boost/make_shared.hpp>

#include "bag_check.hpp"
#include "errors/plain_format.hpp"
#include "files/child_process.hpp"
#include "files/input_file.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"
#include "ros/bounded_stream.hpp"
#include "ros/scan_pairer.hpp"
#include "ros/topic_names.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;

/// Of the messages recorded nearest to a scan, so many are looked at for one of its stamp.
constexpr std::ptrdiff_t kNearest = 32;
/// For `rosbag reindex` [s].
constexpr double kMendingTimeout = 3600.0;

constexpr InputKind kBag = {"a bag", std::numeric_limits<std::uint64_t>::max()};

std::string withoutSlash(const std::string& topic) {
  return startsWith(topic, "/") ? topic.substr(1) : topic;
}

/// All that a scan_info says but its number, as bytes.
std::vector<std::uint8_t> contentOf(ScanInfo info) {
  info.header.seq = 0;
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(info));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, info);
  return bytes;
}

/// The topic called `name` in the namespace of `topic`.
std::string sibling(const std::string& topic, const char* name) {
  const std::size_t slash = topic.find_last_of('/');
  return slash == std::string::npos ? name : topic.substr(0, slash + 1) + name;
}

/// Calls `read` with the message's bytes. @throw SurfaceError if they are damaged
template <typename Function>
void readBytes(const rosbag::MessageInstance& message, const Function& read) {
  const auto shorter = [&] {
    return SurfaceError("the bag is damaged: a message of '" + message.getTopic() +
                        "' is shorter than it states");
  };
  try {
    std::vector<std::uint8_t> bytes(message.size());
    ros::serialization::OStream written(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    message.write(written);
    read(ros::serialization::IStream(bytes.data(), static_cast<std::uint32_t>(bytes.size())));
  } catch (const rosbag::BagException& error) {
    throw SurfaceError("the bag is damaged: a message of '" + message.getTopic() +
                       "' cannot be read: " + error.what());
  } catch (const MessageError&) {
    throw shorter();
  } catch (const ros::Exception&) {  // of roscpp's deserialization
    throw shorter();
  }
}

/// @throw SurfaceError if the message is of another type, or damaged
template <typename Message>
boost::shared_ptr<const Message> instantiate(const rosbag::MessageInstance& message) {
  if (!message.isType<Message>()) {
    const std::string type = ros::message_traits::DataType<Message>::value();
    if (message.getDataType() == type) {
      throw SurfaceError("topic '" + message.getTopic() + "' carries " + type +
                         " of another definition (md5 sum " + message.getMD5Sum() + ", must be " +
                         ros::message_traits::MD5Sum<Message>::value() + ")");
    }
    throw SurfaceError("topic '" + message.getTopic() + "' carries " + message.getDataType() +
                       ", must be " + type);
  }
  const auto content = boost::make_shared<Message>();
  readBytes(message, [&](ros::serialization::IStream stream) {
    readMessage(stream.getData(), stream.getLength(), *content);
  });
  return content;
}

/// MD5 sum of ScanInfo before it named scan and part.
constexpr const char* kUnnamedScanInfo = "e2c5059195594fd4b9cdb74aaee36cf7";
/// The same before it named lot and wafer, and who measured.
constexpr const char* kNamedScanInfo = "c6e33f09a2cac5e2c805eeac41e5c8ab";

/// - @p has_names of scan and part
void readFormer(ros::serialization::IStream stream, bool has_names, ScanInfo* info) {
  stream.next(info->header);
  stream.next(info->pitch_x);
  stream.next(info->pitch_y);
  stream.next(info->height_scale);
  stream.next(info->height_offset);
  stream.next(info->invalid_value);
  stream.next(info->has_invalid_value);
  if (!has_names) return;
  stream.next(info->scan_name);
  stream.next(info->part_id);
  stream.next(info->serial_id);
}

/// scan_info of today, or of bags that were recorded before: what is of today only stands behind
/// the rest.
boost::shared_ptr<const ScanInfo> instantiateInfo(const rosbag::MessageInstance& message) {
  const bool has_names = message.getMD5Sum() == kNamedScanInfo;
  if (!has_names && message.getMD5Sum() != kUnnamedScanInfo) return instantiate<ScanInfo>(message);
  const auto info = boost::make_shared<ScanInfo>();
  readBytes(message, [&](const ros::serialization::IStream& stream) {
    readFormer(stream, has_names, info.get());
  });
  return info;
}

/// @throw FileError for a file that does not begin as a bag does
void requireMagic(const std::string& path) {
  const std::string magic = "#ROSBAG V";
  const std::string begin = readInputStart(path, kBag, magic.size());
  if (begin.empty()) throw FileError(path + ": is empty");
  if (begin != magic) throw FileError(path + ": is not a bag, whatever its name says");
}

}  // namespace

ScanBagReader::ScanBagReader(const std::string& path, const std::string& height_topic,
                             const ScanOptions& parameters)
    : path_(path), parameters_(parameters) {
  if (!fs::exists(path)) throw FileError(path + ": no such file");
  requireMagic(path);
  if (checkBag(path) == BagEnd::kCutOff) {
    openMended();
  } else {
    try {
      bag_.open(path, rosbag::bagmode::Read);
    } catch (const std::exception& error) {
      throw FileError(path + ": not a bag that can be read: " + error.what());
    }
  }
  heights_ = messagesOf(height_topic);
  if (heights_.empty()) {
    rosbag::View everything(bag_);
    std::set<std::string> topics;
    for (const rosbag::ConnectionInfo* connection : everything.getConnections())
      topics.insert(connection->topic);
    std::string names;
    for (const std::string& topic : topics) names += (names.empty() ? "" : ", ") + topic;
    throw FileError(path + ": no message on topic '" + height_topic + "'; the bag has " +
                    (names.empty() ? "no messages" : names) +
                    (wasCutOff() ? " (it was cut off)" : ""));
  }
  infos_ = messagesOf(sibling(height_topic, kScanInfoTopic));
  counter_heights_ = messagesOf(sibling(height_topic, kCounterHeightTopic));
  counter_infos_ = messagesOf(sibling(height_topic, kCounterScanInfoTopic));
}

void ScanBagReader::openMended() {
  mended_folder_ = std::make_unique<PrivateFolder>();
  const std::string folder = mended_folder_->path().string();
  const std::string cut = path_ + ": the bag was cut off; ";
  std::string source = path_;
  // rosbag takes nothing of a bag whose index ends too early, and all of one without an index.
  if (const std::uint64_t index = cutIndexPlace(path_)) {
    fs::create_directory(folder + "/cut");
    source = folder + "/cut/" + fs::path(path_).filename().string();
    std::error_code error;
    fs::copy_file(path_, source, error);
    if (!error) fs::resize_file(source, index, error);
    if (error) throw FileError(cut + "it cannot be mended: " + error.message());
  }
  const ChildResult result =
      runChild({"rosbag", "reindex", "--quiet", "--output-dir=" + folder, source},
               environmentWithout({}, {}), folder + "/log", kMendingTimeout);
  fs::remove_all(folder + "/cut");
  if (!result.started) throw FileError(cut + "the program rosbag, which mends it, was not found");
  const fs::path mended = fs::path(folder) / fs::path(path_).filename();
  if (!fs::exists(mended)) throw FileError(cut + "rosbag reindex could not mend it");
  try {
    checkBag(mended.string());
    bag_.open(mended.string(), rosbag::bagmode::Read);
  } catch (const std::exception& error) {
    throw FileError(cut + "nothing before the cut can be read: " +
                    replaced(error.what(), mended.string() + ": ", ""));
  }
}

ScanBagReader::Messages ScanBagReader::messagesOf(const std::string& topic) {
  const std::string name = withoutSlash(topic);
  views_.push_back(std::make_unique<rosbag::View>(bag_, rosbag::TopicQuery({name, "/" + name})));
  Messages messages;
  for (const rosbag::MessageInstance& message : *views_.back()) messages.push_back(message);
  return messages;
}

ReceivedScan ScanBagReader::pair(const rosbag::MessageInstance& message,
                                 const Messages& infos) const {
  const auto image = instantiate<sensor_msgs::Image>(message);
  if (infos.empty()) return receiveScan(image, parameters_);

  // Partners are recorded one after the other: look outwards from the time of the image.
  const auto after = std::lower_bound(infos.begin(), infos.end(), message.getTime(),
                                      [](const rosbag::MessageInstance& info,
                                         const ros::Time& time) { return info.getTime() < time; });
  const std::ptrdiff_t middle = after - infos.begin();
  const auto size = static_cast<std::ptrdiff_t>(infos.size());
  ScanInfoConstPtr found;
  for (std::ptrdiff_t distance = 0; distance < kNearest; ++distance) {
    for (const std::ptrdiff_t place : {middle + distance, middle - distance - 1}) {
      if (place < 0 || place >= size) continue;
      const auto info = instantiateInfo(infos[static_cast<std::size_t>(place)]);
      if (info->header.stamp != image->header.stamp) continue;
      if (found && contentOf(*info) != contentOf(*found)) throw SurfaceError(whySharedStamp());
      if (!found) found = info;
    }
  }
  if (!found) throw SurfaceError("the bag has no scan_info with the stamp of the scan");
  ReceivedScan scan = receiveScan(image, scanOptions(*found, parameters_));
  scan.identity = identityOf(image->header, found.get());
  return scan;
}

BagScan ScanBagReader::read(std::size_t index, bool with_counter_surface) const {
  const rosbag::MessageInstance& message = heights_.at(index);
  const ReceivedScan scan = pair(message, infos_);
  PlainStream stamp;
  stamp << scan.header.stamp;
  BagScan result{scan.surface, {}, scan.identity, scan.header.frame_id, stamp.str()};
  if (!with_counter_surface) return result;
  const auto after =
      std::upper_bound(counter_heights_.begin(), counter_heights_.end(), message.getTime(),
                       [](const ros::Time& time, const rosbag::MessageInstance& counter) {
                         return time < counter.getTime();
                       });
  if (after == counter_heights_.begin()) {
    throw SurfaceError(
        "no counter-surface was recorded before the scan (counter_surface/type is topic)");
  }
  result.counter_surface = pair(*(after - 1), counter_infos_).surface;
  return result;
}

std::unique_ptr<BagScans> openBag(const std::string& path, const std::string& height_topic,
                                  const ScanOptions& parameters) {
  return std::make_unique<ScanBagReader>(path, height_topic, parameters);
}

}  // namespace mems_stiction
