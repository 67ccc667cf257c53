#include "ros/image_conversion.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>
#include <sensor_msgs/image_encodings.h>
#include <boost/make_shared.hpp>
#include <boost/weak_ptr.hpp>

#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

namespace enc = sensor_msgs::image_encodings;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kRows = 3;
constexpr int kCols = 5;

ScanOptions calibration(double scale = 1.0, double offset = 0.0) {
  ScanOptions options;
  options.pitch_x = 10e-9;
  options.pitch_y = 20e-9;
  options.height_scale = scale;
  options.height_offset = offset;
  return options;
}

/// Different in every cell, on a frame that is not square: a flip or a transposition shows.
int rawValue(int row, int col) { return 1 + 7 * row + col; }

/// @param padding unused bytes at the end of each row; a multiple of the scalar's size
template <typename Scalar>
sensor_msgs::ImagePtr image(const std::string& encoding, int channels = 1,
                            std::size_t padding = 0) {
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->header.stamp = ros::Time(12, 34);
  message->header.frame_id = "stage";
  message->encoding = encoding;
  message->height = kRows;
  message->width = kCols;
  message->step = static_cast<std::uint32_t>(kCols * channels * sizeof(Scalar) + padding);
  message->data.assign(std::size_t{message->step} * kRows, 0xAB);
  for (int row = 0; row < kRows; ++row) {
    for (int col = 0; col < kCols; ++col) {
      const auto value = static_cast<Scalar>(rawValue(row, col));
      std::memcpy(&message->data[row * message->step + col * channels * sizeof(Scalar)], &value,
                  sizeof value);
      const Scalar quality = 1;
      if (channels == 2) {
        std::memcpy(&message->data[row * message->step + (col * 2 + 1) * sizeof(Scalar)], &quality,
                    sizeof quality);
      }
    }
  }
  return message;
}

void swapBytes(sensor_msgs::Image& message, std::size_t scalar_size) {
  for (auto at = message.data.begin(); at != message.data.end();
       at += static_cast<std::ptrdiff_t>(scalar_size)) {
    std::reverse(at, at + static_cast<std::ptrdiff_t>(scalar_size));
  }
  message.is_bigendian = message.is_bigendian ? 0 : 1;
}

void expectHeights(const HeightMap& surface, double scale, double offset) {
  ASSERT_EQ(surface.rows(), kRows);
  ASSERT_EQ(surface.cols(), kCols);
  EXPECT_EQ(surface.pitchX(), 10e-9);
  EXPECT_EQ(surface.pitchY(), 20e-9);
  for (int row = 0; row < kRows; ++row) {
    for (int col = 0; col < kCols; ++col) {
      EXPECT_DOUBLE_EQ(surface.height(row, col), rawValue(row, col) * scale + offset)
          << row << ", " << col;
    }
  }
}

template <typename Scalar>
void expectRoundTrip(const std::string& encoding, int channels = 1) {
  SCOPED_TRACE(encoding);
  for (const std::size_t padding : {std::size_t{0}, 3 * sizeof(Scalar)}) {
    auto message = image<Scalar>(encoding, channels, padding);
    expectHeights(receiveScan(message, calibration(2e-9, 1e-6)).surface, 2e-9, 1e-6);
    expectHeights(receiveScan(message, calibration()).surface, 1.0, 0.0);
    if (sizeof(Scalar) > 1) {
      swapBytes(*message, sizeof(Scalar));
      expectHeights(receiveScan(message, calibration(2e-9, 1e-6)).surface, 2e-9, 1e-6);
      expectHeights(receiveScan(message, calibration()).surface, 1.0, 0.0);
    }
  }
}

/// The text of the refusal; empty if there was none.
std::string refusal(const sensor_msgs::ImagePtr& message,
                    const ScanOptions& options = calibration()) {
  try {
    receiveScan(message, options);
  } catch (const SurfaceError& error) {
    return error.what();
  }
  return "";
}

