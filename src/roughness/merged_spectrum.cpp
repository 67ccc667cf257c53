#include "roughness/merged_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

constexpr double kBandsPerOctave = 8.0;
constexpr double kFirstWave = 2.0;           ///< along a side: fewer are what levelling has left
constexpr double kFirstWaveOfLargest = 1.0;  ///< of the largest scan nobody else sees them
constexpr double kPixelsOfShortest = 10.0;   ///< a coarse scan blurs and aliases shorter waves
constexpr int kCorrections = 4;
/// Degrees of freedom for each wave (of both halves) under Hann's window: (sum w^2)^2/(N sum w^4),
/// of both axes.
constexpr double kHannFreedom = 0.264;
/// Below so many waves along a side nothing of the surface is thought to arrive.
constexpr double kLeastSource = 0.4;

/// Spectra that fall faster than this power of the wave number are what Hann's window lets through
/// of longer waves.
constexpr double kLeakage = 5.0;

// the search for a stretch
constexpr double kFirstWaveOfStretch = 3.0;
constexpr double kLastWaveOfStretch = 128.0;
constexpr double kBandsOfStretch = 6.0;
constexpr double kLeastGain = 10.0;  ///< of the logarithm of the likelihood

int bandOf(double wave_number, double bands_per_octave) {
  return static_cast<int>(std::floor(bands_per_octave * std::log2(wave_number)));
}

double finestPitch(const std::vector<ScanWaves>& scans) {
  double finest = std::numeric_limits<double>::infinity();
  for (const ScanWaves& scan : scans) finest = std::min(finest, scan.longerPitch());
  return finest;
}

/// Of one band of the scans of one kind.
struct BandSum {
  double power = 0.0;
  double count = 0.0;
  double log_wave_number = 0.0;
  double correction = 1.0;  ///< what of the density is found there
};

/// Scans of one size and pitch, which share corrections.
struct ScanGroup {
  const ScanWaves* first = nullptr;
  ScanTrust trust;
  double count = 0.0;
  std::map<int, BandSum> bands;
};

/// Waves of scans that are alike, all together: each lies in one band, whatever the scan.
void addWaves(const std::vector<const ScanWaves*>& alike, const SpectrumStretch& stretch,
              ScanGroup& group) {
  const ScanWaves& first = *alike.front();
  group.first = &first;
  group.count = static_cast<double>(alike.size());
  const double least_square = group.trust.least_waves * group.trust.least_waves;
  const double most_square = group.trust.most_wave_number * group.trust.most_wave_number;
  int last_band = 0;
  BandSum* sum = nullptr;  // of the wave before, which often lies in the same band
  ScanWaves::visit(alike, [&](const FrameWave& wave, double power, double weight) {
    const double q_x = first.waveNumberX(wave.x);
    const double q_y = first.waveNumberY(wave.y);
    if (wave.x * wave.x + wave.y * wave.y < least_square || q_x * q_x + q_y * q_y > most_square)
      return;
    const double wave_number = stretch.roundWave(q_x, q_y);
    const int band = bandOf(wave_number, kBandsPerOctave);
    if (sum == nullptr || band != last_band) sum = &group.bands[band];
    last_band = band;
    sum->power += weight * power;
    sum->count += weight * group.count;
    sum->log_wave_number += weight * group.count * std::log(wave_number);
  });
}

std::vector<ScanGroup> groupsOf(const std::vector<ScanWaves>& scans,
                                const std::vector<ScanTrust>& trust,
                                const SpectrumStretch& stretch) {
  std::vector<std::vector<const ScanWaves*>> alike;
  std::vector<ScanGroup> groups;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    std::size_t place = 0;
    while (place < groups.size() && !(alike[place].front()->isAlike(scans[i]) &&
                                      groups[place].trust.least_waves == trust[i].least_waves)) {
      ++place;
    }
    if (place == groups.size()) {
      groups.emplace_back().trust = trust[i];
      alike.emplace_back();
    }
    alike[place].push_back(&scans[i]);
  }
  for (std::size_t i = 0; i < groups.size(); ++i) addWaves(alike[i], stretch, groups[i]);
  return groups;
}

