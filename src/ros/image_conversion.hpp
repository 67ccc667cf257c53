#pragma once

/// @file
/// Between sensor_msgs/Image and height maps: encodings, byte order, validity (REP 117, REP 118).

#include <optional>
#include <string>

#include <sensor_msgs/Image.h>
#include <std_msgs/Header.h>

#include "mems_stiction/ScanInfo.h"
#include "mems_stiction/configuration/provenance.hpp"
#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/height_map/raw_scan.hpp"
#include "surface/alignment.hpp"

namespace mems_stiction {

/// A scan as it arrived.
struct ReceivedScan {
  std_msgs::Header header;
  HeightMap surface;  ///< shares the message, where it shows its pixels
  std::optional<SurfacePose> counter_surface_pose;  ///< at the scan's stamp; none = as configured
  ScanIdentity identity;                            ///< as the scan states it
};

/// The encodings that carry heights, for messages: "32FC1, 64FC1, ...".
std::string acceptedEncodings();

/// The message over the parameters: every field that the message leaves at its default keeps the
/// parameter's value.
/// @throw SurfaceError naming a field that is negative, not finite, or stated nowhere.
ScanOptions scanOptions(const ScanInfo& info, const ScanOptions& parameters);

/// The message that reads back as `options`.
ScanInfo scanInfoMessage(const ScanOptions& options, const std_msgs::Header& header);

/// What the messages say of what was scanned: without a scan_name the frame_id is it.
/// - @p info null: there is none.
/// @throw SurfaceError if a name is longer than anybody reads, or half a site is stated.
ScanIdentity identityOf(const std_msgs::Header& header, const ScanInfo* info);

/// What was scanned, as a message states it.
void fillIdentity(const ScanIdentity& identity, ScanInfo& info);

/// Shares the pixels of 32FC1 and 64FC1 in this machine's byte order with scale 1, offset 0, no
/// invalid value and no height beyond kLargestHeight, which counts as missing; copies otherwise.
/// The image's memory is never written to.
/// @throw SurfaceError if the encoding is not accepted, the size is zero, step or data size do not
/// fit, or the pitch is
///        not stated.
ReceivedScan receiveScan(const sensor_msgs::ImageConstPtr& image, const ScanOptions& options);

/// rows x cols CV_32FC1 or CV_64FC1 [m] as 32FC1 [m], NaN where invalid. Float32 keeps 7 digits: a
/// stage offset should have come off before.
sensor_msgs::ImagePtr heightImage(const cv::Mat& heights, const std_msgs::Header& header);

/// The same without a loss: as 64FC1 where a height is no float32.
sensor_msgs::ImagePtr exactHeightImage(const cv::Mat& heights, const std_msgs::Header& header);

/// rows x cols CV_8UC1 as mono8.
sensor_msgs::ImagePtr contactMapImage(const cv::Mat& contact_map, const std_msgs::Header& header);

}  // namespace mems_stiction
