#include "mems_stiction/ros/picture_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>
#include <opencv2/imgproc.hpp>

namespace mems_stiction {
namespace {

constexpr double kLetters = 0.7;
constexpr int kLineHeight = 30;  // [pixels]

cv::Size sizeOf(const std::string& text) {
  return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kLetters, 1, nullptr);
}

}  // namespace

void write(cv::Mat& picture, const std::string& text, cv::Point at, const cv::Scalar& colour, Align align) {
  const int width = sizeOf(text).width;
  if (align == Align::kMiddle) at.x -= width / 2;
  if (align == Align::kRight) at.x -= width;
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, kLetters, colour, 1, cv::LINE_AA);
}

int writeWrapped(cv::Mat& picture, const std::string& text, cv::Point at, int width, const cv::Scalar& colour) {
  std::string line;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const std::string longer = line.empty() ? word : line + " " + word;
    if (!line.empty() && sizeOf(longer).width > width) {
      write(picture, line, at, colour);
      at.y += kLineHeight;
      line = word;
    } else {
      line = longer;
    }
    begin = end + 1;
  }
  write(picture, line, at, colour);
  return at.y + kLineHeight;
}

void writeLabel(cv::Mat& picture, const std::string& text, cv::Point at, int left, int right) {
  const cv::Size size = sizeOf(text);
  at.x = std::clamp(at.x - size.width / 2, left + 8, right - size.width - 8);
  cv::rectangle(picture, {at.x - 4, at.y - size.height - 4}, {at.x + size.width + 4, at.y + 6}, kBackgroundColour,
                cv::FILLED);
  write(picture, text, at, kTextColour);
}

Prefix prefixOf(double largest) {
  constexpr std::array<Prefix, 6> kPrefixes = {
      {{1.0, ""}, {1e-3, "m"}, {1e-6, "u"}, {1e-9, "n"}, {1e-12, "p"}, {1e-15, "f"}}};
  for (const Prefix& prefix : kPrefixes) {
    if (largest >= prefix.factor) return prefix;
  }
  return kPrefixes.back();
}

std::string numberOf(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string quantity(double value, const char* unit) {
  if (!std::isfinite(value) || value == 0.0) return numberOf(value) + " " + unit;
  const Prefix prefix = prefixOf(std::abs(value));
  return numberOf(value / prefix.factor) + " " + prefix.letter + unit;
}

sensor_msgs::ImagePtr imageOf(const cv::Mat& picture, const std_msgs::Header& header) {
  return cv_bridge::CvImage(header, sensor_msgs::image_encodings::BGR8, picture).toImageMsg();
}

}  // namespace mems_stiction