MergedSpectrum pooled(const std::vector<ScanGroup>& groups, const SpectrumStretch& stretch,
                      double largest) {
  std::map<int, BandSum> together;
  for (const ScanGroup& group : groups) {
    for (const auto& [band, sum] : group.bands) {
      BandSum& all = together[band];
      all.power += sum.power / sum.correction;
      all.count += sum.count;
      all.log_wave_number += sum.log_wave_number;
    }
  }
  MergedSpectrum spectrum;
  spectrum.stretch = stretch;
  spectrum.largest_wave_number = largest;
  for (const auto& [band, sum] : together) {
    if (!(sum.power > 0.0)) continue;
    spectrum.bands.push_back({std::exp(sum.log_wave_number / sum.count), sum.power / sum.count,
                              kHannFreedom * sum.count});
  }
  return spectrum;
}

/// The most that may be found of the density of long waves: that of a spectrum which falls as
/// steeply as any that the window shows. On frames that are not square a band has few waves, and
/// may have far less power than what reaches it from others; each round would take its density
/// further down, by decades.
double mostLeakage() {
  static const double most = [] {
    const WaveTransfer& transfer = waveTransfer();
    const auto density = [](double waves) {
      return std::pow(std::max(waves, kFirstWaveOfLargest), -kLeakage);
    };
    std::vector<double> sources;
    for (const double length : transfer.lengths)
      sources.push_back(length < kLeastSource ? 0.0 : density(length));
    const cv::Mat arrived = transfer.round_shares * cv::Mat(sources);
    double largest = 1.0;
    for (std::size_t i = 0; i < transfer.waves.size(); ++i) {
      const double waves = transfer.waves[i].count();
      if (waves < kFirstWaveOfLargest) continue;
      largest = std::max(largest, arrived.at<double>(static_cast<int>(i)) / density(waves));
    }
    return largest;
  }();
  return most;
}

/// What of the density is found in the bands of a group's long waves.
void correct(const MergedSpectrum& spectrum, ScanGroup& group) {
  const WaveTransfer& transfer = waveTransfer();
  const ScanWaves& scan = *group.first;
  const auto densityOf = [&](const FrameWave& wave) {
    return spectrum.densityAt(
        spectrum.stretch.roundWave(scan.waveNumberX(wave.x), scan.waveNumberY(wave.y)));
  };
  std::vector<double> sources;
  const bool is_square = scan.sideX() == scan.sideY();
  const bool is_round = spectrum.stretch.ratio == 1.0 && is_square;
  const auto add = [&](const FrameWave& wave) {
    sources.push_back(wave.count() < kLeastSource ? 0.0 : densityOf(wave));
  };
  if (is_round) {
    for (const double length : transfer.lengths) add({length, 0.0});
  } else {
    for (const double y : transfer.sources) {
      for (const double x : transfer.sources) add({x, y});
    }
  }
  const cv::Mat arrived = (is_round ? transfer.round_shares : transfer.shares) * cv::Mat(sources);
  struct Found {
    double count = 0.0;
    double expected = 0.0;
    double density = 0.0;
  };
  std::map<int, Found> found;
  for (std::size_t i = 0; i < transfer.waves.size(); ++i) {
    const FrameWave& wave = transfer.waves[i];
    if (wave.count() < group.trust.least_waves) continue;
    const double weight = transfer.weights[i];
    Found& of_band =
        found[bandOf(spectrum.stretch.roundWave(scan.waveNumberX(wave.x), scan.waveNumberY(wave.y)),
                     kBandsPerOctave)];
    of_band.count += weight;
    of_band.expected += weight * arrived.at<double>(static_cast<int>(i));
    of_band.density += weight * densityOf(wave);
  }
  for (const auto& [band, of_band] : found) {
    const auto place = group.bands.find(band);
    if (place == group.bands.end() || !(of_band.expected > 0.0) || !(of_band.density > 0.0))
      continue;
    // bands that lie wholly among the long waves
    if (std::abs(of_band.count * group.count - place->second.count) > 0.5) continue;
    const double share = of_band.expected / of_band.density;
    place->second.correction = is_square ? share : std::min(share, mostLeakage());
  }
}

/// Waves by wave number vector, for the search for a stretch.
struct VectorWave {
  double q_x, q_y, power, weight;
};

