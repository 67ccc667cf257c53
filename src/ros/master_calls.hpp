#pragma once

/// @file
/// Calls to the master, and to this process's own slave API, that end whatever the other side does.
/// Those of roscpp wait for ever for a master that takes a call and does not answer;
/// ros::param::set() and getCached() even hold the lock of all parameters then.

#include <atomic>
#include <string>

#include <xmlrpcpp/XmlRpcValue.h>

namespace mems_stiction {

/// For one thread, but for give_up.
class MasterCalls {
 public:
  /// As long as it is above 0, calls end at once, without an answer.
  std::atomic<int> give_up{0};

  /// Without waiting for a master that is not there. @return whether it answered at all; `payload`
  /// is invalid if it refused
  bool hears(const char* method, const XmlRpc::XmlRpcValue& request,
             XmlRpc::XmlRpcValue& payload) const;
  /// @return whether it answered, and did not refuse
  bool ask(const char* method, const XmlRpc::XmlRpcValue& request,
           XmlRpc::XmlRpcValue& payload) const;
  /// The same for the slave API of a process.
  bool askProcess(const std::string& address, const char* method,
                  const XmlRpc::XmlRpcValue& request, XmlRpc::XmlRpcValue& payload) const;
  /// That of this process, which alone lists its topics with their types.
  bool askOurselves(const char* method, const XmlRpc::XmlRpcValue& request,
                    XmlRpc::XmlRpcValue& payload) const;
  /// - @p name the full one
  bool setParameter(const std::string& name, const XmlRpc::XmlRpcValue& value) const;
};

/// Does a node of this name run already? A master gives a name to whoever asks last, and ends the
/// node that had it. Address of the process that has the name at the master and answers there.
/// Empty: there is none, it has died, or there is no master to ask. After ros::init(), before
/// ros::start().
std::string livingOwnerOf(const std::string& name);

/// Asks that process to end and waits for it, some seconds at most. One that still registers topics
/// while this process does would take the name back: then the master ends both.
/// - @p owner as livingOwnerOf() gives it
void endOwner(const std::string& owner);

/// While the node starts: waits for the master, as ros::param::set() does, but without its lock.
void setParameterAtStart(const std::string& name, const XmlRpc::XmlRpcValue& value);

}  // namespace mems_stiction
