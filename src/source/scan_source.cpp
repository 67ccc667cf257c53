#include "source/scan_source.hpp"

#include <std_msgs/String.h>

#include "ros/own_log.hpp"

namespace mems_stiction {
namespace {

constexpr char kRefusedTopic[] = "refused";
/// What was refused while nobody listened is on the log.
constexpr std::uint32_t kRefusedQueue = 1000;

std_msgs::String textMessage(const std::string& text) {
  std_msgs::String message;
  message.data = text;
  return message;
}

}  // namespace

ScanSource::ScanSource(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                       const std::string& name)
    : options_(readSourceParameters(private_handle)),
      handle_(withQueue(handle, queue_)),
      private_handle_(withQueue(private_handle, queue_)),
      refused_(private_handle_.advertise<std_msgs::String>(kRefusedTopic, kRefusedQueue)),
      accounting_([this](const std::string& text) { refused_.publish(textMessage(text)); }),
      publisher_(handle_, options_),
      diagnostics_(handle_, name),
      spinner_(1, &queue_) {
  prepareLog();
  loggers_ = serveLoggers(private_handle_);
  diagnostics_.add("scan_source", [this](auto& status) { accounting_.report(status); });
  diagnostics_timer_ =
      handle_.createSteadyTimer(ros::WallDuration(options_.diagnostic_period),
                                [this](const ros::SteadyTimerEvent&) { diagnostics_.publish(); });
  if (options_.source == SourceKind::kFolder) {
    folder_ = std::make_unique<FolderSource>(options_, name, publisher_, accounting_);
  } else if (options_.source == SourceKind::kLines) {
    lines_ =
        std::make_unique<LineSource>(options_, handle_, private_handle_, publisher_, accounting_);
  } else {
    cloud_ = std::make_unique<CloudSource>(options_, handle_, publisher_, accounting_);
  }
  master_ = MasterWatch::ofThisProcess();
  const auto nothing = [](const MasterCalls&) { return true; };
  master_->add(this, {nothing, nothing});
  spinner_.start();
}

ScanSource::~ScanSource() {
  master_->remove(this);
  folder_.reset();
  cloud_.reset();
  spinner_.stop();  // lines are put together on its thread
  lines_.reset();
  finishLog();
}

}  // namespace mems_stiction
