#include "roughness/height_marginal.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/core/optim.hpp>

namespace mems_stiction {
namespace {

constexpr double kTailFrom = 0.5;   ///< normal number from which the distribution is fitted
constexpr double kBodyFrom = -3.5;  ///< and down to which it is that of the heights
constexpr double kBodyStep = 0.1;
constexpr double kLevelStep = 0.15;  ///< of the levels of the fit, in normal numbers
constexpr double kShapePrior = 0.3;  ///< standard deviation of c
constexpr double kEnds = 9.0;        ///< of the table
constexpr double kFewestPlaces = 20.0;
constexpr double kAlmostStraight = 1e-6;

double straight(const std::vector<double>& x, const std::vector<double>& y, double wanted) {
  if (wanted <= x.front()) return y.front();
  if (wanted >= x.back()) return y.back();
  const auto above = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), wanted) - x.begin());
  const double share = (wanted - x[above - 1]) / (x[above] - x[above - 1]);
  return y[above - 1] + share * (y[above] - y[above - 1]);
}

double tailHeight(double g, double a, double b, double c) {
  return a + b * (std::abs(c) > kAlmostStraight ? std::expm1(c * g) / c : g);
}

/// Its inverse; beyond its end a number that nobody reaches.
double tailNumber(double height, double a, double b, double c) {
  constexpr double kNever = 30.0;
  const double y = (height - a) / b;
  if (std::abs(c) <= kAlmostStraight) return y;
  const double power = 1.0 + c * y;
  if (power > 1e-9) return std::log(power) / c;
  return c < 0.0 ? kNever : -kNever;
}

/// Counts between levels against those of a tail: - ln likelihood of (a, ln b, c).
class TailCost : public cv::MinProblemSolver::Function {
 public:
  TailCost(std::vector<double> levels, std::vector<double> shares, double independent)
      : levels_(std::move(levels)), shares_(std::move(shares)), independent_(independent) {}

  int getDims() const override { return 3; }
  double calc(const double* x) const override {
    const double b = std::exp(x[1]);
    double above = 1.0;  // share above the level before
    double cost = 0.0;
    for (std::size_t i = 0; i < shares_.size(); ++i) {
      const double next = i < levels_.size() ? normalShare(-tailNumber(levels_[i], x[0], b, x[2])) : 0.0;
      cost -= shares_[i] * std::log(std::max(above - next, 1e-12));
      above = next;
    }
    return independent_ * cost + x[2] * x[2] / (2.0 * kShapePrior * kShapePrior);
  }

 private:
  std::vector<double> levels_;
  std::vector<double> shares_;
  double independent_;
};

}  // namespace

double normalShare(double g) { return 0.5 * std::erfc(-g / std::sqrt(2.0)); }

double normalNumber(double share) {
  double low = -kEnds;
  double high = kEnds;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (normalShare(middle) < share ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

HeightMarginal::HeightMarginal(double mean, double deviation)
    : numbers_{-kEnds, kEnds}, heights_{mean - kEnds * deviation, mean + kEnds * deviation} {}

HeightMarginal::HeightMarginal(std::vector<double> sample, double independent) {
  std::sort(sample.begin(), sample.end());
  const auto count = static_cast<double>(sample.size());
  const auto heightAt = [&](double g) {
    const double place = std::clamp(normalShare(g) * count - 0.5, 0.0, count - 1.0);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sample.size() - 1);
    return sample[below] + (place - std::floor(place)) * (sample[above] - sample[below]);
  };

  std::vector<double> levels;
  const double top = normalNumber(1.0 - 1.0 / std::max(independent, kFewestPlaces));
  for (double g = kTailFrom; g < top; g += kLevelStep) {
    const double level = heightAt(g);
    if (levels.empty() || level > levels.back()) levels.push_back(level);
  }
  std::vector<double> shares;
  double before = 0.0;
  for (const double level : levels) {
    const double below =
        static_cast<double>(std::lower_bound(sample.begin(), sample.end(), level) - sample.begin()) / count;
    shares.push_back(below - before);
    before = below;
  }
  shares.push_back(1.0 - before);
  const double origin = levels.front();
  const double unit = std::max(heightAt(1.5) - origin, 1e-30);
  for (double& level : levels) level = (level - origin) / unit;

  cv::Mat found = (cv::Mat_<double>(1, 3) << -0.5, 0.0, 0.0);
  const cv::Mat steps = (cv::Mat_<double>(1, 3) << 0.2, 0.2, 0.1);
  const cv::Ptr<cv::DownhillSolver> solver =
      cv::DownhillSolver::create(cv::makePtr<TailCost>(levels, shares, independent), steps,
                                 cv::TermCriteria(cv::TermCriteria::MAX_ITER + cv::TermCriteria::EPS, 2000, 1e-6));
  solver->minimize(found);
  const double a = found.at<double>(0);
  const double b = std::exp(found.at<double>(1));
  tail_shape_ = found.at<double>(2);

  // the body moves so that it meets the tail
  const double move = origin + unit * tailHeight(kTailFrom, a, b, tail_shape_) - heightAt(kTailFrom);
  const double slope = heightAt(kBodyFrom + 1.0) - heightAt(kBodyFrom);
  const auto add = [&](double g, double height) {
    const double least = heights_.empty() ? height : heights_.back() + 1e-6 * unit;
    numbers_.push_back(g);
    heights_.push_back(std::max(height, least));
  };
  for (double g = -kEnds; g < kBodyFrom - 1e-9; g += 0.25) {
    add(g, heightAt(kBodyFrom) + move + slope * (g - kBodyFrom));
  }
  for (double g = kBodyFrom; g < kTailFrom - 1e-9; g += kBodyStep) add(g, heightAt(g) + move);
  for (double g = kTailFrom; g < kEnds; g += kBodyStep) add(g, origin + unit * tailHeight(g, a, b, tail_shape_));
}

double HeightMarginal::heightOf(double g) const { return straight(numbers_, heights_, g); }

double HeightMarginal::numberOf(double height) const { return straight(heights_, numbers_, height); }

HeightMarginal HeightMarginal::mixed(double share, double mean, double deviation) const {
  HeightMarginal mixture = *this;
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    mixture.heights_[i] = share * heights_[i] + (1.0 - share) * (mean + deviation * numbers_[i]);
  }
  return mixture;
}

}  // namespace mems_stiction