double unlikeliness(const std::vector<VectorWave>& waves, const SpectrumStretch& stretch) {
  struct Sum {
    double count = 0.0;
    double power = 0.0;
  };
  constexpr int kMost = 512;  // bands of 2^85
  std::vector<Sum> bands(kMost);
  const int first =
      static_cast<int>(std::floor(kBandsOfStretch *
                                  std::log2(std::hypot(waves.front().q_x, waves.front().q_y)))) -
      kMost / 2;
  const double cosine = std::cos(stretch.direction);
  const double sine = std::sin(stretch.direction);
  for (const VectorWave& wave : waves) {
    const double along = cosine * wave.q_x + sine * wave.q_y;
    const double across = cosine * wave.q_y - sine * wave.q_x;
    const double square = along * along * stretch.ratio + across * across / stretch.ratio;
    const int band =
        static_cast<int>(std::floor(0.5 * kBandsOfStretch * std::log2(square))) - first;
    Sum& sum = bands[static_cast<std::size_t>(std::clamp(band, 0, kMost - 1))];
    sum.count += wave.weight;
    sum.power += wave.weight * wave.power;
  }
  double total = 0.0;
  for (const Sum& sum : bands) {
    if (sum.power > 0.0) total += sum.count * std::log(sum.power / sum.count);
  }
  return 0.5 * kHannFreedom * total;
}

/// The spectrum of groups, with what their windows and levelling have done to the longest waves.
MergedSpectrum corrected(std::vector<ScanGroup>& groups, const SpectrumStretch& stretch,
                         double largest) {
  MergedSpectrum spectrum = pooled(groups, stretch, largest);
  if (spectrum.bands.empty())
    throw SurfaceError("the scans show no roughness: a spectrum needs waves of some height");
  for (int round = 0; round < kCorrections; ++round) {
    for (ScanGroup& group : groups) correct(spectrum, group);
    spectrum = pooled(groups, stretch, largest);
  }
  return spectrum;
}

SpectrumDifference differenceOf(std::vector<ScanGroup>& scan, std::vector<ScanGroup>& others,
                                double largest) {
  SpectrumDifference difference;
  double weights = 0.0;
  double sum = 0.0;
  try {
    const MergedSpectrum one = corrected(scan, {}, largest);
    const MergedSpectrum all = corrected(others, {}, largest);
    double steepest =
        0.0;  // of density times q^5 so far: beyond, what is found has leaked through the window
    for (const SpectrumBand& band : one.bands) {
      const double level = band.density * std::pow(band.wave_number, kLeakage);
      if (level < steepest) continue;
      steepest = level;
      const auto same =
          std::find_if(all.bands.begin(), all.bands.end(), [&](const SpectrumBand& other) {
            return bandOf(other.wave_number, kBandsPerOctave) ==
                   bandOf(band.wave_number, kBandsPerOctave);
          });
      if (same == all.bands.end()) continue;
      const double weight = 0.5 / (1.0 / band.freedom + 1.0 / same->freedom);
      weights += weight;
      sum += weight * std::log(band.density / same->density);
      const double wave = 2.0 * kPi / band.wave_number;
      difference.longest_wave = std::max(difference.longest_wave, wave);
      difference.shortest_wave = wave;
    }
  } catch (const SurfaceError&) {  // one of them has no such waves
    return {};
  }
  if (!(weights > 0.0)) return {};
  difference.logarithm = sum / weights;
  difference.deviation = std::sqrt(1.0 / weights);
  return difference;
}

/// Sums of all scans but those of one.
std::vector<ScanGroup> without(const std::vector<ScanGroup>& all, const ScanWaves& scan,
                               const ScanGroup& its_own) {
  std::vector<ScanGroup> rest;
  for (const ScanGroup& group : all) {
    rest.push_back(group);
    if (!group.first->isAlike(scan)) continue;
    rest.back().count -= its_own.count;
    for (const auto& [band, sum] : its_own.bands) {
      BandSum& left = rest.back().bands[band];
      left.count -= sum.count;
      left.power = left.count > 0.0 ? left.power - sum.power : 0.0;
      left.log_wave_number -= sum.log_wave_number;
    }
    if (rest.back().count == 0.0) rest.pop_back();
  }
  return rest;
}

}  // namespace

double MergedSpectrum::densityAt(double wave_number) const {
  if (bands.empty() || !(wave_number <= largest_wave_number)) return 0.0;
  if (wave_number <= bands.front().wave_number) return bands.front().density;
  const auto above = std::upper_bound(
      bands.begin(), bands.end(), wave_number,
      [](double wanted, const SpectrumBand& band) { return wanted < band.wave_number; });
  if (above == bands.end()) return bands.back().density;
  const SpectrumBand& below = *(above - 1);
  const double share =
      std::log(wave_number / below.wave_number) / std::log(above->wave_number / below.wave_number);
  return below.density * std::pow(above->density / below.density, share);
}

