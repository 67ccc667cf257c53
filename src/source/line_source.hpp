#pragma once

/// @file
/// The door `lines`: the lines of a scanner on a stage become a scan.
///
/// Everything happens on the thread of the handle's queue. Lines, and the beginnings and ends of
/// scans among them, wait in one queue until the place of the first line is known.

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <ros/node_handle.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Bool.h>
#include <std_srvs/Trigger.h>
#include <opencv2/core.hpp>

#include "ros/transform_listener.hpp"
#include "source/line_map.hpp"
#include "source/scan_publisher.hpp"
#include "source/source_accounting.hpp"
#include "source/source_options.hpp"

namespace mems_stiction {

/// Where a joint was, between the stamps of its messages.
class JointTrack {
 public:
  /// Those that come late are passed over, but for a clock that was set back.
  void add(const ros::Time& stamp, double position);
  /// @throw NoTransform while no message at or behind the stamp is there, or none before
  double at(const ros::Time& stamp) const;

 private:
  std::deque<std::pair<ros::Time, double>> positions_;
};

/// Puts lines together and publishes the scans.
class LineSource {
 public:
  /// - @p publisher, @p accounting must outlive this
  LineSource(const SourceOptions& options, ros::NodeHandle& handle, ros::NodeHandle& private_handle,
             ScanPublisher& publisher, SourceAccounting& accounting);
  LineSource(const LineSource&) = delete;
  LineSource& operator=(const LineSource&) = delete;

 private:
  enum class Event { kLine, kBegin, kEnd };

  struct Waiting {
    Event event;
    sensor_msgs::PointCloud2ConstPtr line;
    ros::SteadyTime since;
  };

  /// A line at its place, and how far the stage has come.
  struct Placed {
    ScanLine points;
    double progress;
  };

  struct Scan {
    std_msgs::Header first;  ///< of its first line; seq counts the lines
    std::vector<ScanLine> lines;
    std::uint64_t points = 0;                      ///< of all lines
    std::uint32_t first_number = 0, repeated = 0;  ///< of the sequence; lines of one stamp
    std::optional<cv::Vec3d> start, direction;     ///< of the stage, by tf
    double origin = 0.0, last = 0.0;               ///< progress of the first and the last line
    double furthest = 0.0;                         ///< from the origin, either way
    bool has_moved = false;
    ros::SteadyTime last_line;
  };

  struct LineCounts {
    std::uint64_t taken = 0, outside = 0, refused = 0, without_place = 0, doubled = 0;
    std::uint64_t lost_by_sequence = 0, lost_by_position = 0;
  };

  bool isContinuous() const;
  void push(Event event, const sensor_msgs::PointCloud2ConstPtr& line);
  void onTrigger(bool is_on);
  bool answer(Event event, std_srvs::Trigger::Response& response);
  /// Works off what waits, as far as places are known.
  void poll();
  /// @return false: its place may still come
  bool takeLine(const Waiting& waiting);
  Placed placed(const sensor_msgs::PointCloud2& line);
  Placed placedByTransform(const std_msgs::Header& header, cv::Mat points);
  double numberOf(const std_msgs::Header& header);
  void countNumber(const std_msgs::Header& header);
  void add(const std_msgs::Header& header, Placed line);
  void begin();
  void end();
  void publishFinished();
  void showCounts();

  const SourceOptions options_;
  ScanPublisher& publisher_;
  SourceAccounting& accounting_;
  std::unique_ptr<TransformListener> transforms_;
  JointTrack joint_;
  std::deque<Waiting> waiting_;
  bool is_open_ = false;  ///< lines belong to a scan
  bool is_triggered_ = false;
  std::optional<Scan> scan_;  ///< has a line, or was begun
  std::deque<Scan> finished_;
  std::optional<std_msgs::Header> last_header_;
  LineCounts counts_;
  ros::Subscriber points_, joints_, trigger_;
  ros::ServiceServer begin_service_, end_service_;
  ros::SteadyTimer timer_;
};

}  // namespace mems_stiction
