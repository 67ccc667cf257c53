#pragma once

/// @file
/// Log lines of threads that must not wait. rosconsole locks while roscpp looks up a cached
/// parameter for each line, and whoever sets a parameter in this process locks all of them until
/// the master has answered.

#include <string>

#include <ros/console.h>
#include <ros/node_handle.h>

namespace mems_stiction {

/// Has the line written by a thread of the process, in order. Returns at once; when far too many
/// wait, the newest are counted instead.
void logSoon(ros::console::Level level, std::string text);

/// While the master is there: asks it what roscpp else would ask with the first line of the log,
/// and with each one after it until it is answered.
void prepareLog();

/// Answers ~get_loggers of this process in roscpp's place, which with log4cxx 1.0 frees the log
/// that it asks: the next line from a new place in the code ends the process.
/// - @p handle any; its queue calls back
ros::ServiceServer serveLoggers(ros::NodeHandle& handle);

/// Waits for the lines that wait, but not for long.
void finishLog();

}  // namespace mems_stiction
