#pragma once

/// @file
/// Notices that the ROS master has gone or was restarted, says so, and brings the process back into
/// the new one's books. Its thread is the only one that talks to the master once the node runs:
/// nobody waits for it, so it may wait for the master.
///
///     watch_ = MasterWatch::ofThisProcess();
///     watch_->add(this, {[this](const MasterCalls& calls) { return putParametersBack(calls); },
///         writeMirror});
///     watch_->writeSoon(this);

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <thread>

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/time.h>

#include "ros/master_calls.hpp"
#include "ros/registrations.hpp"

namespace mems_stiction {

/// One per process, since a process is registered as a whole: the nodelets of a manager share it.
/// Every thread may call.
class MasterWatch {
 public:
  /// What the master has of a member. Each is called again if it returns false, since the master
  /// was gone before the end.
  struct Member {
    std::function<bool(const MasterCalls&)>
        put_back;  ///< all of it, before the process is registered again
    std::function<bool(const MasterCalls&)> write;  ///< what changes while the node runs
    bool is_doubtful = false;  ///< the last write had no answer: a master that goes on may still do
                               ///< it, after the next
  };

  /// Watches for as long as somebody owns it.
  static std::shared_ptr<MasterWatch> ofThisProcess();
  ~MasterWatch();
  MasterWatch(const MasterWatch&) = delete;
  MasterWatch& operator=(const MasterWatch&) = delete;

  /// To be called once all of the member is advertised. Returns when the watch has seen at the
  /// master what the process offers there: a master that ends right afterwards costs nothing. One
  /// that is gone already, or silent, is waited for as long as a look takes, some seconds.
  void add(const void* owner, Member member);
  /// Afterwards nothing of the member runs any more.
  void remove(const void* owner);
  /// Has the member written as soon as the master takes it. Returns at once.
  void writeSoon(const void* owner);

  /// OK while the master knows the process, else WARN and what that means.
  void report(diagnostic_updater::DiagnosticStatusWrapper& status) const;

 private:
  MasterWatch();
  void loop();
  /// @return false: it was cut short, and is to be repeated
  bool look();
  void write();
  void registerAgain();
  /// Logs a state once, when it begins.
  void enter(Registrations::State state);

  Registrations registrations_;  ///< of the watch's thread
  MasterCalls calls_;

  std::mutex members_mutex_;  ///< held while members call the master
  std::map<const void*, Member> members_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool stopping_ = false;
  std::set<const void*> due_;  ///< to be written
  bool is_asked_ = false;      ///< since they were looked at
  std::condition_variable looked_;
  unsigned looks_asked_ = 0;  ///< by new members
  unsigned looks_made_ = 0;   ///< of those
  Registrations::State state_ = Registrations::State::kKnown;
  ros::SteadyTime last_known_ = ros::SteadyTime::now();
  bool is_forgotten_ = false;  ///< since the master knew the process last. Also a call whose answer
                               ///< was lost may have registered it.
  unsigned registered_again_ = 0;
  std::thread thread_;
};

}  // namespace mems_stiction
