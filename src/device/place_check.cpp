#include "device/place_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "device/area_load.hpp"
#include "device/law_check.hpp"
#include "device/scan_list.hpp"
#include "errors/short_number.hpp"
#include "height_map/validity.hpp"
#include "numeric/constants.hpp"
#include "numeric/mean.hpp"
#include "numeric/median.hpp"
#include "preprocess/level.hpp"
#include "surface/alignment.hpp"
#include "verdict/part_verdict.hpp"

namespace mems_stiction {
namespace {

/// Blocks along each side of a scan, and pixels along the side of the smallest one.
constexpr int kBlocks = 4;
constexpr int kLeastBlock = 24;
constexpr double kLeastMeasuredOfBlock = 0.5;
/// Places differ by more than chance from so many standard deviations on (of a few made scans more,
/// by Student's distribution), and from so many times what the most uneven made scan has: the
/// largest of sixteen logarithms has a long tail.
constexpr double kBeyondChance = 5.0;
constexpr double kBeyondMost = 1.25;

/// Variance of the differences of neighbours, over both directions: the mean squared gradient about
/// its mean.
double gradientVariance(const HeightMap& block) {
  const cv::Mat heights = block.asDouble().heights();
  double total = 0.0;
  for (const bool is_along_x : {true, false}) {
    const double pitch = is_along_x ? block.pitchX() : block.pitchY();
    const cv::Point step = is_along_x ? cv::Point(1, 0) : cv::Point(0, 1);
    double count = 0.0;
    double sum = 0.0;
    double squares = 0.0;
    for (int row = 0; row + step.y < heights.rows; ++row) {
      for (int col = 0; col + step.x < heights.cols; ++col) {
        const double slope =
            (heights.at<double>(row + step.y, col + step.x) - heights.at<double>(row, col)) / pitch;
        if (!std::isfinite(slope)) continue;
        count += 1.0;
        sum += slope;
        squares += slope * slope;
      }
    }
    if (count > 0.0) total += squares / count - (sum / count) * (sum / count);
  }
  return total;
}

HeightMap blockOf(const HeightMap& scan, const cv::Rect& place) {
  return {scan.heights()(place).clone(), scan.pitchX(), scan.pitchY()};
}

void overMedian(double PlaceTexture::*figure, std::vector<PlaceTexture>& textures) {
  std::vector<double> values;
  for (const PlaceTexture& texture : textures) values.push_back(texture.*figure);
  const double median = medianOf(values);
  for (PlaceTexture& texture : textures) texture.*figure -= median;
}

}  // namespace

std::vector<PlaceTexture> placeTextures(const HeightMap& scan) {
  const int rows = scan.rows() / kBlocks;
  const int cols = scan.cols() / kBlocks;
  if (std::min(rows, cols) < kLeastBlock) return {};
  std::vector<PlaceTexture> textures;
  for (int y = 0; y < kBlocks; ++y) {
    for (int x = 0; x < kBlocks; ++x) {
      PlaceTexture texture;
      texture.place = cv::Rect(x * cols, y * rows, cols, rows);
      const HeightMap block = blockOf(scan, texture.place);
      if (1.0 - invalidFraction(block) < kLeastMeasuredOfBlock) continue;
      const double deviation = heightStatistics(levelled(block)).rms_height;
      texture.gradient = logOf(gradientVariance(block));
      texture.height = logOf(deviation * deviation);
      textures.push_back(texture);
    }
  }
  overMedian(&PlaceTexture::gradient, textures);
  overMedian(&PlaceTexture::height, textures);
  return textures;
}

PlaceCheck::PlaceCheck(const Options& model, double loaded_area,
                       const std::vector<NamedScan>& scans,
                       const std::vector<HeightMap>& counter_surface)
    : model_(model),
      loaded_area_(loaded_area),
      adhesion_(model),
      scans_(scans),
      counter_surface_(counter_surface) {
  const double finest = finestPitch(mapsOf(scans));
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (!showsSummits(scans[i].surface, finest)) continue;
    const std::vector<PlaceTexture> textures = placeTextures(scans[i].surface);
    if (textures.empty()) continue;
    checked_.emplace_back();
    checked_.back().scan = i;
    checked_.back().own = rangeOf(textures);
  }
}

PlaceCheck::Range PlaceCheck::rangeOf(const std::vector<PlaceTexture>& textures) {
  Range range;
  for (const PlaceTexture& texture : textures) {
    range.gradient = std::max(range.gradient, std::abs(texture.gradient));
    range.height = std::max(range.height, std::abs(texture.height));
  }
  return range;
}

void PlaceCheck::add(const std::vector<HeightMap>& made, const PlaceCheck* same_scans) {
  for (std::size_t i = 0; i < checked_.size(); ++i) {
    checked_[i].made.push_back(same_scans != nullptr
                                   ? same_scans->checked_[i].made.back()
                                   : rangeOf(placeTextures(made[checked_[i].scan])));
  }
}

