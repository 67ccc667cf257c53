#include "source/cloud_source.hpp"

#include <chrono>
#include <utility>

#include <tf2/LinearMath/Transform.h>

#include "errors/error_text.hpp"
#include "errors/one_line.hpp"
#include "errors/plain_format.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "ros/bounded_stream.hpp"
#include "ros/checked_messages.hpp"
#include "ros/own_log.hpp"
#include "ros/topic_names.hpp"
#include "source/cloud_points.hpp"

namespace mems_stiction {
namespace {

/// Between looks for a transform or the node [s].
constexpr double kLookPeriod = 0.02;

constexpr char kPointsTopic[] = "points";

}  // namespace

void transformPoints(const geometry_msgs::Transform& transform, cv::Mat& points) {
  const auto& turn = transform.rotation;
  const auto& shift = transform.translation;
  const tf2::Matrix3x3 rotation(tf2::Quaternion(turn.x, turn.y, turn.z, turn.w).normalized());
  cv::Matx34d matrix;
  for (int row = 0; row < 3; ++row) {
    for (int col = 0; col < 3; ++col) matrix(row, col) = rotation[row][col];
  }
  matrix(0, 3) = shift.x;
  matrix(1, 3) = shift.y;
  matrix(2, 3) = shift.z;
  cv::transform(points, points, matrix);
}

std::string cloudName(const std_msgs::Header& header) {
  PlainStream text;
  text << "the cloud of stamp " << header.stamp << " in frame '"
       << shortened(header.frame_id, kLongestQuotation) << "'";
  return oneLine(text.str());
}

CloudSource::CloudSource(const SourceOptions& options, ros::NodeHandle& handle,
                         ScanPublisher& publisher, SourceAccounting& accounting)
    : options_(options),
      publisher_(publisher),
      accounting_(accounting),
      transforms_(options.points.frame.empty() ? nullptr
                                               : std::make_unique<TransformListener>(handle)),
      thread_([this] { loop(); }),
      points_(subscribeChecked<sensor_msgs::PointCloud2>(
          handle, kPointsTopic, kSubscriberQueue,
          {[this](const sensor_msgs::PointCloud2ConstPtr& cloud) { take(cloud); },
           [this](const BoundedStream& bytes, const std::string& reason) {
             std_msgs::Header header;
             readBeginning(bytes, header);
             accounting_.refused(cloudName(header), reason);
           },
           kLargestMessage})) {}

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

void CloudSource::take(const sensor_msgs::PointCloud2ConstPtr& cloud) {
  std::optional<Waiting> dropped;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    countMissing(cloud->header.seq);
    line_.push_back({cloud, ros::SteadyTime::now()});
    if (line_.size() > static_cast<std::size_t>(options_.points.queue_size)) {
      dropped = line_.front();
      line_.pop_front();
    }
    countWaiting();
  }
  if (dropped) {
    accounting_.givenUp(cloudName(dropped->cloud->header), options_.points.queue_size);
  }
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

bool CloudSource::work() {
  const std::string waits_for = publisher_.waitsFor();
  accounting_.hindered(waits_for);
  if (!waits_for.empty()) return false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!at_hand_) {
      at_hand_ = line_.front();
      line_.pop_front();
    }
  }
  const std_msgs::Header& header = at_hand_->cloud->header;
  std::string reason;
  try {
    publish(*at_hand_->cloud);
  } catch (const NoTransform& error) {
    if ((ros::SteadyTime::now() - at_hand_->since).toSec() < options_.points.transform_timeout)
      return false;
    reason = error.what();
  } catch (const std::exception& error) {  // whatever it is, the next cloud may do
    reason = reasonOf(error);
  }
  if (reason.empty()) {
    accounting_.published(cloudName(header));
  } else {
    accounting_.refused(cloudName(header), reason);
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  at_hand_.reset();
  countWaiting();
  return true;
}

void CloudSource::publish(const sensor_msgs::PointCloud2& cloud) {
  const std_msgs::Header& header = cloud.header;
  const ros::Time stamp = header.stamp.isZero() ? ros::Time::now() : header.stamp;
  cv::Mat points = cloudPoints(cloud);
  dropUnmeasured(points, options_.points.map);
  if (transforms_)
    transformPoints(transforms_->at(options_.points.frame, header.frame_id, stamp), points);
  const CloudMap map = mapOfPoints(points, options_.points.map);
  for (const std::string& note : map.notes)
    logSoon(ros::console::levels::Info, cloudName(header) + ": " + note);
  accounting_.show("last_map", map.notes.empty() ? "on the grid of the points" : map.notes.front());
  publisher_.publish(map.surface, options_.identity,
                     transforms_ ? options_.points.frame : header.frame_id,
                     publisher_.freeStamp(stamp.toNSec()));
}

}  // namespace mems_stiction
