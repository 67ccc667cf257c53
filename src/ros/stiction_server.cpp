#include "mems_stiction/ros/stiction_server.hpp"

#include <thread>
#include <utility>

#include <boost/bind/bind.hpp>
#include <boost/make_shared.hpp>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/one_line.hpp"
#include "mems_stiction/ros/prediction_conversion.hpp"
#include "mems_stiction/ros/topic_names.hpp"

namespace mems_stiction {
namespace {

constexpr std::uint32_t kServiceThreads = 2;
const ros::WallDuration kGatePeriod(0.01);

ros::NodeHandle withQueue(ros::NodeHandle handle, ros::CallbackQueue& queue) {
  handle.setCallbackQueue(&queue);
  return handle;
}

/// An unlimited queue keeps every scan.
std::size_t capacityOf(const NodeOptions& options) {
  return options.drop_policy == DropPolicy::kAll ? 0 : static_cast<std::size_t>(options.queue_size);
}

}  // namespace

StictionServer::StictionServer(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                               const std::string& name)
    : StictionServer(handle, private_handle, name, readParameters(private_handle)) {}

StictionServer::StictionServer(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                               const std::string& name, const NodeConfiguration& configuration)
    : handle_(withQueue(handle, topic_queue_)),
      private_handle_(withQueue(private_handle, topic_queue_)),
      service_handle_(withQueue(private_handle, service_queue_)),
      options_(configuration.node),
      accounting_(ros::WallDuration(options_.warning_period)),
      predictor_(configuration.core, options_.accumulate_deformation),
      publisher_(handle_, options_.display, [this] { worker_.push([this] { showLastScan(); }); }),
      worker_(capacityOf(options_)),
      counter_surface_frame_(options_.transform.frame.empty()
                                 ? nullptr
                                 : std::make_unique<CounterSurfaceFrame>(handle_, options_.transform.frame)),
      gate_(ros::WallDuration(options_.transform.timeout),
            [this](const std_msgs::Header& header) { return counter_surface_frame_->poseAt(header); }),
      scans_(
          ros::WallDuration(options_.pairing_timeout),
          [this](const auto& image, const auto& info) { onScan(image, info); },
          [this](const auto& header, const auto& reason) { rejectLone(header, reason); }),
      counter_surfaces_(
          ros::WallDuration(options_.pairing_timeout),
          [this](const auto& image, const auto& info) { onCounterSurface(image, info); },
          [this](const auto& header, const auto& reason) { accounting_.counterSurfaceRejected(header, reason); }),
      transport_(handle_),
      reconfigure_(service_handle_, predictor_.settings(), [this](const auto& settings) { change(settings); }),
      actions_(service_handle_, [this](const auto& height, const auto& info) { return findCase(height, info); }),
      diagnostics_(handle_, private_handle_, name),
      topic_spinner_(1, &topic_queue_),
      service_spinner_(kServiceThreads, &service_queue_) {
  advertiseServices();
  subscribe();
  startTimers();
  worker_.start();
  actions_.start();
  service_spinner_.start();
  topic_spinner_.start();
}

StictionServer::~StictionServer() {
  // Long runs and the worker first: a service that waits for them gets its refusal, so that the spinners can end.
  stopping_ = true;
  actions_.stop();
  worker_.stop();
  service_spinner_.stop();
  topic_spinner_.stop();
  const ScanCounts counts = accounting_.counts();
  if (counts.waiting() > 0) ROS_INFO_STREAM(counts.waiting() << " scans were still waiting at shutdown");
}

void StictionServer::advertiseServices() {
  services_ = {service_handle_.advertiseService(kSetLoadService, &StictionServer::setLoad, this),
               service_handle_.advertiseService(kGetLoadService, &StictionServer::getLoad, this),
               service_handle_.advertiseService(kPredictService, &StictionServer::predict, this),
               service_handle_.advertiseService(kResetSurfaceService, &StictionServer::resetSurface, this)};
}

void StictionServer::subscribe() {
  using ImagePtr = sensor_msgs::ImageConstPtr;
  const image_transport::TransportHints hints("raw", ros::TransportHints(), private_handle_);
  const bool use_scan_info = options_.use_scan_info;
  const auto subscribePair = [&](const char* image_topic, const char* info_topic, ScanPairer& pairer, auto on_single,
                                 image_transport::Subscriber& image_subscriber, ros::Subscriber& info_subscriber) {
    if (!use_scan_info) {
      image_subscriber = transport_.subscribe(
          image_topic, kSubscriberQueue,
          [this, on_single](const ImagePtr& image) { (this->*on_single)(image, nullptr); }, {}, hints);
      return;
    }
    image_subscriber = transport_.subscribe(
        image_topic, kSubscriberQueue, [&pairer](const ImagePtr& image) { pairer.add(image, ros::WallTime::now()); },
        {}, hints);
    info_subscriber = handle_.subscribe<ScanInfo>(
        info_topic, kSubscriberQueue,
        [&pairer](const ScanInfoConstPtr& info) { pairer.add(info, ros::WallTime::now()); });
  };
  subscribePair(kHeightTopic, kScanInfoTopic, scans_, &StictionServer::onScan, height_, scan_info_);
  if (predictor_.settings().snapshot()->counter_surface.type == CounterSurfaceType::kTopic) {
    subscribePair(kCounterHeightTopic, kCounterScanInfoTopic, counter_surfaces_, &StictionServer::onCounterSurface,
                  counter_height_, counter_scan_info_);
  }
}

void StictionServer::startTimers() {
  diagnostics_.setHardwareID("none");
  diagnostics_.add("scans", this, &StictionServer::report);
  diagnostic_timer_ = handle_.createWallTimer(ros::WallDuration(options_.diagnostic_period),
                                              [this](const ros::WallTimerEvent&) { diagnostics_.force_update(); });
  pairing_timer_ = handle_.createWallTimer(ros::WallDuration(0.2 * options_.pairing_timeout), [this](const auto&) {
    scans_.expire(ros::WallTime::now());
    counter_surfaces_.expire(ros::WallTime::now());
  });
  if (counter_surface_frame_) {
    gate_timer_ = handle_.createWallTimer(kGatePeriod, [this](const auto&) { gate_.poll(ros::WallTime::now()); });
  }
}

void StictionServer::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  accounting_.report(status);
  status.add("cleaned", predictor_.cleanings());
  const std::size_t waiting = worker_.waitingScans();
  status.add("waiting_for_worker", waiting);
  status.add("waiting_for_partner", scans_.waiting());
  status.add("waiting_for_transform", gate_.waiting());
  if (waiting > static_cast<std::size_t>(options_.queue_size)) {
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN,
                        std::to_string(waiting) + " scans wait, more than queue_size");
  }
}

