#include "ros/device_force_stream.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include <diagnostic_msgs/DiagnosticStatus.h>

#include "device/device_evidence.hpp"
#include "errors/error_text.hpp"
#include "errors/short_number.hpp"
#include "evaluation/frame_load.hpp"
#include "evaluation/half_space_call.hpp"
#include "mems_stiction/evaluation/scan_predictor.hpp"
#include "prediction/asked_output.hpp"
#include "ros/background_thread.hpp"
#include "ros/message_parts.hpp"
#include "ros/topic_names.hpp"
#include "settings/time_limit.hpp"

namespace mems_stiction {
namespace {

/// The node ends.
struct Stopped {};

/// Parts that wait; the one that has waited longest goes.
constexpr std::size_t kMostWaiting = 100;
/// Scans that wait for a half-space (HalfSpaceStream), and so half-spaces whose device may still be
/// at hand, and devices that may be judged again.
constexpr std::size_t kMostHalfSpaces = 8;

Prediction withoutMaps(Prediction prediction) {
  prediction.deformed_lower.release();
  prediction.deformed_upper.release();
  prediction.contact_map.release();
  prediction.pressure.release();
  return prediction;
}

bool haveSamePixels(const PreparedScan& one, const PreparedScan& other) {
  return one.surfaces.lower.heights().data == other.surfaces.lower.heights().data;
}

/// Of surfaces that are under their counter-surface, for a verdict.
Prediction predictionOf(const PreparedScan& prepared, const Configuration& settings) {
  Configuration asked = settings;
  asked.counter_surface = {};
  asked.model.output = figuresAlone();
  return withoutMaps(ScanPredictor(asked).predict(prepared));
}

/// Of the settings that bear on a device's force.
std::string forceHash(const Configuration& settings) {
  Configuration counted = settings;
  counted.device = DeviceOptions();
  counted.device.contact_area = settings.device.contact_area;
  counted.device.contacts = settings.device.contacts;
  return settingsHash(counted);
}

}  // namespace

DeviceForceStream::DeviceForceStream(const ros::NodeHandle& handle, const SurfaceLimits& most,
                                     SolutionPause& pause, Warn warn, Judged judged)
    : pause_(pause), warn_(std::move(warn)), judged_(std::move(judged)), parts_(most) {
  ros::NodeHandle node(handle);
  // Latched: whoever comes finds the newest.
  publisher_ = node.advertise<DeviceAdhesion>(kDeviceForceTopic, kPredictionQueue, true);
}

void DeviceForceStream::start() {
  thread_ = std::thread([this] { loop(); });
}

void DeviceForceStream::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void DeviceForceStream::offer(const StationCase& scan, const PredictedScan& predicted) {
  const SettingsOwner::Snapshot& settings = scan.settings;
  if (!wantsDeviceForce(settings->device, settings->device_force)) return;
  const Provenance& provenance = predicted.provenance;
  const PartName part{provenance.part_id, provenance.serial_id};
  Task task{part,
            {scan.header, provenance, predicted.pool_settings_hash, predicted.scan_id},
            settings,
            scan.scan,
            withoutMaps(predicted.prediction)};
  const ScanStatement statement =
      statementOf(provenance.scan_name, predicted.prediction, predicted.verdict);
  std::vector<Task> gone;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++counts_.offered;
    const std::vector<PartName> forgotten =
        parts_.add(part, scan.header.stamp.toNSec(), statement, task.newest);
    const auto leave = [&](std::vector<Task>::iterator waiting) {
      ++counts_.skipped;
      gone.push_back(std::move(*waiting));
      return waiting_.erase(waiting);
    };
    for (auto waiting = waiting_.begin(); waiting != waiting_.end();) {
      if (waiting->part == part) {  // its surface is among those of the newer one
        ++counts_.skipped;
        awaited_.remove(waiting->scan);
        waiting = waiting_.erase(waiting);
      } else {
        const bool is_forgotten =
            std::find(forgotten.begin(), forgotten.end(), waiting->part) != forgotten.end();
        waiting = is_forgotten ? leave(waiting) : waiting + 1;
      }
    }
    if (waiting_.size() == kMostWaiting) leave(waiting_.begin());
    awaited_.add(task.scan);
    waiting_.push_back(std::move(task));
  }
  changed_.notify_all();
  for (const Task& lost : gone) {
    warn_(lost.scan.header, "device_force: scans of other parts came before its turn");
    judged_({lost.scan, std::nullopt, std::nullopt});
  }
}

