#pragma once

/// @file
/// Which traction holds a displacement of an elastic half-space, and roughly which displacement
/// answers a traction?
///
///     periodic:  t_q = (E/2) |q| u_q,  0 for q = 0: the mean displacement is the rigid body's
///     free:      u = G * t,  G(x, y) = 1/(pi E) times the integral of 1/r over a cell
///             (Love; Johnson (3.25))
///                K_q = 1/G_q on a frame padded to twice its size
///
/// Bodies of finite thickness (mechanics/wave_stiffness.hpp): K(q) in place of (E/2) |q|; with free
/// edges films alone, whose G has a part more (cell_influence.hpp).
///
/// All are products in Fourier space: rows are transformed, two at a time, then columns are
/// transformed, multiplied and transformed back while they lie in the cache, then rows back. E is
/// the contact modulus of the pair, u the sum of both bodies' displacements. Sources: Johnson,
/// Contact Mechanics (1985), chapter 3; Stanley and Kato, J. Tribology 119 (1997) 481 for the
/// periodic form; Hockney, Methods Comput. Phys. 9 (1970) 135 for the padding.
///
///     SpectrumMemory memory;
///     StiffnessOperator<float> stiffness(grid, contact_modulus, threads, memory);
///     stiffness.precondition(shift, residual, direction);

#include <atomic>
#include <functional>
#include <memory>
#include <vector>

#include <opencv2/core.hpp>

#include "half_space/half_space_grid.hpp"
#include "mechanics/wave_stiffness.hpp"
#include "numeric/large_pages.hpp"

namespace mems_stiction {

/// How a body answers tractions.
struct ElasticResponse {
  double contact_modulus =
      0.0;  ///< E of the thick bodies [Pa], > 0; not looked at where an influence is given
  /// u at a distance of (row, col) cells under a unit traction on one cell [m/Pa], for a frame with
  /// free edges that is no larger; null for the half-space's.
  const cv::Mat1d* influence = nullptr;
  /// The bodies if one is not thick, which must outlive what answers so; null for half-spaces. With
  /// an influence of long waves that a frame of this size cannot have they answer instead.
  const WaveStiffness* layers = nullptr;
};

/// Memory for the half spectrum of a frame, which operators that do not work at the same time can
/// share.
struct SpectrumMemory {
  LargePageVector<unsigned char> bytes;
};

/// K and (K + shift)^-1 on arrays of the grid, Scalar float or double. The same bits for any number
/// of threads.
template <typename Scalar>
class StiffnessOperator {
 public:
  /// - @p contact_modulus [Pa], > 0
  /// - @p threads >= 1
  /// - @p memory is made large enough; it must outlive the operator
  /// - @p cancel looked at after every few rows, as set-up and products take seconds at some
  /// million pixels with free
  ///   edges; may be null. An operator whose set-up was cancelled is not to be used, nor what a
  ///   product gave then
  StiffnessOperator(const HalfSpaceGrid& grid, double contact_modulus, int threads,
                    SpectrumMemory& memory, const std::atomic<bool>* cancel = nullptr);
  StiffnessOperator(const HalfSpaceGrid& grid, const ElasticResponse& response, int threads,
                    SpectrumMemory& memory, const std::atomic<bool>* cancel = nullptr);
  ~StiffnessOperator();
  StiffnessOperator(const StiffnessOperator&) = delete;
  StiffnessOperator& operator=(const StiffnessOperator&) = delete;

  /// traction = K displacement; [m] to [Pa]. The arrays may be one.
  void multiply(const Scalar* displacement, Scalar* traction);
  /// displacement = (K + shift)^-1 traction, its mean 0 where K does not resist the mean. The
  /// arrays may be one.
  /// - @p shift [Pa/m], > 0
  /// @return sum of traction times displacement, in the precision of eight packets a row, added in
  /// double
  double precondition(double shift, const Scalar* traction, Scalar* displacement);

  /// displacement = K^-1 traction, its mean 0 where K does not resist the mean. The arrays may be
  /// one.
  void displace(const Scalar* traction, Scalar* displacement);
  /// The same row by row: take(row, displacement of its cells) is called for each row by one of the
  /// threads, while the row lies in the cache.
  using TakeRow = std::function<void(int row, const Scalar* displacement)>;
  void displace(const Scalar* traction, const TakeRow& take);

  /// The smallest stiffness against a displacement that is not uniform [Pa/m]; of a 1 x 1 frame
  /// infinity.
  double smallest() const { return smallest_; }
  /// The largest one [Pa/m].
  double largest() const { return largest_; }
  /// Whether K resists a uniform displacement: with free edges.
  bool resistsMean() const { return grid_.boundary == HalfSpaceBoundary::kFree; }

 private:
  struct Transforms;
  /// finish(first, second, joined, spare) is called with two rows of the result, joined, and a pad
  /// as long.
  template <typename Multiplier, typename Finish>
  void apply(const Scalar* from, const Multiplier& multiplier, const Finish& finish);
  /// A finish that writes the rows to `to` and then calls after_rows(first, second).
  template <typename AfterRows>
  auto writeTo(Scalar* to, const AfterRows& after_rows) const;
  void fillPeriodic(const ElasticResponse& response);
  /// Of the wave at (row, col) [rad/m].
  double waveNumber(int row, int col) const;
  void fillFree(const ElasticResponse& response);
  /// Complex numbers of a row of the half spectrum.
  Scalar* spectrumOf(std::size_t row);
  /// Where the stiffness of wave numbers (row, col) stands.
  Scalar& entry(int row, int col);

  bool isCancelled() const { return cancel_ != nullptr && cancel_->load(); }

  HalfSpaceGrid grid_;
  int threads_;
  const std::atomic<bool>* cancel_;
  int blocks_;  ///< of columns of the half spectrum
  double smallest_;
  double largest_ = 0.0;
  LargePageVector<Scalar> stiffness_;          ///< column by column of the half spectrum [Pa/m]
  SpectrumMemory* memory_;                     ///< rows x blocks of complex numbers
  std::size_t pad_size_;                       ///< of each pad
  std::vector<LargePageVector<Scalar>> pads_;  ///< for what each thread transforms
  std::vector<double> row_products_;
  std::unique_ptr<Transforms> transforms_;
};

}  // namespace mems_stiction
