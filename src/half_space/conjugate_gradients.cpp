#include "half_space/conjugate_gradients.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "conjugate_rows.hpp"
#include "half_space/row_work.hpp"

namespace mems_stiction {
namespace {

/// Iterations for one system.
constexpr int kMostIterations = 200;
/// The share of the residual that may stay: this times the longest move of a cell over the longest
/// one allowed, as t' changes by such a share on the way; at least and at most.
constexpr double kForcingFactor = 10.0;
constexpr double kFinestForcing = 1e-3;
constexpr double kCoarsestForcing = 0.3;
/// Shift for small contacts, of the mean positive t': the less, the fewer iterations for few, stiff
/// ones. At least this share of the smallest stiffness.
constexpr double kShiftShare = 0.3;
constexpr double kSmallestShift = 0.1;
/// Contacts are large where that shift is more than this times the smallest stiffness.
constexpr double kLargeContacts = 0.05;
/// Shift for large contacts, of the smallest stiffness; y and z, of the largest, and z where C is P
/// of all cells.
constexpr double kFreeShift = 0.5;
constexpr double kYielding = 0.12;
constexpr double kRough = 0.7;
constexpr double kRoughOfAll = 1.0;

}  // namespace

struct ConjugateGradients::Preconditioner {
  float shift;     ///< [Pa/m]
  float yielding;  ///< y [Pa/m]; 0: P alone
  float rough;     ///< z [Pa/m]
};

struct ConjugateGradients::Product {
  double value;
  double mean;
};

ConjugateGradients::ConjugateGradients(const HalfSpaceGrid& grid,
                                       StiffnessOperator<float>& stiffness, CoarseAnswer* coarse,
                                       int threads, const std::atomic<bool>* cancel,
                                       std::function<void()> give_way)
    : grid_(grid),
      stiffness_(stiffness),
      coarse_(coarse),
      threads_(threads),
      cancel_(cancel),
      give_way_(std::move(give_way)) {}

void ConjugateGradients::allocateShared() {
  for (auto* const array : {&residual_, &first_}) {
    if (array->empty()) array->assign(grid_.size(), 0.0F);
  }
}

void ConjugateGradients::allocate() {
  allocateShared();
  for (auto* const array : {&slope_, &smoothed_, &search_, &search_traction_, &step_}) {
    if (array->empty()) array->assign(grid_.size(), 0.0F);
  }
}

ConjugateGradients::Preconditioner ConjugateGradients::preconditionerOf(
    const System& system) const {
  const double smallest = stiffness_.smallest();
  const double shift = kShiftShare * system.mean_slope;
  if (shift > kLargeContacts * smallest) {
    const double rough = coarse_ != nullptr ? kRough : kRoughOfAll;
    return {static_cast<float>(kFreeShift * smallest),
            static_cast<float>(kYielding * stiffness_.largest()),
            static_cast<float>(rough * stiffness_.largest())};
  }
  return {static_cast<float>(std::max(shift, kSmallestShift * smallest)), 0.0F, 0.0F};
}

/// The sums of work(first cell of the row) over the rows.
template <typename Work>
static conjugate_rows::Sums overRows(const HalfSpaceGrid& grid, int threads, const Work& work) {
  std::vector<conjugate_rows::Sums> row_sums;
  return sumOverRows(row_sums, grid.rows, threads, [&](int row) { return work(grid.offset(row)); });
}

ConjugateGradients::Product ConjugateGradients::smooth(const Preconditioner& preconditioner,
                                                       double mean) {
  const auto shift = static_cast<double>(preconditioner.shift);
  if (preconditioner.yielding == 0.0F) {
    ++products_;
    return {stiffness_.precondition(shift, residual_.data(), smoothed_.data()), 0.0};
  }
  const auto cols = static_cast<std::size_t>(grid_.cols);
  const auto level = static_cast<float>(mean);
  overRows(grid_, threads_, [&](std::size_t i) {
    return conjugate_rows::weigh(cols, preconditioner.yielding, level, residual_.data() + i,
                                 slope_.data() + i, smoothed_.data() + i);
  });
  if (coarse_ != nullptr) {
    coarse_->find(shift, smoothed_.data());
  } else {
    ++products_;
    stiffness_.precondition(shift, smoothed_.data(), smoothed_.data());
  }
  std::vector<conjugate_rows::Sums> row_sums;
  const auto sums = sumOverRows(row_sums, grid_.rows, threads_, [&](int row) {
    const std::size_t i = grid_.offset(row);
    if (coarse_ != nullptr) coarse_->row(row, smoothed_.data() + i);
    return conjugate_rows::combine(cols, preconditioner.yielding, preconditioner.rough, level,
                                   residual_.data() + i, slope_.data() + i, smoothed_.data() + i);
  });
  return {sums.product, stiffness_.resistsMean() ? 0.0 : sums.sum / grid_.cellCount()};
}

ConjugateGradients::Product ConjugateGradients::turn(const Preconditioner& preconditioner,
                                                     double ratio, double mean,
                                                     double smoothed_mean) {
  const auto cols = static_cast<std::size_t>(grid_.cols);
  const auto part = static_cast<float>(ratio);
  conjugate_rows::Sums sums;
  if (preconditioner.yielding == 0.0F) {
    sums = overRows(grid_, threads_, [&](std::size_t i) {
      return conjugate_rows::turn(cols, part, preconditioner.shift, static_cast<float>(mean),
                                  smoothed_.data() + i, residual_.data() + i, slope_.data() + i,
                                  search_.data() + i, search_traction_.data() + i);
    });
  } else {
    overRows(grid_, threads_, [&](std::size_t i) {
      return conjugate_rows::follow(cols, part, static_cast<float>(smoothed_mean),
                                    smoothed_.data() + i, search_.data() + i);
    });
    stiffness_.multiply(search_.data(), search_traction_.data());
    ++products_;
    sums = overRows(grid_, threads_, [&](std::size_t i) {
      return conjugate_rows::respond(cols, slope_.data() + i, search_.data() + i,
                                     search_traction_.data() + i);
    });
  }
  return {sums.product, stiffness_.resistsMean() ? 0.0 : sums.sum / grid_.cellCount()};
}

ConjugateGradients::Direction ConjugateGradients::find(const System& system) {
  const auto cols = static_cast<std::size_t>(grid_.cols);
  const Preconditioner preconditioner = preconditionerOf(system);
  const double finest = std::clamp(system.useful_residual, kFinestForcing, kCoarsestForcing);
  Direction direction;
  double mean = system.mean_residual;  // of the residual: no direction answers it
  double product = 0.0;
  double first_product = 0.0;
  for (int iteration = 0; iteration < kMostIterations && !isCancelled(); ++iteration) {
    if (give_way_) give_way_();
    const Product smoothed = smooth(preconditioner, mean);
    if (!(smoothed.value > 0.0)) break;
    const double ratio = iteration == 0 ? 0.0 : smoothed.value / product;
    product = smoothed.value;
    if (iteration == 0) first_product = product;
    const double forcing = std::clamp(kForcingFactor * direction.longest / system.longest_move,
                                      finest, kCoarsestForcing);
    const bool is_last = product <= forcing * forcing * first_product;
    const Product turned = turn(preconditioner, ratio, mean, smoothed.mean);
    double length = product / turned.value;
    direction.is_unstable = !(turned.value > 0.0);
    if (direction.is_unstable) {
      const double longest = overRows(grid_, threads_, [&](std::size_t i) {
                               return conjugate_rows::largest(cols, search_.data() + i);
                             }).largest;
      length = std::max(0.0, system.longest_move - direction.longest) / longest;
    }
    const auto advance = iteration == 0 ? conjugate_rows::begin : conjugate_rows::advance;
    direction.longest = overRows(grid_, threads_, [&](std::size_t i) {
                          return advance(cols, static_cast<float>(length), slope_.data() + i,
                                         search_.data() + i, search_traction_.data() + i,
                                         step_.data() + i, first_.data() + i, residual_.data() + i);
                        }).largest;
    mean -= length * turned.mean;
    direction.decrease += length * product * grid_.cellArea();
    if (is_last || direction.is_unstable || direction.longest > system.longest_move) break;
  }
  overRows(grid_, threads_, [&](std::size_t i) {
    return conjugate_rows::finish(cols, slope_.data() + i, step_.data() + i, residual_.data() + i,
                                  first_.data() + i);
  });
  direction.mean_residual = mean;
  return direction;
}

}  // namespace mems_stiction
