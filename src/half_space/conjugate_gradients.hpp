#pragma once

/// @file
/// Along which step does the energy of a contact fall, and how far does Newton's method go along
/// it?
///
///     (K + t') s = r        r: residual t - K u; t' of each cell
///
/// by conjugate gradients in single precision, left at negative curvature, where s is longer than
/// t' is known for, and where r is known better than the law is straight over s. With P = (K +
/// shift)^-1 the preconditioner is
///
///     P                           small contacts: it also gives K of its result, one product an
///                                 iteration
///     S C S + 1/(z + t'),         large ones: cells that their contact holds answer by themselves,
///                                 the others as a body
///     S = y/(y + t'), t' > 0      only between them. C is P of every second cell of every second
///                                 row (coarse_answer.hpp), whose work hardly counts; what varies
///                                 from cell to cell is answered by z alone
///
/// Sources: Dembo, Eisenstat and Steihaug, SIAM J. Numer. Anal. 19 (1982) 400 for how exactly each
/// system is solved; Steinbach and Wendland, Adv. Comput. Math. 9 (1998) 191 for K^-1 of the whole
/// plane as preconditioner of a part of it.
///
///     ConjugateGradients gradients(grid, stiffness, coarse, threads, cancel, give_way);
///     gradients.allocate();
///     ... residual and slope ...
///     const ConjugateGradients::Direction direction = gradients.find(system);

#include <atomic>
#include <cstddef>
#include <functional>

#include "half_space/coarse_answer.hpp"
#include "half_space/half_space_grid.hpp"
#include "half_space/stiffness_operator.hpp"
#include "numeric/large_pages.hpp"

namespace mems_stiction {

/// Solves one system after the other on arrays of the grid. The same bits for any number of
/// threads.
class ConjugateGradients {
 public:
  /// What is known of a system beside its arrays.
  struct System {
    double mean_residual = 0.0;    ///< what K cannot resist of the residual [Pa]
    double mean_slope = 0.0;       ///< of the positive t' [Pa/m]
    double longest_move = 0.0;     ///< of a cell in one step, over which t' changes [m]
    double useful_residual = 0.0;  ///< share of the residual below which nothing is gained
  };
  /// A step along which the energy falls.
  struct Direction {
    double decrease = 0.0;       ///< minus the derivative of the energy along it, at its begin [J]
    double longest = 0.0;        ///< largest |s| [m]
    double mean_residual = 0.0;  ///< what K cannot resist of r - t' s [Pa]
    bool is_unstable = false;
  };

  /// - @p stiffness must outlive this
  /// - @p coarse likewise; null: all cells in place of every second one
  /// - @p cancel looked at after each product; may be null
  /// - @p give_way called before each iteration; may be empty
  ConjugateGradients(const HalfSpaceGrid& grid, StiffnessOperator<float>& stiffness,
                     CoarseAnswer* coarse, int threads, const std::atomic<bool>* cancel,
                     std::function<void()> give_way);

  /// Makes residual and stepTraction, of zeros: those that the owner uses without find() too.
  void allocateShared();
  /// Makes the others too, unless they are there.
  void allocate();

  float* residual() { return residual_.data(); }      ///< t - K u [Pa]; lost by find()
  float* slope() { return slope_.data(); }            ///< t' of the frame's cells [Pa/m]
  const float* step() const { return step_.data(); }  ///< s [m]
  float* stepTraction() { return first_.data(); }     ///< K s [Pa]
  const float* stepTraction() const { return first_.data(); }
  /// Applications of P or of K on all cells so far: one pair of transforms each.
  int products() const { return products_; }

  /// Sets step and its traction.
  Direction find(const System& system);

 private:
  struct Preconditioner;
  struct Product;
  Preconditioner preconditionerOf(const System& system) const;
  /// The preconditioned residual.
  Product smooth(const Preconditioner& preconditioner, double mean);
  /// The next conjugate direction and its traction. @return what it costs, and the mean that it
  /// adds to the residual
  Product turn(const Preconditioner& preconditioner, double ratio, double mean,
               double smoothed_mean);
  bool isCancelled() const { return cancel_ != nullptr && cancel_->load(); }

  HalfSpaceGrid grid_;
  StiffnessOperator<float>& stiffness_;
  CoarseAnswer* coarse_;
  int threads_;
  const std::atomic<bool>* cancel_;
  std::function<void()> give_way_;
  LargePageVector<float> residual_;
  LargePageVector<float> slope_;
  LargePageVector<float> smoothed_;         ///< the preconditioned residual [m]
  LargePageVector<float> search_;           ///< conjugate direction [m]
  LargePageVector<float> search_traction_;  ///< K of it [Pa]
  LargePageVector<float> step_;
  LargePageVector<float>
      first_;  ///< while s is sought, the residual that it began with; then K s [Pa]
  int products_ = 0;
};

}  // namespace mems_stiction
