#include "ros/own_log.hpp"

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

#include <ros/console_impl.h>
#include <ros/names.h>
#include <ros/param.h>
#include <ros/service_manager.h>
#include <roscpp/GetLoggers.h>
#include <roscpp/Logger.h>

namespace mems_stiction {
namespace {

constexpr std::size_t kMostLines = 1000;
constexpr std::chrono::seconds kLongestFinish{1};

/// Lives as long as the process, since nobody can end a thread that rosconsole holds. The process
/// ends behind its last line: rosconsole's locks go with the process, and a line that is written
/// then would abort it.
class OwnLog {
 public:
  static OwnLog& ofThisProcess() {
    static OwnLog* const log =
        new OwnLog;  // NOLINT(cppcoreguidelines-owning-memory): its thread uses it to the end
    return *log;
  }

  void push(ros::console::Level level, std::string text) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (lines_.size() < kMostLines) {
        lines_.emplace_back(level, std::move(text));
      } else {
        ++lost_;
      }
    }
    changed_.notify_all();
  }

  void finish() {
    std::unique_lock<std::mutex> lock(mutex_);
    finish(lock);
  }

 private:
  OwnLog() {
    std::thread([this] { loop(); }).detach();
    std::atexit([] { ofThisProcess().close(); });
  }

  void finish(std::unique_lock<std::mutex>& lock) {
    changed_.wait_for(lock, kLongestFinish, [this] { return lines_.empty(); });
  }

  void close() {
    std::unique_lock<std::mutex> lock(mutex_);
    finish(lock);
    is_closed_ = true;
    if (is_writing_) changed_.wait_for(lock, kLongestFinish, [this] { return !is_writing_; });
  }

  [[noreturn]] void loop() {
    std::unique_lock<std::mutex> lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this] { return !lines_.empty() && !is_closed_; });
      is_writing_ = true;
      const auto [level, text] = lines_.front();
      const std::size_t lost = std::exchange(lost_, 0);
      lock.unlock();
      ROS_LOG_STREAM(level, ROSCONSOLE_DEFAULT_NAME, text);
      if (lost > 0) {
        ROS_WARN_STREAM(
            lost << " lines of the log are missing: it could not be written for a while");
      }
      lock.lock();
      lines_.pop_front();  // only now, so that finish() waits for it
      is_writing_ = false;
      if (lines_.empty() || is_closed_) changed_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::pair<ros::console::Level, std::string>> lines_;
  std::size_t lost_ = 0;
  bool is_writing_ = false;
  bool is_closed_ = false;
};

/// Level and what GetLoggers calls it.
struct NamedLevel {
  ros::console::Level level;
  const char* name;
};
constexpr NamedLevel kLevels[] = {{ros::console::levels::Debug, "debug"},
                                  {ros::console::levels::Info, "info"},
                                  {ros::console::levels::Warn, "warn"},
                                  {ros::console::levels::Error, "error"},
                                  {ros::console::levels::Fatal, "fatal"}};

roscpp::Logger loggerOf(const std::string& name) {
  void* const handle = ros::console::impl::getHandle(name);
  roscpp::Logger logger;
  logger.name = name;
  for (const NamedLevel& named : kLevels) {
    logger.level = named.name;
    if (ros::console::impl::isEnabledFor(handle, named.level)) break;
  }
  return logger;
}

}  // namespace

void logSoon(ros::console::Level level, std::string text) {
  OwnLog::ofThisProcess().push(level, std::move(text));
}

void prepareLog() {
  bool ignored = false;
  ros::param::getCached("/rosout_disable_topics_generation", ignored);
}

ros::ServiceServer serveLoggers(ros::NodeHandle& handle) {
  const std::string name = ros::names::resolve("~get_loggers");
  ros::ServiceManager::instance()->unadvertiseService(name);
  const boost::function<bool(roscpp::GetLoggers::Request&, roscpp::GetLoggers::Response&)> answer =
      [](roscpp::GetLoggers::Request&, roscpp::GetLoggers::Response& response) {
        for (const char* logger : {"ros", ROSCONSOLE_DEFAULT_NAME, "ros.roscpp"})
          response.loggers.push_back(loggerOf(logger));
        return true;
      };
  return handle.advertiseService(name, answer);
}

void finishLog() { OwnLog::ofThisProcess().finish(); }

}  // namespace mems_stiction
