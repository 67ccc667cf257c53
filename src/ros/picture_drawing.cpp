#include "ros/picture_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <sensor_msgs/image_encodings.h>
#include <opencv2/imgproc.hpp>

#include "errors/short_number.hpp"
#include "ros/image_conversion.hpp"

namespace mems_stiction {
namespace {

constexpr double kLetters = 0.7;
constexpr double kSmallLetters = 0.42;
constexpr int kLineHeight = 30;  // [pixels]

cv::Size sizeOf(const std::string& text) {
  return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kLetters, 1, nullptr);
}

}  // namespace

void write(cv::Mat& picture, const std::string& text, cv::Point at, const cv::Scalar& colour,
           Align align) {
  const int width = sizeOf(text).width;
  if (align == Align::kMiddle) at.x -= width / 2;
  if (align == Align::kRight) at.x -= width;
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, kLetters, colour, 1, cv::LINE_AA);
}

int writeWrapped(cv::Mat& picture, const std::string& text, cv::Point at, int width,
                 const cv::Scalar& colour) {
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
  cv::rectangle(picture, {at.x - 4, at.y - size.height - 4}, {at.x + size.width + 4, at.y + 6},
                kBackgroundColour, cv::FILLED);
  write(picture, text, at, kTextColour);
}

void sign(cv::Mat& picture, const Provenance& provenance) {
  std::string text;
  for (const auto& [word, value] :
       {std::pair("scan ", provenance.scan_name), std::pair("part ", provenance.part_id),
        std::pair("serial number ", provenance.serial_id), std::pair("lot ", provenance.lot_id),
        std::pair("wafer ", provenance.wafer_id), std::pair("settings ", provenance.settings_hash),
        std::pair("mems_stiction ", provenance.version)}) {
    if (!value.empty()) text += (text.empty() ? "" : ", ") + (word + value);
  }
  const int width =
      cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kSmallLetters, 1, nullptr).width;
  cv::putText(picture, text, {std::max(10, picture.cols - 10 - width), picture.rows - 10},
              cv::FONT_HERSHEY_SIMPLEX, kSmallLetters, kQuietColour, 1, cv::LINE_AA);
}

Prefix prefixOf(double largest) {
  constexpr std::array<Prefix, 6> kPrefixes = {
      {{1.0, ""}, {1e-3, "m"}, {1e-6, "u"}, {1e-9, "n"}, {1e-12, "p"}, {1e-15, "f"}}};
  for (const Prefix& prefix : kPrefixes) {
    if (largest >= prefix.factor) return prefix;
  }
  return kPrefixes.back();
}

std::string quantity(double value, const char* unit) {
  if (!std::isfinite(value) || value == 0.0) return shortNumber(value) + " " + unit;
  const Prefix prefix = prefixOf(std::abs(value));
  return shortNumber(value / prefix.factor) + " " + prefix.letter + unit;
}

std::string figuresText(double pull_off_force, double apparent_work_of_adhesion,
                        double contact_fraction, long contacts) {
  return "pull-off " + quantity(pull_off_force, "N") + ", apparent work " +
         quantity(apparent_work_of_adhesion, "J/m^2") + ", " +
         shortNumber(100.0 * contact_fraction) + " % in " + std::to_string(contacts) +
         (contacts == 1 ? " contact" : " contacts");
}

sensor_msgs::ImagePtr imageOf(const cv::Mat& picture, const std_msgs::Header& header) {
  return imageMessage(picture, sensor_msgs::image_encodings::BGR8, header);
}

}  // namespace mems_stiction
