#include "roughness/height_marginal.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/core/optim.hpp>

namespace mems_stiction {
namespace {

constexpr double kTailPlaces = 800.0;   ///< independent places above g0 [-],
constexpr double kLeastTailFrom = 0.5;  ///< which lies between these
constexpr double kMostTailFrom = 2.0;
constexpr double kBodyFrom = -3.5;  ///< down to this number the distribution is that of the heights
constexpr double kBodyStep = 0.1;
constexpr double kLevelStep = 0.15;  ///< of the levels of the fit, in normal numbers
constexpr double kShapePrior = 0.5;  ///< standard deviation of c, where b is about 1
constexpr double kEnds = 9.0;        ///< of the table
constexpr double kFewestPlaces = 20.0;
constexpr double kAlmostStraight = 1e-6;

double straight(const std::vector<double>& x, const std::vector<double>& y, double wanted) {
  if (wanted <= x.front()) return y.front();
  if (wanted >= x.back()) return y.back();
  const auto above =
      static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), wanted) - x.begin());
  const double share = (wanted - x[above - 1]) / (x[above] - x[above - 1]);
  return y[above - 1] + share * (y[above] - y[above - 1]);
}

/// The tail of a distribution: parameters by the table of the header.
struct Tail {
  double from = 0.0;  ///< g0
  double a = 0.0;
  double b = 1.0;
  double c = 0.0;
  TailForm form = TailForm::kExponential;

  bool isPower() const { return form == TailForm::kPower && c > 0.0; }
  double height(double g) const {
    if (isPower()) {
      const double power = c * (from + 1.0) + 1.0;
      return a + b * from * std::expm1(power * std::log(g / from)) / power;
    }
    return a + b * (std::abs(c) > kAlmostStraight ? std::expm1(c * (g - from)) / c : g - from);
  }
  /// The inverse; beyond its end a number that nobody reaches.
  double number(double height) const {
    constexpr double kNever = 30.0;
    const double factor = isPower() ? c * (from + 1.0) + 1.0 : c;
    const double y = (height - a) / (isPower() ? b * from : b);
    double step = y;
    if (std::abs(factor) > kAlmostStraight) {
      const double power = 1.0 + factor * y;
      step = power > 1e-9 ? std::log(power) / factor : factor < 0.0 ? kNever : -kNever;
    }
    return isPower() ? from * std::exp(std::clamp(step, -kNever, 4.0)) : from + step;
  }
};

/// Counts between levels against those of a tail: - ln likelihood of (a, ln b, c).
class TailCost : public cv::MinProblemSolver::Function {
 public:
  TailCost(std::vector<double> levels, std::vector<double> shares, double independent, double from,
           TailForm form)
      : levels_(std::move(levels)),
        shares_(std::move(shares)),
        independent_(independent),
        from_(from),
        form_(form) {}

  int getDims() const override { return 3; }
  double calc(const double* x) const override {
    const Tail tail{from_, x[0], std::exp(x[1]), x[2], form_};
    double above = 1.0;  // share above the level before
    double cost = 0.0;
    for (std::size_t i = 0; i < shares_.size(); ++i) {
      const double next = i < levels_.size() ? normalShare(-tail.number(levels_[i])) : 0.0;
      cost -= shares_[i] * std::log(std::max(above - next, 1e-12));
      above = next;
    }
    return independent_ * cost + x[2] * x[2] / (2.0 * kShapePrior * kShapePrior);
  }

 private:
  std::vector<double> levels_;
  std::vector<double> shares_;
  double independent_;
  double from_;
  TailForm form_;
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

HeightMarginal::HeightMarginal(std::vector<double> sample, double independent, TailForm form) {
  std::sort(sample.begin(), sample.end());
  const auto count = static_cast<double>(sample.size());
  const auto heightAt = [&](double g) {
    const double place = std::clamp(normalShare(g) * count - 0.5, 0.0, count - 1.0);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sample.size() - 1);
    return sample[below] + (place - std::floor(place)) * (sample[above] - sample[below]);
  };

  // on the grid of the table
  const double wanted = -normalNumber(std::min(0.5, kTailPlaces / independent));
  const double from =
      std::round(std::clamp(wanted, kLeastTailFrom, kMostTailFrom) / kBodyStep) * kBodyStep;
  std::vector<double> levels;
  const double top = normalNumber(1.0 - 1.0 / std::max(independent, kFewestPlaces));
  for (double g = from; g < top || levels.empty(); g += kLevelStep) {
    const double level = heightAt(g);
    if (levels.empty() || level > levels.back()) levels.push_back(level);
  }
  std::vector<double> shares;
  double before = 0.0;
  for (const double level : levels) {
    const double below = static_cast<double>(std::lower_bound(sample.begin(), sample.end(), level) -
                                             sample.begin()) /
                         count;
    shares.push_back(below - before);
    before = below;
  }
  shares.push_back(1.0 - before);
  const double origin = levels.front();
  const double unit = std::max(heightAt(from + 1.0) - origin, 1e-30);
  for (double& level : levels) level = (level - origin) / unit;

  cv::Mat found = (cv::Mat_<double>(1, 3) << 0.0, 0.0, 0.0);
  const cv::Mat steps = (cv::Mat_<double>(1, 3) << 0.2, 0.2, 0.1);
  const cv::Ptr<cv::DownhillSolver> solver = cv::DownhillSolver::create(
      cv::makePtr<TailCost>(levels, shares, independent, from, form), steps,
      cv::TermCriteria(cv::TermCriteria::MAX_ITER + cv::TermCriteria::EPS, 2000, 1e-6));
  solver->minimize(found);
  const Tail tail{from, found.at<double>(0), std::exp(found.at<double>(1)), found.at<double>(2),
                  form};
  tail_shape_ = tail.c;

  // the body moves so that it meets the tail
  const double move = origin + unit * tail.height(from) - heightAt(from);
  const double slope = heightAt(kBodyFrom + 1.0) - heightAt(kBodyFrom);
  const auto add = [&](double g, double height) {
    const double least = heights_.empty() ? height : heights_.back() + 1e-6 * unit;
    numbers_.push_back(g);
    heights_.push_back(std::max(height, least));
  };
  for (double g = -kEnds; g < kBodyFrom - 1e-9; g += 0.25) {
    add(g, heightAt(kBodyFrom) + move + slope * (g - kBodyFrom));
  }
  for (double g = kBodyFrom; g < from - 1e-9; g += kBodyStep) add(g, heightAt(g) + move);
  for (double g = from; g < kEnds; g += kBodyStep) add(g, origin + unit * tail.height(g));
}

double HeightMarginal::heightOf(double g) const { return straight(numbers_, heights_, g); }

double HeightMarginal::numberOf(double height) const {
  return straight(heights_, numbers_, height);
}

HeightMarginal HeightMarginal::mixed(double share, double mean, double deviation) const {
  HeightMarginal mixture = *this;
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    mixture.heights_[i] = share * heights_[i] + (1.0 - share) * (mean + deviation * numbers_[i]);
  }
  return mixture;
}

}  // namespace mems_stiction
