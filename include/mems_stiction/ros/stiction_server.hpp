#pragma once

/// The one implementation behind node and nodelet: connects topics and services with the worker that owns the core.
///
/// Threads: one for topics and timers, one for the core (WorkQueue), two for services. A service that needs the core is
/// run by the worker before the scans that wait.

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <diagnostic_updater/diagnostic_updater.h>
#include <image_transport/image_transport.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include "mems_stiction/GetLoad.h"
#include "mems_stiction/Predict.h"
#include "mems_stiction/SetLoad.h"
#include "mems_stiction/ros/live_predictor.hpp"
#include "mems_stiction/ros/result_publisher.hpp"
#include "mems_stiction/ros/scan_accounting.hpp"
#include "mems_stiction/ros/scan_pairer.hpp"
#include "mems_stiction/ros/work_queue.hpp"

namespace mems_stiction {

class StictionServer {
 public:
  /// Reads the parameters and starts to serve.
  /// @throw OptionsError one line per bad parameter; then nothing was advertised.
  StictionServer(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle, const std::string& name);
  /// Finishes the scan at hand, answers or refuses the calls that wait, and joins every thread.
  ~StictionServer();
  StictionServer(const StictionServer&) = delete;
  StictionServer& operator=(const StictionServer&) = delete;

 private:
  void advertiseServices();
  void subscribe();
  void startTimers();

  void onScan(const sensor_msgs::ImageConstPtr& image, const ScanInfoConstPtr& info);
  void onCounterSurface(const sensor_msgs::ImageConstPtr& image, const ScanInfoConstPtr& info);
  void predictAndPublish(const sensor_msgs::ImageConstPtr& image, const ScanInfoConstPtr& info, ros::WallTime arrival);
  void takeCounterSurface(const sensor_msgs::ImageConstPtr& image, const ScanInfoConstPtr& info);
  void rejectLone(const std_msgs::Header& header, const std::string& reason);
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);
  /// @param info null: the parameters serve.
  ReceivedScan receive(const sensor_msgs::ImageConstPtr& image, const ScanInfo* info) const;

  bool setLoad(SetLoad::Request& request, SetLoad::Response& response);
  bool getLoad(GetLoad::Request& request, GetLoad::Response& response);
  bool predict(Predict::Request& request, Predict::Response& response);
  bool resetSurface(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);

  // Declared before everything that holds handles on them.
  ros::CallbackQueue topic_queue_;
  ros::CallbackQueue service_queue_;
  ros::NodeHandle handle_;
  ros::NodeHandle private_handle_;
  ros::NodeHandle service_handle_;

  NodeConfiguration configuration_;
  ScanAccounting accounting_;
  LivePredictor predictor_;  ///< touched by the worker only
  ResultPublisher publisher_;
  WorkQueue worker_;
  mutable std::mutex load_mutex_;
  LoadOptions load_;  ///< what ~get_load tells, without waiting for the worker

  ScanPairer scans_;             ///< touched by the topic thread only
  ScanPairer counter_surfaces_;  ///< touched by the topic thread only
  image_transport::ImageTransport transport_;
  image_transport::Subscriber height_;
  ros::Subscriber scan_info_;
  image_transport::Subscriber counter_height_;
  ros::Subscriber counter_scan_info_;
  std::vector<ros::ServiceServer> services_;
  diagnostic_updater::Updater diagnostics_;
  ros::WallTimer diagnostic_timer_;
  ros::WallTimer pairing_timer_;

  ros::AsyncSpinner topic_spinner_;
  ros::AsyncSpinner service_spinner_;
};

}  // namespace mems_stiction
