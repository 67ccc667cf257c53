#pragma once

/// @file
/// The doors `cloud` and `grid_map`: each PointCloud2 of a sensor that sees a whole field, and each
/// GridMap, becomes a scan.

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include <ros/node_handle.h>
#include <std_msgs/Header.h>
#include <opencv2/core.hpp>

#include "ros/transform_listener.hpp"
#include "source/cloud_grid.hpp"
#include "source/scan_publisher.hpp"
#include "source/source_accounting.hpp"
#include "source/source_options.hpp"

namespace mems_stiction {

/// Takes messages on the handle's queue and works on a thread of its own.
class CloudSource {
 public:
  /// - @p publisher, @p accounting must outlive this
  CloudSource(const SourceOptions& options, ros::NodeHandle& handle, ScanPublisher& publisher,
              SourceAccounting& accounting);
  /// Finishes the message at hand.
  ~CloudSource();
  CloudSource(const CloudSource&) = delete;
  CloudSource& operator=(const CloudSource&) = delete;

 private:
  /// A message that has come.
  struct Waiting {
    std_msgs::Header header;
    std::string name;                 ///< in the books
    std::function<cv::Mat()> points;  ///< throws SurfaceError
    ros::SteadyTime since;
    std::optional<geometry_msgs::Transform> transform = {};  ///< tf forgets, while it waits
  };

  template <typename Message>
  ros::Subscriber subscribe(ros::NodeHandle& handle, const char* topic, const char* kind,
                            const std::function<cv::Mat(const Message&)>& points_of);
  void take(Waiting one);
  void countWaiting() { accounting_.waits(line_.size() + (at_hand_ ? 1 : 0)); }
  void countMissing(std::uint32_t number);
  void loop();
  /// @return whether there was something to do
  bool work();
  /// Its transform, if it is wanted and there.
  void lookUp(Waiting& one) const;
  /// @throw NoTransform while it is not there; SurfaceError with a reason to refuse the message
  void publish(const Waiting& one);

  const SourceOptions options_;
  ScanPublisher& publisher_;
  SourceAccounting& accounting_;
  std::unique_ptr<TransformListener> transforms_;  ///< if heights are taken in another frame
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Waiting> line_;
  std::optional<Waiting> at_hand_;  ///< waits for its transform, or is being published
  bool is_stopping_ = false;
  std::optional<std::uint32_t> last_number_;  ///< of the publisher's sequence
  std::uint64_t missing_ = 0;
  std::thread thread_;
  ros::Subscriber points_;
};

}  // namespace mems_stiction
