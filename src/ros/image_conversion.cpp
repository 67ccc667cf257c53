#include "ros/image_conversion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <sensor_msgs/fill_image.h>
#include <sensor_msgs/image_encodings.h>
#include <boost/make_shared.hpp>

#include "errors/one_line.hpp"
#include "height_map/scan_sanity.hpp"
#include "height_map/unmeasured.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "ros/message_parts.hpp"

namespace mems_stiction {
namespace {

namespace enc = sensor_msgs::image_encodings;

struct HeightEncoding {
  std::string name;
  std::size_t scalar_size;  ///< [bytes]
  std::size_t channels;
  int type;  ///< of a cv::Mat
};

const std::vector<HeightEncoding>& heightEncodings() {
  static const std::vector<HeightEncoding> encodings = {
      {enc::TYPE_32FC1, 4, 1, CV_32FC1}, {enc::TYPE_64FC1, 8, 1, CV_64FC1},
      {enc::TYPE_32FC2, 4, 2, CV_32FC2}, {enc::TYPE_16UC1, 2, 1, CV_16UC1},
      {enc::MONO16, 2, 1, CV_16UC1},     {enc::TYPE_16SC1, 2, 1, CV_16SC1},
      {enc::MONO8, 1, 1, CV_8UC1},       {enc::TYPE_8UC1, 1, 1, CV_8UC1}};
  return encodings;
}

constexpr bool kThisMachineIsBigEndian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;

/// @throw SurfaceError if the message's own figures do not agree with each other.
const HeightEncoding& checkedEncoding(const sensor_msgs::Image& image) {
  const auto& encodings = heightEncodings();
  const auto found =
      std::find_if(encodings.begin(), encodings.end(),
                   [&](const HeightEncoding& encoding) { return encoding.name == image.encoding; });
  if (found == encodings.end()) {
    throw SurfaceError("encoding '" + shortened(image.encoding, kLongestQuotation) +
                       "' does not carry heights; accepted: " + acceptedEncodings());
  }
  if (image.height == 0 || image.width == 0 ||
      image.height > std::numeric_limits<std::int32_t>::max() ||
      image.width > std::numeric_limits<std::int32_t>::max()) {
    throw SurfaceError("size " + std::to_string(image.height) + " x " +
                       std::to_string(image.width) +
                       " is not allowed, an image must have at least one pixel and at most "
                       "2147483647 rows and columns");
  }
  const std::uint64_t row_size = std::uint64_t{image.width} * found->scalar_size * found->channels;
  if (image.step < row_size || image.step % found->scalar_size != 0) {
    throw SurfaceError("step " + std::to_string(image.step) + " is not allowed for " +
                       std::to_string(image.width) + " columns of " + image.encoding +
                       ", must be a multiple of " + std::to_string(found->scalar_size) +
                       " and >= " + std::to_string(row_size) + " bytes");
  }
  const std::uint64_t data_size = std::uint64_t{image.step} * image.height;
  if (image.data.size() != data_size) {
    throw SurfaceError("data has " + std::to_string(image.data.size()) + " bytes, must have step " +
                       std::to_string(image.step) + " x height " + std::to_string(image.height) +
                       " = " + std::to_string(data_size));
  }
  return *found;
}

/// A copy in this machine's byte order.
cv::Mat swappedPixels(const sensor_msgs::Image& image, const HeightEncoding& encoding) {
  cv::Mat pixels(static_cast<int>(image.height), static_cast<int>(image.width), encoding.type);
  const std::size_t scalars = image.width * encoding.channels;
  for (int row = 0; row < pixels.rows; ++row) {
    const std::uint8_t* source =
        image.data.data() + std::size_t{image.step} * static_cast<std::size_t>(row);
    std::uint8_t* target = pixels.ptr<std::uint8_t>(row);
    for (std::size_t i = 0; i < scalars;
         ++i, source += encoding.scalar_size, target += encoding.scalar_size) {
      std::reverse_copy(source, source + encoding.scalar_size, target);
    }
  }
  return pixels;
}

double statedPitch(const char* field, double stated, double parameter) {
  if (stated == 0.0) return parameter;
  if (!Range::positive().contains(stated)) {
    throw SurfaceError(std::string("scan_info.") + field + ": " + numberText(stated) +
                       " m is not allowed, must be > 0 m, or 0 for the parameter scan/" + field);
  }
  return stated;
}

/// A publisher that knows of no site leaves 0, 0.
bool isSiteStated(const ScanInfo& info) {
  return info.has_site || info.site_x != 0.0 || info.site_y != 0.0;
}

ScanIdentity statedIdentity(const ScanInfo& info) {
  ScanIdentity identity;
  copyIdentity(info, identity);
  if (!isSiteStated(info)) identity.site_x = identity.site_y = ScanIdentity().site_x;
  return identity;
}

double finite(const char* field, double value) {
  if (!std::isfinite(value)) {
    throw SurfaceError(std::string("scan_info.") + field + ": " + numberText(value) +
                       " is not allowed, must be a finite number");
  }
  return value;
}

/// Pixels in this machine's byte order; cv_bridge would load GDAL and a hundred libraries more into
/// each program.
sensor_msgs::ImagePtr imageMessage(const cv::Mat& pixels, const std::string& encoding,
                                   const std_msgs::Header& header) {
  const cv::Mat whole = pixels.isContinuous() ? pixels : pixels.clone();
  const auto message = boost::make_shared<sensor_msgs::Image>();
  message->header = header;
  message->encoding = encoding;
  if (whole.empty()) return message;
  sensor_msgs::fillImage(*message, encoding, static_cast<std::uint32_t>(whole.rows),
                         static_cast<std::uint32_t>(whole.cols),
                         static_cast<std::uint32_t>(whole.step), whole.data);
  message->is_bigendian = kThisMachineIsBigEndian;
  return message;
}

}  // namespace

std::string acceptedEncodings() {
  std::string names;
  for (const HeightEncoding& encoding : heightEncodings())
    names += (names.empty() ? "" : ", ") + encoding.name;
  return names;
}

ScanOptions scanOptions(const ScanInfo& info, const ScanOptions& parameters) {
  ScanOptions options = parameters;
  options.pitch_x = statedPitch("pitch_x", info.pitch_x, parameters.pitch_x);
  options.pitch_y = statedPitch("pitch_y", info.pitch_y, parameters.pitch_y);
  if (info.height_scale != 0.0) {
    options.height_scale = finite("height_scale", info.height_scale);
    options.height_offset = finite("height_offset", info.height_offset);
  }
  if (info.has_invalid_value) options.invalid_value = info.invalid_value;
  return options;
}

ScanInfo scanInfoMessage(const ScanOptions& options, const std_msgs::Header& header) {
  ScanInfo info;
  info.header = header;
  info.pitch_x = options.pitch_x;
  info.pitch_y = options.pitch_y;
  info.height_scale = options.height_scale;
  info.height_offset = options.height_offset;
  info.has_invalid_value = !std::isnan(options.invalid_value);
  if (info.has_invalid_value) info.invalid_value = options.invalid_value;
  return info;
}

void fillIdentity(const ScanIdentity& identity, ScanInfo& info) {
  copyIdentity(identity, info);
  info.has_site = isStated(identity.site_x);
}

ScanIdentity identityOf(const std_msgs::Header& header, const ScanInfo* info) {
  if (header.frame_id.size() > kLongestName) {
    throw SurfaceError("header.frame_id: a name of " + std::to_string(header.frame_id.size()) +
                       " bytes is not allowed, must have at most " + std::to_string(kLongestName));
  }
  ScanIdentity identity;
  if (info != nullptr) {
    identity = statedIdentity(*info);
    const std::vector<std::string> complaints = identityComplaints(identity, "scan_info.");
    if (!complaints.empty()) throw SurfaceError(complaints.front());
  }
  if (identity.scan_name.empty()) identity.scan_name = header.frame_id;
  return identity;
}

ReceivedScan receiveScan(const sensor_msgs::ImageConstPtr& image, const ScanOptions& options) {
  const HeightEncoding& encoding = checkedEncoding(*image);
  const bool foreign_order =
      encoding.scalar_size > 1 && (image->is_bigendian != 0) != kThisMachineIsBigEndian;
  if (foreign_order) {
    return {image->header,
            measuredPart(heightMapFromPixels(swappedPixels(*image, encoding), options)),
            std::nullopt, identityOf(image->header, nullptr)};
  }
  // Pixels of a message are shared and never written to.
  const cv::Mat shown(static_cast<int>(image->height), static_cast<int>(image->width),
                      encoding.type, const_cast<std::uint8_t*>(image->data.data()), image->step);
  const PixelOwner message(image.get(), [image](const void* /*message*/) {});
  return {image->header, measuredPart(heightMapFromPixels(shown, options, message)), std::nullopt,
          identityOf(image->header, nullptr)};
}

sensor_msgs::ImagePtr heightImage(const cv::Mat& heights, const std_msgs::Header& header) {
  cv::Mat narrow;
  heights.convertTo(narrow, CV_32F);
  return imageMessage(narrow, enc::TYPE_32FC1, header);
}

sensor_msgs::ImagePtr exactHeightImage(const cv::Mat& heights, const std_msgs::Header& header) {
  if (isSinglePrecision(heights)) return heightImage(heights, header);
  return imageMessage(heights, enc::TYPE_64FC1, header);
}

sensor_msgs::ImagePtr contactMapImage(const cv::Mat& contact_map, const std_msgs::Header& header) {
  return imageMessage(contact_map, enc::MONO8, header);
}

}  // namespace mems_stiction
