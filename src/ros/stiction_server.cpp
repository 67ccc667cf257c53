#include "ros/stiction_server.hpp"

#include <thread>
#include <utility>

#include <boost/bind/bind.hpp>
#include <boost/make_shared.hpp>

#include "device/device_evidence.hpp"
#include "errors/error_text.hpp"
#include "errors/one_line.hpp"
#include "evaluation/plausibility.hpp"
#include "ros/checked_messages.hpp"
#include "ros/message_bytes.hpp"
#include "ros/own_log.hpp"
#include "ros/scan_folders.hpp"
#include "ros/topic_names.hpp"

namespace mems_stiction {
namespace {

const ros::WallDuration kGatePeriod(0.01);
constexpr int kLongWithoutPublisher = 10;  // [s]
constexpr const char* kTooMuchWaits = "what waits holds more than max_waiting_memory";

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
      accounting_(ros::WallDuration(options_.warning_period),
                  ros::WallDuration(options_.diagnostic_period)),
      predictor_(predictorFromFolders(configuration.core, options_.accumulate_deformation)),
      // image_transport's plugins serve dynamic_reconfigure, which talks to the master: not on the
      // topic thread
      publisher_(withQueue(handle, service_queue_), options_.display,
                 [this] { worker_.push([this] { showLastScan(); }); }),
      half_space_(configuration.core.half_space.enabled == HalfSpaceUse::kNever
                      ? nullptr
                      : std::make_unique<HalfSpaceStream>(
                            withQueue(handle, service_queue_), configuration.core.half_space,
                            half_space_pause_,
                            [this](const auto& header, const auto& text) {
                              accounting_.warn(header, text);
                            },
                            [this](const auto& scan, const auto& verdict) {
                              worker_.push([=] {
                                half_space_->taken(scan);
                                takeHalfSpaceVerdict(scan, verdict);
                              });
                            },
                            [this](const auto& scan, const auto& solution, const auto& why) {
                              if (device_force_) device_force_->takeHalfSpace(scan, solution, why);
                            },
                            [this](const auto& scan) {
                              return device_force_ ? device_force_->evidenceOf(scan) : Evidence();
                            })),
      device_force_(!configuration.core.device_force.enabled
                        ? nullptr
                        : std::make_unique<DeviceForceStream>(
                              withQueue(handle, service_queue_),
                              SurfaceLimits{static_cast<std::size_t>(options_.max_part_scans),
                                            static_cast<std::size_t>(options_.max_part_memory)},
                              half_space_pause_,
                              [this](const auto& header, const auto& text) {
                                accounting_.warn(header, text);
                              },
                              [this](const auto& answer) {
                                worker_.push([=] {
                                  device_force_->taken(answer.last);
                                  takeDeviceVerdict(answer);
                                });
                              })),
      verdict_(withQueue(handle, service_queue_)),
      worker_(capacityOf(options_), static_cast<std::size_t>(options_.max_waiting_memory)),
      counter_surface_frame_(
          options_.transform.frame.empty()
              ? nullptr
              : std::make_unique<CounterSurfaceFrame>(handle_, options_.transform.frame)),
      gate_(
          ros::WallDuration(options_.transform.timeout),
          [this](const std_msgs::Header& header) { return counter_surface_frame_->poseAt(header); },
          static_cast<std::size_t>(options_.max_waiting_memory)),
      scans_(
          ros::WallDuration(options_.pairing_timeout),
          [this](const auto& image, const auto& info) { onScan(image, info); },
          [this](const auto& header, const auto& reason) { rejectLone(header, reason); },
          static_cast<std::size_t>(options_.max_waiting_memory)),
      counter_surfaces_(
          ros::WallDuration(options_.pairing_timeout),
          [this](const auto& image, const auto& info) { onCounterSurface(image, info); },
          [this](const auto& header, const auto& reason) {
            accounting_.counterSurfaceRejected(header, reason);
          },
          static_cast<std::size_t>(options_.max_waiting_memory)),
      reconfigure_(
          service_handle_, predictor_.settings(), options_.max_message_size,
          [this](const auto& settings) { change(settings); }, [this] { master_->writeSoon(this); }),
      actions_(
          service_handle_, options_.max_message_size,
          [this](const auto& height, const auto& info) { return findCase(height, info); },
          [this](const auto& scan) {
            return device_force_ ? device_force_->scansOf(scan) : std::nullopt;
          }),
      half_space_calls_(
          service_handle_, configuration.core.half_space, options_.max_message_size,
          half_space_pause_,
          [this](const auto& height, const auto& info) { return findCase(height, info); },
          [this](const auto& scan) {
            return device_force_ ? device_force_->evidenceOf(scan) : Evidence();
          }),
      diagnostics_(handle_, name),
      parameters_(handle_, private_handle_),
      master_(MasterWatch::ofThisProcess()),
      topic_spinner_(1, &topic_queue_) {
  prepareLog();
  advertiseServices();
  subscribe();
  startTimers();
  if (half_space_) half_space_->start();
  if (device_force_) device_force_->start();
  worker_.start();
  actions_.start();
  half_space_calls_.start();
  master_->add(this,
               {[this](const MasterCalls& calls) { return putParametersBack(calls); },
                [this](const MasterCalls& calls) { return reconfigure_.writeMirror(calls); }});
  try {
    service_queue_.start();
    topic_spinner_.start();
  } catch (...) {
    master_->remove(this);
    throw;
  }
}

StictionServer::~StictionServer() {
  // Long runs and the worker first: a service that waits for them gets its refusal, so that the
  // spinners can end.
  stopping_ = true;
  master_->remove(this);
  actions_.stop();
  half_space_calls_.stop();
  worker_.stop();
  if (half_space_) half_space_->stop();
  if (device_force_) device_force_->stop();
  service_queue_.stop();
  topic_spinner_.stop();
  const ScanCounts counts = accounting_.counts();
  if (counts.waiting() > 0) {
    logSoon(ros::console::levels::Info,
            std::to_string(counts.waiting()) + " scans were still waiting at shutdown");
  }
  finishLog();
}

void StictionServer::subscribe() {
  using ImagePtr = sensor_msgs::ImageConstPtr;
  const bool use_scan_info = options_.use_scan_info;
  const auto subscribePair = [&](const char* image_topic, const char* info_topic,
                                 ScanPairer& pairer, auto on_single,
                                 ros::Subscriber& image_subscriber,
                                 ros::Subscriber& info_subscriber) {
    const auto addToPairs = [&](const auto& half) {
      pairer.setSeveralPublishers(image_subscriber.getNumPublishers() > 1 ||
                                  info_subscriber.getNumPublishers() > 1);
      pairer.add(half, ros::SteadyTime::now());
    };
    const bool is_scan = &pairer == &scans_;
    const double most = options_.max_message_size;
    const auto take = [=](const ImagePtr& image) {
      if (is_scan) accounting_.arrived(image->header);
      if (use_scan_info) {
        addToPairs(image);
      } else {
        (this->*on_single)(image, nullptr);
      }
    };
    const auto refuseImage = [=, &pairer](const BoundedStream& bytes, const std::string& reason) {
      std_msgs::Header header;
      readBeginning(bytes, header);
      if (is_scan && !header.stamp.isZero()) accounting_.arrived(header);
      if (use_scan_info) {
        pairer.refuseImage(header, reason);
      } else if (is_scan) {
        rejectLone(header, reason);
      } else {
        accounting_.counterSurfaceRejected(header, reason);
      }
    };
    image_subscriber = subscribeChecked<sensor_msgs::Image>(handle_, image_topic, kSubscriberQueue,
                                                            {take, refuseImage, most});
    if (!use_scan_info) return;
    info_subscriber =
        subscribeChecked<ScanInfo>(handle_, info_topic, kSubscriberQueue,
                                   {[=](const ScanInfoConstPtr& info) { addToPairs(info); },
                                    [&pairer](const auto& bytes, const auto& reason) {
                                      std_msgs::Header header;
                                      readBeginning(bytes, header);
                                      pairer.refuseInfo(header, reason);
                                    },
                                    most});
  };
  subscribePair(kHeightTopic, kScanInfoTopic, scans_, &StictionServer::onScan, height_, scan_info_);
  if (predictor_.settings().snapshot()->counter_surface.type == CounterSurfaceType::kTopic) {
    subscribePair(kCounterHeightTopic, kCounterScanInfoTopic, counter_surfaces_,
                  &StictionServer::onCounterSurface, counter_height_, counter_scan_info_);
  }
}

void StictionServer::startTimers() {
  diagnostics_.add("scans", [this](auto& status) { report(status); });
  diagnostics_.add("master", [this](auto& status) { master_->report(status); });
  if (half_space_)
    diagnostics_.add("half_space", [this](auto& status) { half_space_->report(status); });
  if (device_force_)
    diagnostics_.add("device_force", [this](auto& status) { device_force_->report(status); });
  diagnostic_timer_ =
      handle_.createSteadyTimer(ros::WallDuration(options_.diagnostic_period),
                                [this](const ros::SteadyTimerEvent&) { diagnostics_.publish(); });
  pairing_timer_ = handle_.createSteadyTimer(ros::WallDuration(0.2 * options_.pairing_timeout),
                                             [this](const auto&) {
                                               scans_.expire(ros::SteadyTime::now());
                                               counter_surfaces_.expire(ros::SteadyTime::now());
                                             });
  publisher_timer_ =
      handle_.createSteadyTimer(ros::WallDuration(1.0), [this](const auto&) { watchPublishers(); });
  if (counter_surface_frame_) {
    gate_timer_ = handle_.createSteadyTimer(
        kGatePeriod, [this](const auto&) { gate_.poll(ros::SteadyTime::now()); });
  }
}

void StictionServer::watchPublishers() {
  seconds_without_publisher_ = height_.getNumPublishers() > 0 ? 0 : seconds_without_publisher_ + 1;
  if (seconds_without_publisher_ != kLongWithoutPublisher) return;  // said once each time
  const bool had_scans = accounting_.counts().received > 0;
  logSoon(had_scans ? ros::console::levels::Info : ros::console::levels::Warn,
          "nobody has published " + height_.getTopic() + " for " +
              std::to_string(kLongWithoutPublisher) +
              " s: start what gives scans (scan_source, the instrument's driver, rosbag play), or "
              "remap height to its topic");
}

bool StictionServer::putParametersBack(const MasterCalls& calls) const {
  return parameters_.putBack(calls) && reconfigure_.writeMirror(calls);
}

void StictionServer::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  accounting_.report(status);
  status.add("cleaned", predictor_.cleanings());
  const std::size_t waiting = worker_.waitingScans();
  status.add("waiting_for_worker", waiting);
  status.add("waiting_memory [bytes]", worker_.waitingBytes() + gate_.waitingBytes() +
                                           scans_.waitingBytes() +
                                           counter_surfaces_.waitingBytes());
  status.add("waiting_for_partner", scans_.waiting());
  status.add("waiting_for_transform", gate_.waiting());
  if (waiting > static_cast<std::size_t>(options_.queue_size)) {
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN,
                        std::to_string(waiting) + " scans wait, more than queue_size");
  }
  const std::string lost = reconfigure_.lost();
  if (!lost.empty()) status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN, lost);
}

