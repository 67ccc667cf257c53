#include "device/made_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace mems_stiction {
namespace {

constexpr double kStepsPerOctave = 12.0;
/// Of the density: what stands for none where the table goes on flat.
constexpr double kNone = 1e-12;
constexpr double kSteepest = 4.0;
/// Sides that are so near to each other are the same.
constexpr double kAsWide = 0.99;

/// The spectrum of what is left to chance, as a table.
/// - @p pass of a wave number: share of the density
template <typename Pass>
SurfaceSpectrum tableOf(const MergedSpectrum& merged, const SpectrumContinuation& continuation,
                        double longest_wave, const Pass& pass) {
  const double first = merged.bands.front().wave_number;
  const auto densityAt = [&](double q) {
    double density = merged.densityAt(q);
    if (q < first)
      density *= std::pow(first / std::max(q, continuation.rolloff), continuation.slope);
    return density;
  };
  SurfaceSpectrum spectrum;
  spectrum.stretch = merged.stretch.ratio;
  spectrum.direction = merged.stretch.direction;
  // waves longer than the device are its tilt
  const double from = 2.0 * kPi / longest_wave * 0.999;
  const double to = merged.largest_wave_number;
  double largest = 0.0;
  const int steps = static_cast<int>(std::ceil(kStepsPerOctave * std::log2(to / from)));
  for (int i = 0; i <= steps; ++i) {
    const double q = i == steps ? to : from * std::exp2(i / kStepsPerOctave);
    const double density = densityAt(q) * pass(q);
    spectrum.wave_number.push_back(q);
    spectrum.density.push_back(density);
    largest = std::max(largest, density);
  }
  for (double& density : spectrum.density) density = std::max(density, kNone * kNone * largest);
  spectrum.wave_number.insert(spectrum.wave_number.begin(), from * 0.999);
  spectrum.density.insert(spectrum.density.begin(), kNone * largest);
  return spectrum;
}

/// Catmull and Rom's cubic between four neighbours.
struct CubicPlace {
  int first = 0;
  double weights[4] = {};
};

CubicPlace cubicPlace(double place) {
  CubicPlace cubic;
  const double floor = std::floor(place);
  const double t = place - floor;
  cubic.first = static_cast<int>(floor) - 1;
  cubic.weights[0] = 0.5 * t * (-1.0 + t * (2.0 - t));
  cubic.weights[1] = 0.5 * (2.0 + t * t * (-5.0 + 3.0 * t));
  cubic.weights[2] = 0.5 * t * (1.0 + t * (4.0 - 3.0 * t));
  cubic.weights[3] = 0.5 * t * t * (t - 1.0);
  return cubic;
}

int reflected(int index, int count) {
  const int at = index < 0 ? -1 - index : index >= count ? 2 * count - 1 - index : index;
  return std::clamp(at, 0, count - 1);
}

TiledSurface fieldOf(const SurfaceLaw& law, const SpectrumContinuation& continuation,
                     const MadeSize& size, double longest_wave, bool has_own, std::uint64_t seed,
                     BlockChoice blocks) {
  const bool is_short = law.non_gaussian_share > 0.0 && law.split_wave_number > 0.0;
  const MergedSpectrum& merged = law.non_gaussian_share > 0.0 ? law.numbers : law.heights;
  const auto pass = [&](double q) {
    if (is_short) return std::pow(highPass(q, law.split_wave_number), 2);
    return has_own ? law.own->openShare(q) : 1.0;
  };
  return TiledSurface(tableOf(merged, continuation, longest_wave, pass), size.rows, size.cols,
                      size.pitch_x, size.pitch_y, seed, std::nullopt, blocks);
}

}  // namespace

bool takesOwnWaves(const SurfaceLaw& law, const MadeSize& size) {
  constexpr double kWholeShare = 0.999;
  return law.own && law.own->heights.cols * law.own->pitch_x >= kWholeShare * size.sideX() &&
         law.own->heights.rows * law.own->pitch_y >= kWholeShare * size.sideY();
}

BlockChoice blocksOf(const MadeSize& size) {
  constexpr std::int64_t kOneTransform = 1 << 20;
  return size.rows * size.cols <= kOneTransform ? BlockChoice::kWhole : BlockChoice::kFast;
}

