#include "preprocess/polynomial_level.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "numeric/packet.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double kHuber = 1.345;
constexpr double kTukey = 4.685;
constexpr int kHuberRounds = 8;
constexpr int kTukeyRounds = 30;
constexpr double kRest = 1e-4;              ///< step that ends the rounds, in units of the noise
constexpr int kStrides[] = {16, 4};         ///< pixels from one of a sample to the next
constexpr int kSmallestSample = 256;        ///< valid pixels that a sample must have
constexpr int kMasks = 3;                   ///< how often the ground is looked for anew
constexpr std::size_t kMostSorted = 65536;  ///< residuals, at equal distances
constexpr double kGroundShare = 0.25;       ///< of the pixels, whose heights lie closest together
constexpr double kGroundWidth =
    2.0 * 0.31864;  ///< of that share of a normal distribution, in standard deviations
constexpr double kClearlyNarrower = 0.8;

enum class Weighting { kAlike, kByHuber, kByTukey };

/// Powers of u and v in each term.
constexpr int kPowerU[] = {0, 1, 0, 2, 1, 0};
constexpr int kPowerV[] = {0, 0, 1, 0, 1, 2};

int termCount(int degree) { return (degree + 1) * (degree + 2) / 2; }

/// Sums over one row: weight w times powers of u, and times those and the height.
struct RowMoments {
  double weights[5] = {};
  double heights[3] = {};
};

template <Weighting Kind>
MEMS_STICTION_INLINE Packet weightOf(const Packet& residual, double scale) {
  if (Kind == Weighting::kByHuber) {
    const Packet distance = select(residual < 0.0, 0.0 - residual, residual) / scale;
    return select(distance > kHuber, kHuber / distance, 1.0);
  }
  if (Kind == Weighting::kByTukey) {
    const Packet distance = residual / (kTukey * scale);
    const Packet share = 1.0 - distance * distance;
    return select(share > 0.0, share * share, 0.0);
  }
  return 1.0;
}

struct MomentLanes {
  Packet w, wu, wuu, wuuu, wuuuu, wh, whu, whuu;

  RowMoments sums() const {
    return {{w.sum(), wu.sum(), wuu.sum(), wuuu.sum(), wuuuu.sum()},
            {wh.sum(), whu.sum(), whuu.sum()}};
  }
};

template <Weighting Kind>
MEMS_STICTION_INLINE void addMoments(const LineCurve& curve, double scale,
                                     const Packet& all_heights, const Packet& u,
                                     MomentLanes& sums) {
  const PacketMask is_valid = isNumber(all_heights);
  const Packet height = select(is_valid, all_heights - curve.origin, 0.0);
  const Packet residual = height - (curve.a + u * (curve.b + curve.c * u));
  const Packet weight = select(is_valid, weightOf<Kind>(residual, scale), 0.0);
  const Packet wu = weight * u;
  const Packet wuu = wu * u;
  sums.w += weight;
  sums.wu += wu;
  sums.wuu += wuu;
  sums.wuuu += wuu * u;
  sums.wuuuu += wuu * u * u;
  sums.wh += weight * height;
  sums.whu += wu * height;
  sums.whuu += wuu * height;
}

template <Weighting Kind>
MEMS_STICTION_INLINE RowMoments momentsOf(const double* line, const double* places,
                                          std::size_t size, const LineCurve& curve, double scale) {
  const LineCurve local = curve;
  MomentLanes sums;
  std::size_t i = 0;
  for (; i + Packet::kCount <= size; i += Packet::kCount) {
    addMoments<Kind>(local, scale, Packet::load(line + i), Packet::load(places + i), sums);
  }
  if (i < size) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    addMoments<Kind>(local, scale, Packet::loadFirst(line + i, size - i, kNan),
                     Packet::loadFirst(places + i, size - i, 0.0), sums);
  }
  return sums.sums();
}

MEMS_STICTION_VECTORIZED RowMoments rowMoments(const double* line, const double* places,
                                               std::size_t size, const LineCurve& curve,
                                               double scale, Weighting weighting) {
  switch (weighting) {
    case Weighting::kAlike:
      return momentsOf<Weighting::kAlike>(line, places, size, curve, scale);
    case Weighting::kByHuber:
      return momentsOf<Weighting::kByHuber>(line, places, size, curve, scale);
    case Weighting::kByTukey:
      break;
  }
  return momentsOf<Weighting::kByTukey>(line, places, size, curve, scale);
}

/// Median of all heights, whose rows follow each other or are one.
double medianHeight(const cv::Mat& heights, CleaningMemory& memory) {
  return memory.medians.median(heights.ptr<double>(), heights.total());
}