bool DeviceForceStream::HalfSpaceOfScan::isOf(const PreparedScan& other,
                                              const std::string& other_hash) const {
  return haveSamePixels(scan, other) && hash == other_hash;
}

void DeviceForceStream::takeHalfSpace(const StationCase& scan, const SolvedHalfSpace& solution,
                                      const std::string& why) {
  if (!wantsDeviceForce(scan.settings->device, scan.settings->device_force)) return;
  HalfSpaceOfScan taken{scan.scan, forceHash(*scan.settings), solution, why};
  for (cv::Mat* const map : {&taken.solution.pressure, &taken.solution.gap}) map->release();
  taken.solution.deformed_lower = taken.solution.deformed_upper = HeightMap();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto is_older = [&](const HalfSpaceOfScan& other) {
      return other.isOf(taken.scan, taken.hash);
    };
    half_spaces_.erase(std::remove_if(half_spaces_.begin(), half_spaces_.end(), is_older),
                       half_spaces_.end());
    half_spaces_.push_front(std::move(taken));
    forgetHalfSpace();
    const auto judged =
        std::find_if(newest_tasks_.begin(), newest_tasks_.end(), [this](const NewestTask& newest) {
          return half_spaces_.front().isOf(newest.finest, newest.hash);
        });
    if (judged == newest_tasks_.end() || !parts_.of(judged->task.part)) return;
    const auto is_newer = [&](const Task& waiting) { return waiting.part == judged->task.part; };
    if (std::any_of(waiting_.begin(), waiting_.end(), is_newer)) return;
    ++counts_.offered;
    awaited_.add(judged->task.scan);
    waiting_.push_back(judged->task);
  }
  changed_.notify_all();
}

bool DeviceForceStream::mayJudge(const HalfSpaceOfScan& half_space) const {
  return std::any_of(newest_tasks_.begin(), newest_tasks_.end(), [&](const NewestTask& newest) {
    const std::optional<ScannedPart> part = parts_.of(newest.task.part);
    return part && std::any_of(part->scans.begin(), part->scans.end(), [&](const auto& scanned) {
             return half_space.isOf(scanned.scan, newest.hash);
           });
  });
}

void DeviceForceStream::forgetHalfSpace() {
  if (half_spaces_.size() <= kMostHalfSpaces) return;
  const auto oldest =
      std::find_if(half_spaces_.rbegin(), half_spaces_.rend(),
                   [this](const HalfSpaceOfScan& half_space) { return !mayJudge(half_space); });
  if (oldest != half_spaces_.rend()) half_spaces_.erase(std::next(oldest).base());
}

void DeviceForceStream::loop() {
  yieldToOtherThreads();
  for (;;) {
    std::optional<Task> task;
    std::optional<ScannedPart> part;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [this] { return stopping_ || !waiting_.empty(); });
      if (stopping_) return;
      task = std::move(waiting_.back());
      waiting_.pop_back();
      part = parts_.of(
          task->part);  // there as long as its scan waits, but for one that is to be judged again
      if (part) {
        const auto is_of_part = [&](const NewestTask& newest) {
          return newest.task.part == task->part;
        };
        newest_tasks_.erase(std::remove_if(newest_tasks_.begin(), newest_tasks_.end(), is_of_part),
                            newest_tasks_.end());
        newest_tasks_.push_front({*task, forceHash(*task->settings), {}});
        if (newest_tasks_.size() > kMostHalfSpaces) newest_tasks_.pop_back();
      } else {
        ++counts_.skipped;
      }
    }
    DeviceAnswer answer{task->scan, std::nullopt, std::nullopt};
    try {
      if (part) answer = work(*task, *part);
    } catch (const Stopped&) {
      return;
    } catch (const std::exception& error) {  // of the publisher: the next part must get its turn
      warn_(task->scan.header, "device_force: " + reasonOf(error));
    }
    judged_(answer);
  }
}