bool names(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(ImageConversion, EveryEncodingComesThroughInBothByteOrdersAndWithPaddedRows) {
  expectRoundTrip<float>(enc::TYPE_32FC1);
  expectRoundTrip<double>(enc::TYPE_64FC1);
  expectRoundTrip<float>(enc::TYPE_32FC2, 2);
  expectRoundTrip<std::uint16_t>(enc::TYPE_16UC1);
  expectRoundTrip<std::uint16_t>(enc::MONO16);
  expectRoundTrip<std::int16_t>(enc::TYPE_16SC1);
  expectRoundTrip<std::uint8_t>(enc::MONO8);
  expectRoundTrip<std::uint8_t>(enc::TYPE_8UC1);
}

TEST(ImageConversion, FloatMetersAreSharedWithTheMessage) {
  const auto single = image<float>(enc::TYPE_32FC1);
  EXPECT_EQ(receiveScan(single, calibration()).surface.heights().data, single->data.data());
  const auto wide = image<double>(enc::TYPE_64FC1);
  EXPECT_EQ(receiveScan(wide, calibration()).surface.heights().data, wide->data.data());
  EXPECT_NE(receiveScan(single, calibration(1e-9)).surface.heights().data, single->data.data());
}

TEST(ImageConversion, AReceivedScanKeepsItsPixelsAlive) {
  auto message = image<float>(enc::TYPE_32FC1);
  const ReceivedScan scan = receiveScan(message, calibration());
  const boost::weak_ptr<const sensor_msgs::Image> observer(message);
  message.reset();
  EXPECT_FALSE(observer.expired());
  expectHeights(scan.surface, 1.0, 0.0);
  EXPECT_EQ(scan.header.frame_id, "stage");
}

TEST(ImageConversion, NonFiniteFloatsAndTheInvalidValueAreInvalid) {
  auto message = image<float>(enc::TYPE_32FC1);
  const float values[] = {std::numeric_limits<float>::quiet_NaN(),
                          std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity()};
  std::memcpy(message->data.data(), values, sizeof values);
  ScanOptions options = calibration(1e-9);
  options.invalid_value = rawValue(1, 1);
  const HeightMap surface = receiveScan(message, options).surface;
  for (int col = 0; col < 3; ++col) EXPECT_FALSE(std::isfinite(surface.height(0, col))) << col;
  EXPECT_FALSE(std::isfinite(surface.height(1, 1)));
  EXPECT_EQ(heightStatistics(surface).valid_count, kRows * kCols - 4);
}

TEST(ImageConversion, NumbersBeyondAHeightAreInvalidInBothByteOrders) {
  auto message = image<float>(enc::TYPE_32FC1);
  const float values[] = {1e21F, -std::numeric_limits<float>::max(), 9e19F};
  std::memcpy(message->data.data(), values, sizeof values);
  for (int order = 0; order < 2; ++order, swapBytes(*message, sizeof(float))) {
    const HeightMap surface = receiveScan(message, calibration()).surface;
    EXPECT_TRUE(std::isnan(surface.height(0, 0)) && std::isnan(surface.height(0, 1)));
    EXPECT_EQ(surface.height(0, 2), static_cast<double>(9e19F));
    EXPECT_EQ(heightStatistics(surface).valid_count, kRows * kCols - 2);
    // In metres, as files have it: the same pixels in a smaller unit are heights.
    EXPECT_EQ(heightStatistics(receiveScan(message, calibration(1e-30)).surface).valid_count,
              kRows * kCols);
  }
}

TEST(ImageConversion, SignedCountsKeepTheirSign) {
  auto message = image<std::int16_t>(enc::TYPE_16SC1);
  const std::int16_t value = -300;
  std::memcpy(message->data.data(), &value, sizeof value);
  EXPECT_DOUBLE_EQ(receiveScan(message, calibration(1e-10)).surface.height(0, 0), -300 * 1e-10);
}

TEST(ImageConversion, RefusesOtherEncodingsAndListsWhatItTakes) {
  for (const std::string& encoding :
       {std::string("rgb8"), std::string("bayer_rggb8"), std::string("64FC2"), std::string(""),
        std::string("nonsense")}) {
    auto message = image<float>(enc::TYPE_32FC1);
    message->encoding = encoding;
    const std::string text = refusal(message);
    EXPECT_TRUE(names(text, "'" + encoding + "'")) << text;
    for (const char* accepted : {"32FC1", "64FC1", "32FC2", "16UC1", "mono16", "16SC1", "mono8"}) {
      EXPECT_TRUE(names(text, accepted)) << text;
    }
  }
}

TEST(ImageConversion, RefusesSizesThatDoNotFit) {
  auto message = image<float>(enc::TYPE_32FC1);
  message->data.pop_back();
  EXPECT_TRUE(names(refusal(message), "data has 59 bytes")) << refusal(message);

  message = image<float>(enc::TYPE_32FC1);
  message->step = 16;
  EXPECT_TRUE(names(refusal(message), "step 16")) << refusal(message);

  message = image<float>(enc::TYPE_32FC1);
  message->step = 21;
  message->data.resize(63);
  EXPECT_TRUE(names(refusal(message), "multiple of 4")) << refusal(message);

  message = image<float>(enc::TYPE_32FC1);
  message->height = 0;
  message->data.clear();
  EXPECT_TRUE(names(refusal(message), "at least one pixel")) << refusal(message);

  // step x height is a multiple of 2^32 and must not wrap around to the size of the data
  message = image<float>(enc::TYPE_32FC1);
  message->width = 1;
  message->step = 0x80000000U;
  message->height = 2;
  message->data.clear();
  EXPECT_TRUE(names(refusal(message), "data has 0 bytes")) << refusal(message);
}

TEST(ImageConversion, ThePitchMustBeStatedSomewhere) {
  EXPECT_TRUE(names(refusal(image<float>(enc::TYPE_32FC1), ScanOptions()), "pitch"));
}

TEST(ScanInfoMessage, DefaultsMeanTheParameters) {
  ScanOptions parameters = calibration(3e-9, 4e-6);
  parameters.invalid_value = 65535;
  const ScanOptions options = scanOptions(ScanInfo(), parameters);
  EXPECT_EQ(options.pitch_x, 10e-9);
  EXPECT_EQ(options.pitch_y, 20e-9);
  EXPECT_EQ(options.height_scale, 3e-9);
  EXPECT_EQ(options.height_offset, 4e-6);
  EXPECT_EQ(options.invalid_value, 65535);
}

TEST(ScanInfoMessage, WhatItStatesGoesFirst) {
  ScanOptions stated = calibration(-5e-9, 0.0);
  stated.pitch_x = 1e-9;
  stated.invalid_value = 0.0;
  const ScanOptions options = scanOptions(scanInfoMessage(stated, {}), calibration(3e-9, 4e-6));
  EXPECT_EQ(options.pitch_x, 1e-9);
  EXPECT_EQ(options.height_scale, -5e-9);
  EXPECT_EQ(options.height_offset, 0.0);
  EXPECT_EQ(options.invalid_value, 0.0);
}

TEST(ScanInfoMessage, RefusesAPitchThatIsNotPositiveByName) {
  for (const double pitch : {-1e-9, kNaN, std::numeric_limits<double>::infinity()}) {
    ScanInfo info;
    info.pitch_y = pitch;
    try {
      scanOptions(info, calibration());
      ADD_FAILURE() << pitch;
    } catch (const SurfaceError& error) {
      EXPECT_TRUE(names(error.what(), "scan_info.pitch_y")) << error.what();
    }
  }
}

TEST(ScanInfoMessage, NamesThatNobodyReadsAreRefused) {
  const std::string longest(1000, 'a');
  std_msgs::Header header;
  header.frame_id = longest;
  ScanInfo info;
  info.scan_name = info.part_id = info.serial_id = longest;
  EXPECT_EQ(identityOf(header, &info).part_id, longest);
  header.frame_id += "a";
  EXPECT_THROW(identityOf(header, nullptr), SurfaceError);
  header.frame_id = "scan";
  for (std::string* name :
       {&info.scan_name, &info.part_id, &info.serial_id, &info.lot_id, &info.wafer_id,
        &info.acquisition_time, &info.instrument, &info.operator_name, &info.checksum}) {
    *name = longest;
  }
  EXPECT_EQ(identityOf(header, &info).checksum, longest);
  for (std::string* name :
       {&info.scan_name, &info.part_id, &info.serial_id, &info.operator_name, &info.checksum}) {
    *name += "a";
    EXPECT_THROW(identityOf(header, &info), SurfaceError);
    *name = longest;
  }
  info.part_id.append(1000000, 'a');
  try {
    identityOf(header, &info);
    FAIL();
  } catch (const SurfaceError& error) {
    EXPECT_STREQ(
        error.what(),
        "scan_info.part_id: a name of 1001000 bytes is not allowed, must have at most 1000");
  }
}

TEST(ScanInfoMessage, ASiteIsStatedAsAWholeOrNotAtAll) {
  std_msgs::Header header;
  ScanInfo info;
  EXPECT_TRUE(std::isnan(identityOf(header, &info).site_x))
      << "what a publisher leaves that knows of no site";
  info.has_site = true;
  EXPECT_EQ(identityOf(header, &info).site_x, 0.0) << "the middle of the wafer";
  EXPECT_EQ(identityOf(header, &info).site_y, 0.0);
  info.has_site = false;
  info.site_y = -0.01;
  EXPECT_EQ(identityOf(header, &info).site_x, 0.0);
  EXPECT_EQ(identityOf(header, &info).site_y, -0.01);
  info.site_x = kNaN;
  try {
    identityOf(header, &info);
    FAIL();
  } catch (const SurfaceError& error) {
    EXPECT_STREQ(error.what(),
                 "scan_info.site_y: -0.01 is stated without site_x: state both, or none");
  }
  info.site_y = kNaN;
  EXPECT_TRUE(std::isnan(identityOf(header, &info).site_y));
}

TEST(ScanInfoMessage, WhatIsStatedOfAScanComesBack) {
  ScanIdentity identity;
  visitScanIdentityFields(identity, [](const Figure& figure, auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string>) {
      value = std::string("of ") + figure.name;
    } else {
      value = figure.name[5] == 'x' ? 0.0 : -2e-3;
    }
  });
  ScanInfo info;
  fillIdentity(identity, info);
  ScanIdentity back = identityOf({}, &info);
  std::vector<std::string> stated;
  visitScanIdentityFields(identity, [&](const Figure&, const auto& value) {
    std::ostringstream text;
    text << value;
    stated.push_back(text.str());
  });
  visitScanIdentityFields(
      back, [&, place = std::size_t{0}](const Figure& figure, const auto& value) mutable {
        std::ostringstream text;
        text << value;
        EXPECT_EQ(text.str(), stated[place++]) << figure.name;
      });
  fillIdentity({}, info);
  EXPECT_FALSE(info.has_site);
  EXPECT_TRUE(std::isnan(identityOf({}, &info).site_x));
}

