#pragma once

/// @file
/// What the pictures for a screen have in common: their size and colours, text, quantities with
/// prefixes.

#include <string>

#include <sensor_msgs/Image.h>
#include <std_msgs/Header.h>
#include <opencv2/core.hpp>

#include "mems_stiction/configuration/provenance.hpp"

namespace mems_stiction {

const cv::Size kPictureSize(1000, 600);  ///< [pixels]
// Of the trend beside them: light on dark.
const cv::Scalar kBackgroundColour(29, 24, 22);
const cv::Scalar kTextColour(242, 242, 242);
const cv::Scalar kQuietColour(184, 173, 168);
const cv::Scalar kGridColour(74, 63, 58);
const cv::Scalar kWarningColour(79, 90, 255);

enum class Align { kLeft, kMiddle, kRight };

/// - @p at the end of the base line that `align` names
void write(cv::Mat& picture, const std::string& text, cv::Point at, const cv::Scalar& colour,
           Align align = Align::kLeft);
/// In lines that fit the width [pixels]; returns the height that the next line would have.
int writeWrapped(cv::Mat& picture, const std::string& text, cv::Point at, int width,
                 const cv::Scalar& colour);
/// In front of whatever is there, its middle as near to that of `at` as the limits [pixels] allow.
void writeLabel(cv::Mat& picture, const std::string& text, cv::Point at, int left, int right);

/// What is known of where a picture comes from, in small letters along its lower edge.
void sign(cv::Mat& picture, const Provenance& provenance);

/// A power of 1000 and the letter for it.
struct Prefix {
  double factor;
  const char* letter;
};
/// With which the largest value has digits before the point.
Prefix prefixOf(double largest);
/// "0.123 uN"
std::string quantity(double value, const char* unit);

/// "pull-off 1.2 uN, apparent work 3 mJ/m^2, 0.5 % in 12 contacts"
std::string figuresText(double pull_off_force, double apparent_work_of_adhesion,
                        double contact_fraction, long contacts);

/// bgr8
sensor_msgs::ImagePtr imageOf(const cv::Mat& picture, const std_msgs::Header& header);

}  // namespace mems_stiction
