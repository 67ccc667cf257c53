#include "source/source_accounting.hpp"

#include <algorithm>

#include <diagnostic_msgs/DiagnosticStatus.h>

#include "errors/one_line.hpp"
#include "ros/own_log.hpp"

namespace mems_stiction {
namespace {

/// Nodes that start together are there so soon: the log says nothing of it [s].
constexpr double kShortHindrance = 5.0;

}  // namespace

void SourceAccounting::published(const std::string& name) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++counts_.published;
  last_published_ = oneLine(name);
}

void SourceAccounting::refused(const std::string& name, const std::string& reason) {
  // Readers begin with the path of the file.
  const std::string text =
      shortened(oneLine(reason.find(name) != std::string::npos ? reason : name + ": " + reason),
                kLongestSentence);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++counts_.refused;
    last_refused_ = text;
  }
  logSoon(ros::console::levels::Warn, "refused " + text);
  tell_(text);
}

void SourceAccounting::givenUp(const std::string& name, int most) {
  refused(name,
          "given up for newer ones, since " + std::to_string(most) + " wait already (queue_size)");
}

void SourceAccounting::repeated() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++counts_.repeated;
}

void SourceAccounting::waits(std::uint64_t count, std::uint64_t gone) {
  const std::lock_guard<std::mutex> lock(mutex_);
  counts_.waiting = count;
  counts_.gone = gone;
}

void SourceAccounting::hindered(const std::string& by) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (hindered_by_.empty()) hindered_since_ = now;
  hindered_by_ = by;
  if (by.empty()) told_hindrance_.clear();
  if (by == told_hindrance_ || (now - hindered_since_).toSec() < kShortHindrance) return;
  told_hindrance_ = by;
  logSoon(ros::console::levels::Warn, by);
}

void SourceAccounting::show(const std::string& key, const std::string& value) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = std::find_if(shown_.begin(), shown_.end(),
                                  [&](const auto& entry) { return entry.first == key; });
  if (found == shown_.end()) {
    shown_.emplace_back(key, value);
  } else {
    found->second = value;
  }
}

SourceCounts SourceAccounting::counts() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return counts_;
}

void SourceAccounting::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using Level = diagnostic_msgs::DiagnosticStatus;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (counts_.refused > reported_refused_) {
    status.summary(Level::WARN, "refused " + last_refused_);
  } else if (!hindered_by_.empty()) {
    status.summary(Level::WARN, hindered_by_);
  } else if (counts_.found() == 0) {
    status.summary(Level::OK, "no scan yet");
  } else {
    status.summary(Level::OK, "every scan since the last report is published or waits");
  }
  reported_refused_ = counts_.refused;
  status.add("found", counts_.found());
  status.add("published", counts_.published);
  status.add("refused", counts_.refused);
  status.add("waiting", counts_.waiting);
  status.add("repeated", counts_.repeated);
  status.add("gone", counts_.gone);
  status.add("last_published", last_published_);
  status.add("last_refused", last_refused_);
  status.add("hindered_by", hindered_by_);
  for (const auto& [key, value] : shown_) status.add(key, value);
}

}  // namespace mems_stiction
