#include "device/surface_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "device/scan_list.hpp"
#include "preprocess/level.hpp"

namespace mems_stiction {
namespace {

/// chi^2 of skewness and kurtosis from which heights are not Gaussian beyond doubt.
constexpr double kDecisive = 25.0;
/// Two degrees of freedom are as large as this by chance in one of seven.
constexpr double kShareByChance = 4.0;
/// Share of the variance that the widest scan must have to speak for all heights.
constexpr double kMostVariance = 0.985;
/// Waves along the side of the fine scans above which the short ones are looked at by themselves.
constexpr double kSplits[] = {2.0, 4.0, 8.0};
/// The longest waves that a levelled scan has, along its side.
constexpr double kFirstOfLevelled = 0.75;
/// Octaves of the longest waves that tell whether the spectrum still rises.
constexpr double kEndOctaves = 1.5;
constexpr int kLevelSteps = 3;
constexpr int kLevelStride = 7;
constexpr double kMostNumber = 3.5;

/// One scan in work, without slope, its holes filled.
struct Scan {
  cv::Mat heights;    ///< CV_64FC1
  cv::Mat distances;  ///< of FilledSurface
  double pitch_x = 0.0;
  double pitch_y = 0.0;
  bool is_fine = false;

  double sideX() const { return heights.cols * pitch_x; }
  double sideY() const { return heights.rows * pitch_y; }
  double measuredShare() const {
    if (distances.empty()) return 1.0;
    return 1.0 - static_cast<double>(cv::countNonZero(distances)) /
                     static_cast<double>(distances.total());
  }
  double area() const { return sideX() * sideY() * measuredShare(); }  ///< that was measured
  double longerSide() const { return std::max(sideX(), sideY()); }
  HeightMap map(const cv::Mat& values) const { return {values, pitch_x, pitch_y}; }
  FilledSurface filled(const cv::Mat& values) const {
    if (distances.empty()) return {map(values), {}};
    return {map(values), distances(cv::Rect(cv::Point(), values.size()))};
  }
};

struct Moments {
  double mean = 0.0;
  double deviation = 0.0;
  double skewness = 0.0;
  double excess = 0.0;  ///< kurtosis - 3
};

Moments momentsOf(const std::vector<double>& values) {
  Moments moments;
  const auto count = static_cast<double>(values.size());
  for (const double value : values) moments.mean += value / count;
  double second = 0.0;
  double third = 0.0;
  double fourth = 0.0;
  for (const double value : values) {
    const double distance = value - moments.mean;
    const double square = distance * distance;
    second += square / count;
    third += square * distance / count;
    fourth += square * square / count;
  }
  moments.deviation = std::sqrt(second);
  if (second > 0.0) {
    moments.skewness = third / (second * moments.deviation);
    moments.excess = fourth / (second * second) - 3.0;
  }
  return moments;
}

/// Of the moments over an area of a Gaussian surface.
struct SamplingVariance {
  double skewness = 0.0;
  double excess = 0.0;
  double independent = 0.0;  ///< places: the area over the integral of rho^2 [-]
};

/// The power of a spectrum above a split, asked for by rising wave numbers:
/// MergedSpectrum::densityAt() with its logarithms at hand.
class RisingDensities {
 public:
  RisingDensities(const MergedSpectrum& spectrum, double longest, double split)
      : largest_(spectrum.largest_wave_number), longest_(longest), split_(split) {
    for (const SpectrumBand& band : spectrum.bands) {
      bands_.push_back({band.wave_number, std::log(band.wave_number), std::log(band.density), 0.0});
    }
    for (std::size_t i = 0; i + 1 < bands_.size(); ++i) {
      bands_[i].slope = (bands_[i + 1].log_density - bands_[i].log_density) /
                        (bands_[i + 1].log_wave_number - bands_[i].log_wave_number);
    }
  }

  void restart() { place_ = 0; }
  double at(double q) {
    if (q < longest_ || q > largest_) return 0.0;
    while (place_ + 1 < bands_.size() && bands_[place_ + 1].wave_number <= q) ++place_;
    const Band& band = bands_[place_];
    const double beyond = q > band.wave_number ? std::log(q) - band.log_wave_number : 0.0;
    const double pass = highPass(q, split_);
    return std::exp(band.log_density + band.slope * beyond) * pass * pass;
  }

