#include "evaluation/region_border.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "numeric/constants.hpp"

namespace mems_stiction {

void countRegionAlone(const PreparedScan& prepared, Prediction& prediction) {
  const HeightMap& scan = prepared.surfaces.lower;
  const double pixels = static_cast<double>(prepared.outside.total());
  const double left_out = cv::countNonZero(prepared.outside);
  prediction.invalid_fraction = std::max(0.0, (prediction.invalid_fraction * pixels - left_out) / (pixels - left_out));

  // From the middle of each pixel to that of the nearest one outside, in pixels: exact along rows and columns.
  cv::Mat distance;
  cv::distanceTransform(prepared.outside == 0, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  const double pitch = std::max(scan.pitchX(), scan.pitchY());
  const auto mark = [&](Asperity& asperity) {
    const int col = std::clamp(static_cast<int>(std::lround(asperity.x / scan.pitchX())), 0, scan.cols() - 1);
    const int row = std::clamp(static_cast<int>(std::lround(asperity.y / scan.pitchY())), 0, scan.rows() - 1);
    const double radius = std::sqrt(asperity.area / kPi);
    // A contact ends half a pixel before the middle of the first one outside.
    if ((static_cast<double>(distance.at<float>(row, col)) - 1.0) * pitch <= radius) asperity.is_at_border = true;
  };
  std::for_each(prediction.asperities.begin(), prediction.asperities.end(), mark);
  std::for_each(prediction.pull_off_contacts.begin(), prediction.pull_off_contacts.end(), mark);
}

}  // namespace mems_stiction