bool lacksLongWaves(const SurfaceLaw& law, double side) {
  constexpr double kLonger = 1.5;
  return side > kLonger * law.longestWave();
}

SpectrumContinuation drawnContinuation(const SurfaceLaw& law, double side,
                                       std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const double first = law.heights.bands.front().wave_number;
  SpectrumContinuation continuation;
  continuation.slope = std::clamp(law.slope + law.slope_deviation * normal(engine), 0.0, kSteepest);
  continuation.rolloff = first * std::pow(std::min(2.0 * kPi / side / first, 1.0), uniform(engine));
  if (!lacksLongWaves(law, side)) return {0.0, first};
  return continuation;
}

MadeSurface::MadeSurface(const SurfaceLaw& law, const SpectrumContinuation& continuation,
                         const MadeSize& size, double longest_wave, std::uint64_t seed,
                         BlockChoice blocks, Among among)
    : law_(&law),
      size_(size),
      field_(fieldOf(law, continuation, size, longest_wave, takesOwnWaves(law, size), 2 * seed,
                     blocks)),
      has_own_(takesOwnWaves(law, size)) {
  if (law.non_gaussian_share > 0.0) {
    translation_.emplace([&](double g) { return law.marginal.heightOf(g); });
    if (law.split_wave_number > 0.0) {
      const auto pass = [&](double q) {
        const double high = highPass(q, law.split_wave_number);
        return (1.0 - high * high) * (has_own_ ? law.own->openShare(q) : 1.0);
      };
      long_waves_.emplace(tableOf(law.heights, continuation, longest_wave, pass), size.rows,
                          size.cols, size.pitch_x, size.pitch_y, 2 * seed + 1, std::nullopt,
                          blocks);
    }
  }
  if (among == Among::kOthers) {
    const bool are_numbers = law.non_gaussian_share > 0.0 && law.split_wave_number == 0.0;
    longer_waves_.emplace(are_numbers ? law.numbers : law.heights, 2.0 * kPi / law.longestWave(),
                          2.0 * kPi / longest_wave,
                          [&](double q) { return has_own_ ? law.own->openShare(q) : 1.0; });
  }
  drawPlace(seed);
}

void MadeSurface::reseed(std::uint64_t seed) {
  field_.reseed(2 * seed);
  if (long_waves_) long_waves_->reseed(2 * seed + 1);
  drawPlace(seed);
}

void MadeSurface::drawPlace(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  if (longer_waves_) longer_waves_->draw(engine);
  if (!has_own_) return;
  std::uniform_real_distribution<double> uniform;
  std::normal_distribution<double> normal;
  const OwnLongWaves& own = *law_->own;
  place_x_ = uniform(engine) * std::max(0.0, own.heights.cols * own.pitch_x - size_.sideX());
  place_y_ = uniform(engine) * std::max(0.0, own.heights.rows * own.pitch_y - size_.sideY());
  tilt_x_ = normal(engine) * own.tilt_x;
  tilt_y_ = normal(engine) * own.tilt_y;
}

void MadeSurface::heights(std::int64_t row, std::int64_t col, cv::Mat& tile) {
  field_.heights(row, col, tile);
  const bool are_numbers = law_->non_gaussian_share > 0.0 && law_->split_wave_number == 0.0;
  if (has_own_ && are_numbers) addOwnWaves(row, col, tile);
  if (longer_waves_ && are_numbers) addLongerWaves(row, col, tile);
  if (translation_) {
    for (int i = 0; i < tile.rows; ++i) {
      float* line = tile.ptr<float>(i);
      for (int j = 0; j < tile.cols; ++j)
        line[j] = static_cast<float>((*translation_)(static_cast<double>(line[j])));
    }
  }
  if (long_waves_) {
    spare_.create(tile.size(), tile.type());
    long_waves_->heights(row, col, spare_);
    tile += spare_;
  }
  if (has_own_ && !are_numbers) addOwnWaves(row, col, tile);
  if (longer_waves_ && !are_numbers) addLongerWaves(row, col, tile);
}

void MadeSurface::addLongerWaves(std::int64_t row, std::int64_t col, cv::Mat& tile) {
  longer_waves_->addTo(tile, static_cast<double>(col) * size_.pitch_x,
                       static_cast<double>(row) * size_.pitch_y, size_.pitch_x, size_.pitch_y);
}

