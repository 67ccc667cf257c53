#include "half_space/contact_minimiser.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "evaluation_rows.hpp"
#include "half_space/row_work.hpp"

namespace mems_stiction {
namespace {

/// Pressure up to which the law is steep at first, of 8 Gamma/(3 z0), and later, of the largest
/// there is.
constexpr double kFirstWall = 10.0;
constexpr double kWallReserve = 2.0;
/// Halvings of a Newton step before the search gives up.
constexpr int kMostHalvings = 20;
/// Share of the decrease that the slope promises which a step must give (Armijo).
constexpr double kSufficientDecrease = 1e-4;
/// Energies that differ by less than this share of their parts are equal but for what single
/// precision adds to K u.
constexpr double kEnergyNoise = 1e-9;
/// What single precision leaves in K u for each step, of the residual that it takes away, and for
/// going on from one state to the next, of 8 Gamma/(3 z0); and for a step of the conjugate
/// gradients. Measured: a tenth of it to as much, and five times it after jumps that were taken
/// back, less than an equilibrium's residual still.
constexpr double kSinglePrecision = 3e-7;
constexpr double kGradientsPrecision = 1e-6;
/// Share of the allowed residual that may come from it.
constexpr double kStaleShare = 0.1;
/// Windows that leave more than this share of the residual have failed; so many times in one state.
constexpr double kWorthwhile = 0.5;
constexpr int kMostFailures = 2;
/// In how many states after one in which they failed windows are not tried: one, and up to so many
/// if they fail again.
constexpr int kLongestPause = 7;

}  // namespace

/// Energy and residual at the present displacement, or along a step from it.
struct ContactMinimiser::Evaluation {
  double force = 0.0;             ///< [N]
  double energy = 0.0;            ///< E [J]
  double energy_scale = 0.0;      ///< of its parts [J]
  double largest_residual = 0.0;  ///< [Pa]
  double residual_norm = 0.0;     ///< root of the mean square [Pa]
  double mean_residual = 0.0;     ///< what K cannot resist of it [Pa]
  double mean_slope = 0.0;        ///< of the positive t' [Pa/m]
  double contact_cells = 0.0;     ///< that repel each other
  double gap = 0.0;               ///< sum over the valid cells [m]
  double lowest_gap = 0.0;        ///< [m]
  bool has_slopes = false;        ///< t' of each cell is at hand
};

ContactMinimiser::ContactMinimiser(const HalfSpaceGrid& grid, const TractionLaw& law,
                                   const ElasticResponse& response, LargePageVector<double> relief,
                                   const MinimiserSettings& settings)
    : ContactMinimiser(grid, law, response, std::move(relief), {}, settings) {
  windows_ = std::make_unique<ContactWindows>(grid, law, response, settings);
  wall_pressure_ = kFirstWall * law.stress();
  setLaw(law);
}

void ContactMinimiser::takeRelief(LargePageVector<double> relief) {
  relief_ = std::move(relief);
  largest_relief_ = 0.0;
  valid_count_ = 0;
  for (const double relief_here : relief_) {
    if (!std::isfinite(relief_here)) continue;
    largest_relief_ = std::max(largest_relief_, relief_here);
    ++valid_count_;
  }
}

void ContactMinimiser::restart(LargePageVector<double> relief, LargePageVector<float> fixed,
                               double tolerance) {
  takeRelief(std::move(relief));
  fixed_ = std::move(fixed);
  settings_.tolerance = tolerance;
  displacement_.reset();
}

ContactMinimiser::ContactMinimiser(const HalfSpaceGrid& grid, const TractionLaw& law,
                                   const ElasticResponse& response, LargePageVector<double> relief,
                                   LargePageVector<float> fixed, const MinimiserSettings& settings)
    : grid_(grid),
      law_(law),
      wall_(law),
      settings_(settings),
      stiffness_(grid, response, settings.threads, spectrum_, settings.cancel),
      exact_stiffness_(grid, response, settings.threads, spectrum_, settings.cancel),
      coarse_(response.influence == nullptr && CoarseAnswer::fits(grid)
                  ? std::make_unique<CoarseAnswer>(grid, response, settings.threads, spectrum_,
                                                   settings.cancel)
                  : nullptr),
      gradients_(grid, stiffness_, coarse_.get(), settings.threads, settings.cancel,
                 settings.give_way),
      displacement_(grid, !stiffness_.resistsMean(), settings.threads, settings.cancel),
      fixed_(std::move(fixed)) {
  takeRelief(std::move(relief));
  if (!isCancelled()) gradients_.allocateShared();
  is_set_up_ = !isCancelled();
}

void ContactMinimiser::moveOn(double share) {
  displacement_.begin(share, kSinglePrecision * law_.stress());
}

void ContactMinimiser::setLaw(const TractionLaw& law) {
  law_ = law;
  wall_ = law_.steepUpTo(wall_pressure_);
  if (windows_ != nullptr) windows_->setLaw(wall_);
}

bool ContactMinimiser::isBeyondWall(const Evaluation& now) const {
  return wall_.closestGap() > law_.closestGap() && now.lowest_gap < wall_.closestGap();
}

void ContactMinimiser::raiseWall(const Evaluation& now) {
  wall_pressure_ = -kWallReserve * wall_.at(now.lowest_gap).traction;
  setLaw(TractionLaw(law_));
}

void ContactMinimiser::goTo(Place&& place) {
  displacement_.goTo(std::move(place.displacement));
  relief_ = std::move(place.relief);
  flowed_ = std::move(place.flowed);
}

void ContactMinimiser::gapsOfRow(int row, double height, double* gaps) const {
  const double* const relief =
      relief_.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.frame_cols);
  const double* const displacement = displacement_.values() + grid_.offset(row);
  for (int col = 0; col < grid_.frame_cols; ++col)
    gaps[col] = height + relief[col] - displacement[col];
}

