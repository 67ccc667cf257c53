#include "preprocess/region.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "files/input_file.hpp"
#include "height_map/validity.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

[[noreturn]] void refuse(const char* key, const std::string& path, const std::string& why) {
  const bool is_named = startsWith(why, path + ":");
  throw OptionsError(
      {std::string("preprocessing/region/") + key + ": " + (is_named ? why : path + ": " + why)});
}

std::string cornersText(const std::string& path) {
  try {
    return readInput(path, {"a file of corners", 10'000'000, true});
  } catch (const FileError& error) {
    refuse("polygon_file", path, error.what());
  }
}

std::vector<cv::Point2d> readCorners(const std::string& path) {
  std::istringstream stream(cornersText(path));
  std::vector<cv::Point2d> corners;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    line = line.substr(0, line.find('#'));
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    words.imbue(std::locale::classic());
    cv::Point2d corner;
    if ((words >> std::ws).eof()) continue;
    if (!(words >> corner.x >> corner.y) || !(words >> std::ws).eof()) {
      refuse("polygon_file", path,
             "line " + std::to_string(number) + " is no corner; must be x and y in metres");
    }
    corners.push_back(corner);
  }
  if (corners.size() < 3) {
    refuse("polygon_file", path,
           std::to_string(corners.size()) + " corners make no polygon; must be 3 or more");
  }
  return corners;
}

cv::Mat readMask(const std::string& path) {
  ScanFileOptions options;
  options.pitch_x = options.pitch_y = 1.0;  // a mask lies on the scan's pixels
  try {
    const cv::Mat values = readScanFile(path, {}, options).asDouble().heights();
    return (values != 0.0) & validMask(values);
  } catch (const Error& error) {
    refuse("mask_file", path, error.what());
  }
}

std::string sizeText(const cv::Size& size) {
  return std::to_string(size.width) + " x " + std::to_string(size.height) + " pixels";
}

}  // namespace

void RegionOptions::describe(OptionVisitor& visitor, const std::string& prefix) {
  visitor.number(prefix + "/left", left, "m", Range::nonNegative(),
                 "left edge of the rectangle that counts, from the left edge of the scan");
  visitor.number(prefix + "/top", top, "m", Range::nonNegative(),
                 "upper edge of the rectangle, from the upper edge of the scan");
  visitor.number(prefix + "/width", width, "m", Range::nonNegative(),
                 "of the rectangle; 0 = to the right edge");
  visitor.number(prefix + "/height", height, "m", Range::nonNegative(),
                 "of the rectangle; 0 = to the lower edge");
  visitor.text(prefix + "/polygon_file", polygon_file,
               "text file with the corners of a polygon that counts, x and y in metres in each "
               "line; empty = none");
  visitor.text(prefix + "/mask_file", mask_file,
               "image of the scan's size; pixels that are 0 do not count; empty = none");
}

bool RegionOptions::isStated() const {
  return left > 0.0 || top > 0.0 || width > 0.0 || height > 0.0 || !polygon_file.empty() ||
         !mask_file.empty();
}

Region::Region(const RegionOptions& options) : options_(options) {
  if (!options.polygon_file.empty()) corners_ = readCorners(options.polygon_file);
  if (!options.mask_file.empty()) mask_ = readMask(options.mask_file);
}

const cv::Mat& Region::outside(const cv::Size& size, double pitch_x, double pitch_y) {
  if (outside_.size() == size && pitch_x_ == pitch_x && pitch_y_ == pitch_y) return outside_;
  if (!mask_.empty() && mask_.size() != size) {
    throw SurfaceError("preprocessing/region/mask_file has " + sizeText(mask_.size()) +
                       ", the scan " + sizeText(size));
  }
  std::vector<cv::Point2f> polygon;  // in pixels
  for (const cv::Point2d& corner : corners_) {
    polygon.emplace_back(static_cast<float>(corner.x / pitch_x - 0.5),
                         static_cast<float>(corner.y / pitch_y - 0.5));
  }
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const double right = options_.width > 0.0 ? options_.left + options_.width : kFar;
  const double bottom = options_.height > 0.0 ? options_.top + options_.height : kFar;
  cv::Mat outside(size, CV_8UC1, cv::Scalar(255));
  for (int row = 0; row < size.height; ++row) {
    const double y = (row + 0.5) * pitch_y;
    if (y < options_.top || y >= bottom) continue;
    for (int col = 0; col < size.width; ++col) {
      const double x = (col + 0.5) * pitch_x;
      if (x < options_.left || x >= right) continue;
      if (!mask_.empty() && mask_.at<uchar>(row, col) == 0) continue;
      const cv::Point2f place(static_cast<float>(col), static_cast<float>(row));
      if (!polygon.empty() && cv::pointPolygonTest(polygon, place, false) < 0.0) continue;
      outside.at<uchar>(row, col) = 0;
    }
  }
  if (cv::countNonZero(outside) == static_cast<int>(outside.total())) {
    throw SurfaceError("preprocessing/region leaves no pixel of the scan, which is " +
                       numberText(size.width * pitch_x) + " m wide and " +
                       numberText(size.height * pitch_y) + " m high");
  }
  outside_ = std::move(outside);
  pitch_x_ = pitch_x;
  pitch_y_ = pitch_y;
  return outside_;
}

HeightChange leaveOut(WorkingSurface& surface, const cv::Mat& outside) {
  const cv::Mat valid = validMask(surface.heights);
  HeightChange change;
  change.changed_pixels = cv::countNonZero(valid & outside);
  change.invalid_pixels = static_cast<long long>(surface.heights.total()) -
                          cv::countNonZero(valid) + change.changed_pixels;
  surface.heights.setTo(std::numeric_limits<double>::quiet_NaN(), outside);
  return change;
}

}  // namespace mems_stiction
