#include "evaluation/scan_flags.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "numeric/constants.hpp"
#include "verdict/missing_scan.hpp"

namespace mems_stiction {
namespace {

/// Contacts that reach pixels outside the region count as those at the frame's border: their
/// summits may lie there. Pixels outside are no missing ones: invalid_fraction is that of the
/// region.
/// - @p prepared with a region
void countRegionAlone(const PreparedScan& prepared, Prediction& prediction) {
  const HeightMap& scan = prepared.surfaces.lower;
  const double pixels = static_cast<double>(prepared.outside.total());
  const double left_out = cv::countNonZero(prepared.outside);
  prediction.invalid_fraction =
      std::max(0.0, (prediction.invalid_fraction * pixels - left_out) / (pixels - left_out));

  // From the middle of each pixel to that of the nearest one outside, in pixels: exact along rows
  // and columns.
  cv::Mat distance;
  cv::distanceTransform(prepared.outside == 0, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  const double pitch = std::max(scan.pitchX(), scan.pitchY());
  const auto mark = [&](Asperity& asperity) {
    const int col =
        std::clamp(static_cast<int>(std::lround(asperity.x / scan.pitchX())), 0, scan.cols() - 1);
    const int row =
        std::clamp(static_cast<int>(std::lround(asperity.y / scan.pitchY())), 0, scan.rows() - 1);
    const double radius = std::sqrt(asperity.area / kPi);
    // A contact ends half a pixel before the middle of the first one outside.
    if ((static_cast<double>(distance.at<float>(row, col)) - 1.0) * pitch <= radius)
      asperity.is_at_border = true;
  };
  std::for_each(prediction.asperities.begin(), prediction.asperities.end(), mark);
  std::for_each(prediction.pull_off_contacts.begin(), prediction.pull_off_contacts.end(), mark);
}

}  // namespace

void bringContactsToScan(const PreparedScan& prepared, Prediction& prediction) {
  const int factor = prepared.refinement;
  const HeightMap& fine = prepared.model_surfaces.lower;
  for (auto* const contacts : {&prediction.asperities, &prediction.pull_off_contacts}) {
    for (Asperity& contact :
         *contacts) {  // from the middle of the first fine pixel to that of the scan's
      contact.x -= 0.5 * (factor - 1) * fine.pitchX();
      contact.y -= 0.5 * (factor - 1) * fine.pitchY();
    }
  }
}

void flagByScan(const PreparedScan& prepared, const ShortWaves& waves, Prediction& prediction) {
  prediction.short_waves = waves;
  if (!prepared.outside.empty()) countRegionAlone(prepared, prediction);
}

MeasuredScan measuredScan(const PreparedScan& prepared, const Options& options) {
  const ShortWaves waves = shortWaves(prepared.short_waves, options);
  return {prepared.surfaces.lower.cellArea(), [prepared, waves](Prediction& prediction) {
            bringContactsToScan(prepared, prediction);
            flagByScan(prepared, waves, prediction);
          }};
}

}  // namespace mems_stiction
