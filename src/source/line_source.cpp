#include "source/line_source.hpp"

#include <algorithm>
#include <cmath>

#include "errors/error_text.hpp"
#include "errors/one_line.hpp"
#include "errors/plain_format.hpp"
#include "import/file_bytes.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "ros/checked_messages.hpp"
#include "ros/own_log.hpp"
#include "ros/topic_names.hpp"
#include "source/cloud_points.hpp"

namespace mems_stiction {
namespace {

constexpr double kPollPeriod = 0.01;  // [s]

/// Of a joint; at 1 kHz those of ten seconds.
constexpr std::size_t kMostPositions = 10000;

/// A stage that has moved less has not moved, where no line_pitch is stated [m].
constexpr double kSmallestMove = 1e-7;

/// A stage that has come back so many half lines has turned.
constexpr double kTurn = 3.0;

std::string linesName(const std_msgs::Header& first) {
  PlainStream text;
  text << "the scan of lines from stamp " << first.stamp;
  return text.str();
}

/// All points of a cloud, one after the other.
ScanLine shifted(const cv::Mat& points, const cv::Vec3d& shift) {
  ScanLine line;
  for (int row = 0; row < points.rows; ++row) {
    for (int col = 0; col < points.cols; ++col)
      line.push_back(points.at<cv::Vec3d>(row, col) + shift);
  }
  return line;
}

/// Any two stamps: those of ros::Time throw where they are 68 years apart [s].
double secondsBetween(const ros::Time& from, const ros::Time& to) {
  return 1e-9 * static_cast<double>(static_cast<std::int64_t>(to.toNSec()) -
                                    static_cast<std::int64_t>(from.toNSec()));
}

}  // namespace

void JointTrack::add(const ros::Time& stamp, double position) {
  if (!positions_.empty() && stamp <= positions_.back().first) {
    if (secondsBetween(stamp, positions_.back().first) < 1.0) return;
    positions_.clear();
  }
  positions_.emplace_back(stamp, position);
  if (positions_.size() > kMostPositions) positions_.pop_front();
}

double JointTrack::at(const ros::Time& stamp) const {
  const auto next = std::lower_bound(
      positions_.begin(), positions_.end(), stamp,
      [](const auto& position, const ros::Time& time) { return position.first < time; });
  if (next == positions_.end())
    throw NoTransform("no position of the joint at or behind the stamp of the line");
  if (next->first == stamp) return next->second;
  if (next == positions_.begin())
    throw NoTransform("no position of the joint before the stamp of the line");
  const auto before = std::prev(next);
  const double share =
      secondsBetween(before->first, stamp) / secondsBetween(before->first, next->first);
  return before->second + share * (next->second - before->second);
}

LineSource::LineSource(const SourceOptions& options, ros::NodeHandle& handle,
                       ros::NodeHandle& private_handle, ScanPublisher& publisher,
                       SourceAccounting& accounting)
    : options_(options), publisher_(publisher), accounting_(accounting), is_open_(isContinuous()) {
  if (options_.lines.motion == Motion::kTf)
    transforms_ = std::make_unique<TransformListener>(handle);
  if (options_.lines.motion == Motion::kJoint) {
    joints_ = subscribeChecked<sensor_msgs::JointState>(
        handle, "joint_states", kSubscriberQueue,
        {[this](const sensor_msgs::JointStateConstPtr& state) {
           const auto found =
               std::find(state->name.begin(), state->name.end(), options_.lines.joint);
           const auto place = static_cast<std::size_t>(found - state->name.begin());
           if (place < state->position.size() && std::isfinite(state->position[place])) {
             joint_.add(state->header.stamp, state->position[place]);
           }
         },
         [](const auto&, const std::string& reason) {
           logSoon(ros::console::levels::Warn,
                   "a message of joint_states is passed over: " + reason);
         }});
  }
  trigger_ = handle.subscribe<std_msgs::Bool>(
      "trigger", kPredictionQueue,
      [this](const std_msgs::BoolConstPtr& trigger) { onTrigger(trigger->data != 0); });
  points_ = subscribeChecked<sensor_msgs::PointCloud2>(
      handle, "points", kSubscriberQueue,
      {[this](const sensor_msgs::PointCloud2ConstPtr& line) { push(Event::kLine, line); },
       [this](const auto&, const std::string& reason) {
         ++counts_.refused;
         logSoon(ros::console::levels::Warn, "a line is passed over: " + reason);
       }});
  using Request = std_srvs::Trigger::Request;
  using Response = std_srvs::Trigger::Response;
  begin_service_ = private_handle.advertiseService<Request, Response>(
      "begin_scan",
      [this](Request&, Response& response) { return answer(Event::kBegin, response); });
  end_service_ = private_handle.advertiseService<Request, Response>(
      "end_scan", [this](Request&, Response& response) { return answer(Event::kEnd, response); });
  timer_ = handle.createSteadyTimer(ros::WallDuration(kPollPeriod),
                                    [this](const ros::SteadyTimerEvent&) { poll(); });
}

bool LineSource::isContinuous() const {
  return options_.lines.max_lines > 0 || options_.lines.end_at_turn || options_.lines.pause > 0.0;
}

void LineSource::push(Event event, const sensor_msgs::PointCloud2ConstPtr& line) {
  waiting_.push_back({event, line, ros::SteadyTime::now()});
  poll();
}

void LineSource::onTrigger(bool is_on) {
  if (is_on != is_triggered_) push(is_on ? Event::kBegin : Event::kEnd, nullptr);
  is_triggered_ = is_on;
}

bool LineSource::answer(Event event, std_srvs::Trigger::Response& response) {
  const bool is_end = event == Event::kEnd;
  response.success = !is_end || is_open_ || scan_.has_value();
  response.message = !response.success ? "no scan was begun"
                     : is_end          ? "the scan ends"
                     : scan_           ? "the scan before ends and a new one begins"
                                       : "a scan begins";
  if (response.success) push(event, nullptr);
  return true;
}

void LineSource::poll() {
  while (!waiting_.empty()) {
    const Waiting& first = waiting_.front();
    if (first.event == Event::kLine && !takeLine(first)) break;
    if (first.event == Event::kBegin) begin();
    if (first.event == Event::kEnd) {
      end();
      is_open_ = isContinuous();
    }
    waiting_.pop_front();
  }
  const double pause = options_.lines.pause;
  if (pause > 0.0 && scan_ && (ros::SteadyTime::now() - scan_->last_line).toSec() > pause) end();
  publishFinished();
  showCounts();
}

bool LineSource::takeLine(const Waiting& waiting) {
  if (!is_open_) {
    ++counts_.outside;
    return true;
  }
  try {
    if (!scan_) begin();
    Placed line = placed(*waiting.line);
    countNumber(waiting.line->header);
    add(waiting.line->header, std::move(line));
  } catch (const NoTransform& error) {
    if ((ros::SteadyTime::now() - waiting.since).toSec() < options_.points.transform_timeout)
      return false;
    ++counts_.without_place;
    countNumber(waiting.line->header);
    logSoon(ros::console::levels::Warn,
            oneLine(std::string("a line has no place: ") + error.what()));
  } catch (const std::exception& error) {  // whatever it is, the next line may do
    ++counts_.refused;
    logSoon(ros::console::levels::Warn, oneLine("a line is passed over: " + reasonOf(error)));
  }
  return true;
}

LineSource::Placed LineSource::placed(const sensor_msgs::PointCloud2& line) {
  cv::Mat points = cloudPoints(line);
  dropUnmeasured(points, options_.points.map);
  const LineOptions& lines = options_.lines;
  if (lines.motion == Motion::kTf) return placedByTransform(line.header, points);
  double place = 0.0;
  if (lines.motion == Motion::kJoint) {
    place = lines.joint_scale * joint_.at(line.header.stamp);
  } else if (!scan_->lines.empty()) {
    place = lines.motion == Motion::kSpeed
                ? lines.speed * secondsBetween(scan_->first.stamp, line.header.stamp)
                : lines.line_pitch * numberOf(line.header);
  }
  const double progress = place;
  if (!scan_->lines.empty() && lines.motion == Motion::kJoint && place < scan_->last)
    place += lines.backlash;
  return {shifted(points, {0.0, place, 0.0}), progress};
}

LineSource::Placed LineSource::placedByTransform(const std_msgs::Header& header, cv::Mat points) {
  const geometry_msgs::Transform transform =
      transforms_->at(options_.points.frame, header.frame_id, header.stamp);
  transformPoints(transform, points);
  const auto& shift = transform.translation;
  const cv::Vec3d stage(shift.x, shift.y, shift.z);
  if (!scan_->start) scan_->start = stage;
  const cv::Vec3d way = stage - *scan_->start;
  if (!scan_->direction &&
      cv::norm(way) > std::max(kSmallestMove, 0.5 * options_.lines.line_pitch)) {
    scan_->direction = way / cv::norm(way);
  }
  const double progress = scan_->direction ? way.dot(*scan_->direction) : 0.0;
  const bool goes_back = scan_->direction && progress < scan_->last;
  const cv::Vec3d slack =
      goes_back ? options_.lines.backlash * *scan_->direction : cv::Vec3d(0.0, 0.0, 0.0);
  return {shifted(points, slack), progress};
}

void LineSource::countNumber(const std_msgs::Header& header) {
  ++counts_.taken;
  if (last_header_ && header.seq > last_header_->seq + 1) {
    counts_.lost_by_sequence += header.seq - last_header_->seq - 1;
  }
  last_header_ = header;
}

/// Of a line in its scan. A line that was lost has its number, too, where the driver numbers them.
double LineSource::numberOf(const std_msgs::Header& header) {
  const bool is_repeated =
      !header.stamp.isZero() && last_header_ && header.stamp == last_header_->stamp;
  if (is_repeated) ++scan_->repeated;
  const bool is_numbered = last_header_ && header.seq > last_header_->seq;
  const std::uint32_t number = is_numbered ? header.seq - scan_->first_number
                                           : static_cast<std::uint32_t>(scan_->lines.size());
  return static_cast<double>(number) - scan_->repeated;
}

void LineSource::add(const std_msgs::Header& header, Placed line) {
  const LineOptions& options = options_.lines;
  const double move = std::max(kSmallestMove, 0.5 * options.line_pitch);
  const bool has_turned =
      !scan_->lines.empty() && scan_->has_moved &&
      std::abs(line.progress - scan_->origin) < std::abs(scan_->furthest) - kTurn * move;
  if (options.end_at_turn && has_turned) {
    begin();
    if (options.motion == Motion::kTf) line.progress = 0.0;
  }
  const bool is_first = scan_->lines.empty();
  if (is_first) {
    scan_->first = header;
    scan_->first_number = header.seq;
    scan_->last = scan_->origin = line.progress;
  }
  const bool has_moved = std::abs(line.progress - scan_->last) > 0.1 * move;
  scan_->has_moved = scan_->has_moved || has_moved;
  // A stage that stands still lets the pause run.
  if (has_moved || is_first) scan_->last_line = ros::SteadyTime::now();
  scan_->last = line.progress;
  const double way = line.progress - scan_->origin;
  if (std::abs(way) > std::abs(scan_->furthest)) scan_->furthest = way;
  scan_->points += line.points.size();
  scan_->lines.push_back(std::move(line.points));
  if (scan_->points > kMaxPixels) {
    accounting_.refused(linesName(scan_->first),
                        "more than " + std::to_string(kMaxPixels) +
                            " points without an end: set max_lines, end_at_turn or pause, "
                            "or call ~end_scan");
    scan_.reset();
    return;
  }
  if (options.max_lines > 0 && static_cast<int>(scan_->lines.size()) >= options.max_lines) end();
}

void LineSource::begin() {
  end();
  is_open_ = true;
  scan_.emplace();
  scan_->last_line = ros::SteadyTime::now();
}

void LineSource::end() {
  if (scan_ && !scan_->lines.empty()) finished_.push_back(std::move(*scan_));
  scan_.reset();
  if (finished_.size() > static_cast<std::size_t>(options_.points.queue_size)) {
    accounting_.givenUp(linesName(finished_.front().first), options_.points.queue_size);
    finished_.pop_front();
  }
}

void LineSource::publishFinished() {
  const std::string waits_for = publisher_.waitsFor();
  accounting_.hindered(waits_for);
  while (waits_for.empty() && !finished_.empty()) {
    const Scan scan = std::move(finished_.front());
    finished_.pop_front();
    const std::string name = linesName(scan.first);
    try {
      const LineMap result =
          mapOfLines(scan.lines, {options_.points.map, options_.lines.line_pitch});
      counts_.lost_by_position += result.lost;
      counts_.doubled += result.doubled;
      std::string note = std::to_string(scan.lines.size()) + " lines; " +
                         std::to_string(result.lost) + " places have none, " +
                         std::to_string(result.doubled) + " lines lie at the place of another";
      for (const std::string& more : result.map.notes) note += "; " + more;
      logSoon(ros::console::levels::Info, name + ": " + note);
      accounting_.show("last_map", note);
      const std::uint64_t stamp =
          (scan.first.stamp.isZero() ? ros::Time::now() : scan.first.stamp).toNSec();
      publisher_.publish(result.map.surface, options_.identity,
                         transforms_ ? options_.points.frame : scan.first.frame_id,
                         publisher_.freeStamp(stamp));
      accounting_.published(name);
    } catch (const std::exception& error) {  // whatever it is, the next scan may do
      accounting_.refused(name, reasonOf(error));
    }
  }
}

void LineSource::showCounts() {
  const bool has_lines = scan_ && !scan_->lines.empty();
  accounting_.waits(finished_.size() + (has_lines ? 1 : 0));
  accounting_.show("scan_is_open", is_open_ ? "true" : "false");
  const auto show = [this](const char* key, std::uint64_t count) {
    accounting_.show(key, std::to_string(count));
  };
  show("lines", counts_.taken);
  show("lines_of_this_scan", has_lines ? scan_->lines.size() : 0);
  show("lines_lost_by_position", counts_.lost_by_position);
  show("lines_lost_by_sequence", counts_.lost_by_sequence);
  show("lines_doubled", counts_.doubled);
  show("lines_without_place", counts_.without_place);
  show("lines_outside", counts_.outside);
  show("lines_refused", counts_.refused);
}

}  // namespace mems_stiction
