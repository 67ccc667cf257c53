#pragma once

/// @file
/// The stamp of a scan that was measured at a time that a file states.

#include <cstdint>
#include <string>

namespace mems_stiction {

/// The time of acquisition by ISO 8601, "2026-03-01T14:05:00.5+01:00", without a zone in that of
/// this machine; where it states no time of day, lies before 1980 or beyond tomorrow, or is no such
/// text: the file's own time.
/// - @p file_time [ns since 1970]
/// @return [ns since 1970], what a ROS stamp can hold
std::uint64_t acquisitionStamp(const std::string& acquisition_time, std::int64_t file_time);

}  // namespace mems_stiction
