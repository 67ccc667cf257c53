#include "ros/half_space_stream.hpp"

#include <algorithm>
#include <utility>

#include <diagnostic_msgs/DiagnosticStatus.h>

#include "errors/error_text.hpp"
#include "evaluation/frame_load.hpp"
#include "mems_stiction/evaluation/half_space_scan.hpp"
#include "ros/background_thread.hpp"
#include "ros/half_space_conversion.hpp"
#include "ros/image_conversion.hpp"
#include "ros/message_parts.hpp"
#include "ros/topic_names.hpp"

namespace mems_stiction {
namespace {

/// Scans that wait as their flags ask for it; the one that has waited longest goes.
constexpr std::size_t kMostCallsWaiting = 8;

}  // namespace

HalfSpaceStream::HalfSpaceStream(const ros::NodeHandle& handle, const HalfSpaceOptions& options,
                                 SolutionPause& pause, Warn warn, Judged judged, Solved solved,
                                 Beside beside)
    : solver_(options),
      pause_(pause),
      transport_(handle),
      warn_(std::move(warn)),
      judged_(std::move(judged)),
      solved_(std::move(solved)),
      beside_(std::move(beside)) {
  ros::NodeHandle node(handle);
  solution_publisher_ = node.advertise<HalfSpaceSolution>(kHalfSpaceTopic, kPredictionQueue);
  contact_map_publisher_ = transport_.advertise(kHalfSpaceContactMapTopic, kMapQueue);
}

void HalfSpaceStream::start() {
  thread_ = std::thread([this] { loop(); });
}

void HalfSpaceStream::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void HalfSpaceStream::offer(const HalfSpaceCall& call, const StationCase& predicted,
                            const ScanOfPart& scan) {
  Task task{call, predicted, scan};
  const std::size_t most = call.why.empty() ? 1 : kMostCallsWaiting;
  std::vector<Task> gone;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++counts_.offered;
    // the same scan under other settings is another question, and the newer one
    const auto same = std::find_if(waiting_.begin(), waiting_.end(),
                                   [&](const Task& waiting) { return waiting.scan.id == scan.id; });
    if (same != waiting_.end()) {
      ++counts_.skipped;
      awaited_.remove(same->scan);
      waiting_.erase(same);
    }
    while (waiting_.size() >= most) {
      ++counts_.skipped;
      gone.push_back(std::move(waiting_.front()));
      waiting_.erase(waiting_.begin());
    }
    awaited_.add(task.scan);
    waiting_.push_back(std::move(task));
  }
  changed_.notify_all();
  for (const Task& lost : gone) {
    judged_(lost.scan, std::nullopt);
    if (lost.call.why.empty()) continue;
    warn_(lost.predicted.header,
          "half-space: " + lost.call.why + " asks for it, but newer scans came before its turn");
  }
}

void HalfSpaceStream::loop() {
  yieldToOtherThreads();
  for (;;) {
    std::optional<Task> task;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [this] { return stopping_ || !waiting_.empty(); });
      if (stopping_) return;
      task = std::move(waiting_.back());
      waiting_.pop_back();
    }
    std::optional<Verdict> verdict;
    try {
      verdict = solve(*task);
    } catch (const std::exception& error) {  // of the publishers: the next scan must get its turn
      warn_(task->predicted.header, "half-space: " + reasonOf(error));
    }
    if (!stopping_) judged_(task->scan, verdict);
  }
}

std::optional<Verdict> HalfSpaceStream::solve(const Task& task) {
  const StationCase& scan = task.predicted;
  Options model = scan.settings->model;
  HalfSpaceControl control;
  control.cancel = &stopping_;
  control.give_way = pause_.waiter(stopping_);
  HalfSpaceSolution message;
  std::optional<Verdict> verdict;
  SolvedHalfSpace solved;
  cv::Mat map;
  try {
    model = onFrame(model, scan.settings->device, scan.scan.surfaces);
    const HalfSpaceProblem problem = halfSpaceProblem(scan.scan, model);
    solved = answerOf(task.call, solver_, problem, control);
    message = halfSpaceMessage(solved, model.load, scan.header);
    if (!stopping_) {
      Evidence beside = beside_(scan);
      beside.why_half_space = task.call.why;
      verdict = halfSpaceVerdict(solved, scan.scan, model, *scan.settings, beside);
      fillVerdict(*verdict, message);
    }
    map = halfSpaceContactMap(solved, problem, solver_.options(), scan.scan.refinement);
  } catch (const std::exception& error) {
    message = refusedMessage(error.what(), model.load, scan.header);
  }
  if (stopping_) return std::nullopt;
  fillProvenance(task.scan.provenance, message);
  const bool is_solved = message.status == HalfSpaceSolution::SOLVED;
  publish(message, map);
  if (verdict) solved_(scan, solved, task.call.why);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++(is_solved ? counts_.solved : counts_.failed);
    if (is_solved) last_time_ = message.processing_time;
    if (!is_solved) last_failure_ = message.message;
  }
  if (!is_solved) warn_(scan.header, "half-space: " + message.message);
  return verdict;
}

bool HalfSpaceStream::isExpected(const ScanOfPart& scan) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return awaited_.has(scan);
}

void HalfSpaceStream::taken(const ScanOfPart& scan) {
  const std::lock_guard<std::mutex> lock(mutex_);
  awaited_.remove(scan);
}

void HalfSpaceStream::publish(const HalfSpaceSolution& solution, const cv::Mat& map) const {
  if (!map.empty() && contact_map_publisher_.getNumSubscribers() > 0)
    contact_map_publisher_.publish(contactMapImage(map, solution.header));
  // Last, so that whoever waits for the solution finds the map sent.
  solution_publisher_.publish(solution);
}

void HalfSpaceStream::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const HalfSpaceOptions& options = solver_.options();
  const std::lock_guard<std::mutex> lock(mutex_);
  if (counts_.failed > reported_failed_) {
    status.summary(diagnostic_msgs::DiagnosticStatus::WARN, last_failure_);
  } else {
    status.summary(diagnostic_msgs::DiagnosticStatus::OK,
                   counts_.offered == 0 ? "no scan yet"
                   : options.enabled == HalfSpaceUse::kFlagged
                       ? "solves scans whose flags ask for it"
                       : "solves the newest scan");
  }
  status.add("offered", counts_.offered);
  status.add("solved", counts_.solved);
  status.add("skipped", counts_.skipped);
  status.add("failed", counts_.failed);
  status.add("waiting", waiting_.size());
  status.add("last_failure", last_failure_);
  status.add("last_solution_time [s]", last_time_);
  reported_failed_ = counts_.failed;
}

}  // namespace mems_stiction