void MadeSurface::addOwnWaves(std::int64_t row, std::int64_t col, cv::Mat& tile) {
  const OwnLongWaves& own = *law_->own;
  const double root = std::sqrt(12.0);
  std::vector<CubicPlace> places(static_cast<std::size_t>(tile.cols));
  std::vector<double> planes(places.size());
  int first = std::numeric_limits<int>::max();
  int last = 0;
  for (int j = 0; j < tile.cols; ++j) {
    const double x = (static_cast<double>(col + j) + 0.5) * size_.pitch_x;
    const auto at = static_cast<std::size_t>(j);
    places[at] = cubicPlace((place_x_ + x) / own.pitch_x - 0.5);
    planes[at] = tilt_x_ * root * (x / size_.sideX() - 0.5);
    first = std::min(first, places[at].first);
    last = std::max(last, places[at].first + 3);
  }
  std::vector<double> across(static_cast<std::size_t>(last - first + 1));
  for (int i = 0; i < tile.rows; ++i) {
    const double y = (static_cast<double>(row + i) + 0.5) * size_.pitch_y;
    const CubicPlace place = cubicPlace((place_y_ + y) / own.pitch_y - 0.5);
    const double plane = tilt_y_ * root * (y / size_.sideY() - 0.5);
    for (int at = first; at <= last; ++at) {
      double sum = 0.0;
      for (int k = 0; k < 4; ++k) {
        sum +=
            place.weights[k] * own.heights.at<double>(reflected(place.first + k, own.heights.rows),
                                                      reflected(at, own.heights.cols));
      }
      across[static_cast<std::size_t>(at - first)] = sum;
    }
    float* line = tile.ptr<float>(i);
    for (int j = 0; j < tile.cols; ++j) {
      const CubicPlace& along = places[static_cast<std::size_t>(j)];
      const double* values = &across[static_cast<std::size_t>(along.first - first)];
      double sum = plane + planes[static_cast<std::size_t>(j)];
      for (int k = 0; k < 4; ++k) sum += along.weights[k] * values[k];
      line[j] += static_cast<float>(sum);
    }
  }
}

ScanMaker::ScanMaker(const SurfaceLaw& law, const std::vector<HeightMap>& like, double longest_wave,
                     OwnWavesOf own_waves)
    : law_(&law), without_own_(law), longest_wave_(longest_wave) {
  without_own_.own.reset();
  for (const HeightMap& scan : like) {
    const MadeSize size{scan.rows(), scan.cols(), scan.pitchX(), scan.pitchY()};
    const auto known = std::find_if(kinds_.begin(), kinds_.end(),
                                    [&](const Kind& kind) { return kind.size == size; });
    kind_of_.push_back(static_cast<std::size_t>(known - kinds_.begin()));
    if (known != kinds_.end()) continue;
    kinds_.emplace_back();
    kinds_.back().size = size;
    kinds_.back().has_own =
        law.own && (own_waves == OwnWavesOf::kAll ||
                    (size.sideX() >= kAsWide * law.own->heights.cols * law.own->pitch_x &&
                     size.sideY() >= kAsWide * law.own->heights.rows * law.own->pitch_y));
  }
}

std::vector<HeightMap> ScanMaker::make(const SpectrumContinuation& continuation,
                                       std::mt19937_64& engine) {
  if (!(continuation_ == continuation)) {
    for (Kind& kind : kinds_) kind.surface.reset();
    continuation_ = continuation;
  }
  std::vector<HeightMap> made;
  made.reserve(kind_of_.size());
  for (const std::size_t place : kind_of_) {
    Kind& kind = kinds_[place];
    const std::uint64_t seed = engine();
    if (kind.surface) {
      kind.surface->reseed(seed);
    } else {
      kind.surface.emplace(kind.has_own ? *law_ : without_own_, continuation, kind.size,
                           std::max({longest_wave_, kind.size.sideX(), kind.size.sideY()}), seed,
                           blocksOf(kind.size));
    }
    cv::Mat heights(static_cast<int>(kind.size.rows), static_cast<int>(kind.size.cols), CV_32FC1);
    kind.surface->heights(0, 0, heights);
    made.emplace_back(heights, kind.size.pitch_x, kind.size.pitch_y);
  }
  return made;
}

}  // namespace mems_stiction