double ContactMinimiser::largestLoad() const {
  if (!law_.flows()) return std::numeric_limits<double>::infinity();
  return -law_.at(law_.closestGap()).traction * validArea();
}

double ContactMinimiser::acceptFlow(double height) {
  if (!hasFlow()) return 0.0;
  const auto cols = static_cast<std::size_t>(grid_.frame_cols);
  if (flowed_.empty()) flowed_.resize(relief_.size(), 0.0F);
  const double pressure = -law_.at(law_.closestGap()).traction;
  double depth = 0.0;
  std::vector<double> gaps(cols);
  for (int row = 0; row < grid_.frame_rows; ++row) {
    gapsOfRow(row, height, gaps.data());
    const std::size_t first = static_cast<std::size_t>(row) * cols;
    for (std::size_t col = 0; col < cols; ++col) {
      const double excess = law_.closestGap() - gaps[col];
      if (!(excess > 0.0)) continue;
      relief_[first + col] += excess;
      flowed_[first + col] += static_cast<float>(excess);
      depth += excess;
    }
  }
  return pressure * depth * grid_.cellArea();
}

void ContactMinimiser::maps(double height, cv::Mat& gaps, cv::Mat& pressures) const {
  gaps.create(grid_.frame_rows, grid_.frame_cols, CV_32FC1);
  pressures.create(grid_.frame_rows, grid_.frame_cols, CV_32FC1);
  const auto cols = static_cast<std::size_t>(grid_.frame_cols);
  std::vector<double> row_gaps(cols), tractions(cols), slopes(cols), energies(cols);
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  for (int row = 0; row < grid_.frame_rows; ++row) {
    gapsOfRow(row, height, row_gaps.data());
    law_.atRow(grid_.frame_cols, row_gaps.data(), tractions.data(), slopes.data(), energies.data());
    for (std::size_t col = 0; col < cols; ++col) {
      const bool is_valid = std::isfinite(row_gaps[col]);
      gaps.ptr<float>(row)[col] = is_valid ? static_cast<float>(row_gaps[col]) : kNone;
      pressures.ptr<float>(row)[col] = is_valid ? static_cast<float>(-tractions[col]) : kNone;
    }
  }
}

void ContactMinimiser::refreshElasticTraction() {
  if (displacement_.staleness() == 0.0) return;
  exact_stiffness_.multiply(displacement_.values(), displacement_.traction());
  displacement_.noteFresh();
  ++exact_products_;
}