double MergedSpectrum::rootMean(int order, double from, double to) const {
  constexpr int kSteps = 400;
  const double end = std::min(to, largest_wave_number);
  if (!(from < end)) return 0.0;
  const double step = std::log(end / from) / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double q = from * std::exp((i + 0.5) * step);
    sum += densityAt(q) * std::pow(q, 2 * order + 2);
  }
  return std::sqrt(sum * step / (2.0 * kPi));
}

std::vector<ScanTrust> trustOf(const std::vector<ScanWaves>& scans) {
  double longest = 0.0;
  double shortest = std::numeric_limits<double>::infinity();
  for (const ScanWaves& scan : scans) {
    longest = std::max(longest, scan.longerSide());
    shortest = std::min(shortest, scan.longerSide());
  }
  const double finest = finestPitch(scans);
  std::vector<ScanTrust> trust;
  for (const ScanWaves& scan : scans) {
    const bool is_wide = scan.longerSide() == longest && longest > shortest;
    const bool is_finest = scan.longerPitch() < 1.5 * finest;
    trust.push_back({is_wide ? kFirstWaveOfLargest : kFirstWave,
                     is_finest ? std::numeric_limits<double>::infinity()
                               : 2.0 * kPi / (kPixelsOfShortest * scan.longerPitch())});
  }
  return trust;
}

SpectrumStretch stretchOf(const std::vector<ScanWaves>& scans,
                          const std::vector<ScanTrust>& trust) {
  std::vector<VectorWave> waves;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const ScanWaves& scan = scans[i];
    scan.visit([&](const FrameWave& wave, double power, double weight) {
      const double q_x = scan.waveNumberX(wave.x);
      const double q_y = scan.waveNumberY(wave.y);
      if (wave.count() < kFirstWaveOfStretch || wave.count() > kLastWaveOfStretch ||
          std::hypot(q_x, q_y) > trust[i].most_wave_number) {
        return;
      }
      waves.push_back({q_x, q_y, power, weight});
    });
  }
  if (waves.empty()) return {};
  const double round = unlikeliness(waves, {});
  double least = round;
  SpectrumStretch best;
  const auto attempt = [&](double ratio, double direction) {
    const SpectrumStretch stretch{std::max(ratio, 1.001), direction};
    const double value = unlikeliness(waves, stretch);
    if (value >= least) return;
    least = value;
    best = stretch;
  };
  for (const double ratio : {1.5, 2.5, 5.0}) {
    for (int turn = 0; turn < 12; ++turn) attempt(ratio, turn * kPi / 12.0);
  }
  if (best.ratio == 1.0) return best;
  double by_ratio = 1.3;
  double by_turn = kPi / 24.0;
  for (int refinement = 0; refinement < 4; ++refinement) {
    const SpectrumStretch middle = best;
    for (const double ratio : {middle.ratio / by_ratio, middle.ratio, middle.ratio * by_ratio}) {
      for (const double turn : {-by_turn, 0.0, by_turn}) attempt(ratio, middle.direction + turn);
    }
    by_ratio = std::sqrt(by_ratio);
    by_turn *= 0.5;
  }
  return round - least < kLeastGain ? SpectrumStretch() : best;
}

MergedSpectrum mergedSpectrum(const std::vector<ScanWaves>& scans,
                              const std::vector<ScanTrust>& trust, const SpectrumStretch& stretch) {
  const double largest = kPi * std::sqrt(2.0) / finestPitch(scans) * std::sqrt(stretch.ratio);
  std::vector<ScanGroup> groups = groupsOf(scans, trust, stretch);
  return corrected(groups, stretch, largest);
}

std::vector<SpectrumDifference> spectrumDifferences(const std::vector<ScanWaves>& scans) {
  std::vector<ScanTrust> trust;
  trust.reserve(scans.size());
  for (const ScanWaves& scan : scans) {
    trust.push_back({kFirstWaveOfStretch, 2.0 * kPi / (kPixelsOfShortest * scan.longerPitch())});
  }
  const double largest = kPi * std::sqrt(2.0) / finestPitch(scans);
  const std::vector<ScanGroup> all = groupsOf(scans, trust, {});
  std::vector<SpectrumDifference> differences;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const std::vector<ScanWaves> alone{scans[i]};
    std::vector<ScanGroup> own = groupsOf(alone, {trust[i]}, {});
    std::vector<ScanGroup> rest = without(all, scans[i], own.front());
    differences.push_back(differenceOf(own, rest, largest));
  }
  return differences;
}

}  // namespace mems_stiction