void StictionServer::rejectLone(const std_msgs::Header& header, const std::string& reason) {
  accounting_.received(header);
  accounting_.rejected(header, reason);
}

void StictionServer::onScan(const sensor_msgs::ImageConstPtr& image, const ScanInfoConstPtr& info) {
  accounting_.received(image->header);
  const ros::WallTime arrival = ros::WallTime::now();
  if (!counter_surface_frame_) {
    queueScan(image, info, arrival, std::nullopt);
    return;
  }
  gate_.add(
      image->header, [this, image, info, arrival](const SurfacePose& pose) { queueScan(image, info, arrival, pose); },
      [this, header = image->header](const std::string& reason) { accounting_.rejected(header, oneLine(reason)); },
      arrival);
}

void StictionServer::queueScan(const sensor_msgs::ImageConstPtr& image, const ScanInfoConstPtr& info,
                               ros::WallTime arrival, const std::optional<SurfacePose>& pose) {
  worker_.pushScan([this, image, info, arrival, pose] { predictAndPublish(image, info, arrival, pose); },
                   [this, header = image->header] {
                     accounting_.dropped(header, "newer scans came before its turn (drop_policy is latest)");
                   });
}

void StictionServer::onCounterSurface(const sensor_msgs::ImageConstPtr& image, const ScanInfoConstPtr& info) {
  // In the order of arrival with the scans, so that a replay meets the same counter-surfaces as the live run.
  const auto queue = [this, image, info] { worker_.push([this, image, info] { takeCounterSurface(image, info); }); };
  if (counter_surface_frame_) {
    gate_.addBehind(queue, ros::WallTime::now());
  } else {
    queue();
  }
}

ReceivedScan StictionServer::receive(const sensor_msgs::ImageConstPtr& image, const ScanInfo* info) const {
  const SettingsOwner::Snapshot settings = predictor_.settings().snapshot();
  return receiveScan(image, info == nullptr ? settings->scan : scanOptions(*info, settings->scan));
}

