#include "device/own_long_waves.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

/// Rms heights of the planes (along x, along y) that levelling takes off a scan of these sides.
std::pair<double, double> tiltDeviations(const MergedSpectrum& spectrum, double side_x,
                                         double side_y) {
  constexpr int kReach = 6;
  constexpr double kStep = 0.25;
  constexpr double kLeast = 0.9;  // waves along the side: longer ones are the device's tilt
  // |sum of the wave u with the constant and with the slope|^2 over a side of length 1
  const auto constantOf = [](double u) {
    return u == 0.0 ? 1.0 : std::pow(std::sin(kPi * u) / (kPi * u), 2);
  };
  const auto slopeOf = [](double u) {
    if (u == 0.0) return 0.0;
    const double part = (std::sin(kPi * u) / (kPi * u) - std::cos(kPi * u)) / (2.0 * kPi * u);
    return 12.0 * part * part;
  };
  double along_x = 0.0;
  double along_y = 0.0;
  for (double uy = -kReach; uy <= kReach; uy += kStep) {
    for (double ux = -kReach; ux <= kReach; ux += kStep) {
      if (std::hypot(ux, uy) < kLeast) continue;
      const double density = spectrum.densityAt(
          spectrum.stretch.roundWave(2.0 * kPi * ux / side_x, 2.0 * kPi * uy / side_y));
      along_x += density * constantOf(uy) * slopeOf(ux);
      along_y += density * constantOf(ux) * slopeOf(uy);
    }
  }
  const double scale = kStep * kStep / (side_x * side_y);
  return {std::sqrt(scale * along_x), std::sqrt(scale * along_y)};
}

/// What samples of a surface say of one of its waves.
struct KnownWave {
  double gain = 0.0;  ///< of the wave in the samples, for the best estimate of it [-]
  double open = 1.0;  ///< share of its power that they leave open [-]
};

/// Samples at a distance: points, or means over as much.
class Samples {
 public:
  Samples(const MergedSpectrum& spectrum, double pitch_x, double pitch_y, bool are_means)
      : spectrum_(spectrum), pitch_x_(pitch_x), pitch_y_(pitch_y), are_means_(are_means) {}

  /// Power that a wave and all that look like it have in the samples [m^4].
  double power(double q_x, double q_y) const {
    double sum = 0.0;
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        const double x = q_x + 2.0 * kPi * i / pitch_x_;
        const double y = q_y + 2.0 * kPi * j / pitch_y_;
        sum += densityAt(x, y) * passed(x, y) * passed(x, y);
      }
    }
    return sum;
  }

  KnownWave wave(double q_x, double q_y) const {
    const double all = power(q_x, q_y);
    if (!(all > 0.0)) return {};
    const double own = densityAt(q_x, q_y);
    const double pass = passed(q_x, q_y);
    return {own * pass / all, std::clamp(1.0 - own * pass * pass / all, 0.0, 1.0)};
  }

 private:
  double densityAt(double q_x, double q_y) const {
    return spectrum_.densityAt(spectrum_.stretch.roundWave(q_x, q_y));
  }
  double passed(double q_x, double q_y) const {
    return are_means_ ? sinc(0.5 * q_x * pitch_x_) * sinc(0.5 * q_y * pitch_y_) : 1.0;
  }
  static double sinc(double x) { return x == 0.0 ? 1.0 : std::sin(x) / x; }

  const MergedSpectrum& spectrum_;
  double pitch_x_;
  double pitch_y_;
  bool are_means_;
};

/// How much finer the pixels of own waves are: cubics between them then know the shortest ones to a
/// percent.
int finerPixels(const cv::Mat& values) {
  constexpr std::size_t kMost = std::size_t{1} << 22U;
  return 16 * values.total() <= kMost ? 4 : 4 * values.total() <= kMost ? 2 : 1;
}

}  // namespace

double highPass(double wave_number, double split) {
  if (!(wave_number < kHighPassEnd * split)) return 1.0;
  const double square = wave_number / split * (wave_number / split);
  return -std::expm1(-square * square);
}

bool areMeans(const HeightMap& scan, const ScanWaves& waves, const MergedSpectrum& spectrum) {
  constexpr double kFirst = 1.0 / 8.0;
  constexpr double kLast = 1.0 / 2.2;
  const double pixels = std::min(scan.rows(), scan.cols());
  double unlikeliness[2] = {0.0, 0.0};
  for (const bool are_means : {false, true}) {
    const Samples samples(spectrum, scan.pitchX(), scan.pitchY(), are_means);
    waves.visit([&](const FrameWave& wave, double power, double weight) {
      if (wave.count() < kFirst * pixels || wave.count() > kLast * pixels) return;
      const double expected = samples.power(waves.waveNumberX(wave.x), waves.waveNumberY(wave.y));
      if (expected > 0.0)
        unlikeliness[are_means ? 1 : 0] += weight * (power / expected + std::log(expected));
    });
  }
  return unlikeliness[1] < unlikeliness[0];
}

OwnLongWaves ownLongWaves(const HeightMap& scan, const MergedSpectrum& spectrum, double split,
                          bool are_means) {
  constexpr int kSteps = 128;
  constexpr int kDirections = 8;
  const Samples samples(spectrum, scan.pitchX(), scan.pitchY(), are_means);
  const double shortest = kPi / std::max(scan.pitchX(), scan.pitchY());
  const auto longPass = [&](double q) {
    return split > 0.0 ? std::exp(-std::pow(q / split, 4)) : 1.0;
  };
  const cv::Mat values = scan.heights()(cv::Rect(0, 0, scan.cols() & ~1, scan.rows() & ~1));
  cv::Mat waves;
  cv::dct(values, waves);
  const int finer = finerPixels(values);
  cv::Mat padded = cv::Mat::zeros(finer * values.rows, finer * values.cols, CV_64FC1);
  for (int row = 0; row < waves.rows; ++row) {
    const double q_y = kPi * row / (waves.rows * scan.pitchY());
    const double* from = waves.ptr<double>(row);
    double* to = padded.ptr<double>(row);
    for (int col = 0; col < waves.cols; ++col) {
      const double q_x = kPi * col / (waves.cols * scan.pitchX());
      const double q = std::hypot(q_x, q_y);
      if (q >= shortest) break;
      const double gain = 0.5 * (samples.wave(q_x, q_y).gain + samples.wave(-q_x, q_y).gain);
      to[col] = finer * gain * longPass(q) * from[col];
    }
  }
  OwnLongWaves own;
  cv::idct(padded, own.heights);
  own.pitch_x = scan.pitchX() / finer;
  own.pitch_y = scan.pitchY() / finer;
  own.open_step = shortest / kSteps;
  for (int i = 0; i <= kSteps; ++i) {
    const double q = i * own.open_step;
    double open = 0.0;
    for (int turn = 0; turn < kDirections; ++turn) {
      const double angle = kPi * turn / kDirections;
      const double pass = longPass(q);
      const double known = 1.0 - samples.wave(q * std::cos(angle), q * std::sin(angle)).open;
      open += (1.0 - known * pass * pass) / kDirections;
    }
    own.open_shares.push_back(open);
  }
  std::tie(own.tilt_x, own.tilt_y) =
      tiltDeviations(spectrum, scan.cols() * scan.pitchX(), scan.rows() * scan.pitchY());
  return own;
}

}  // namespace mems_stiction
