#pragma once

/// @file
/// How a plate bends down onto several summits at once: at least cost, so that n of them, far enough apart, are of one height.
///
///     u(x) = sum_j P_j c(x - x_j),   h(x_i) - u(x_i) = H,   sum_j P_j = 0,   B A = (1/2) sum_j P_j u(x_j)          (S15b)
///
/// c is what a unit force bends, the sum over waves of C(q). The first is the highest; each further one is what then stands out
/// most, at least a thickness away from all others: nearer ones no plate can tell apart. The height H costs least where the forces
/// balance.

#include <vector>

#include <opencv2/core.hpp>

#include "approach/gap_field.hpp"
#include "separation/extra_compliance.hpp"
#include "separation/relief_spectrum.hpp"

namespace mems_stiction {

/// Of one frame.
class SummitBending {
 public:
  /// - @p relief of the field, in blocks; must outlive the object, as the compliance
  /// - @p apart what lies between two summits at least [m]
  SummitBending(const GapField& field, ReliefSpectrum& relief, const ExtraCompliance& compliance, double apart);

  /// Takes one summit more.
  /// @return whether there was one
  bool addSummit();
  int count() const { return static_cast<int>(summits_.size()); }
  /// u by block [m].
  const cv::Mat1d& bending() const { return bending_; }
  double energy() const { return energy_; }  ///< B [J/m^2]

 private:
  void bend();
  /// The place itself, and its mirror images where the frame is mirrored.
  std::vector<cv::Point> images(const cv::Point& place) const;

  ReliefSpectrum& relief_;
  const ExtraCompliance& compliance_;
  double apart_;
  double area_;
  cv::Mat1d tops_;  ///< highest place of each block [m]
  cv::Mat1b is_free_;
  cv::Mat1d kernel_;  ///< c [m/N]
  cv::Mat1d bending_;
  std::vector<cv::Point> summits_;
  double energy_ = 0.0;
};

}  // namespace mems_stiction