evaluation_rows::Sums ContactMinimiser::evaluateRow(int row, double height, const Step& step,
                                                    bool with_slopes) {
  const auto arraysFrom = [&](int col) {
    const std::size_t cell = grid_.offset(row) + static_cast<std::size_t>(col);
    return evaluation_rows::RowArrays{displacement_.values() + cell,
                                      displacement_.traction() + cell,
                                      step.step + col,
                                      step.traction + col,
                                      gradients_.residual() + cell,
                                      with_slopes ? gradients_.slope() + cell : nullptr,
                                      nullptr,
                                      mean_traction_};
  };
  if (row >= grid_.frame_rows)
    return evaluation_rows::evaluateFree(grid_.cols, step.length, arraysFrom(0));
  const std::size_t in_frame =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.frame_cols);
  evaluation_rows::RowArrays arrays = arraysFrom(0);
  if (!fixed_.empty()) arrays.fixed = fixed_.data() + in_frame;
  auto sums = evaluation_rows::evaluate(wall_, grid_.frame_cols, height, relief_.data() + in_frame,
                                        step.length, arrays);
  if (grid_.cols > grid_.frame_cols) {
    sums += evaluation_rows::evaluateFree(grid_.cols - grid_.frame_cols, step.length,
                                          arraysFrom(grid_.frame_cols));
  }
  return sums;
}

ContactMinimiser::Evaluation ContactMinimiser::evaluationOf(const evaluation_rows::Sums& sums,
                                                            bool with_slopes) const {
  const double cells = grid_.cellCount();
  Evaluation result;
  result.force = sums.traction * grid_.cellArea();
  result.energy = (0.5 * sums.elastic + sums.energy) * grid_.cellArea();
  result.energy_scale = (0.5 * std::abs(sums.elastic) + std::abs(sums.energy)) * grid_.cellArea();
  result.mean_residual = stiffness_.resistsMean() ? 0.0 : sums.residual / cells;
  result.largest_residual =
      std::max(sums.highest - result.mean_residual, result.mean_residual - sums.lowest);
  result.residual_norm = std::sqrt(
      std::max(0.0, sums.residual_squared / cells - result.mean_residual * result.mean_residual));
  result.mean_slope = sums.positive_slope / cells;
  result.contact_cells = sums.contacts;
  result.gap = sums.gap;
  result.lowest_gap = sums.lowest_gap;
  result.has_slopes = with_slopes;
  return result;
}

ContactMinimiser::Evaluation ContactMinimiser::evaluate(double height) {
  gradients_.allocate();
  return evaluateAlong(height, 0.0);
}

ContactMinimiser::Evaluation ContactMinimiser::evaluateAlong(double height, double length) {
  std::vector<evaluation_rows::Sums> row_sums;
  const auto sums = sumOverRows(row_sums, grid_.rows, settings_.threads, [&](int row) {
    const std::size_t first = grid_.offset(row);
    return evaluateRow(
        row, height, {length, gradients_.step() + first, gradients_.stepTraction() + first}, true);
  });
  return evaluationOf(sums, true);
}

ContactMinimiser::Evaluation ContactMinimiser::moveAndEvaluate(double height,
                                                               std::optional<float> share) {
  const bool with_slopes = !usesWindows();
  if (with_slopes) gradients_.allocate();
  std::vector<evaluation_rows::Sums> row_sums;
  const auto sums = sumOverRows(row_sums, grid_.rows, settings_.threads, [&](int row) {
    if (share) displacement_.goOn(row, *share);
    const float* const any = gradients_.residual() + grid_.offset(row);  // no step is taken
    return evaluateRow(row, height, {0.0, any, any}, with_slopes);
  });
  return evaluationOf(sums, with_slopes);
}

ContactMinimiser::Evaluation ContactMinimiser::answerAndEvaluate(double height, double length) {
  std::vector<evaluation_rows::Sums> row_sums(static_cast<std::size_t>(grid_.rows));
  const float* const change = gradients_.stepTraction();
  stiffness_.displace(change, [&](int row, const float* displacement) {
    const Step step{length, displacement, change + grid_.offset(row)};
    displacement_.step(row, step);
    row_sums[static_cast<std::size_t>(row)] =
        evaluateRow(row, height, {0.0, step.step, step.traction}, false);
  });
  ++window_products_;
  evaluation_rows::Sums sums;  // in the order of the frame
  for (const evaluation_rows::Sums& of_row : row_sums) sums += of_row;
  return evaluationOf(sums, false);
}

void ContactMinimiser::takeStep(double length) {
  forEachRow(grid_.rows, settings_.threads, [&](int row) {
    const std::size_t first = grid_.offset(row);
    displacement_.step(row, {length, gradients_.step() + first, gradients_.stepTraction() + first});
  });
}

bool ContactMinimiser::isNearer(const Evaluation& now, const Evaluation& before, double promised) {
  return now.energy <= before.energy - kSufficientDecrease * promised ||
         (now.energy <= before.energy + kEnergyNoise * before.energy_scale &&
          now.residual_norm < before.residual_norm);
}