/// Normal equations of the terms, gathered row by row.
class NormalEquations {
 public:
  void add(const RowMoments& row, double v) {
    const double powers[] = {1.0, v, v * v, v * v * v, v * v * v * v};
    for (int j = 0; j < 5; ++j) {
      for (int i = 0; i + j < 5; ++i) weights_[i][j] += row.weights[i] * powers[j];
      for (int i = 0; i + j < 3; ++i) heights_[i][j] += row.heights[i] * powers[j];
    }
  }

  Vector6 solve(int degree) const {
    Matrix6 normal = Matrix6::Zero();
    Vector6 moment = Vector6::Zero();
    for (int term = 0; term < termCount(degree); ++term) {
      moment[term] = heights_[kPowerU[term]][kPowerV[term]];
      for (int other = 0; other < termCount(degree); ++other) {
        normal(term, other) =
            weights_[kPowerU[term] + kPowerU[other]][kPowerV[term] + kPowerV[other]];
      }
    }
    // Rank-revealing: what the pixels do not determine stays 0.
    Eigen::CompleteOrthogonalDecomposition<Matrix6> decomposition;
    decomposition.setThreshold(1e-12);
    decomposition.compute(normal);
    return decomposition.solve(moment);
  }

 private:
  double weights_[5][5] = {};
  double heights_[3][3] = {};
};

/// The pixels of a frame, or some at equal distances.
struct PixelGrid {
  cv::Mat heights;
  double first_x, first_y;  ///< [m]
  double pitch_x, pitch_y;  ///< [m]
};

PixelGrid allPixels(const cv::Mat& heights, double pitch_x, double pitch_y) {
  return {heights, 0.0, 0.0, pitch_x, pitch_y};
}

/// Copies every `stride`-th pixel of every `stride`-th row, with as much of the frame left over on
/// either side.
PixelGrid sampleOf(const cv::Mat& heights, double pitch_x, double pitch_y, int stride,
                   std::vector<double>& memory) {
  const int first = stride / 2;
  const int rows = heights.rows / stride;
  const int cols = heights.cols / stride;
  memory.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols));
  const cv::Mat sample(rows, cols, CV_64FC1, memory.data());
  double* target = memory.data();
  for (int row = 0; row < rows; ++row) {
    const double* source = heights.ptr<double>(first + row * stride) + first;
    for (int col = 0; col < cols; ++col) *target++ = source[col * stride];
  }
  return {sample, first * pitch_x, first * pitch_y, stride * pitch_x, stride * pitch_y};
}

bool hasEnoughValid(const std::vector<double>& heights) {
  return std::count_if(heights.begin(), heights.end(),
                       [](double height) { return !std::isnan(height); }) >= kSmallestSample;
}

/// Where the coordinates are centred, and what they are divided by.
PolynomialSurface frameOf(const cv::Mat& heights, double pitch_x, double pitch_y, int degree,
                          CleaningMemory& memory) {
  const SurfaceMeans means = meansOf(heights, memory, " to level by");
  PolynomialSurface frame;
  frame.degree = degree;
  frame.unit = 0.5 * std::max(heights.cols * pitch_x, heights.rows * pitch_y);
  frame.centre_x = means.col * pitch_x;
  frame.centre_y = means.row * pitch_y;
  return frame;
}

/// The quarter of all residuals that lie closest together: the ground, where features stand on it.
struct Ground {
  double height = 0.0;  ///< above the polynomial, median of the quarter [m]
  double noise = std::numeric_limits<double>::quiet_NaN();  ///< by the quarter's width [m]
};

/// - @p residuals all valid; they come back sorted
Ground groundOf(std::vector<double>& residuals) {
  Ground ground;
  const std::size_t size = residuals.size();
  if (size < 2) return ground;
  std::sort(residuals.begin(), residuals.end());
  const std::size_t reach =
      std::max<std::size_t>(1, static_cast<std::size_t>(kGroundShare * static_cast<double>(size)));
  std::size_t first = 0;
  for (std::size_t i = 1; i + reach < size; ++i) {
    if (residuals[i + reach] - residuals[i] < residuals[first + reach] - residuals[first])
      first = i;
  }
  ground.height = residuals[first + reach / 2];
  ground.noise = (residuals[first + reach] - residuals[first]) / kGroundWidth;
  return ground;
}

/// The rounds of a fit over one grid.
class Rounds {
 public:
  /// Holds the grid, whose pixels, fit and memory must outlive it.
  Rounds(PixelGrid grid, PolynomialSurface& fit, CleaningMemory& memory)
      : grid_(std::move(grid)), fit_(fit), memory_(memory) {
    findPlaces(fit, grid_.first_x, grid_.pitch_x, grid_.heights.cols, memory.places);
  }

