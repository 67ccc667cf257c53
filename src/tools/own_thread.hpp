#pragma once

/// Work on a thread of its own, where there is one to be had.

#include <future>
#include <system_error>
#include <utility>

namespace mems_stiction {

/// Starts the work at once. If the system grants no more threads, whoever asks for the result does
/// the work.
template <typename Work>
auto onOwnThread(Work work) -> std::future<decltype(work())> {
  try {
    return std::async(std::launch::async, work);
  } catch (const std::system_error&) {
    return std::async(std::launch::deferred, std::move(work));
  }
}

}  // namespace mems_stiction