void StictionServer::rejectLone(const std_msgs::Header& header, const std::string& reason) {
  accounting_.received();
  accounting_.rejected(header, reason);
}

void StictionServer::onScan(const sensor_msgs::ImageConstPtr& image, const ScanInfoConstPtr& info) {
  accounting_.received();
  const ros::SteadyTime arrival = ros::SteadyTime::now();
  if (!counter_surface_frame_) {
    queueScan(image, info, arrival, std::nullopt);
    return;
  }
  gate_.add(
      image->header,
      [this, image, info, arrival](const SurfacePose& pose) {
        queueScan(image, info, arrival, pose);
      },
      [this, header = image->header](const std::string& reason) {
        accounting_.rejected(header, oneLine(reason));
      },
      [this, header = image->header] { accounting_.dropped(header, kTooMuchWaits); },
      bytesOf(image) + bytesOf(info), arrival);
}

void StictionServer::queueScan(const sensor_msgs::ImageConstPtr& image,
                               const ScanInfoConstPtr& info, ros::SteadyTime arrival,
                               const std::optional<SurfacePose>& pose) {
  worker_.pushScan(
      [this, image, info, arrival, pose] { predictAndPublish(image, info, arrival, pose); },
      [this, header = image->header] {
        accounting_.dropped(header, options_.drop_policy == DropPolicy::kLatest
                                        ? "newer scans came before its turn (drop_policy is latest)"
                                        : kTooMuchWaits);
      },
      bytesOf(image) + bytesOf(info));
}