ReceivedScan StictionServer::receiveByCall(sensor_msgs::Image image, const ScanInfo& info) const {
  ReceivedScan scan = receive(boost::make_shared<const sensor_msgs::Image>(std::move(image)), &info);
  if (!counter_surface_frame_) return scan;
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(options_.transform.timeout);
  for (;;) {
    try {
      scan.counter_surface_pose = counter_surface_frame_->poseAt(scan.header);
      return scan;
    } catch (const NoTransform&) {
      if (stopping_ || ros::WallTime::now() >= deadline) throw;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

StationCase StictionServer::findCase(const sensor_msgs::Image& height, const ScanInfo& info) {
  if (height.width == 0) return worker_.call([this] { return predictor_.stationCase(nullptr); });
  const ReceivedScan scan = receiveByCall(height, info);
  return worker_.call([&] { return predictor_.stationCase(&scan); });
}

void StictionServer::change(const RunningSettings& settings) {
  // Between two scans: what is published after the answer was predicted with the new settings.
  worker_.call([&] { predictor_.settings().change(settings); });
}

void StictionServer::predictAndPublish(const sensor_msgs::ImageConstPtr& image, const ScanInfoConstPtr& info,
                                       ros::WallTime arrival, const std::optional<SurfacePose>& pose) {
  try {
    ReceivedScan scan = receive(image, info.get());
    scan.counter_surface_pose = pose;
    const PredictedScan predicted = predictor_.predictScan(scan, publisher_.demanded());
    publisher_.publish(predicted, scan);
    if (publisher_.isPreviewWanted()) publisher_.publishPreview(predictor_.lastSurface(), scan.header);
    accounting_.predicted((ros::WallTime::now() - arrival).toSec(), predicted.prediction.processing_time);
    for (const std::string& line : predicted.warnings) accounting_.warn(scan.header, line);
  } catch (const std::exception& error) {
    accounting_.rejected(image->header, oneLine(error.what()));
  }
}

void StictionServer::showLastScan() {
  const ReceivedScan* scan = predictor_.lastScan();
  if (scan != nullptr) publisher_.publishPreview(predictor_.lastSurface(), scan->header);
}

void StictionServer::takeCounterSurface(const sensor_msgs::ImageConstPtr& image, const ScanInfoConstPtr& info) {
  try {
    predictor_.setCounterSurface(receive(image, info.get()));
    accounting_.counterSurfaceAccepted();
  } catch (const std::exception& error) {
    accounting_.counterSurfaceRejected(image->header, oneLine(error.what()));
  }
}

bool StictionServer::setLoad(SetLoad::Request& request, SetLoad::Response& response) {
  // What is returned when there is no prediction: NO_EQUILIBRIUM and zeros.
  response.prediction = predictionMessage(PredictedScan(), std_msgs::Header());
  try {
    const boost::recursive_mutex::scoped_lock lock(reconfigure_.mutex());
    RunningSettings settings = predictor_.settings().current();
    const LoadOptions before = settings.load;
    settings.load.voltage = request.voltage;
    settings.load.mechanical_load = request.mechanical_load;
    change(settings);
    reconfigure_.show();
    worker_.call([&] {
      response.success = true;
      response.message = "from " + numberText(before.voltage) + " V, " + numberText(before.mechanical_load) + " N";
      try {
        if (const std::optional<PredictedScan> predicted = predictor_.predictLastScan()) {
          response.prediction = predictionMessage(*predicted, predictor_.lastScan()->header);
        } else {
          response.message += "; no scan yet, so there is no prediction";
        }
      } catch (const std::exception& error) {
        response.message += "; the last scan cannot be predicted: " + oneLine(error.what());
      }
    });
  } catch (const std::future_error&) {
    response.success = false;
    response.message = kShuttingDown;
  } catch (const std::exception& error) {
    response.success = false;
    response.message = oneLine(error.what());
  }
  return true;
}

bool StictionServer::getLoad(GetLoad::Request& /*request*/, GetLoad::Response& response) {
  const LoadOptions load = predictor_.settings().current().load;
  response.voltage = load.voltage;
  response.mechanical_load = load.mechanical_load;
  response.max_voltage = load.max_voltage;
  response.max_mechanical_load = load.max_mechanical_load;
  return true;
}

bool StictionServer::predict(Predict::Request& request, Predict::Response& response) {
  response.prediction = predictionMessage(PredictedScan(), request.height.header);
  try {
    const ReceivedScan scan = receiveByCall(std::move(request.height), request.scan_info);
    worker_.call([&] {
      const PredictedScan predicted = predictor_.predictOnce(scan, request.voltage, request.mechanical_load);
      response.prediction = predictionMessage(predicted, scan.header);
    });
    response.success = true;
  } catch (const std::future_error&) {
    response.message = kShuttingDown;
  } catch (const std::exception& error) {
    response.message = oneLine(error.what());
  }
  return true;
}

bool StictionServer::resetSurface(std_srvs::Trigger::Request& /*request*/, std_srvs::Trigger::Response& response) {
  try {
    worker_.call([this] { predictor_.resetSurface(); });
    response.success = true;
    response.message = options_.accumulate_deformation ? "the next scan is taken as it was made"
                                                       : "nothing to forget: accumulate_deformation is false";
  } catch (const std::future_error&) {
    response.message = kShuttingDown;
  }
  return true;
}

}  // namespace mems_stiction
