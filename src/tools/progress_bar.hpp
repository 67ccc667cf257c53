#pragma once

/// How far a long run is and when it will end: in place on a terminal, a line every half minute
/// elsewhere.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>

#include "numeric/words.hpp"
#include "status_line.hpp"

namespace mems_stiction {

/// How long the rest of a run takes, by the mean of the rows that are done. It falls while a row is
/// worked at, however long that takes, and is estimated anew with the next row that is done.
class TimeLeft {
 public:
  /// - @p total rows of the run
  /// - @p before rows that were there before it
  TimeLeft(std::size_t total, std::size_t before) : total_(total), before_(before), done_(before) {}

  /// - @p done rows by now
  /// - @p elapsed since the run began [s]; grows from call to call
  /// @return [s]; 0 when nothing is known, or what is worked at takes longer than those before
  double seconds(std::size_t done, double elapsed) {
    if (done > done_) {
      done_ = done;
      at_ = elapsed;
    }
    if (done_ == before_ || done_ >= total_) return 0.0;
    const double mean = at_ / static_cast<double>(done_ - before_);
    return mean * static_cast<double>(total_ - done_ - 1) + std::max(0.0, mean - (elapsed - at_));
  }

 private:
  std::size_t total_, before_, done_;
  double at_ = 0.0;  ///< when the last row was done [s]
};

class ProgressBar {
 public:
  /// @param total rows of the run; @param done rows that were there before it
  ProgressBar(std::size_t total, std::size_t done) : total_(total), left_(total, done) {}

  /// @param doing what the present scan is at; may be empty
  void show(std::size_t done, std::size_t failed, const std::string& doing = "") {
    const auto now = Clock::now();
    const double rest = left_.seconds(done, std::chrono::duration<double>(now - start_).count());
    const double wait = line_.onTerminal() ? 0.1 : 30.0;
    if (std::chrono::duration<double>(now - shown_).count() < wait) return;
    shown_ = now;
    std::string text = std::to_string(done) + " of " + countText(total_, "scan");
    if (failed > 0) text += ", " + std::to_string(failed) + " failed";
    if (rest >= 1.0) text += ", " + clock(rest) + " left";
    if (!doing.empty()) text += "; " + doing;
    if (line_.onTerminal()) {
      constexpr std::size_t kWidth = 30;
      const std::size_t filled = total_ > 0 ? kWidth * done / total_ : kWidth;
      const std::string bar = std::string(filled, '#') + std::string(kWidth - filled, '.');
      line_.show("[" + bar + "] " + text);
    } else {
      std::fprintf(stderr, "%s\n", text.c_str());
      std::fflush(stderr);
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// 75 -> "1:15"
  static std::string clock(double seconds) {
    const long whole = std::lround(seconds);
    const std::string rest = std::to_string(whole % 60);
    return std::to_string(whole / 60) + (rest.size() < 2 ? ":0" : ":") + rest;
  }

  std::size_t total_;
  TimeLeft left_;
  StatusLine line_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_ = line_.onTerminal() ? Clock::time_point{} : start_;
};

}  // namespace mems_stiction
