/// Figures of roughness where a surface has them in closed form.

#include <cmath>

#include "mems_stiction/roughness/areal_parameters.hpp"
#include "roughness/autocorrelation.hpp"
#include "roughness/power_spectrum.hpp"
#include "roughness/summits.hpp"
#include "support/analytic_surfaces.hpp"
#include "surface/gaussian_surface.hpp"
#include "surface/self_affine_surface.hpp"
#include "verification/closed_forms.hpp"
#include "verification/grid_convergence.hpp"
#include "verification/sections.hpp"

namespace mems_stiction {
namespace verification {
namespace {

constexpr double kAmplitude = 4e-9;
constexpr double kPi = closed_form::kPi;

/// Five waves of 200 nm.
HeightMap waves(double pixels_per_wave) {
  const double pitch = 200e-9 / pixels_per_wave;
  return analytic::sine(static_cast<int>(2 * pixels_per_wave),
                        static_cast<int>(5 * pixels_per_wave), pitch, pitch, kAmplitude, 5);
}

std::vector<Row> waveRows() {
  const double slope = 2.0 * kPi * kAmplitude / 200e-9;
  std::vector<Row> rows = {
      limit("Sa of a sine", "m", "2 A/pi", 2.0 * kAmplitude / kPi, 1e-3,
            "midpoint rule: (pi/160)^2/3", {1.8, "midpoint rule: second order"}),
      limit("Sdq of a sine", "", "2 pi A/(L sqrt(2))", slope / std::sqrt(2.0), 5e-3,
            "two of 800 border columns are left out: twice 1/800",
            {0.9, "differences of second order, the border of first"}),
      limit("autocorrelation length of a sine", "m", "L acos(0.2)/(2 pi)",
            200e-9 * std::acos(0.2) / (2.0 * kPi), 1e-3,
            "straight lines between pixels: (2 pi/160)^2/8",
            {1.5, "straight lines between pixels: second order"})};
  return onGrids(
      rows, {"pixels per wave", {20, 40, 80, 160}, 1},
      [](double pixels, const Phase&) -> std::vector<double> {
        const HeightMap surface = waves(pixels);
        const ArealParameters found = arealParameters(surface);
        return {found.sa, found.sdq, spatialParameters(surface, FrameBoundary::kPeriodic).sal};
      });
}

GaussianSurfaceOptions gaussian(int seed) {
  GaussianSurfaceOptions options;
  options.rows = options.cols = 512;
  options.pitch_x = options.pitch_y = 5e-9;
  options.correlation_length_x = options.correlation_length_y = 60e-9;
  options.seed = seed;
  return options;
}

/// Means over seeds of what a sample of a random surface scatters in.
std::vector<Row> gaussianRows() {
  const double length = 60e-9, sigma = gaussian(1).rms_height;
  const double m2 = 2.0 * sigma * sigma / (length * length);
  const double m4 = 12.0 * sigma * sigma / std::pow(length, 4);
  const int seeds = 6;
  double found_m2 = 0.0, found_m4 = 0.0, found_sal = 0.0, found_density = 0.0,
         found_curvature = 0.0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const HeightMap surface = gaussianSurface(gaussian(seed));
    const SpectralMoments moments = powerSpectrum(surface, SpectrumWindow::kNone).moments;
    const SummitParameters summits = summitParameters(surface);
    found_m2 += moments.m2 / seeds;
    found_m4 += moments.m4 / seeds;
    found_sal += spatialParameters(surface, FrameBoundary::kPeriodic).sal / seeds;
    found_density += summits.density / seeds;
    found_curvature += summits.mean_curvature / seeds;
  }
  const char* theory = "Nayak 1971, of exp(-r^2/l^2)";
  const char* scatter = "six samples of some 600 independent patches";
  return {near("m2 of Gaussian surfaces", "", theory, found_m2, m2, 0.03, scatter),
          near("m4 of Gaussian surfaces", "1/m^2", theory, found_m4, m4, 0.06, scatter),
          near("autocorrelation length of Gaussian surfaces", "m", "l sqrt(ln 5)", found_sal,
               length * std::sqrt(std::log(5.0)), 0.08,
               "the shortest of all directions, of samples that scatter by 4 %"),
          near("density of their summits", "1/m^2", "m4/(6 pi sqrt(3) m2)", found_density,
               m4 / (6.0 * kPi * std::sqrt(3.0) * m2), 0.07,
               "some 2800 summits; 12 pixels per correlation length"),
          near("mean curvature of their summits", "1/m", "(8/3) sqrt(m4/pi)", found_curvature,
               8.0 / 3.0 * std::sqrt(m4 / kPi), 0.07,
               "some 2800 summits; 12 pixels per correlation length")};
}

}  // namespace

Section roughnessSection() {
  const HeightMap surface = waves(40);
  const ArealParameters height = arealParameters(surface);
  const SpectralMoments moments = powerSpectrum(surface, SpectrumWindow::kNone).moments;
  const double wave_number = 2.0 * kPi / 200e-9;
  const ArealParameters plane =
      arealParameters(analytic::tiltedPlane(31, 18, 11e-9, 27e-9, 0.12, -0.05));
  const SummitParameters cap = summitParameters(analytic::paraboloid(41, 31, 5e-9, 8e-9, 300e-9));
  SelfAffineSurfaceOptions affine;
  affine.hurst_exponent = 0.7;
  affine.seed = 3;
  const HurstFit hurst = fitHurstExponent(
      powerSpectrum(selfAffineSurface(affine), SpectrumWindow::kNone), 50e-9, 900e-9);
  Section section{"Roughness", {}};
  section.rows = {
      exact("Sq of a sine", "m", "A/sqrt(2)", height.sq, kAmplitude / std::sqrt(2.0)),
      exact("Sku of a sine", "", "3/2", height.sku, 1.5),
      near("Ssk of a sine", "", "0", height.ssk, 0.0, kRoundOff, kRoundOffReason),
      exact("Sz of a sine", "m", "2 A", height.sz, 2.0 * kAmplitude),
      exact("Sdq of a plane", "", "its slope", plane.sdq, 0.13),
      exact("Sdr of a plane", "", "sqrt(1 + slope^2) - 1", plane.sdr, std::sqrt(1.0169) - 1.0),
      exact("m0 of a sine", "m^2", "A^2/2", moments.m0, 0.5 * kAmplitude * kAmplitude),
      exact("m2 of a sine", "", "(A k)^2/4", moments.m2,
            0.25 * std::pow(kAmplitude * wave_number, 2)),
      exact("m4 of a sine", "1/m^2", "3 A^2 k^4/16", moments.m4,
            3.0 / 16.0 * kAmplitude * kAmplitude * std::pow(wave_number, 4)),
      near("radius of a paraboloid's summit", "m", "put in", cap.mean_radius, 300e-9, 1e-9,
           "round-off of second differences"),
      near("Hurst exponent of a self-affine surface", "", "put in", hurst.hurst_exponent, 0.7, 0.04,
           "scatter of some 5000 waves"),
  };
  for (const auto& rows : {waveRows(), gaussianRows()}) {
    section.rows.insert(section.rows.end(), rows.begin(), rows.end());
  }
  return section;
}

}  // namespace verification
}  // namespace mems_stiction