 private:
  struct Band {
    double wave_number;
    double log_wave_number;
    double log_density;
    double slope;  ///< up to the next one
  };
  std::vector<Band> bands_;
  double largest_;
  double longest_;
  double split_;
  std::size_t place_ = 0;
};

SamplingVariance samplingVariance(const MergedSpectrum& spectrum, double split, double longest,
                                  double area) {
  constexpr int kSide = 512;
  constexpr int kSteps = 2000;
  constexpr double kResolved = 0.97;  // of the variance, on the grid of the integral
  const auto densityAt = [&](double q) {
    const double pass = highPass(q, split);
    return q < longest ? 0.0 : spectrum.densityAt(q) * pass * pass;
  };
  const double from = std::max(longest, 0.5 * spectrum.bands.front().wave_number);
  const double to = spectrum.bands.back().wave_number;
  const double step = std::log(to / from) / kSteps;
  std::vector<double> sums;
  double sum = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const double q = from * std::exp(i * step);
    sum += densityAt(q) * q * q;
    sums.push_back(sum);
  }
  const auto reached = std::lower_bound(sums.begin(), sums.end(), kResolved * sum) - sums.begin();
  const double resolved = from * std::exp(static_cast<double>(reached) * step);
  const double pitch = std::max(kPi / resolved, 3.0 * 2.0 * kPi / longest / kSide);
  cv::Mat powers(kSide, kSide, CV_64FC1);
  RisingDensities densities(spectrum, longest, split);
  // One eighth of the plane has all wave numbers.
  const auto opposite = [](int place) { return (kSide - place) % kSide; };
  for (int row = 0; row <= kSide / 2; ++row) {
    densities.restart();
    for (int col = row; col <= kSide / 2; ++col) {
      const double power = densities.at(2.0 * kPi * std::hypot(row, col) / (kSide * pitch));
      for (const int one : {row, opposite(row)}) {
        for (const int other : {col, opposite(col)}) {
          powers.at<double>(one, other) = power;
          powers.at<double>(other, one) = power;
        }
      }
    }
  }
  // A correlation has no imaginary part: of what cv::dft() packs every other value is 0.
  cv::Mat correlation;
  cv::dft(powers, correlation);
  const double variance = correlation.at<double>(0, 0);
  double squares = 0.0;
  double cubes = 0.0;
  double fourths = 0.0;
  const auto add = [&](double value, double count) {
    const double rho = value / variance;
    squares += count * rho * rho;
    cubes += count * rho * rho * rho;
    fourths += count * rho * rho * rho * rho;
  };
  for (int row = 0; row < kSide; ++row) {
    const double* line = correlation.ptr<double>(row);
    for (int col = 1; col + 1 < kSide; col += 2) add(line[col], 2.0);
  }
  for (const int col : {0, kSide - 1}) {
    for (const int row : {0, kSide - 1}) add(correlation.at<double>(row, col), 1.0);
    for (int row = 1; row + 1 < kSide; row += 2) add(correlation.at<double>(row, col), 2.0);
  }
  const double cell = pitch * pitch / area;
  return {6.0 * cell * std::abs(cubes), 24.0 * cell * fourths, 1.0 / (cell * squares)};
}

/// The waves above a split, of a frame that goes on by its reflections.
cv::Mat highPassed(const Scan& scan, double split) {
  if (split == 0.0) return scan.heights;
  const cv::Rect even(0, 0, scan.heights.cols & ~1, scan.heights.rows & ~1);
  cv::Mat waves;
  cv::dct(scan.heights(even), waves);
  for (int row = 0; row < waves.rows; ++row) {
    const double q_y = kPi * row / (waves.rows * scan.pitch_y);
    double* line = waves.ptr<double>(row);
    for (int col = 0; col < waves.cols; ++col) {
      const double q_x = kPi * col / (waves.cols * scan.pitch_x);
      const double q = std::sqrt(q_x * q_x + q_y * q_y);
      if (q > kHighPassEnd * split) break;  // and so do all shorter waves
      line[col] *= highPass(q, split);
    }
  }
  cv::Mat passed;
  cv::idct(waves, passed);
  return passed;
}

/// Every so many values that were measured, without a margin.
/// - @p distances of FilledSurface
void addSample(const cv::Mat& values, const cv::Mat& distances, double margin, int stride,
               std::vector<double>& sample) {
  const int rows = static_cast<int>(margin * values.rows);
  const int cols = static_cast<int>(margin * values.cols);
  for (int row = rows; row < values.rows - rows; row += stride) {
    const double* line = values.ptr<double>(row);
    const float* filled = distances.empty() ? nullptr : distances.ptr<float>(row);
    for (int col = cols; col < values.cols - cols; col += stride) {
      if (filled == nullptr || filled[col] == 0.0F) sample.push_back(line[col]);
    }
  }
}

/// Mean and slope off so that the numbers of the heights have none: steps of Newton's method.
cv::Mat levelledUnder(const HeightMarginal& marginal, const cv::Mat& heights) {
  cv::Mat found = heights.clone();
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(found, mean, deviation);
  if (!(deviation[0] > 0.0)) return found;
  const double step = 1e-3 * deviation[0];
  const auto placeOf = [](int index, int count) { return (index - 0.5 * (count - 1)) / count; };
  for (int round = 0; round < kLevelSteps; ++round) {
    cv::Matx33d matrix = cv::Matx33d::zeros();
    cv::Vec3d vector(0.0, 0.0, 0.0);
    for (int place = 0; place < static_cast<int>(found.total()); place += kLevelStride) {
      const int row = place / found.cols;
      const int col = place % found.cols;
      const double height = found.at<double>(row, col);
      const double number = marginal.numberOf(height);
      double slope =
          (marginal.numberOf(height + step) - marginal.numberOf(height - step)) / (2.0 * step);
      slope = std::abs(number) > kMostNumber ? 0.0 : std::clamp(slope, 0.0, 10.0 / deviation[0]);
      const cv::Vec3d base(1.0, placeOf(col, found.cols), placeOf(row, found.rows));
      matrix += slope * (base * base.t());
      vector += std::clamp(number, -kMostNumber, kMostNumber) * base;
    }
    cv::Vec3d plane;
    if (!cv::solve(matrix, vector, plane, cv::DECOMP_SVD)) return found;
    for (int row = 0; row < found.rows; ++row) {
      double* line = found.ptr<double>(row);
      for (int col = 0; col < found.cols; ++col) {
        line[col] -=
            plane[0] + plane[1] * placeOf(col, found.cols) + plane[2] * placeOf(row, found.rows);
      }
    }
  }
  return found;
}

cv::Mat numbersOf(const HeightMarginal& marginal, const cv::Mat& heights) {
  cv::Mat numbers(heights.size(), CV_64FC1);
  for (int row = 0; row < heights.rows; ++row) {
    const double* from = heights.ptr<double>(row);
    double* to = numbers.ptr<double>(row);
    for (int col = 0; col < heights.cols; ++col) to[col] = marginal.numberOf(from[col]);
  }
  return numbers;
}

std::vector<Scan> scansOf(const std::vector<HeightMap>& surfaces) {
  const double finest = finestPitch(surfaces);
  std::vector<Scan> scans;
  for (const HeightMap& surface : surfaces) {
    Scan scan;
    const FilledSurface filled = filledSurface(surface);
    levelled(filled.surface).heights().convertTo(scan.heights, CV_64F);
    scan.distances = filled.distances;
    scan.pitch_x = surface.pitchX();
    scan.pitch_y = surface.pitchY();
    scan.is_fine = showsSummits(surface, finest);
    scans.push_back(scan);
  }
  return scans;
}

/// The one with the longest side, if it is larger than the fine ones.
const Scan* widestOf(const std::vector<Scan>& scans) {
  const Scan* widest = nullptr;
  double fine_side = std::numeric_limits<double>::infinity();
  for (const Scan& scan : scans) {
    if (widest == nullptr || scan.longerSide() > widest->longerSide()) widest = &scan;
    if (scan.is_fine) fine_side = std::min(fine_side, scan.longerSide());
  }
  return widest->longerSide() > fine_side * (1.0 + 1e-9) ? widest : nullptr;
}

std::vector<ScanWaves> wavesOf(const std::vector<Scan>& scans, const std::vector<cv::Mat>& values) {
  std::vector<ScanWaves> waves;
  waves.reserve(scans.size());
  for (std::size_t i = 0; i < scans.size(); ++i) waves.emplace_back(scans[i].filled(values[i]));
  return waves;
}

/// Heights that may tell whether the surface is Gaussian.
struct Candidate {
  double split = 0.0;
  bool is_widest = false;
  std::vector<double> sample;
  Moments moments;
  SamplingVariance variance;
  double chi_square = 0.0;