TEST(HeightImage, NarrowsToFloatAndKeepsInvalidCells) {
  cv::Mat heights = (cv::Mat_<double>(2, 3) << 1e-9, 2e-9, kNaN, -4e-9, 5e-9, 6e-9);
  std_msgs::Header header;
  header.stamp = ros::Time(7, 8);
  const auto message = heightImage(heights, header);
  EXPECT_EQ(message->encoding, "32FC1");
  EXPECT_EQ(message->header.stamp, header.stamp);
  const HeightMap back = receiveScan(message, calibration()).surface;
  ASSERT_EQ(back.rows(), 2);
  ASSERT_EQ(back.cols(), 3);
  EXPECT_EQ(back.height(1, 0), static_cast<float>(-4e-9));
  EXPECT_TRUE(std::isnan(back.height(0, 2)));
}

TEST(ContactMapImage, IsMono8OfTheSameSize) {
  const cv::Mat map = (cv::Mat_<std::uint8_t>(2, 3) << 0, 1, 2, 3, 0, 1);
  const auto message = contactMapImage(map, {});
  EXPECT_EQ(message->encoding, "mono8");
  EXPECT_EQ(message->height, 2U);
  EXPECT_EQ(message->width, 3U);
  EXPECT_EQ(message->data, (std::vector<std::uint8_t>{0, 1, 2, 3, 0, 1}));
}

}  // namespace
}  // namespace mems_stiction
