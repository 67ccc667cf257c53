#include "source/line_source.hpp"

#include <algorithm>
#include <cmath>

#include "errors/error_text.hpp"
#include "errors/one_line.hpp"
#include "errors/plain_format.hpp"
#include "errors/short_number.hpp"
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

std::string linesName(const std_msgs::Header& first) {
  PlainStream text;
  text << "the scan of lines from stamp " << first.stamp;
  return text.str();
}

/// All points of a cloud, one after the other.
ScanLine pointsOf(const cv::Mat& points) {
  ScanLine line;
  for (int row = 0; row < points.rows; ++row)
    line.insert(line.end(), points.ptr<cv::Vec3d>(row), points.ptr<cv::Vec3d>(row) + points.cols);
  return line;
}

void shift(ScanLine& line, const cv::Vec3d& by) {
  for (cv::Vec3d& point : line) point += by;
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

LineSource::~LineSource() {
  if (scan_) finished_.push_back(std::move(*scan_));
  for (const Scan& scan : finished_) {
    if (scan.lines.empty()) continue;
    logSoon(ros::console::levels::Warn,
            linesName(scan.lines.front().header) + " is discarded with its " +
                std::to_string(scan.lines.size()) + " lines: the source ends");
  }
}

bool LineSource::isContinuous() const {
  return options_.lines.max_lines > 0 || options_.lines.end_at_turn || options_.lines.pause > 0.0;
}

void LineSource::push(Event event, const sensor_msgs::PointCloud2ConstPtr& line) {
  waiting_.push_back({event, line, ros::SteadyTime::now()});
  poll();
}

void LineSource::onTrigger(bool is_on) {
  if (is_triggered_ != is_on) push(is_on ? Event::kBegin : Event::kEnd, nullptr);
  is_triggered_ = is_on;
}

bool LineSource::answer(Event event, std_srvs::Trigger::Response& response) {
  const bool is_end = event == Event::kEnd;
  response.success = !is_end || is_open_ || scan_.has_value();
  response.message = !response.success ? "no scan was begun"
                     : is_end          ? "the scan ends"
                     : scan_           ? "the scan before ends and a new one begins"
                                       : "a scan begins";
  if (response.success) {
    is_triggered_ = !is_end && is_triggered_.value_or(false);  // the next true begins a scan
    push(event, nullptr);
  }
  return true;
}

void LineSource::poll() {
  while (!waiting_.empty()) {
    const Waiting& first = waiting_.front();
    if (first.event == Event::kLine && !takeLine(first)) break;
    if (first.event == Event::kBegin) begin();
    if (first.event == Event::kEnd) {
      end(true);
      is_open_ = false;
    }
    waiting_.pop_front();
  }
  const double pause = options_.lines.pause;
  if (pause > 0.0 && scan_ && (ros::SteadyTime::now() - scan_->went_on).toSec() > pause) end(false);
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
    TakenLine line = placed(*waiting.line);
    countNumber(line.header);
    add(std::move(line));
  } catch (const NoTransform& error) {
    if ((ros::SteadyTime::now() - waiting.since).toSec() < options_.points.transform_timeout)
      return false;
    ++counts_.without_place;
    countNumber(waiting.line->header);
    logSoon(ros::console::levels::Warn,
            oneLine(std::string("a line has no place: ") + error.what()));
  } catch (const std::exception& error) {  // whatever it is, the next line may do
    ++counts_.refused;
    noteNumber(waiting.line->header);
    logSoon(ros::console::levels::Warn, oneLine("a line is passed over: " + reasonOf(error)));
  }
  return true;
}

LineSource::TakenLine LineSource::placed(const sensor_msgs::PointCloud2& line) {
  cv::Mat points = cloudPoints(line);
  dropUnmeasured(points, options_.points.map);
  const LineOptions& lines = options_.lines;
  if (lines.motion == Motion::kTf) {
    const geometry_msgs::Transform transform =
        transforms_->at(options_.points.frame, line.header.frame_id, line.header.stamp);
    transformPoints(transform, points);
    const auto& stage = transform.translation;
    return {line.header, pointsOf(points), {stage.x, stage.y, stage.z}};
  }
  double place = 0.0;
  if (lines.motion == Motion::kJoint) {
    place = lines.joint_scale * joint_.at(line.header.stamp);
  } else if (!scan_->lines.empty()) {
    place = lines.motion == Motion::kSpeed
                ? lines.speed * secondsBetween(scan_->zero, line.header.stamp)
                : lines.line_pitch * static_cast<double>(numberOf(line.header));
  }
  TakenLine taken{line.header, pointsOf(points), {0.0, place, 0.0}};
  shift(taken.points, taken.stage);
  return taken;
}

void LineSource::countNumber(const std_msgs::Header& header) {
  ++counts_.taken;
  noteNumber(header);
}

void LineSource::noteNumber(const std_msgs::Header& header) {
  if (last_header_ && header.seq > last_header_->seq + 1) {
    counts_.lost_by_sequence += header.seq - last_header_->seq - 1;
  }
  last_header_ = header;
}

/// Of a line in its scan. A line that was lost has its number, too, where the driver numbers them;
/// behind a driver that began anew the numbers go on.
std::int64_t LineSource::numberOf(const std_msgs::Header& header) {
  const std_msgs::Header& last = scan_->lines.back().header;
  const bool is_repeated = !header.stamp.isZero() && header.stamp == last.stamp;
  scan_->number += header.seq > last.seq ? std::int64_t{header.seq} - last.seq : 1;
  if (is_repeated) --scan_->number;
  return scan_->number;
}

