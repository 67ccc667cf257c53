#pragma once

/// @file
/// How does a scan lie and bend, apart from its features?
///
///     z(x, y) ~ sum of c_ij u^i v^j over i + j <= degree;
///             u = (x - centre_x)/unit, v = (y - centre_y)/unit
///
/// Least squares over the valid pixels, or robust: iterated reweighting, first with Huber's weights
/// (k = 1.345), then with Tukey's biweight (c = 4.685), residuals in units of 1.4826 times the
/// median of their absolute values. Both constants keep 95 % of the efficiency of least squares on
/// Gaussian roughness (Huber and Ronchetti, Robust Statistics, 2009). Pixels more than 4.685 units
/// away, such as particles, spikes and etched steps, then have no say.
///
/// Tall features on a fifth of the frame can pull the first fit so far that the reweighting does
/// not find back. So a second one starts from the slopes between neighbouring pixels, which
/// features change at their edges alone. It masks what stands out of the ground (the quarter of all
/// residuals that lie closest together, whose width is its noise), fits the rest, and masks again,
/// three times to rest. The second one is taken where its ground is less than 0.8 as wide.
/// Assumption: features leave at least about a third of the frame, or are flat themselves;
/// otherwise they are the surface. Degenerate cases: terms that the valid pixels do not determine
/// (a single row has no slope across it) are 0.

#include <Eigen/Core>

#include "preprocess/working_surface.hpp"

namespace mems_stiction {

enum class FitWeights {
  kEqual,   ///< least squares
  kRobust,  ///< iterated reweighting
};

/// A polynomial of second degree in x and y.
struct PolynomialSurface {
  int degree = 0;         ///< 0, 1 or 2
  double origin = 0.0;    ///< added to the sum [m]
  double centre_x = 0.0;  ///< centroid of the valid pixels [m]
  double centre_y = 0.0;  ///< [m]
  double unit = 1.0;      ///< half of the frame's longer side [m]
  double noise = 0.0;     ///< 1.4826 x median of the absolute residuals [m]
  Eigen::Matrix<double, 6, 1> coefficients =
      Eigen::Matrix<double, 6, 1>::Zero();  ///< of 1, u, v, u^2, u v, v^2 [m]

  double height(double x, double y) const;  ///< [m]
};

/// - @p heights all of a surface or some of its lines
/// - @p degree 0, 1 or 2
/// @throw SurfaceError if no pixel is valid.
PolynomialSurface fitPolynomial(const cv::Mat& heights, double pitch_x, double pitch_y, int degree,
                                FitWeights weights, CleaningMemory& memory);
/// The robust polynomial from coarse samples to all pixels: every 16th pixel of every 16th row,
/// then every fourth of every fourth, each until it rests; then all of them with the noise of the
/// last sample. Its rest is that of the other to about the last step of either, 1e-4 noise, in a
/// fiftieth of the time. Features whose period is that of the samples can lead it to another.
PolynomialSurface fitPolynomialBySamples(const cv::Mat& heights, double pitch_x, double pitch_y,
                                         int degree, CleaningMemory& memory);

/// The polynomial along the row at y [m], over the places u of its pixels.
LineCurve curveAt(const PolynomialSurface& polynomial, double y);
/// u of the columns at first_x, first_x + pitch_x, ... [m]
void findPlaces(const PolynomialSurface& polynomial, double first_x, double pitch_x, int cols,
                std::vector<double>& places);

HeightChange subtract(const PolynomialSurface& polynomial, WorkingSurface& surface);

}  // namespace mems_stiction
