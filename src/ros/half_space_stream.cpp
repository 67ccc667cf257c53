#include "ros/half_space_stream.hpp"

#include <utility>

#include <diagnostic_msgs/DiagnosticStatus.h>

#include "evaluation/frame_load.hpp"
#include "mems_stiction/evaluation/half_space_scan.hpp"
#include "ros/background_thread.hpp"
#include "ros/half_space_conversion.hpp"
#include "ros/provenance_conversion.hpp"
#include "ros/verdict_conversion.hpp"

namespace mems_stiction {

HalfSpaceStream::HalfSpaceStream(const ros::NodeHandle& handle, const HalfSpaceOptions& options, SolutionPause& pause,
                                 Warn warn, Judged judged, Beside beside)
    : solver_(options),
      pause_(pause),
      publisher_(handle),
      warn_(std::move(warn)),
      judged_(std::move(judged)),
      beside_(std::move(beside)) {}

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

void HalfSpaceStream::offer(const StationCase& predicted, const ScanOfPart& scan, const cv::Mat& model_map,
                            const DrawnCurve& model_curve) {
  std::optional<Task> task(
      Task{predicted, scan, model_map.clone(), model_curve});  // the model uses its map's memory again
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (waiting_) ++counts_.skipped;
    ++counts_.offered;
    waiting_.swap(task);
  }
  changed_.notify_all();
}

void HalfSpaceStream::loop() {
  yieldToOtherThreads();
  for (;;) {
    std::optional<Task> task;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [this] { return stopping_ || waiting_; });
      if (stopping_) return;
      task.swap(waiting_);
    }
    solve(*task);
  }
}

void HalfSpaceStream::solve(const Task& task) {
  const StationCase& scan = task.predicted;
  Options model = scan.settings->model;
  HalfSpaceControl control;
  control.cancel = &stopping_;
  control.give_way = pause_.waiter(stopping_);
  HalfSpaceSolution message;
  std::optional<Verdict> verdict;
  cv::Mat map;
  try {
    model = onFrame(model, scan.settings->device, scan.scan.surfaces);
    const HalfSpaceProblem problem = halfSpaceProblem(scan.scan, model);
    const SolvedHalfSpace solved = solver_.solve(problem, control);
    message = halfSpaceMessage(solved, model.load, scan.header);
    if (!stopping_) {
      verdict = halfSpaceVerdict(solved, scan.scan, model, *scan.settings, beside_(scan));
      fillVerdict(*verdict, message);
    }
    map = halfSpaceContactMap(solved, problem, solver_.options(), scan.scan.refinement);
  } catch (const std::exception& error) {
    message = refusedMessage(error.what(), model.load, scan.header);
  }
  if (stopping_) return;
  fillProvenance(task.scan.provenance, message);
  const bool is_solved = message.status == HalfSpaceSolution::SOLVED;
  publisher_.publish(message, task.model_map, map, task.model_curve);
  if (verdict) judged_(task.scan, *verdict);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++(is_solved ? counts_.solved : counts_.failed);
    if (is_solved) last_time_ = message.processing_time;
    if (!is_solved) last_failure_ = message.message;
  }
  if (!is_solved) warn_(scan.header, "half-space: " + message.message);
}

void HalfSpaceStream::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (counts_.failed > reported_failed_) {
    status.summary(diagnostic_msgs::DiagnosticStatus::WARN, last_failure_);
  } else {
    status.summary(diagnostic_msgs::DiagnosticStatus::OK,
                   counts_.offered == 0 ? "no scan yet" : "solves the newest scan");
  }
  status.add("offered", counts_.offered);
  status.add("solved", counts_.solved);
  status.add("skipped", counts_.skipped);
  status.add("failed", counts_.failed);
  status.add("last_failure", last_failure_);
  status.add("last_solution_time [s]", last_time_);
  reported_failed_ = counts_.failed;
}

}  // namespace mems_stiction
