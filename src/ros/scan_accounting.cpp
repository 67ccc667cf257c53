#include "ros/scan_accounting.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>

#include <diagnostic_msgs/DiagnosticStatus.h>

#include "errors/one_line.hpp"
#include "errors/plain_format.hpp"
#include "ros/own_log.hpp"

namespace mems_stiction {
namespace {

std::string named(const char* what, const std_msgs::Header& header, const std::string& reason) {
  PlainStream text;
  text << what << " of stamp " << header.stamp << ": " << shortened(reason, kLongestSentence);
  return text.str();
}

/// From the first quotation mark before a word to the last behind one: what a message says may hold
/// such marks itself.
std::string withoutQuotation(const std::string& text, char mark) {
  const auto is_in_word = [&text](std::size_t at) {
    return at < text.size() && std::isalnum(static_cast<unsigned char>(text[at])) != 0;
  };
  std::size_t opening = text.find(mark);
  while (opening != std::string::npos && opening > 0 && is_in_word(opening - 1))
    opening = text.find(mark, opening + 1);
  std::size_t closing = text.rfind(mark);
  while (closing != std::string::npos && closing > 0 && is_in_word(closing + 1))
    closing = text.rfind(mark, closing - 1);
  if (opening == std::string::npos || closing == std::string::npos || closing <= opening)
    return text;
  return text.substr(0, opening) + text.substr(closing + 1);
}

/// Warnings of one kind differ in their figures, and in words that they quote from messages.
std::string kindOf(const std::string& warning) {
  const std::string text = withoutQuotation(withoutQuotation(warning, '\''), '"');
  std::string kind;
  std::copy_if(text.begin(), text.end(), std::back_inserter(kind),
               [](unsigned char character) { return std::isdigit(character) == 0; });
  return kind;
}

/// Reasons may name; so many of them are remembered.
constexpr std::size_t kMostKinds = 100;

/// Beyond a period, so that a busy machine is not warned of [s].
constexpr double kNoticedPause = 1.0;

/// Ends of sequences that may go on.
constexpr std::size_t kMostSequences = 16;

}  // namespace

ScanAccounting::ScanAccounting(ros::WallDuration warning_period, ros::WallDuration report_period)
    : warning_period_(warning_period), report_period_(report_period) {}

void ScanAccounting::arrived(const std_msgs::Header& header) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!sequences_.empty() && header.stamp <= sequences_.front().stamp)
    ++counts_.stamps_not_increasing;
  // The sequence that this number continues, or else the one whose last number is the nearest
  // below.
  auto chosen = std::find_if(sequences_.begin(), sequences_.end(), [&](const Sequence& sequence) {
    return header.seq == sequence.last + 1;
  });
  if (chosen == sequences_.end()) {
    for (auto one = sequences_.begin(); one != sequences_.end(); ++one) {
      if (one->last < header.seq && (chosen == sequences_.end() || one->last > chosen->last))
        chosen = one;
    }
  }
  Sequence next{header.seq, header.stamp, 0};
  if (chosen != sequences_.end()) {
    counts_.missing_by_sequence -= chosen->missing;
    const std::uint64_t missing = header.stamp >= chosen->stamp ? header.seq - chosen->last - 1 : 0;
    counts_.missing_by_sequence += missing;
    chosen->missing = missing;
    // After a gap the old end stays: the number may be another publisher's.
    if (header.seq == chosen->last + 1) sequences_.erase(chosen);
  }
  sequences_.push_front(next);
  if (sequences_.size() > kMostSequences) sequences_.pop_back();
}

void ScanAccounting::received() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++counts_.received;
}

void ScanAccounting::predicted(double latency, double processing_time) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++counts_.predicted;
  last_latency_ = latency;
  max_latency_ = std::max(max_latency_, latency);
  last_processing_time_ = processing_time;
}

