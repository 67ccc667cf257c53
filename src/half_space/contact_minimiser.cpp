#include "mems_stiction/half_space/contact_minimiser.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>
#include <vector>

#include "evaluation_rows.hpp"
#include "mems_stiction/half_space/row_work.hpp"

namespace mems_stiction {
namespace {

/// A cell moves no farther than this in one Newton step, of z0: t' changes over such a distance.
constexpr double kLongestMove = 1.0;
/// Halvings of a Newton step before the search gives up.
constexpr int kMostHalvings = 20;
/// Share of the decrease that the slope promises which a step must give (Armijo).
constexpr double kSufficientDecrease = 1e-4;
/// Energies that differ by less than this share of their parts are equal but for what single precision adds to K u.
constexpr double kEnergyNoise = 1e-9;

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
};

ContactMinimiser::ContactMinimiser(const HalfSpaceGrid& grid, const TractionLaw& law, double contact_modulus,
                                   LargePageVector<double> relief, const MinimiserSettings& settings)
    : grid_(grid),
      law_(law),
      settings_(settings),
      stiffness_(grid, contact_modulus, settings.threads, spectrum_, settings.cancel),
      exact_stiffness_(grid, contact_modulus, settings.threads, spectrum_, settings.cancel),
      gradients_(grid, stiffness_, settings.threads, settings.cancel, settings.give_way),
      relief_(std::move(relief)) {
  for (const double relief_here : relief_) {
    if (!std::isfinite(relief_here)) continue;
    largest_relief_ = std::max(largest_relief_, relief_here);
    ++valid_count_;
  }
  for (auto* const array : {&displacement_, &elastic_traction_}) {
    if (!isCancelled()) array->assign(grid.size(), 0.0);
  }
  gradients_.allocate();
  for (auto* const array : {&change_, &last_change_}) {
    if (!isCancelled()) array->assign(grid.size(), 0.0F);
  }
  if (isCancelled()) return;
  if (!stiffness_.resistsMean()) {
    change_traction_.assign(grid.size(), 0.0F);
    last_change_traction_.assign(grid.size(), 0.0F);
  }
  is_set_up_ = true;
}

void ContactMinimiser::moveOn(double share) {
  std::swap(change_, last_change_);
  std::swap(change_traction_, last_change_traction_);
  const auto factor = static_cast<float>(share);
  forEachRow(grid_.rows, settings_.threads, [&](int row) {
    const std::size_t first = grid_.offset(row);
    const std::size_t end = first + static_cast<std::size_t>(grid_.cols);
    for (std::size_t i = first; i < end; ++i) {
      change_[i] = factor * last_change_[i];
      displacement_[i] += static_cast<double>(change_[i]);
    }
    if (change_traction_.empty()) return;
    for (std::size_t i = first; i < end; ++i) {
      change_traction_[i] = factor * last_change_traction_[i];
      elastic_traction_[i] += static_cast<double>(change_traction_[i]);
    }
  });
  if (share != 0.0) is_fresh_ = false;
}

void ContactMinimiser::takeBack() {
  forEachRow(grid_.rows, settings_.threads, [&](int row) {
    const std::size_t first = grid_.offset(row);
    const std::size_t end = first + static_cast<std::size_t>(grid_.cols);
    for (std::size_t i = first; i < end; ++i) {
      displacement_[i] -= static_cast<double>(change_[i]);
    }
    if (change_traction_.empty()) return;
    for (std::size_t i = first; i < end; ++i) elastic_traction_[i] -= static_cast<double>(change_traction_[i]);
  });
  std::swap(change_, last_change_);
  std::swap(change_traction_, last_change_traction_);
  is_fresh_ = false;
}

void ContactMinimiser::gapsOfRow(int row, double height, double* gaps) const {
  const double* const relief =
      relief_.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.frame_cols);
  const double* const displacement = displacement_.data() + grid_.offset(row);
  for (int col = 0; col < grid_.frame_cols; ++col) gaps[col] = height + relief[col] - displacement[col];
}

double ContactMinimiser::largestLoad() const {
  if (!law_.flows()) return std::numeric_limits<double>::infinity();
  return -law_.at(law_.closestGap()).traction * validArea();
}

double ContactMinimiser::keepFlow(double height) {
  if (!law_.flows()) return 0.0;
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

ContactMinimiser::Contact ContactMinimiser::contactAt(double height) const {
  struct Count {
    int cells = 0;
    int valid = 0;
    double gap = 0.0;
    Count& operator+=(const Count& other) {
      cells += other.cells;
      valid += other.valid;
      gap += other.gap;
      return *this;
    }
  };
  std::vector<Count> counts;
  const Count total = sumOverRows(counts, grid_.frame_rows, settings_.threads, [&](int row) {
    const double* const relief =
        relief_.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.frame_cols);
    const double* const displacement = displacement_.data() + grid_.offset(row);
    Count count;
    for (int col = 0; col < grid_.frame_cols; ++col) {
      const double gap = height + relief[col] - displacement[col];
      const bool is_valid = std::isfinite(relief[col]);
      count.valid += is_valid ? 1 : 0;
      count.cells += gap < law_.contactGap() ? 1 : 0;
      count.gap += is_valid ? gap : 0.0;
    }
    return count;
  });
  return {total.cells, total.gap / total.valid};
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
  if (is_fresh_) return;
  exact_stiffness_.multiply(displacement_.data(), elastic_traction_.data());
  is_fresh_ = true;
  ++exact_products_;
}