  void solve(Weighting weighting) {
    NormalEquations equations;
    for (int row = 0; row < grid_.heights.rows; ++row) {
      equations.add(
          rowMoments(grid_.heights.ptr<double>(row), memory_.places.data(), memory_.places.size(),
                     curveAt(fit_, yOf(row)), fit_.noise, weighting),
          (yOf(row) - fit_.centre_y) / fit_.unit);
    }
    const Vector6 next = equations.solve(fit_.degree);
    step_ = (next - fit_.coefficients).cwiseAbs().maxCoeff();
    fit_.coefficients = next;
  }

  void findNoise() {
    const std::size_t cols = memory_.places.size();
    double* distances = roomFor(grid_.heights.total(), memory_.distances);
    for (int row = 0; row < grid_.heights.rows; ++row) {
      distancesFrom(curveAt(fit_, yOf(row)), memory_.places.data(), grid_.heights.ptr<double>(row),
                    cols, distances + static_cast<std::size_t>(row) * cols);
    }
    fit_.noise = 1.4826 * memory_.medians.median(distances, grid_.heights.total());
  }

  /// Until the fit rests, with the noise after every round.
  void reweight(int huber_rounds) {
    for (int round = 0; round < huber_rounds + kTukeyRounds && !isExact(); ++round) {
      const bool is_tukey = round >= huber_rounds;
      solve(is_tukey ? Weighting::kByTukey : Weighting::kByHuber);
      findNoise();
      if (is_tukey && step_ < kRest * fit_.noise) break;
    }
  }

  /// Until the fit rests, with the noise that it has.
  void settle() {
    for (int round = 0; round < kTukeyRounds && !isExact(); ++round) {
      solve(Weighting::kByTukey);
      if (step_ < kRest * fit_.noise) break;
    }
  }

  Ground ground() const {
    const std::size_t stride = grid_.heights.total() / kMostSorted + 1;
    std::vector<double> residuals;
    residuals.reserve(grid_.heights.total() / stride + 1);
    const auto cols = static_cast<std::size_t>(grid_.heights.cols);
    for (std::size_t place = 0; place < grid_.heights.total(); place += stride) {
      const auto row = static_cast<int>(place / cols);
      const auto col = place % cols;
      const double u = memory_.places[col];
      const LineCurve curve = curveAt(fit_, yOf(row));
      const double height = grid_.heights.ptr<double>(row)[col];
      if (!std::isnan(height))
        residuals.push_back(height - curve.origin - (curve.a + u * (curve.b + curve.c * u)));
    }
    return groundOf(residuals);
  }

  /// Masks what stands out of the ground, fits the rest, and again until it rests.
  void settleOnGround() {
    for (int mask = 0; mask < kMasks; ++mask) {
      const Ground found = ground();
      if (std::isnan(found.noise)) return;
      fit_.coefficients[0] += found.height;
      fit_.noise = found.noise;
      settle();
    }
  }

 private:
  /// A noise at the rounding of the polynomial itself.
  bool isExact() const { return !(fit_.noise > 1e-13 * fit_.coefficients.cwiseAbs().maxCoeff()); }
  double yOf(int row) const { return grid_.first_y + row * grid_.pitch_y; }

  PixelGrid grid_;
  PolynomialSurface& fit_;
  CleaningMemory& memory_;
  double step_ = 0.0;
};

/// Slopes from each pixel to the next along a row or column, less what features' edges add: b + c u
/// + d v, in heights per unit of the frame.
Eigen::Vector3d slopesOf(const cv::Mat& differences, double pitch_x, double pitch_y, double step,
                         const PolynomialSurface& frame, double first_x, double first_y, int degree,
                         CleaningMemory& memory) {
  if (differences.empty() || cv::countNonZero(differences == differences) == 0)
    return Eigen::Vector3d::Zero();
  PolynomialSurface slopes = frameOf(differences, pitch_x, pitch_y, degree, memory);
  slopes.origin = medianHeight(differences, memory);
  Rounds rounds(allPixels(differences, pitch_x, pitch_y), slopes, memory);
  rounds.findNoise();
  rounds.reweight(kHuberRounds);
  const double per_unit = frame.unit / step;
  const double ratio = frame.unit / slopes.unit;
  const double u = (frame.centre_x - first_x - slopes.centre_x) / slopes.unit;
  const double v = (frame.centre_y - first_y - slopes.centre_y) / slopes.unit;
  const auto& terms = slopes.coefficients;
  return per_unit * Eigen::Vector3d(slopes.origin + terms[0] + terms[1] * u + terms[2] * v,
                                    ratio * terms[1], ratio * terms[2]);
}