  void take(const SamplingVariance& found) {
    variance = found;
    moments = momentsOf(sample);
    chi_square = moments.skewness * moments.skewness / variance.skewness +
                 moments.excess * moments.excess / variance.excess;
  }
};

std::vector<double> allOf(const Scan& scan) {
  std::vector<double> sample;
  addSample(scan.heights, scan.distances, 0.0, 1, sample);
  return sample;
}

Candidate fineCandidate(const std::vector<Scan>& scans, const MergedSpectrum& spectrum,
                        double split, double side) {
  Candidate candidate;
  candidate.split = split;
  const double waves = split * side / (2.0 * kPi);
  const double margin = waves > 0.0 ? 0.25 / waves : 0.0;  // the filter's edges
  double area = 0.0;
  for (const Scan& scan : scans) {
    if (!scan.is_fine) continue;
    addSample(highPassed(scan, candidate.split), scan.distances, margin, 2, candidate.sample);
    area += scan.area() * (1.0 - 2.0 * margin) * (1.0 - 2.0 * margin);
  }
  candidate.take(
      samplingVariance(spectrum, candidate.split, kFirstOfLevelled * 2.0 * kPi / side, area));
  return candidate;
}

double fineSide(const std::vector<Scan>& scans) {
  double side = std::numeric_limits<double>::infinity();
  for (const Scan& scan : scans) {
    if (scan.is_fine) side = std::min(side, scan.longerSide());
  }
  return side;
}

Candidate widestCandidate(const Scan& widest, const MergedSpectrum& spectrum) {
  Candidate candidate;
  candidate.is_widest = true;
  candidate.sample = allOf(widest);
  candidate.take(samplingVariance(spectrum, 0.0, kFirstOfLevelled * 2.0 * kPi / widest.longerSide(),
                                  widest.area()));
  return candidate;
}

Candidate decisiveCandidate(const std::vector<Scan>& scans, const Scan* widest,
                            const MergedSpectrum& spectrum) {
  const double side = fineSide(scans);
  std::optional<Candidate> first;
  const auto isDecisive = [&](const Candidate& candidate) {
    if (!first) first = candidate;
    return candidate.chi_square >= kDecisive;
  };
  if (widest != nullptr) {
    const double total =
        spectrum.rootMean(0, 2.0 * kPi / widest->longerSide(), spectrum.largest_wave_number);
    const double deviation = momentsOf(allOf(*widest)).deviation;
    if (deviation * deviation > kMostVariance * total * total) {
      Candidate candidate = widestCandidate(*widest, spectrum);
      if (isDecisive(candidate)) return candidate;
    }
  }
  Candidate fine = fineCandidate(scans, spectrum, 0.0, side);
  if (isDecisive(fine)) return fine;
  for (const double waves : kSplits) {
    fine = fineCandidate(scans, spectrum, waves * 2.0 * kPi / side, side);
    if (isDecisive(fine)) return fine;
  }
  return *first;
}

void takeSlope(SurfaceLaw& law) {
  const std::vector<SpectrumBand>& bands = law.heights.bands;
  const double last = bands.front().wave_number * std::exp2(kEndOctaves);
  double weights = 0.0;
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (const SpectrumBand& band : bands) {
    if (band.wave_number > last) break;
    const double weight = 0.5 * band.freedom;
    weights += weight;
    mean_x += weight * std::log(band.wave_number);
    mean_y += weight * std::log(band.density);
  }
  mean_x /= weights;
  mean_y /= weights;
  double squares = 0.0;
  double products = 0.0;
  for (const SpectrumBand& band : bands) {
    if (band.wave_number > last) break;
    const double weight = 0.5 * band.freedom;
    const double x = std::log(band.wave_number) - mean_x;
    squares += weight * x * x;
    products += weight * x * (std::log(band.density) - mean_y);
  }
  if (!(squares > 0.0)) return;
  law.slope = -products / squares;
  law.slope_deviation = std::sqrt(1.0 / squares);
}

}  // namespace

