#pragma once

/// The force of a device as a program gives it: with progress on a terminal, from two seconds on.

#include <chrono>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>

#include "errors/one_line.hpp"
#include "status_line.hpp"

namespace mems_stiction {

/// The result of work(on_progress), which reports the share that is done.
/// - @p what as in "scan.tiff"
template <typename Work>
auto withProgress(const std::string& what, Work&& work) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::seconds kPatience{2};
  constexpr std::chrono::milliseconds kPeriod{100};
  StatusLine line;
  const auto begin = Clock::now();
  auto shown = begin;
  return work([&](double share) {
    const auto now = Clock::now();
    if (now - begin < kPatience || now - shown < kPeriod) return;
    shown = now;
    char text[64];
    std::snprintf(text, sizeof text, ": the force of the device, %.0f %%", 100.0 * share);
    line.show(oneLine(what) + text);
  });
}

}  // namespace mems_stiction
