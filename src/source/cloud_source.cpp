#include "source/cloud_source.hpp"

#include <chrono>
#include <utility>

#include "errors/error_text.hpp"
#include "errors/one_line.hpp"
#include "errors/plain_format.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "ros/bounded_stream.hpp"
#include "ros/checked_messages.hpp"
#include "ros/own_log.hpp"
#include "ros/topic_names.hpp"
#include "source/cloud_points.hpp"
#include "source/grid_map_points.hpp"

namespace mems_stiction {
namespace {

/// Between looks for a transform or the node [s].
constexpr double kLookPeriod = 0.02;

constexpr char kPointsTopic[] = "points";
constexpr char kGridMapTopic[] = "grid_map";

/// Of a message in the books: its stamp and frame.
std::string nameOf(const char* kind, const std_msgs::Header& header) {
  PlainStream text;
  text << "the " << kind << " of stamp " << header.stamp << " in frame '"
       << shortened(header.frame_id, kLongestQuotation) << "'";
  return oneLine(text.str());
}

}  // namespace

CloudSource::CloudSource(const SourceOptions& options, ros::NodeHandle& handle,
                         ScanPublisher& publisher, SourceAccounting& accounting)
    : options_(options),
      publisher_(publisher),
      accounting_(accounting),
      transforms_(options.points.frame.empty() ? nullptr
                                               : std::make_unique<TransformListener>(handle)) {
  const bool has_frame = transforms_ != nullptr;
  const std::string layer = options_.points.layer;
  points_ = options_.source == SourceKind::kGridMap
                ? subscribe<GridMapMessage>(handle, kGridMapTopic, "grid map",
                                            [layer, has_frame](const GridMapMessage& map) {
                                              return gridMapPoints(map, layer, has_frame);
                                            })
                : subscribe<sensor_msgs::PointCloud2>(handle, kPointsTopic, "cloud", cloudPoints);
  thread_ = std::thread([this] { loop(); });
}

template <typename Message>
ros::Subscriber CloudSource::subscribe(ros::NodeHandle& handle, const char* topic, const char* kind,
                                       const std::function<cv::Mat(const Message&)>& points_of) {
  return subscribeChecked<Message>(
      handle, topic, kSubscriberQueue,
      {[this, kind, points_of](const boost::shared_ptr<const Message>& message) {
         const std_msgs::Header& header = message->header;
         take({header, nameOf(kind, header), [message, points_of] { return points_of(*message); },
               ros::SteadyTime::now()});
       },
       [this, kind](const BoundedStream& bytes, const std::string& reason) {
         std_msgs::Header header;
         readBeginning(bytes, header);
         accounting_.refused(nameOf(kind, header), reason);
       },
       kLargestMessage});
}

CloudSource::~CloudSource() {
  points_.shutdown();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void CloudSource::countMissing(std::uint32_t number) {
  if (last_number_ && number > *last_number_ + 1) missing_ += number - *last_number_ - 1;
  last_number_ = number;
  accounting_.show("missing_by_sequence", std::to_string(missing_));
}

void CloudSource::take(Waiting one) {
  std::optional<Waiting> dropped;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    countMissing(one.header.seq);
    line_.push_back(std::move(one));
    if (line_.size() > static_cast<std::size_t>(options_.points.queue_size)) {
      dropped = std::move(line_.front());
      line_.pop_front();
    }
    countWaiting();
  }
  if (dropped) accounting_.givenUp(dropped->name, options_.points.queue_size);
  changed_.notify_all();
}

void CloudSource::loop() {
  while (true) {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [this] { return is_stopping_ || at_hand_ || !line_.empty(); });
      if (is_stopping_) return;
    }
    if (work()) continue;
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_for(lock, std::chrono::duration<double>(kLookPeriod),
                      [this] { return is_stopping_; });
  }
}

void CloudSource::lookUp(Waiting& one) const {
  if (!transforms_ || one.transform || one.header.stamp.isZero()) return;
  try {
    one.transform = transforms_->at(options_.points.frame, one.header.frame_id, one.header.stamp);
  } catch (const std::exception&) {  // it may still come, and is refused with its reason if not
  }
}

bool CloudSource::work() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (Waiting& one : line_) lookUp(one);
    if (at_hand_) lookUp(*at_hand_);
  }
  const std::string waits_for = publisher_.waitsFor();
  accounting_.hindered(waits_for);
  if (!waits_for.empty()) return false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!at_hand_) {
      at_hand_ = std::move(line_.front());
      line_.pop_front();
    }
  }
  std::string reason;
  try {
    publish(*at_hand_);
  } catch (const NoTransform& error) {
    if ((ros::SteadyTime::now() - at_hand_->since).toSec() < options_.points.transform_timeout)
      return false;
    reason = error.what();
  } catch (const std::exception& error) {  // whatever it is, the next cloud may do
    reason = reasonOf(error);
  }
  if (reason.empty()) {
    accounting_.published(at_hand_->name);
  } else {
    accounting_.refused(at_hand_->name, reason);
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  at_hand_.reset();
  countWaiting();
  return true;
}

void CloudSource::publish(const Waiting& one) {
  const std_msgs::Header& header = one.header;
  const ros::Time stamp = header.stamp.isZero() ? ros::Time::now() : header.stamp;
  std::optional<geometry_msgs::Transform> transform = one.transform;
  if (transforms_ && !transform)  // before work that is in vain without it
    transform = transforms_->at(options_.points.frame, header.frame_id, stamp);
  cv::Mat points = one.points();
  dropUnmeasured(points, options_.points.map);
  if (transform) transformPoints(*transform, points);
  const CloudMap map = mapOfPoints(points, options_.points.map);
  for (const std::string& note : map.notes)
    logSoon(ros::console::levels::Info, one.name + ": " + note);
  accounting_.show("last_map", map.notes.empty() ? "on the grid of the points" : map.notes.front());
  publisher_.publish(map.surface, options_.identity,
                     transforms_ ? options_.points.frame : header.frame_id,
                     publisher_.freeStamp(stamp.toNSec()));
}

}  // namespace mems_stiction