void ScanAccounting::dropped(const std_msgs::Header& header, const std::string& reason) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++counts_.dropped;
  last_reason_ = named("dropped the scan", header, reason);
  warnThrottled(reason, last_reason_);
}

void ScanAccounting::rejected(const std_msgs::Header& header, const std::string& reason) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++counts_.rejected;
  last_reason_ = named("rejected the scan", header, reason);
  warnThrottled(reason, last_reason_);
}

void ScanAccounting::counterSurfaceAccepted() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++counts_.counter_surfaces;
}

void ScanAccounting::counterSurfaceRejected(const std_msgs::Header& header,
                                            const std::string& reason) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++counts_.counter_surfaces_rejected;
  last_reason_ = named("rejected the counter-surface", header, reason);
  warnThrottled(reason, last_reason_);
}

void ScanAccounting::warn(const std_msgs::Header& header, const std::string& text) {
  const std::lock_guard<std::mutex> lock(mutex_);
  warnThrottled(text, named("the scan", header, text));
}

void ScanAccounting::warnThrottled(const std::string& kind, const std::string& text) {
  if (throttles_.size() > kMostKinds) throttles_.clear();
  Throttle& throttle = throttles_[kindOf(kind)];
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (!throttle.last_shown.isZero() && now - throttle.last_shown < warning_period_) {
    ++throttle.suppressed;
    return;
  }
  logSoon(ros::console::levels::Warn, throttle.suppressed == 0
                                          ? text
                                          : text + " (and " + std::to_string(throttle.suppressed) +
                                                " warnings of this kind since the last one shown)");
  throttle.last_shown = now;
  throttle.suppressed = 0;
}

ScanCounts ScanAccounting::counts() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return counts_;
}

void ScanAccounting::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const ros::SteadyTime now = ros::SteadyTime::now();
  const double elapsed = last_report_.isZero() ? 0.0 : (now - last_report_).toSec();
  const double rate = elapsed > 0.0 ? (counts_.predicted - reported_.predicted) / elapsed : 0.0;

  const bool lost = counts_.dropped > reported_.dropped || counts_.rejected > reported_.rejected ||
                    counts_.missing_by_sequence > reported_.missing_by_sequence ||
                    counts_.counter_surfaces_rejected > reported_.counter_surfaces_rejected;
  if (lost) {
    status.summary(
        diagnostic_msgs::DiagnosticStatus::WARN,
        last_reason_.empty() ? "scans are missing by their sequence numbers" : last_reason_);
  } else if (counts_.received == 0) {
    status.summary(diagnostic_msgs::DiagnosticStatus::OK, "no scan yet");
  } else {
    status.summary(diagnostic_msgs::DiagnosticStatus::OK,
                   "every scan since the last report is predicted or waits");
  }
  const double pause = elapsed - report_period_.toSec();
  longest_pause_ = std::max(longest_pause_, pause);
  if (pause > kNoticedPause + report_period_.toSec()) {
    PlainStream text;
    text << "the node stood still for " << std::lround(pause)
         << " s: stopped, suspended, or without a processor";
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN, text.str());
  }
  status.add("received", counts_.received);
  status.add("predicted", counts_.predicted);
  status.add("dropped", counts_.dropped);
  status.add("rejected", counts_.rejected);
  status.add("waiting", counts_.waiting());
  status.add("missing_by_sequence", counts_.missing_by_sequence);
  status.add("stamps_not_increasing", counts_.stamps_not_increasing);
  status.add("counter_surfaces", counts_.counter_surfaces);
  status.add("counter_surfaces_rejected", counts_.counter_surfaces_rejected);
  status.add("last_reason", last_reason_);
  status.add("rate [Hz]", rate);
  status.add("last_latency [s]", last_latency_);
  status.add("max_latency [s]", max_latency_);
  status.add("last_processing_time [s]", last_processing_time_);
  status.add("longest_pause [s]", longest_pause_);
  reported_ = counts_;
  last_report_ = now;
}

}  // namespace mems_stiction
