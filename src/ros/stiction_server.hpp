#pragma once

/// @file
/// The one implementation behind node and nodelet: connects topics and services with the worker
/// that owns the core.
///
/// Threads of the node: one for topics, transforms and timers; one for the core (WorkQueue); one
/// for each call of a service that waits, and one for the next; one for each action; one for
/// ~solve_half_space; one that solves the newest scan as a half-space, one that finds the force of
/// the newest device. Threads of the process: one that writes the log, and one that watches the
/// master and alone talks to it. The worker serves services that need the core before the scans
/// that wait. Actions and half-spaces take from it what they need, and then work by themselves.

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include "mems_stiction/GetLoad.h"
#include "mems_stiction/GetPrediction.h"
#include "mems_stiction/Predict.h"
#include "mems_stiction/SetLoad.h"
#include "mems_stiction/SetMechanicalLoad.h"
#include "mems_stiction/SetVoltage.h"
#include "ros/call_queue.hpp"
#include "ros/counter_surface_frame.hpp"
#include "ros/device_force_stream.hpp"
#include "ros/device_verdict_topic.hpp"
#include "ros/diagnostics.hpp"
#include "ros/guarded_queue.hpp"
#include "ros/half_space_calls.hpp"
#include "ros/half_space_stream.hpp"
#include "ros/live_predictor.hpp"
#include "ros/master_watch.hpp"
#include "ros/reconfigure_server.hpp"
#include "ros/registrations.hpp"
#include "ros/result_publisher.hpp"
#include "ros/scan_accounting.hpp"
#include "ros/scan_pairer.hpp"
#include "ros/station_actions.hpp"
#include "ros/transform_gate.hpp"
#include "ros/work_queue.hpp"

namespace mems_stiction {

/// Lives as long as the node; everything happens on its own threads.
class StictionServer {
 public:
  /// Reads the parameters and starts to serve.
  /// @throw OptionsError one line per bad parameter; then nothing was advertised.
  StictionServer(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                 const std::string& name);
  /// Finishes the scan at hand, answers or refuses the calls that wait, and joins every thread.
  ~StictionServer();
  StictionServer(const StictionServer&) = delete;
  StictionServer& operator=(const StictionServer&) = delete;

 private:
  StictionServer(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                 const std::string& name, const NodeConfiguration& configuration);
  void advertiseServices();
  void subscribe();
  void startTimers();
  /// A word where nobody publishes scans.
  void watchPublishers();

  void onScan(const sensor_msgs::ImageConstPtr& image, const ScanInfoConstPtr& info);
  void onCounterSurface(const sensor_msgs::ImageConstPtr& image, const ScanInfoConstPtr& info);
  /// @param pose of the counter-surface at the scan's stamp, when counter_surface/frame is set
  void queueScan(const sensor_msgs::ImageConstPtr& image, const ScanInfoConstPtr& info,
                 ros::SteadyTime arrival, const std::optional<SurfacePose>& pose);
  void predictAndPublish(const sensor_msgs::ImageConstPtr& image, const ScanInfoConstPtr& info,
                         ros::SteadyTime arrival, const std::optional<SurfacePose>& pose);
  /// What is said of a scan and its part once the half-space has judged it, or cannot.
  void takeHalfSpaceVerdict(const ScanOfPart& scan, const std::optional<Verdict>& verdict);
  /// The last scan to the stream that solves it as a half-space, if it is to be.
  void offerToHalfSpace(const PredictedScan& predicted);
  /// The last scan to both streams, under settings that have changed: to that of the half-space if
  /// its flags ask for it.
  void offerAgain(const PredictedScan& predicted);
  /// The last scan to the stream that finds its device's force.
  void offerToDevice(const PredictedScan& predicted);
  /// What is said of a scan and its part once the device's own force has judged it, or cannot.
  void takeDeviceVerdict(const DeviceAnswer& answer);
  /// And what was said of the newest scan of the part, if that waits for less now.
  void publishVerdict(const DeviceAnswer& answer);
  void showLastScan();
  void takeCounterSurface(const sensor_msgs::ImageConstPtr& image, const ScanInfoConstPtr& info);
  void rejectLone(const std_msgs::Header& header, const std::string& reason);
  /// What a restarted master has lost; the mirror of reconfigure shows the settings of now. @return
  /// false: no master
  bool putParametersBack(const MasterCalls& calls) const;
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);
  /// @param info null: the parameters serve.
  ReceivedScan receive(const sensor_msgs::ImageConstPtr& image, const ScanInfo* info) const;
  /// A scan that came by a call, with its pose; waits for the transform. Not for the worker and the
  /// topic thread.
  ReceivedScan receiveByCall(sensor_msgs::Image image, const ScanInfo& info) const;
  StationCase findCase(const sensor_msgs::Image& height, const ScanInfo& info);
  /// The one way to change settings, on the worker. @throw OptionsError, std::future_error.
  void change(const RunningSettings& settings);