DeviceAnswer DeviceForceStream::work(const Task& task, const ScannedPart& part) {
  std::optional<Verdict> verdict;
  DeviceAdhesion message;
  try {
    message = find(task, part, verdict);
  } catch (const std::exception& error) {
    message = refusedDevice(error.what(), task.settings->model.load, task.scan.header);
  }
  if (stopping_) throw Stopped();
  message.scan_count = static_cast<std::uint32_t>(part.scans.size());
  fillProvenance(task.scan.provenance, message);
  const bool is_refused = message.status == DeviceAdhesion::REFUSED;
  publisher_.publish(message);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    since_.reset();
    ++(is_refused                                       ? counts_.failed
       : message.status == DeviceAdhesion::JUDGED_AGAIN ? counts_.judged_again
                                                        : counts_.found);
    if (message.status == DeviceAdhesion::FOUND) last_time_ = message.processing_time;
    if (is_refused) last_failure_ = message.message;
  }
  if (is_refused) warn_(task.scan.header, "device_force: " + message.message);
  DeviceAnswer answer{task.scan, verdict, std::nullopt, true};
  if (verdict && PartKey{task.part.first, task.part.second, ""}.isStated()) {
    answer.part = pooledVerdictOf(part.statements(), *verdict);
  }
  return answer;
}

DeviceAdhesion DeviceForceStream::find(const Task& task, const ScannedPart& part,
                                       std::optional<Verdict>& verdict) {
  const Configuration& settings = *task.settings;
  const Options model = onFrame(settings.model, settings.device, task.newest.surfaces);
  const std::vector<std::uint64_t> numbers = part.numbers();
  const std::string hash = forceHash(settings);
  const bool is_known = found_ && found_->numbers == numbers && found_->hash == hash;
  if (!is_known) {
    const Clock::time_point begin = Clock::now();
    DeviceScans scans = part.together(settings);
    PreparedScan finest = part.scans[scans.finest()].scan;
    Prediction of_finest =
        haveSamePixels(finest, task.newest) ? task.prediction : predictionOf(finest, settings);
    DeviceForce force = make(scans);
    Found found{task.newest,
                numbers,
                hash,
                std::move(scans),
                std::move(finest),
                std::move(of_finest),
                std::move(force),
                std::chrono::duration<double>(Clock::now() - begin).count()};
    const std::lock_guard<std::mutex> lock(mutex_);
    found_ = std::move(found);
  }
  DeviceForce force = found_->force;
  const PreparedScan& finest = found_->finest;
  const Prediction& of_finest = found_->of_finest;
  const Options on_finest = onFrame(settings.model, settings.device, finest.surfaces);
  const HalfSpaceCall call = halfSpaceCall(of_finest, finest, on_finest, settings);
  Evidence evidence;
  evidence.device = deviceEvidence(force);
  std::optional<HalfSpaceOfScan> half_space;
  SolvedHalfSpace unsolved;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto known =
        std::find_if(half_spaces_.begin(), half_spaces_.end(),
                     [&](const HalfSpaceOfScan& other) { return other.isOf(finest, hash); });
    if (known != half_spaces_.end()) half_space = *known;
    newest_tasks_.front().finest = finest;
  }
  if (half_space) {
    evidence.half_space = &half_space->solution;
    evidence.why_half_space = half_space->why;
  } else if (!call.objection.empty()) {
    unsolved = unsolvedHalfSpace(call.objection);
    evidence.half_space = &unsolved;
    evidence.why_half_space = call.why;
  }
  if (part.taken > part.scans.size()) {
    force.warnings.push_back("only " + std::to_string(part.scans.size()) + " of " +
                             std::to_string(part.taken) +
                             " scans are kept (max_part_scans and max_part_memory)");
  }
  verdict = verdictOf(of_finest, settings.device, settings.uncertainty, on_finest,
                      finest.surfaces.lower.cellArea(), evidence);
  if (verdict->judge == Judge::kHalfSpace) {
    force =
        judgedByHalfSpace(std::move(force), of_finest, on_finest, settings.uncertainty, evidence);
  }
  DeviceAdhesion message = deviceMessage(force, model.load, task.scan.header);
  message.status = is_known ? DeviceAdhesion::JUDGED_AGAIN : DeviceAdhesion::FOUND;
  message.processing_time = found_->time;
  fillVerdict(*verdict, message);
  return message;
}