bool PlaceCheck::find() {
  for (Checked& checked : checked_) {
    if (isBeyond(checked))
      checked.strongest = strongestOf(scans_[checked.scan].surface, counter_surface_);
  }
  return closes();
}

void PlaceCheck::compare(const std::vector<HeightMap>& made,
                         const std::vector<HeightMap>& made_counter_surface) {
  for (const Checked& checked : checked_) {
    if (!checked.strongest || !checked.strongest->is_conforming) continue;
    made_.push_back(strongestOf(made[checked.scan], made_counter_surface));
  }
}

std::vector<double> PlaceCheck::madeLike(const Checked& checked, double Range::*figure) const {
  const HeightMap& scan = scans_[checked.scan].surface;
  std::vector<double> figures;
  for (const Checked& other : checked_) {
    if (!haveSameGrid(scans_[other.scan].surface, scan)) continue;
    for (const Range& made : other.made) figures.push_back(made.*figure);
  }
  return figures;
}

bool PlaceCheck::isBeyond(const Checked& checked) const {
  const auto isMore = [&](double Range::*figure) {
    const std::vector<double> made = madeLike(checked, figure);
    const auto count = static_cast<double>(made.size());
    const double deviations =
        kBeyondChance * studentQuantile(count - 1.0) / kNormal95 * std::sqrt(1.0 + 1.0 / count);
    const double most = *std::max_element(made.begin(), made.end());
    return checked.own.*figure >
           std::max(kBeyondMost * most, meanOf(made) + deviations * deviationOf(made));
  };
  return checked.made.size() > 1 && (isMore(&Range::gradient) || isMore(&Range::height));
}

PlaceCheck::Strongest PlaceCheck::strongestOf(const HeightMap& scan,
                                              const std::vector<HeightMap>& counter_surface) {
  Strongest strongest;
  strongest.force = -std::numeric_limits<double>::infinity();
  for (const PlaceTexture& texture : placeTextures(scan)) {
    SurfacePair block =
        underCounterSurface(levelled(blockOf(scan, texture.place)), counter_surface);
    if (!block.upperIsPlane()) block.upper = levelled(block.upper);
    adhesion_.setOptions(loadedOn(model_, loaded_area_, areaOf(block.lower)));
    const Prediction found = adhesion_.predict(block);
    const double force = logOf(found.pull_off_force);
    if (!(force > strongest.force)) continue;
    strongest = {force, logOf(found.apparent_work_of_adhesion), found.is_conforming, texture};
  }
  return strongest;
}

const PlaceCheck::Checked* PlaceCheck::place() const {
  const Checked* found = nullptr;
  for (const Checked& checked : checked_) {
    if (!checked.strongest) continue;
    if (found == nullptr || checked.strongest->force > found->strongest->force) found = &checked;
  }
  return found;
}

bool PlaceCheck::closes() const {
  const Checked* uneven = place();
  return uneven != nullptr && uneven->strongest->is_conforming;
}

PlaceAlone PlaceCheck::alone() const {
  const Checked* uneven = place();
  if (uneven == nullptr) return {};
  const Strongest& strongest = *uneven->strongest;
  const HeightMap& scan = scans_[uneven->scan].surface;
  return {std::exp(strongest.force), std::exp(strongest.work),
          strongest.texture.place.area() * scan.pitchX() * scan.pitchY()};
}

double PlaceCheck::excess(double Strongest::*figure) const {
  if (!closes() || made_.empty()) return 0.0;
  const Checked* uneven = place();
  std::vector<double> made;
  for (const Strongest& strongest : made_) made.push_back(strongest.*figure);
  return std::max(0.0, (*uneven->strongest).*figure - meanOf(made));
}

std::string PlaceCheck::sentence() const {
  const Checked* uneven = place();
  if (uneven == nullptr) return "";
  const PlaceTexture& texture = uneven->strongest->texture;
  const HeightMap& scan = scans_[uneven->scan].surface;
  const auto middle = [](int first, int count, double pitch) {
    return shortNumber((first + 0.5 * count) * pitch * 1e6, 2);
  };
  return scans_[uneven->scan].name + ": its places differ by more than chance. The " +
         shortNumber(texture.place.width * scan.pitchX() * 1e6, 2) + " x " +
         shortNumber(texture.place.height * scan.pitchY() * 1e6, 2) +
         " um about x = " + middle(texture.place.x, texture.place.width, scan.pitchX()) +
         " um, y = " + middle(texture.place.y, texture.place.height, scan.pitchY()) +
         " um hold most; over the scan's other places their rms gradient is " +
         shortNumber(std::exp(0.5 * texture.gradient), 2) + ", their rms height " +
         shortNumber(std::exp(0.5 * texture.height), 2);
}

}  // namespace mems_stiction
