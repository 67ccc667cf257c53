#pragma once

/// @file
/// Notices that the ROS master has gone or was restarted, says so, and brings the process back into the new one's books.
///
///     watch_ = MasterWatch::ofThisProcess();
///     watch_->add(this, [this] { return putParametersBack(); });

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/time.h>

#include "mems_stiction/ros/registrations.hpp"

namespace mems_stiction {

/// One per process, since a process is registered as a whole: the nodelets of a manager share it. Every thread may call.
class MasterWatch {
 public:
  /// Puts back what the master held for a member, before the process is registered again.
  /// @return false: the master was gone before the end; it is called again.
  using Restore = std::function<bool()>;

  /// Watches for as long as somebody holds it.
  static std::shared_ptr<MasterWatch> ofThisProcess();
  ~MasterWatch();
  MasterWatch(const MasterWatch&) = delete;
  MasterWatch& operator=(const MasterWatch&) = delete;

  void add(const void* member, Restore restore);
  /// Afterwards `restore` does not run any more.
  void remove(const void* member);

  /// OK while the master knows the process, else WARN and what that means.
  void report(diagnostic_updater::DiagnosticStatusWrapper& status) const;

 private:
  MasterWatch();
  void loop();
  void look();
  void registerAgain();
  /// Logs a state once, when it begins.
  void enter(Registrations::State state);

  Registrations registrations_;  ///< of the watch's thread

  std::mutex members_mutex_;  ///< held while members restore
  std::map<const void*, Restore> members_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool stopping_ = false;
  Registrations::State state_ = Registrations::State::kKnown;
  ros::SteadyTime last_known_ = ros::SteadyTime::now();
  unsigned registered_again_ = 0;
  std::thread thread_;
};

}  // namespace mems_stiction