bool ContactMinimiser::relaxContacts(double height, Evaluation& now) {
  const ContactWindows::Frame frame{height,
                                    relief_.data(),
                                    displacement_.values(),
                                    displacement_.traction(),
                                    gradients_.residual(),
                                    now.mean_residual,
                                    now.largest_residual};
  if (!windows_->relax(frame, exact_stiffness_, gradients_.stepTraction())) return false;
  if (settings_.give_way) settings_.give_way();
  const Evaluation before = now;
  displacement_.addStaleness(kSinglePrecision * before.largest_residual);
  now = answerAndEvaluate(height, 1.0);
  if (!isNearer(now, before, 0.0)) {
    now = answerAndEvaluate(height, -1.0);
    return false;
  }
  return now.residual_norm < kWorthwhile * before.residual_norm;
}

void ContactMinimiser::noteWindows(int failures) {
  if (windows_pause_ > 0) {
    --windows_pause_;
  } else {
    last_pause_ = failures < kMostFailures ? 0 : std::min(2 * last_pause_ + 1, kLongestPause);
    windows_pause_ = last_pause_;
  }
}

ContactState ContactMinimiser::solve(double height, const Search& search) {
  ContactState state;
  state.height = height;
  const int products_before = products();
  const std::optional<float> share = displacement_.takeShare();
  const double exact = settings_.tolerance * law_.stress();
  const double allowed = search.tolerance * exact;
  const double stale = kStaleShare * std::min(allowed, std::max(exact, search.residual_norm));
  // how many times what is allowed is left; an exact state needs no norm
  const auto excessOf = [&](const Evaluation& of) {
    return std::min(of.largest_residual / exact, std::max(of.largest_residual / allowed,
                                                          of.residual_norm / search.residual_norm));
  };
  Evaluation now;
  if (displacement_.staleness() <= stale) {
    now = moveAndEvaluate(height, share);
  } else {
    if (share)
      forEachRow(grid_.rows, settings_.threads, [&](int row) { displacement_.goOn(row, *share); });
    refreshElasticTraction();
    now = evaluate(height);
  }
  int failures = 0;  // of windows
  while (!isCancelled()) {
    if (excessOf(now) <= 1.0) {
      if (isBeyondWall(now)) {
        raiseWall(now);
        now = evaluate(height);
        continue;
      }
      if (displacement_.staleness() <= stale) {
        state.is_converged = true;
        break;
      }
      refreshElasticTraction();
      now = evaluate(height);
      continue;
    }
    if (state.newton_steps == settings_.max_newton_steps) break;
    ++state.newton_steps;
    if (usesWindows() && failures < kMostFailures) {
      if (relaxContacts(height, now)) continue;
      ++failures;
      if (excessOf(now) <= 1.0) continue;
    }
    if (!now.has_slopes) {  // the first of Newton's steps in a row
      now = evaluate(height);
    }
    ConjugateGradients::System system;
    system.mean_residual = now.mean_residual;
    system.mean_slope = now.mean_slope;
    system.longest_move = search.longest_move * law_.range();
    system.useful_residual = 1.0 / excessOf(now);
    const ConjugateGradients::Direction direction = gradients_.find(system);
    if (!(direction.decrease > 0.0)) break;
    double length = std::min(1.0, system.longest_move / direction.longest);
    const Evaluation before = now;
    bool is_lower = false;
    for (int halvings = 0; halvings <= kMostHalvings; ++halvings, length *= 0.5) {
      mean_traction_ =
          before.mean_residual + length * (direction.mean_residual - before.mean_residual);
      now = evaluateAlong(height, length);
      is_lower = isNearer(now, before, length * direction.decrease);
      if (is_lower) break;
    }
    if (!is_lower) {
      now = evaluate(height);
      if (displacement_.staleness() == 0.0) break;
      refreshElasticTraction();
      now = evaluate(height);
      continue;
    }
    takeStep(length);
    displacement_.addStaleness(kGradientsPrecision * before.largest_residual);
  }
  noteWindows(failures);
  mean_traction_ = now.mean_residual;
  state.force = now.force;
  state.energy = now.energy;
  state.residual = now.largest_residual / law_.stress();
  state.contact_area = now.contact_cells * grid_.cellArea();
  state.mean_gap = now.gap / static_cast<double>(valid_count_);
  lowest_gap_ = now.lowest_gap;
  state.products = products() - products_before;
  return state;
}

}  // namespace mems_stiction