void StictionServer::onCounterSurface(const sensor_msgs::ImageConstPtr& image,
                                      const ScanInfoConstPtr& info) {
  // In the order of arrival with the scans, so that a replay meets the same counter-surfaces as the
  // live run.
  const auto drop = [this, header = image->header] {
    accounting_.counterSurfaceRejected(
        header, std::string("a newer one came before its turn, and ") + kTooMuchWaits);
  };
  const std::size_t bytes = bytesOf(image) + bytesOf(info);
  const auto queue = [this, image, info, drop, bytes] {
    worker_.pushCounterSurface([this, image, info] { takeCounterSurface(image, info); }, drop,
                               bytes);
  };
  if (counter_surface_frame_) {
    gate_.addCounterSurface(queue, drop, bytes, ros::SteadyTime::now());
  } else {
    queue();
  }
}

ReceivedScan StictionServer::receive(const sensor_msgs::ImageConstPtr& image,
                                     const ScanInfo* info) const {
  const SettingsOwner::Snapshot settings = predictor_.settings().snapshot();
  ReceivedScan scan =
      receiveScan(image, info == nullptr ? settings->scan : scanOptions(*info, settings->scan));
  scan.identity = identityOf(image->header, info);
  return scan;
}

ReceivedScan StictionServer::receiveByCall(sensor_msgs::Image image, const ScanInfo& info) const {
  ReceivedScan scan =
      receive(boost::make_shared<const sensor_msgs::Image>(std::move(image)), &info);
  if (!counter_surface_frame_) return scan;
  const ros::SteadyTime deadline =
      ros::SteadyTime::now() + ros::WallDuration(options_.transform.timeout);
  for (;;) {
    try {
      scan.counter_surface_pose = counter_surface_frame_->poseAt(scan.header);
      return scan;
    } catch (const NoTransform&) {
      if (stopping_ || ros::SteadyTime::now() >= deadline) throw;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

StationCase StictionServer::findCase(const sensor_msgs::Image& height, const ScanInfo& info) {
  if (height.width == 0) return worker_.call([this] { return predictor_.stationCase(nullptr); });
  const ReceivedScan scan = receiveByCall(height, info);
  StationCase found = worker_.call([&] { return predictor_.stationCase(&scan); });
  for (const std::string& line : warningsOf(found.scan)) accounting_.warn(found.header, line);
  return found;
}

void StictionServer::change(const RunningSettings& settings) {
  // Between two scans: what is published after the answer was predicted with the new settings.
  worker_.call([&] {
    predictor_.settings().change(settings);
    const SettingsOwner::Snapshot changed = predictor_.settings().snapshot();
    const bool wants_device =
        device_force_ && wantsDeviceForce(changed->device, changed->device_force);
    const bool wants_half_space = half_space_ &&
                                  changed->half_space.enabled == HalfSpaceUse::kFlagged &&
                                  mayCallHalfSpace(*changed);
    if (!wants_device && !wants_half_space) return;
    const std::optional<PredictedScan> predicted = lastScanOrNothing();
    if (predicted) offerAgain(*predicted);
  });
}

void StictionServer::predictAndPublish(const sensor_msgs::ImageConstPtr& image,
                                       const ScanInfoConstPtr& info, ros::SteadyTime arrival,
                                       const std::optional<SurfacePose>& pose) {
  const SolutionPause::Request request(half_space_pause_);
  try {
    ReceivedScan scan = receive(image, info.get());
    scan.counter_surface_pose = pose;
    const PredictedScan predicted = predictor_.predictScan(scan, publisher_.demanded());
    publisher_.publish(predicted, scan);
    offerToHalfSpace(predicted);
    offerToDevice(predicted);
    if (predictor_.settings().snapshot()->device.isStated()) {
      publishVerdict(
          {{scan.header, predicted.provenance, predicted.pool_settings_hash, predicted.scan_id},
           predicted.verdict,
           predicted.part});
    }
    if (publisher_.isPreviewWanted())
      publisher_.publishPreview(predictor_.lastSurface(), scan.header);
    accounting_.predicted((ros::SteadyTime::now() - arrival).toSec(),
                          predicted.prediction.processing_time);
    for (const std::string& line : predicted.warnings) accounting_.warn(scan.header, line);
  } catch (const std::exception& error) {
    accounting_.rejected(image->header, oneLine(reasonOf(error)));
  }
}

void StictionServer::takeHalfSpaceVerdict(const ScanOfPart& scan,
                                          const std::optional<Verdict>& verdict) {
  DeviceAnswer answer{scan, std::nullopt, std::nullopt};
  const std::optional<PartNews> news =
      verdict ? predictor_.judgeAgain(scan, *verdict) : std::nullopt;
  // A device that has been judged by its own force is not judged by one frame after that.
  if (verdict && !verdict_.said().isByDeviceForce(scan)) {
    answer.verdict = verdict;
    if (news) {
      answer.last = news->last;
      answer.part = news->verdict;
      publisher_.publishPart(news->verdict, news->last);
    }
  }
  publishVerdict(answer);
}

void StictionServer::offerToHalfSpace(const PredictedScan& predicted) {
  if (!half_space_ || !predicted.half_space.is_made || !predicted.half_space.objection.empty())
    return;
  const StationCase scan = predictor_.stationCase(nullptr);
  half_space_->offer(
      predicted.half_space, scan,
      {scan.header, predicted.provenance, predicted.pool_settings_hash, predicted.scan_id});
}

void StictionServer::offerAgain(const PredictedScan& predicted) {
  if (!predicted.half_space.why.empty()) offerToHalfSpace(predicted);
  offerToDevice(predicted);
}

void StictionServer::offerToDevice(const PredictedScan& predicted) {
  if (device_force_) device_force_->offer(predictor_.stationCase(nullptr), predicted);
}

void StictionServer::takeDeviceVerdict(const DeviceAnswer& answer) {
  if (answer.part) publisher_.publishPart(*answer.part, answer.last);
  publishVerdict(answer);
}

void StictionServer::publishVerdict(const DeviceAnswer& answer) {
  const ScanOfPart& newest = predictor_.newestOf(answer.last);
  const AwaitedAnswers awaited{device_force_ && device_force_->isExpected(answer.last),
                               half_space_ && half_space_->isExpected(answer.last),
                               newest.id != answer.last.id};
  verdict_.publish(answer, awaited, predictor_.isLast(answer.last.id));
  if (awaited.is_overtaken) publishVerdict({newest, std::nullopt, std::nullopt});
}

void StictionServer::showLastScan() {
  const ReceivedScan* scan = predictor_.lastScan();
  if (scan != nullptr) publisher_.publishPreview(predictor_.lastSurface(), scan->header);
}

void StictionServer::takeCounterSurface(const sensor_msgs::ImageConstPtr& image,
                                        const ScanInfoConstPtr& info) {
  try {
    predictor_.setCounterSurface(receive(image, info.get()));
    accounting_.counterSurfaceAccepted();
  } catch (const std::exception& error) {
    accounting_.counterSurfaceRejected(image->header, oneLine(reasonOf(error)));
  }
}

}  // namespace mems_stiction