DeviceForce DeviceForceStream::make(const DeviceScans& scans) {
  auto go_on = [this, give_way = pause_.waiter(stopping_)]() mutable {
    give_way();
    if (stopping_) throw Stopped();
  };
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    since_ = Clock::now();
    share_ = 0.0;
  }
  const BesideWork beside(std::ref(go_on));
  return scans.force([&](double share) {
    go_on();
    const std::lock_guard<std::mutex> lock(mutex_);
    share_ = share;
  });
}

bool DeviceForceStream::isFoundWith(const StationCase& scan) const {
  return found_ && haveSamePixels(found_->newest, scan.scan) &&
         found_->hash == forceHash(*scan.settings);
}

std::optional<DeviceScans> DeviceForceStream::scansOf(const StationCase& scan) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!isFoundWith(scan)) return std::nullopt;
  return found_->scans;
}

Evidence DeviceForceStream::evidenceOf(const StationCase& scan) const {
  Evidence evidence;
  if (!wantsDeviceForce(scan.settings->device, scan.settings->device_force)) return evidence;
  evidence.why_no_device = kDeviceOnTopic;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (isFoundWith(scan)) {
    evidence.device = deviceEvidence(found_->force);
  }
  return evidence;
}

bool DeviceForceStream::isExpected(const ScanOfPart& scan) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return awaited_.has(scan);
}

void DeviceForceStream::taken(const ScanOfPart& scan) {
  const std::lock_guard<std::mutex> lock(mutex_);
  awaited_.remove(scan);
}

void DeviceForceStream::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const double seconds =
      since_ ? std::chrono::duration<double>(Clock::now() - *since_).count() : 0.0;
  if (counts_.failed > reported_failed_) {
    status.summary(diagnostic_msgs::DiagnosticStatus::WARN, last_failure_);
  } else {
    status.summary(diagnostic_msgs::DiagnosticStatus::OK,
                   counts_.offered == 0 ? "no scan of a device with a contact area yet"
                   : since_
                       ? "makes surfaces of the device's size, " + shortNumber(100.0 * share_, 2) +
                             " % after " + shortNumber(seconds, 2) + " s"
                       : "knows the newest scan's device");
  }
  status.add("offered", counts_.offered);
  status.add("found", counts_.found);
  status.add("judged_again", counts_.judged_again);
  status.add("skipped", counts_.skipped);
  status.add("failed", counts_.failed);
  status.add("waiting", waiting_.size());
  status.add("last_failure", last_failure_);
  status.add("last_time [s]", last_time_);
  status.add("time_so_far [s]", seconds);
  status.add("share_done", since_ ? share_ : 0.0);
  status.add("kept_scans", parts_.scans());
  status.add("kept_memory [bytes]", parts_.bytes());
  reported_failed_ = counts_.failed;
}

}  // namespace mems_stiction