/// A start that features do not spoil, however high they are: the slopes of neighbours, of which
/// only their edges are others.
void startByNeighbours(const cv::Mat& heights, double pitch_x, double pitch_y,
                       PolynomialSurface& fit, CleaningMemory& memory) {
  const int degree = fit.degree - 1;
  cv::Mat along_x;
  cv::Mat along_y;
  if (heights.cols > 1)
    along_x = heights.colRange(1, heights.cols) - heights.colRange(0, heights.cols - 1);
  if (heights.rows > 1)
    along_y = heights.rowRange(1, heights.rows) - heights.rowRange(0, heights.rows - 1);
  const Eigen::Vector3d x =
      slopesOf(along_x, pitch_x, pitch_y, pitch_x, fit, 0.5 * pitch_x, 0.0, degree, memory);
  const Eigen::Vector3d y =
      slopesOf(along_y, pitch_x, pitch_y, pitch_y, fit, 0.0, 0.5 * pitch_y, degree, memory);
  const double twist = heights.rows > 1 && heights.cols > 1 ? 0.5 * (x[2] + y[1]) : 0.0;
  fit.coefficients << 0.0, x[0], y[0], 0.5 * x[1], twist, 0.5 * y[2];
}

/// Features on more than a part of the frame pull least squares so far that no reweighting finds
/// back. Where a fit from the slopes of neighbours has a clearly narrower ground, it is the one.
void findGround(const cv::Mat& heights, double pitch_x, double pitch_y, PolynomialSurface& fit,
                CleaningMemory& memory) {
  PolynomialSurface other = fit;
  startByNeighbours(heights, pitch_x, pitch_y, other, memory);
  const PixelGrid grid = allPixels(heights, pitch_x, pitch_y);
  Rounds rounds(grid, other, memory);
  rounds.settleOnGround();
  const double width = rounds.ground().noise;
  if (width < kClearlyNarrower * Rounds(grid, fit, memory).ground().noise) {
    fit = std::move(other);
  }
}

}  // namespace

double PolynomialSurface::height(double x, double y) const {
  const LineCurve curve = curveAt(*this, y);
  const double u = (x - centre_x) / unit;
  return curve.origin + (curve.a + u * (curve.b + curve.c * u));
}

PolynomialSurface fitPolynomial(const cv::Mat& heights, double pitch_x, double pitch_y, int degree,
                                FitWeights weights, CleaningMemory& memory) {
  PolynomialSurface fit = frameOf(heights, pitch_x, pitch_y, degree, memory);
  fit.origin = medianHeight(heights, memory);
  const PixelGrid grid = allPixels(heights, pitch_x, pitch_y);
  Rounds rounds(grid, fit, memory);
  rounds.solve(Weighting::kAlike);
  rounds.findNoise();
  if (weights != FitWeights::kRobust) return fit;
  rounds.reweight(kHuberRounds);
  if (degree > 0) findGround(heights, pitch_x, pitch_y, fit, memory);
  return fit;
}

PolynomialSurface fitPolynomialBySamples(const cv::Mat& heights, double pitch_x, double pitch_y,
                                         int degree, CleaningMemory& memory) {
  PolynomialSurface fit = frameOf(heights, pitch_x, pitch_y, degree, memory);
  bool is_started = false;
  for (const int stride : kStrides) {
    const PixelGrid sample = sampleOf(heights, pitch_x, pitch_y, stride, memory.sample);
    if (!hasEnoughValid(memory.sample)) continue;
    if (!is_started) fit.origin = medianHeight(sample.heights, memory);
    Rounds rounds(sample, fit, memory);
    if (!is_started) rounds.solve(Weighting::kAlike);
    rounds.findNoise();
    rounds.reweight(is_started ? 0 : kHuberRounds);
    is_started = true;
  }
  if (!is_started)
    return fitPolynomial(heights, pitch_x, pitch_y, degree, FitWeights::kRobust, memory);
  const PixelGrid grid = allPixels(heights, pitch_x, pitch_y);
  Rounds(grid, fit, memory).settle();
  return fit;
}

LineCurve curveAt(const PolynomialSurface& polynomial, double y) {
  const double v = (y - polynomial.centre_y) / polynomial.unit;
  const auto& terms = polynomial.coefficients;
  return {polynomial.origin, terms[0] + v * (terms[2] + v * terms[5]), terms[1] + v * terms[4],
          terms[3]};
}

void findPlaces(const PolynomialSurface& polynomial, double first_x, double pitch_x, int cols,
                std::vector<double>& places) {
  places.resize(static_cast<std::size_t>(cols));
  for (int col = 0; col < cols; ++col) {
    places[static_cast<std::size_t>(col)] =
        (first_x + col * pitch_x - polynomial.centre_x) / polynomial.unit;
  }
}

HeightChange subtract(const PolynomialSurface& polynomial, WorkingSurface& surface) {
  findPlaces(polynomial, 0.0, surface.pitch_x, surface.heights.cols, surface.memory.places);
  return subtractCurves(surface,
                        [&](int row) { return curveAt(polynomial, row * surface.pitch_y); });
}

}  // namespace mems_stiction