void LineSource::add(TakenLine line) {
  const LineOptions& options = options_.lines;
  if (scan_->lines.empty()) scan_->zero = line.header.stamp;
  append(*scan_, std::move(line));
  if (options.end_at_turn && !scan_->way.turns().empty()) divideAtTurn();
  if (scan_->points > kMaxPixels) {
    accounting_.refused(linesName(scan_->lines.front().header),
                        "more than " + std::to_string(kMaxPixels) +
                            " points without an end: set max_lines, end_at_turn or pause, "
                            "or call ~end_scan");
    scan_.reset();
    return;
  }
  if (options.max_lines > 0 && static_cast<int>(scan_->lines.size()) >= options.max_lines)
    end(false);
}

void LineSource::append(Scan& scan, TakenLine line) {
  scan.points += line.points.size();
  scan.lines.push_back(std::move(line));
  // A stage that stands still lets the pause run.
  if (scan.way.add(cv::norm(scan.lines.back().stage - scan.lines.front().stage)))
    scan.went_on = ros::SteadyTime::now();
}

void LineSource::divideAtTurn() {
  Scan before = emptyScan(), behind = emptyScan();
  behind.zero = scan_->zero;
  behind.number = scan_->number;
  for (std::size_t i = 0; i < scan_->lines.size(); ++i)
    append(i < scan_->way.turns().front() ? before : behind, std::move(scan_->lines[i]));
  scan_ = std::move(behind);
  finish(std::move(before), false);
}

LineSource::Scan LineSource::emptyScan() const {
  return {StageWay(options_.lines.line_pitch), ros::SteadyTime::now(), {}, 0, {}, 0};
}

bool LineSource::isStageMeasured() const {
  return options_.lines.motion == Motion::kJoint || options_.lines.motion == Motion::kTf;
}

void LineSource::begin() {
  end(false);
  is_open_ = true;
  scan_ = emptyScan();
}

void LineSource::end(bool is_told) {
  if (scan_ && !scan_->lines.empty()) finish(std::move(*scan_), is_told);
  scan_.reset();
}

void LineSource::finish(Scan scan, bool is_told) {
  if (!is_told && isStageMeasured() && !scan.way.hasMoved()) {
    counts_.outside += scan.lines.size();
    return;
  }
  finished_.push_back(std::move(scan));
  if (finished_.size() > static_cast<std::size_t>(options_.points.queue_size)) {
    accounting_.givenUp(linesName(finished_.front().lines.front().header),
                        options_.points.queue_size);
    finished_.pop_front();
  }
}

std::vector<ScanLine> LineSource::withoutBacklash(Scan& scan) const {
  const LineOptions& options = options_.lines;
  std::vector<TakenLine>& lines = scan.lines;
  const cv::Vec3d first = lines.front().stage;
  if (isStageMeasured() && options.backlash != 0.0 && !options.end_at_turn) {
    cv::Vec3d along(0.0, 1.0, 0.0);
    if (options.motion == Motion::kTf) {
      const auto furthest =
          std::max_element(lines.begin(), lines.end(), [&](const auto& one, const auto& other) {
            return cv::norm(one.stage - first) < cv::norm(other.stage - first);
          });
      along = cv::normalize(furthest->stage - first);
    }
    std::vector<double> places;
    for (const TakenLine& line : lines) places.push_back((line.stage - first).dot(along));
    const std::vector<double> more = slacks(places, options.backlash, options.line_pitch);
    for (std::size_t i = 0; i < lines.size(); ++i) shift(lines[i].points, more[i] * along);
  }
  std::vector<ScanLine> points;
  for (TakenLine& line : lines) points.push_back(std::move(line.points));
  return points;
}

void LineSource::checkMoved(const Scan& scan) const {
  if (!isStageMeasured() || scan.way.hasMoved()) return;
  throw SurfaceError("over " + std::to_string(scan.lines.size()) + " lines the stage moved by " +
                     shortNumber(scan.way.span()) + " m, must be more than " +
                     shortNumber(scan.way.leastMove()) + " m, as of noise: nothing moved");
}

void LineSource::publishFinished() {
  const std::string waits_for = publisher_.waitsFor();
  accounting_.hindered(waits_for);
  while (waits_for.empty() && !finished_.empty()) {
    Scan scan = std::move(finished_.front());
    finished_.pop_front();
    const std_msgs::Header& first = scan.lines.front().header;
    const std::string name = linesName(first);
    try {
      checkMoved(scan);
      const LineMap result =
          mapOfLines(withoutBacklash(scan), {options_.points.map, options_.lines.line_pitch});
      counts_.lost_by_position += result.lost;
      counts_.doubled += result.doubled;
      std::string note = std::to_string(scan.lines.size()) + " lines; " +
                         std::to_string(result.lost) + " places have none, " +
                         std::to_string(result.doubled) + " lines lie at the place of another";
      for (const std::string& more : result.map.notes) note += "; " + more;
      logSoon(ros::console::levels::Info, name + ": " + note);
      accounting_.show("last_map", note);
      const std::uint64_t stamp = (first.stamp.isZero() ? ros::Time::now() : first.stamp).toNSec();
      publisher_.publish(result.map.surface, options_.identity,
                         transforms_ ? options_.points.frame : first.frame_id,
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
