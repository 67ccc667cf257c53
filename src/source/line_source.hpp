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
#include "source/stage_way.hpp"

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
  /// Says what it discards.
  ~LineSource();

 private:
  enum class Event { kLine, kBegin, kEnd };

  struct Waiting {
    Event event;
    sensor_msgs::PointCloud2ConstPtr line;
    ros::SteadyTime since;
  };

  /// A line at its place, but for the backlash.
  struct TakenLine {
    std_msgs::Header header;
    ScanLine points;
    cv::Vec3d stage;  ///< where the stage was
  };

  struct Scan {
    StageWay way;  ///< by the stage's distance from its first place
    ros::SteadyTime went_on;
    std::vector<TakenLine> lines;
    std::uint64_t points = 0;  ///< of all lines
    ros::Time zero;            ///< where a stage of known speed was at 0
    std::int64_t number = 0;   ///< of the last line, for motion: count
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
  TakenLine placed(const sensor_msgs::PointCloud2& line);
  std::int64_t numberOf(const std_msgs::Header& header);
  void countNumber(const std_msgs::Header& header);
  /// Counts the lines that the driver has sent between the last one and this one.
  void noteNumber(const std_msgs::Header& header);
  void add(TakenLine line);
  static void append(Scan& scan, TakenLine line);
  /// The lines behind the furthest one are those of a new scan.
  void divideAtTurn();
  Scan emptyScan() const;
  /// Whether the stage's places are measured: it may stand, and its encoder has noise.
  bool isStageMeasured() const;
  void begin();
  /// - @p is_told else the scan ends by itself: if the stage did not move it was none
  void end(bool is_told);
  void finish(Scan scan, bool is_told);
  /// @throw SurfaceError if the stage did not move
  void checkMoved(const Scan& scan) const;
  std::vector<ScanLine> withoutBacklash(Scan& scan) const;
  void publishFinished();
  void showCounts();

  const SourceOptions options_;
  ScanPublisher& publisher_;
  SourceAccounting& accounting_;
  std::unique_ptr<TransformListener> transforms_;
  JointTrack joint_;
  std::deque<Waiting> waiting_;
  bool is_open_ = false;              ///< lines belong to a scan
  std::optional<bool> is_triggered_;  ///< nothing: no trigger came
  std::optional<Scan> scan_;          ///< has a line, or was begun
  std::deque<Scan> finished_;
  std::optional<std_msgs::Header> last_header_;
  LineCounts counts_;
  ros::Subscriber points_, joints_, trigger_;
  ros::ServiceServer begin_service_, end_service_;
  ros::SteadyTimer timer_;
};

}  // namespace mems_stiction
