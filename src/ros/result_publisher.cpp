#include "ros/result_publisher.hpp"

#include <utility>

#include <std_msgs/String.h>

#include "ros/display_conversion.hpp"
#include "ros/prediction_conversion.hpp"
#include "ros/topic_names.hpp"

namespace mems_stiction {
namespace {

template <typename Publisher>
bool hasListener(const Publisher& publisher) {
  return publisher.getNumSubscribers() > 0;
}

}  // namespace

ResultPublisher::ResultPublisher(const ros::NodeHandle& handle, const DisplayOptions& display,
                                 std::function<void()> preview_wanted)
    : display_(display), transport_(handle) {
  ros::NodeHandle node(handle);
  prediction_ = node.advertise<StictionPrediction>(kPredictionTopic, kPredictionQueue);
  summary_ = node.advertise<std_msgs::String>(kSummaryTopic, kPredictionQueue);
  // Latched: whoever comes finds what the last part's scans say.
  part_verdict_ = node.advertise<PartVerdict>(kPartVerdictTopic, kPredictionQueue, true);
  deformed_height_ = transport_.advertise(kDeformedHeightTopic, kMapQueue);
  deformed_counter_height_ = transport_.advertise(kDeformedCounterHeightTopic, kMapQueue);
  contact_map_ = transport_.advertise(kContactMapTopic, kMapQueue);
  asperities_ = node.advertise<AsperityArray>(kAsperitiesTopic, kMapQueue);
  surface_points_ = node.advertise<sensor_msgs::PointCloud2>(kSurfacePointsTopic, kDisplayQueue);
  asperity_markers_ =
      node.advertise<visualization_msgs::MarkerArray>(kAsperityMarkersTopic, kDisplayQueue);
  // Latched for who looks for it, and made anew for whoever comes, since the latched one may be
  // old.
  preview_ = node.advertise<sensor_msgs::Image>(
      kPreviewTopic, kDisplayQueue,
      [preview_wanted = std::move(preview_wanted)](const ros::SingleSubscriberPublisher&) {
        preview_wanted();
      },
      ros::SubscriberStatusCallback(), ros::VoidConstPtr(), true);
}

OutputOptions ResultPublisher::demanded() const {
  const bool points = hasListener(surface_points_);
  const bool markers = hasListener(asperity_markers_);
  OutputOptions output;
  output.deformed_surfaces =
      hasListener(deformed_height_) || hasListener(deformed_counter_height_) || points || markers;
  output.contact_map = hasListener(contact_map_) || points;
  output.asperities = hasListener(asperities_) || markers;
  output.roughness = true;
  output.energy_curve = false;
  return output;
}

void ResultPublisher::publish(const PredictedScan& predicted, const ReceivedScan& scan) const {
  const Prediction& prediction = predicted.prediction;
  const std_msgs::Header& header = scan.header;
  const bool has_surfaces = !prediction.deformed_lower.empty();
  const bool has_map = !prediction.contact_map.empty();
  if (has_surfaces && hasListener(deformed_height_)) {
    deformed_height_.publish(heightImage(prediction.deformed_lower, header));
  }
  if (!prediction.deformed_upper.empty() && hasListener(deformed_counter_height_)) {
    deformed_counter_height_.publish(heightImage(prediction.deformed_upper, header));
  }
  if (has_map && hasListener(contact_map_))
    contact_map_.publish(contactMapImage(prediction.contact_map, header));
  if (hasListener(asperities_)) asperities_.publish(asperitiesMessage(prediction, header));
  if (has_surfaces && has_map && hasListener(surface_points_)) {
    surface_points_.publish(surfacePoints(prediction, scan.surface, header, display_));
  }
  if (has_surfaces && hasListener(asperity_markers_)) {
    asperity_markers_.publish(asperityMarkers(prediction, scan.surface, header, display_));
  }
  if (predicted.part)
    publishPart(*predicted.part, {header, predicted.provenance, predicted.pool_settings_hash});
  if (hasListener(summary_)) {
    std_msgs::String summary;
    summary.data = summaryOf(predicted);
    summary_.publish(summary);
  }
  // Last, so that whoever waits for the prediction finds the rest sent.
  prediction_.publish(predictionMessage(predicted, header));
}

void ResultPublisher::publishPart(const PooledVerdict& part, const ScanOfPart& last) const {
  part_verdict_.publish(partVerdictMessage(part, last));
}

bool ResultPublisher::isPreviewWanted() const { return hasListener(preview_); }

void ResultPublisher::publishPreview(const HeightMap& surface,
                                     const std_msgs::Header& header) const {
  preview_.publish(previewImage(surface, header, display_));
}

}  // namespace mems_stiction
