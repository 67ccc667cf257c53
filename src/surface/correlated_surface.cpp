#include "surface/correlated_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "height_map/validity.hpp"
#include "numeric/constants.hpp"
#include "roughness/filled_surface.hpp"

namespace mems_stiction {
namespace {

constexpr double kBandsPerOctave = 4.0;
constexpr int kLeastWaves = 24;

/// Every pixel of the scan; lines at its border without a measured one repeat the nearest.
cv::Mat allHeights(const HeightMap& scan) {
  const cv::Rect measured = cv::boundingRect(validMask(scan.heights()));
  const HeightMap inner(scan.heights()(measured), scan.pitchX(), scan.pitchY());
  cv::Mat heights;
  filledSurface(inner).surface.heights().convertTo(heights, CV_64F);
  cv::copyMakeBorder(heights, heights, measured.y, scan.rows() - measured.br().y, measured.x,
                     scan.cols() - measured.br().x, cv::BORDER_REPLICATE);
  return heights;
}

/// Waves of a frame that goes on by its reflections; frames of odd sides have one more line.
cv::Mat reflectedWaves(cv::Mat heights) {
  cv::copyMakeBorder(heights, heights, 0, heights.rows % 2, 0, heights.cols % 2,
                     cv::BORDER_REFLECT);
  heights -= cv::mean(heights);
  cv::Mat waves;
  cv::dct(heights, waves);
  return waves;
}

/// Powers of the waves of two frames of one grid, by bands of their wave number.
class Bands {
 public:
  Bands(const cv::Mat& scan, const cv::Mat& made, double pitch_x, double pitch_y)
      : step_x_(kPi / (scan.cols * pitch_x)), step_y_(kPi / (scan.rows * pitch_y)) {
    const double largest = std::hypot(scan.cols * step_x_, scan.rows * step_y_);
    std::vector<Sum> sums(placeOf(largest) + 1);
    for (int row = 0; row < scan.rows; ++row) {
      for (int col = row == 0 ? 1 : 0; col < scan.cols; ++col) {
        const double wave_number = waveNumber(row, col);
        sums[placeOf(wave_number)].add(scan.at<double>(row, col), made.at<double>(row, col),
                                       std::log(wave_number));
      }
    }
    join(sums);
  }

  /// [rad/m]
  double waveNumber(int row, int col) const { return std::hypot(col * step_x_, row * step_y_); }
  /// sqrt(C_2/C_1) of a wave, between the bands beside it; 0 where one of both has no such waves.
  double gain(double wave_number) const {
    const Band& band = bands_[band_of_place_[placeOf(wave_number)]];
    if (!band.isKnown()) return 0.0;
    const double at = std::log(wave_number);
    const Band* beside = &band + (at < band.middle ? -1 : 1);
    const bool is_there = beside >= bands_.data() && beside < bands_.data() + bands_.size();
    if (!is_there || !beside->isKnown() || beside->middle == band.middle)
      return std::exp(band.log_gain);
    const double share = (at - band.middle) / (beside->middle - band.middle);
    return std::exp(band.log_gain + share * (beside->log_gain - band.log_gain));
  }

 private:
  struct Sum {
    double scan = 0.0;
    double made = 0.0;
    double weight = 0.0;
    double middle = 0.0;
    int count = 0;

    void add(double of_scan, double of_made, double log_wave_number) {
      scan += of_scan * of_scan;
      made += of_made * of_made;
      weight += std::abs(of_scan * of_made);
      middle += std::abs(of_scan * of_made) * log_wave_number;
      ++count;
    }
    void add(const Sum& other) {
      scan += other.scan;
      made += other.made;
      weight += other.weight;
      middle += other.middle;
      count += other.count;
    }
  };
  struct Band {
    double middle = 0.0;  ///< mean ln of the wave number, by power
    double log_gain = -std::numeric_limits<double>::infinity();

    explicit Band(const Sum& sum) {
      if (!(sum.scan > 0.0 && sum.made > 0.0 && sum.weight > 0.0)) return;
      middle = sum.middle / sum.weight;
      log_gain = 0.5 * std::log(sum.made / sum.scan);
    }
    bool isKnown() const { return std::isfinite(log_gain); }
  };

  std::size_t placeOf(double wave_number) const {
    const double octaves = std::log2(wave_number / std::min(step_x_, step_y_));
    return static_cast<std::size_t>(std::max(0.0, kBandsPerOctave * octaves));
  }

  /// Neighbours with few waves are one band.
  void join(const std::vector<Sum>& sums) {
    Sum joined;
    for (const Sum& sum : sums) {
      joined.add(sum);
      band_of_place_.push_back(bands_.size());
      if (joined.count < kLeastWaves) continue;
      bands_.emplace_back(joined);
      joined = Sum();
    }
    // the last waves, in the corner of the transform, or all of a small frame
    if (joined.count > 0 || bands_.empty()) bands_.emplace_back(joined);
    for (std::size_t& band : band_of_place_) band = std::min(band, bands_.size() - 1);
  }

  double step_x_;
  double step_y_;
  std::vector<Band> bands_;
  std::vector<std::size_t> band_of_place_;
};

}  // namespace

HeightMap correlatedWith(const HeightMap& scan, const HeightMap& made, const SurfaceFit& fit) {
  const cv::Mat of_scan = reflectedWaves(allHeights(scan));
  if (!(cv::norm(of_scan) > 0.0)) return made;
  cv::Mat heights;
  made.heights().convertTo(heights, CV_64F);
  cv::Mat change = reflectedWaves(heights);
  const Bands bands(of_scan, change, made.pitchX(), made.pitchY());
  const double own = std::sqrt(1.0 - fit.correlation * fit.correlation);
  const double last = fit.shortest_shared > 0.0 ? 2.0 * kPi / fit.shortest_shared
                                                : std::numeric_limits<double>::infinity();
  for (int row = 0; row < change.rows; ++row) {
    for (int col = 0; col < change.cols; ++col) {
      double& wave = change.at<double>(row, col);
      const double wave_number = bands.waveNumber(row, col);
      const double gain = wave_number > 0.0 && wave_number <= last ? bands.gain(wave_number) : 0.0;
      wave = gain > 0.0 ? fit.correlation * gain * of_scan.at<double>(row, col) - (1.0 - own) * wave
                        : 0.0;
    }
  }
  cv::idct(change, change);
  heights += change(cv::Rect(cv::Point(), heights.size()));
  heights -= cv::mean(heights);
  const double rms_height =
      heightStatistics(HeightMap(heights, made.pitchX(), made.pitchY())).rms_height;
  if (rms_height > 0.0) heights *= heightStatistics(made).rms_height / rms_height;
  return {heights, made.pitchX(), made.pitchY()};
}

}  // namespace mems_stiction
