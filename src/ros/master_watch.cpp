#include "ros/master_watch.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <ros/console.h>
#include <ros/master.h>
#include <xmlrpcpp/XmlRpcException.h>

#include "ros/own_log.hpp"

namespace mems_stiction {
namespace {

constexpr std::chrono::seconds kLookPeriod{2};
/// After a look that a member's end has cut short.
constexpr std::chrono::milliseconds kSoon{50};
/// A master that takes the call and does not answer is as good as none after so many periods.
constexpr double kPatience = 3.0 * kLookPeriod.count();

const char* meaningOf(Registrations::State state) {
  switch (state) {
    case Registrations::State::kKnown:
      return "the master knows this node";
    case Registrations::State::kForgotten:
      return "the master was restarted and does not know this node; it registers again";
    case Registrations::State::kTaken:
      return "the master was restarted and another node has this one's name there; end one of them";
    case Registrations::State::kNoMaster:
      break;
  }
  return "the master does not answer: connections that are there go on, nobody new finds this node";
}

}  // namespace

std::shared_ptr<MasterWatch> MasterWatch::ofThisProcess() {
  static std::mutex mutex;
  static std::weak_ptr<MasterWatch> shared;
  const std::lock_guard<std::mutex> lock(mutex);
  std::shared_ptr<MasterWatch> watch = shared.lock();
  if (!watch) {
    watch.reset(new MasterWatch);
    shared = watch;
  }
  return watch;
}

MasterWatch::MasterWatch() : thread_([this] { loop(); }) {}

MasterWatch::~MasterWatch() {
  ++calls_.give_up;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void MasterWatch::add(const void* owner, Member member) {
  {
    const std::lock_guard<std::mutex> lock(members_mutex_);
    members_[owner] = std::move(member);
  }
  std::unique_lock<std::mutex> lock(mutex_);
  const unsigned look = ++looks_asked_;
  changed_.notify_all();
  looked_.wait(lock, [&] { return looks_made_ >= look; });
}

void MasterWatch::remove(const void* owner) {
  ++calls_.give_up;
  {
    const std::lock_guard<std::mutex> lock(members_mutex_);
    members_.erase(owner);
  }
  --calls_.give_up;
  const std::lock_guard<std::mutex> lock(mutex_);
  due_.erase(owner);
}

void MasterWatch::writeSoon(const void* owner) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    due_.insert(owner);
    is_asked_ = true;
  }
  changed_.notify_all();
}

void MasterWatch::loop() {
  auto next_look = std::chrono::steady_clock::now();
  unsigned asked = 0;
  for (;;) {
    if (std::chrono::steady_clock::now() >= next_look) {
      const bool is_whole = look();
      next_look = std::chrono::steady_clock::now() +
                  (is_whole ? std::chrono::milliseconds(kLookPeriod) : kSoon);
      if (is_whole) {
        const std::lock_guard<std::mutex> lock(mutex_);
        looks_made_ = asked;
      }
      looked_.notify_all();
    }
    write();
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_until(lock, next_look,
                        [&] { return stopping_ || is_asked_ || looks_asked_ != asked; });
    if (stopping_) return;
    if (std::exchange(asked, looks_asked_) != asked) next_look = std::chrono::steady_clock::now();
  }
}

bool MasterWatch::look() {
  auto state = Registrations::State::kNoMaster;
  try {
    state = registrations_.look(calls_);
    if (ros::isShuttingDown()) return true;
    if (calls_.give_up > 0) return false;
    enter(state);
    if (state == Registrations::State::kForgotten) registerAgain();
  } catch (const XmlRpc::XmlRpcException&) {  // answers of another form are none
    enter(Registrations::State::kNoMaster);
  }
  return true;
}

/// What is due, unless the name is another node's, or nobody is there to take it: then later.
void MasterWatch::write() {
  std::set<const void*> due;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_asked_ = false;
    if (state_ != Registrations::State::kKnown) return;
    due.swap(due_);
  }
  for (const void* owner : due) {
    const std::lock_guard<std::mutex> lock(members_mutex_);
    const auto member = members_.find(owner);
    if (member == members_.end()) continue;
    const bool is_written = member->second.write(calls_);
    if (!std::exchange(member->second.is_doubtful, !is_written) && is_written) continue;
    const std::lock_guard<std::mutex> due_lock(mutex_);
    due_.insert(owner);
  }
}

void MasterWatch::registerAgain() {
  {
    const std::lock_guard<std::mutex> lock(members_mutex_);
    if (!std::all_of(members_.begin(), members_.end(),
                     [this](const auto& member) { return member.second.put_back(calls_); }))
      return;
  }
  if (registrations_.repeat(calls_)) enter(Registrations::State::kKnown);
}

void MasterWatch::enter(Registrations::State state) {
  const bool is_known = state == Registrations::State::kKnown;
  bool is_back = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_known) last_known_ = ros::SteadyTime::now();
    if (std::exchange(state_, state) == state) return;
    if (state == Registrations::State::kForgotten) is_forgotten_ = true;
    is_back = is_known && std::exchange(is_forgotten_, false);
    if (is_back) ++registered_again_;
  }
  if (is_back) {
    logSoon(ros::console::levels::Warn,
            "registered again, with the settings, loads and counts of before");
  } else if (!is_known) {
    logSoon(ros::console::levels::Warn, ros::master::getURI() + ": " + meaningOf(state));
  }
}

void MasterWatch::report(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const double since = (ros::SteadyTime::now() - last_known_).toSec();
  const bool is_known = state_ == Registrations::State::kKnown && since < kPatience;
  const Registrations::State shown = !is_known && state_ == Registrations::State::kKnown
                                         ? Registrations::State::kNoMaster
                                         : state_;
  status.summary(
      is_known ? diagnostic_msgs::DiagnosticStatus::OK : diagnostic_msgs::DiagnosticStatus::WARN,
      meaningOf(shown));
  status.add("registered_again", registered_again_);
  status.add("last_known [s ago]", since);
}

}  // namespace mems_stiction