/// Scans and what is known of them before their heights are translated.
struct SurfaceStudy::Findings {
  std::vector<Scan> scans;
  const Scan* widest = nullptr;
  bool has_mean_pixels = false;  ///< the widest
  Candidate candidate;
  std::vector<cv::Mat> passed;  ///< of each scan, the waves that are translated
  SurfaceLaw law;               ///< but for T, the spectrum of its numbers and own waves

  bool isTranslated() const { return law.non_gaussian_share > 0.0; }
  /// Finds T and the spectrum of its numbers.
  void translate(TailForm form, SurfaceLaw& translated) const;
};

void SurfaceStudy::Findings::translate(TailForm form, SurfaceLaw& translated) const {
  const double independent = candidate.variance.independent;
  HeightMarginal marginal(candidate.sample, independent, form);
  std::vector<cv::Mat> values = passed;
  if (candidate.split == 0.0) {
    for (cv::Mat& value : values) value = levelledUnder(marginal, value);
    if (!candidate.is_widest) {
      std::vector<double> sample;
      for (std::size_t i = 0; i < scans.size(); ++i) {
        if (scans[i].is_fine) addSample(values[i], scans[i].distances, 0.0, 2, sample);
      }
      marginal = HeightMarginal(sample, independent, form);
      for (cv::Mat& value : values) value = levelledUnder(marginal, value);
    }
  }
  translated.marginal =
      marginal.mixed(law.non_gaussian_share, candidate.moments.mean, candidate.moments.deviation);
  for (cv::Mat& value : values) value = numbersOf(translated.marginal, value);
  const std::vector<ScanWaves> waves = wavesOf(scans, values);
  translated.numbers = mergedSpectrum(waves, trustOf(waves), law.heights.stretch);
}

