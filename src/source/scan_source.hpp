#pragma once

/// @file
/// The one implementation behind the program scan_source and its nodelet: opens the door that the
/// parameters name, and says on /diagnostics what comes through it.

#include <memory>
#include <string>

#include <ros/node_handle.h>
#include <ros/spinner.h>

#include "ros/diagnostics.hpp"
#include "ros/guarded_queue.hpp"
#include "ros/master_watch.hpp"
#include "source/cloud_source.hpp"
#include "source/folder_source.hpp"
#include "source/line_source.hpp"
#include "source/scan_publisher.hpp"
#include "source/source_accounting.hpp"
#include "source/source_options.hpp"

namespace mems_stiction {

/// Lives as long as the node; everything happens on its own threads.
class ScanSource {
 public:
  /// Reads the parameters and begins.
  /// @throw OptionsError one line per bad parameter. @throw FileError for a state file that cannot
  /// be used.
  ScanSource(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
             const std::string& name);
  /// Finishes the scan at hand, and joins every thread.
  ~ScanSource();
  ScanSource(const ScanSource&) = delete;
  ScanSource& operator=(const ScanSource&) = delete;

 private:
  const SourceOptions options_;
  GuardedQueue queue_;
  ros::NodeHandle handle_, private_handle_;
  ros::Publisher refused_;
  ros::ServiceServer loggers_;
  SourceAccounting accounting_;
  ScanPublisher publisher_;
  Diagnostics diagnostics_;
  ros::SteadyTimer diagnostics_timer_;
  std::unique_ptr<FolderSource> folder_;
  std::unique_ptr<CloudSource> cloud_;
  std::unique_ptr<LineSource> lines_;
  std::shared_ptr<MasterWatch> master_;
  ros::AsyncSpinner spinner_;
};

}  // namespace mems_stiction