  bool setLoad(SetLoad::Request& request, SetLoad::Response& response);
  bool setVoltage(SetVoltage::Request& request, SetVoltage::Response& response);
  bool setMechanicalLoad(SetMechanicalLoad::Request& request,
                         SetMechanicalLoad::Response& response);
  /// @param set makes the load that is asked for of the one that is set @param response as of the
  /// three services
  template <typename Response>
  void changeLoad(const std::function<void(LoadOptions&)>& set, Response& response);
  /// On the worker: nothing also when the last scan cannot be predicted.
  std::optional<PredictedScan> lastScanOrNothing();
  std::optional<LoadFigures> lastFiguresOrNothing();
  bool getLoad(GetLoad::Request& request, GetLoad::Response& response);
  bool getPrediction(GetPrediction::Request& request, GetPrediction::Response& response);
  void predict(Predict::Request& request, Predict::Response& response);
  bool resetSurface(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);

  // Declared before everything that holds handles on them.
  GuardedQueue topic_queue_;
  CallQueue service_queue_;
  ros::NodeHandle handle_;
  ros::NodeHandle private_handle_;
  ros::NodeHandle service_handle_;

  const NodeOptions options_;
  ScanAccounting accounting_;
  LivePredictor predictor_;  ///< touched by the worker only, but for what is for every thread
  ResultPublisher publisher_;
  SolutionPause half_space_pause_;                   ///< held while a scan is predicted
  std::unique_ptr<HalfSpaceStream> half_space_;      ///< null: half_space/enabled is false
  std::unique_ptr<DeviceForceStream> device_force_;  ///< null: device_force/enabled is not set
  DeviceVerdictTopic verdict_;
  WorkQueue worker_;
  std::atomic<bool> stopping_{false};

  std::unique_ptr<CounterSurfaceFrame>
      counter_surface_frame_;    ///< null: counter_surface/frame is not set
  TransformGate gate_;           ///< touched by the topic thread only
  ScanPairer scans_;             ///< touched by the topic thread only
  ScanPairer counter_surfaces_;  ///< touched by the topic thread only
  ros::Subscriber height_;
  ros::Subscriber scan_info_;
  ros::Subscriber counter_height_;
  ros::Subscriber counter_scan_info_;
  std::vector<ros::ServiceServer> services_;
  ReconfigureServer reconfigure_;
  StationActions actions_;
  HalfSpaceCalls half_space_calls_;
  Diagnostics diagnostics_;
  RememberedParameters parameters_;
  std::shared_ptr<MasterWatch> master_;
  ros::SteadyTimer diagnostic_timer_;
  ros::SteadyTimer pairing_timer_;
  ros::SteadyTimer publisher_timer_;
  int seconds_without_publisher_ = 0;  ///< of height; on the topic thread
  ros::SteadyTimer gate_timer_;

  ros::AsyncSpinner topic_spinner_;
};

}  // namespace mems_stiction