SpectrumStretch SurfaceStudy::stretchOf(const std::vector<ScanWaves>& waves,
                                        const std::vector<ScanTrust>& trust,
                                        const SurfaceStudy* like) {
  if (like != nullptr && like->findings_->law.heights.stretch.ratio == 1.0) return {};
  return mems_stiction::stretchOf(waves, trust);
}

SurfaceStudy::SurfaceStudy(const std::vector<HeightMap>& surfaces, const SurfaceStudy* like) {
  auto findings = std::make_unique<Findings>();
  findings->scans = scansOf(surfaces);
  const std::vector<Scan>& scans = findings->scans;
  const Scan* widest = findings->widest = widestOf(scans);
  std::vector<cv::Mat> heights;
  heights.reserve(scans.size());
  for (const Scan& scan : scans) heights.push_back(scan.heights);
  const std::vector<ScanWaves> waves = wavesOf(scans, heights);
  const std::vector<ScanTrust> trust = trustOf(waves);
  SurfaceLaw& law = findings->law;
  law.heights = law.numbers = mergedSpectrum(waves, trust, stretchOf(waves, trust, like));
  takeSlope(law);
  if (widest != nullptr) {
    const auto place = static_cast<std::size_t>(widest - scans.data());
    findings->has_mean_pixels = areMeans(widest->map(widest->heights), waves[place], law.heights);
  }
  if (like == nullptr) {
    findings->candidate = decisiveCandidate(scans, widest, law.heights);
  } else {
    const Candidate& known = like->findings_->candidate;
    findings->candidate = known.is_widest && widest != nullptr
                              ? widestCandidate(*widest, law.heights)
                              : fineCandidate(scans, law.heights, known.split, fineSide(scans));
  }
  law.non_gaussian_share = std::max(0.0, 1.0 - kShareByChance / findings->candidate.chi_square);
  if (findings->isTranslated()) {
    law.split_wave_number = findings->candidate.split;
    for (const Scan& scan : scans)
      findings->passed.push_back(highPassed(scan, law.split_wave_number));
  }
  findings_ = std::move(findings);
}

SurfaceStudy::~SurfaceStudy() = default;
SurfaceStudy::SurfaceStudy(SurfaceStudy&& other) noexcept = default;
SurfaceStudy& SurfaceStudy::operator=(SurfaceStudy&& other) noexcept = default;

bool SurfaceStudy::isGaussian() const { return !findings_->isTranslated(); }

SurfaceLaw SurfaceStudy::law(TailForm form) const {
  SurfaceLaw law = findings_->law;
  if (findings_->isTranslated()) findings_->translate(form, law);
  if (findings_->widest == nullptr) return law;
  const Scan& widest = *findings_->widest;
  const bool are_numbers = findings_->isTranslated() && law.split_wave_number == 0.0;
  const cv::Mat values = are_numbers
                             ? numbersOf(law.marginal, levelledUnder(law.marginal, widest.heights))
                             : widest.heights;
  law.own = ownLongWaves(widest.map(values), are_numbers ? law.numbers : law.heights,
                         law.split_wave_number, findings_->has_mean_pixels);
  return law;
}

}  // namespace mems_stiction