ContactMinimiser::Evaluation ContactMinimiser::evaluate(double height, double length) {
  const auto frame_cols = static_cast<std::size_t>(grid_.frame_cols);
  std::vector<evaluation_rows::Sums> row_sums;
  const auto sums = sumOverRows(row_sums, grid_.rows, settings_.threads, [&](int row) {
    const std::size_t first = grid_.offset(row);
    const auto arraysFrom = [&](std::size_t cell) {
      return evaluation_rows::RowArrays{displacement_.data() + cell,  elastic_traction_.data() + cell,
                                        gradients_.step() + cell,     gradients_.stepTraction() + cell,
                                        gradients_.residual() + cell, gradients_.slope() + cell};
    };
    if (row >= grid_.frame_rows) return evaluation_rows::evaluateFree(grid_.cols, length, arraysFrom(first));
    auto row_total = evaluation_rows::evaluate(law_, grid_.frame_cols, height,
                                               relief_.data() + static_cast<std::size_t>(row) * frame_cols, length,
                                               arraysFrom(first));
    if (grid_.cols > grid_.frame_cols) {
      row_total += evaluation_rows::evaluateFree(grid_.cols - grid_.frame_cols, length, arraysFrom(first + frame_cols));
    }
    return row_total;
  });
  const double cells = grid_.cellCount();
  Evaluation result;
  result.force = sums.traction * grid_.cellArea();
  result.energy = (0.5 * sums.elastic + sums.energy) * grid_.cellArea();
  result.energy_scale = (0.5 * std::abs(sums.elastic) + std::abs(sums.energy)) * grid_.cellArea();
  result.mean_residual = stiffness_.resistsMean() ? 0.0 : sums.residual / cells;
  result.largest_residual = std::max(sums.highest - result.mean_residual, result.mean_residual - sums.lowest);
  result.residual_norm =
      std::sqrt(std::max(0.0, sums.residual_squared / cells - result.mean_residual * result.mean_residual));
  result.mean_slope = sums.positive_slope / cells;
  return result;
}

void ContactMinimiser::takeStep(double length) {
  const auto cols = static_cast<std::size_t>(grid_.cols);
  forEachRow(grid_.rows, settings_.threads, [&](int row) {
    const std::size_t first = grid_.offset(row);
    const float* const step = gradients_.step();
    const float* const step_traction = gradients_.stepTraction();
    for (std::size_t i = first; i < first + cols; ++i) {
      const double move = length * static_cast<double>(step[i]);
      const double traction = length * static_cast<double>(step_traction[i]);
      displacement_[i] += move;
      elastic_traction_[i] += traction;
      change_[i] += static_cast<float>(move);
      if (!change_traction_.empty()) change_traction_[i] += static_cast<float>(traction);
    }
  });
  is_fresh_ = false;
}

ContactState ContactMinimiser::solve(double height) {
  ContactState state;
  state.height = height;
  const int products_before = products();
  refreshElasticTraction();
  Evaluation now = evaluate(height, 0.0);
  const double allowed = settings_.tolerance * law_.stress();
  while (!isCancelled()) {
    if (now.largest_residual <= allowed) {
      if (is_fresh_) {
        state.is_converged = true;
        break;
      }
      refreshElasticTraction();
      now = evaluate(height, 0.0);
      continue;
    }
    if (state.newton_steps == settings_.max_newton_steps) break;
    ++state.newton_steps;
    ConjugateGradients::System system;
    system.mean_residual = now.mean_residual;
    system.mean_slope = now.mean_slope;
    system.longest_move = kLongestMove * law_.range();
    system.useful_residual = allowed / now.largest_residual;
    const ConjugateGradients::Direction direction = gradients_.find(system);
    state.met_instability = state.met_instability || direction.is_unstable;
    if (!(direction.decrease > 0.0)) break;
    double length = std::min(1.0, system.longest_move / direction.longest);
    const Evaluation before = now;
    bool is_lower = false;
    for (int halvings = 0; halvings <= kMostHalvings; ++halvings, length *= 0.5) {
      now = evaluate(height, length);
      is_lower = now.energy <= before.energy - kSufficientDecrease * length * direction.decrease ||
                 (now.energy <= before.energy + kEnergyNoise * before.energy_scale &&
                  now.residual_norm < before.residual_norm);
      if (is_lower) break;
    }
    if (!is_lower) {
      now = evaluate(height, 0.0);
      if (is_fresh_) break;
      refreshElasticTraction();
      now = evaluate(height, 0.0);
      continue;
    }
    takeStep(length);
  }
  state.force = now.force;
  state.energy = now.energy;
  state.residual = now.largest_residual / law_.stress();
  state.products = products() - products_before;
  return state;
}

}  // namespace mems_stiction
