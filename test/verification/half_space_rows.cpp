/// The whole surface as a half-space: the law itself, bodies without attraction, spheres from stiff
/// to soft, and waves that snap shut.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "mems_stiction/half_space/half_space_solver.hpp"
#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/axisymmetric_contact.hpp"
#include "support/half_space_cases.hpp"
#include "verification/closed_forms.hpp"
#include "verification/grid_convergence.hpp"
#include "verification/sections.hpp"

namespace mems_stiction {
namespace verification {
namespace {

using closed_form::kPi;
using half_space_cases::elastic;
using half_space_cases::onRigidPlane;

constexpr double kWork = 0.05;
constexpr double kRange = 1.608e-10;
constexpr double kModulus = 88.8e9;
constexpr double kRadius = 50e-9;

SolvedHalfSpace solve(const HalfSpaceProblem& problem, const HalfSpaceOptions& options) {
  return HalfSpaceSolver(options).solve(problem);
}

std::vector<Row> flatRows() {
  const double area = 8 * 9 * 4e-18;
  HalfSpaceOptions options = elastic(kRange);
  options.step = 0.1;
  const SolvedHalfSpace flat =
      solve(onRigidPlane(analytic::flat(8, 9, 2e-9, 2e-9), kModulus), options);
  int off_the_law = 0;
  for (const ForcePoint& point : flat.retraction) {
    const double x = std::pow(kRange / point.height, 3);
    const double law = 8.0 * kWork / (3.0 * kRange) * (x - x * x * x) * area;
    if (point.is_solved && std::abs(point.force - law) > 1e-4 * flat.pull_off_force) ++off_the_law;
  }
  return {near("two planes: pull-off force", "N", "16 Gamma/(9 sqrt(3) z0) A", flat.pull_off_force,
               16.0 * kWork / (9.0 * std::sqrt(3.0) * kRange) * area, 2e-3,
               "parabolas over steps of 0.1 z0"),
          near("two planes: height at rest", "m", "z0", flat.rest_height, kRange, 1e-3,
               "a force of a thousandth of the largest counts as none"),
          near("two planes: work of adhesion", "J/m^2", "Gamma", flat.work_of_adhesion, kWork, 1e-4,
               "quadratic in the height of rest"),
          always("two planes: heights at which the force is not that of the law",
                 "(8 Gamma/(3 z0)) (x^3 - x^9) A", off_the_law,
                 "a ten-thousandth of the largest force")};
}

/// Walls: no attraction, z0 small beside the depth.
HalfSpaceOptions wall(double range) {
  HalfSpaceOptions options = elastic(range);
  options.attraction = false;
  options.step = 2.0;
  return options;
}

std::vector<Row> hertzRows() {
  const double radius = 200e-9, depth = 1e-9;
  const double a = std::sqrt(radius * depth);
  const double load = 4.0 / 3.0 * kModulus * std::sqrt(radius) * std::pow(depth, 1.5);
  const double wide = 40e-9;
  const char* why = "z0 of 0.3 % of the depth";
  return onGrids(
      {limit("a sphere without attraction: depth", "m", "Hertz: (3 F/(4 E sqrt(R)))^(2/3)", depth,
             5e-3, why, {0.5, "the wall's z0 stays: between no order and the second"}),
       limit("a sphere without attraction: largest pressure", "Pa", "Hertz: 3 F/(2 pi a^2)",
             1.5 * load / (kPi * a * a), 5e-3, why, {0.5, "as above"}),
       limit("a sphere without attraction: area of the cells", "m^2", "Hertz: pi R d", kPi * a * a,
             3e-2, "half a pixel of the radius' 20", {0.5, "a rim of pixels"})},
      {"pixels per contact radius", {5, 10, 20}, 2},
      [&](double pixels, const Phase& phase) -> std::vector<double> {
        const double pitch = a / pixels;
        const int size = static_cast<int>(std::ceil(wide / pitch));
        HalfSpaceProblem problem =
            onRigidPlane(analytic::paraboloid(size, size, pitch, pitch, radius, phase.x * pitch,
                                              phase.y * pitch),
                         kModulus);
        problem.load.mechanical_load = load;
        HalfSpaceOptions options = wall(3e-12);
        options.boundary = HalfSpaceBoundary::kFree;
        const SolvedHalfSpace found = solve(problem, options);
        if (found.status != HalfSpaceStatus::kSolved) return {};
        double largest = 0.0;
        cv::minMaxLoc(found.pressure, nullptr, &largest);
        return {-found.rest_height, largest, found.contact_area};
      });
}

std::vector<Row> westergaardRows() {
  const int cols = 256;
  const double pitch = 1e-9, amplitude = 1e-9, length = cols * pitch;
  const double full = kPi * kModulus * amplitude / length;
  std::vector<Row> rows;
  for (const double share : {0.2, 0.5}) {
    HalfSpaceProblem problem =
        onRigidPlane(analytic::sine(2, cols, pitch, pitch, amplitude, 1), kModulus);
    problem.load.mechanical_load = share * full * 2 * length * pitch;
    const SolvedHalfSpace found = solve(problem, wall(2e-12));
    double largest = 0.0;
    if (found.status == HalfSpaceStatus::kSolved) cv::minMaxLoc(found.pressure, nullptr, &largest);
    char text[64];
    std::snprintf(text, sizeof text, "a wavy wall at %g of the pressure that closes it: ", share);
    rows.push_back(near(std::string(text) + "largest pressure", "Pa", "Westergaard: 2 sqrt(p p*)",
                        largest, 2.0 * full * std::sqrt(share), 5e-3,
                        "z0 of 0.2 % of the amplitude"));
    rows.push_back(near(std::string(text) + "width of contact", "m",
                        "Westergaard: sin^2(pi a/l) = p/p*", found.contact_area / (2.0 * pitch),
                        2.0 * length / kPi * std::asin(std::sqrt(share)),
                        2.0 * pitch / (2.0 * length / kPi * std::asin(std::sqrt(share))),
                        "a pixel on either side"));
  }
  return rows;
}

/// Attraction of a rigid paraboloid outside of a square frame, over pi Gamma R: of the law, ring by
/// ring.
double beyondFrame(double height, double half_width) {
  constexpr int kAngles = 64;  // of an eighth of the circle
  double sum = 0.0;
  for (int i = 0; i < kAngles; ++i) {
    const double edge = half_width / std::cos(0.25 * kPi * (i + 0.5) / kAngles);
    const double x = kRange / (height + edge * edge / (2.0 * kRadius));
    sum += (4.0 * x * x - std::pow(x, 8)) / 3.0 * 2.0 / kAngles;
  }
  return sum;
}

/// Pull-off force over pi Gamma R of a sphere with free edges, what is beyond the frame added.
double spherePullOff(double tabor, double pixels_per_cohesive_length, const Phase& phase) {
  const double length = std::sqrt(kRadius * kRange);
  const double cohesive = length * std::pow(tabor, -1.5);
  const double pitch = std::min(cohesive, 0.5 * length) / pixels_per_cohesive_length;
  const int size = static_cast<int>(std::ceil(12.0 * length / pitch));
  const double modulus = kWork / std::pow(kRange * tabor, 1.5) * std::sqrt(kRadius);
  HalfSpaceOptions options = elastic(kRange);
  options.boundary = HalfSpaceBoundary::kFree;
  const SolvedHalfSpace found = solve(
      onRigidPlane(
          analytic::paraboloid(size, size, pitch, pitch, kRadius, phase.x * pitch, phase.y * pitch),
          modulus),
      options);
  return found.pull_off_force / (kPi * kWork * kRadius) +
         beyondFrame(found.pull_off_height, 0.5 * size * pitch);
}

std::vector<Row> sphereRows() {
  std::vector<Row> rows;
  const char* kRings = "the same law on rings, by Newton's method";
  const char* kSame = "steps of the height, two pixels per cohesive length";
  for (const double tabor : {0.05, 0.16, 0.3, 0.5, 1.0, 2.0, 3.0}) {
    const double found = spherePullOff(tabor, 2.0, {0.3, 0.2});
    const double rings = axisymmetric::pullOff(tabor);
    char text[64];
    std::snprintf(text, sizeof text, "a sphere at Tabor's parameter %g: pull-off", tabor);
    rows.push_back(near(text, "pi Gamma R", kRings, found, rings, 1e-2, kSame));
    const bool is_stiff = tabor < 0.1;
    rows.push_back(near(
        std::string(text) + ", Maugis", "pi Gamma R", "Maugis 1992 at 1.157 of Tabor's parameter",
        found, closed_form::maugisPullOff(1.1575 * tabor), is_stiff ? 0.02 : 0.06,
        is_stiff
            ? "the laws hardly differ where bodies are rigid"
            : "other laws: Maugis' traction ends 0.97 z0 beyond contact, that of 9-3 reaches on"));
  }
  const double soft = axisymmetric::pullOff(5.0);
  rows.push_back(near("the rings at Tabor's parameter 0.001", "pi Gamma R", "Bradley: 2",
                      axisymmetric::pullOff(1e-3), 2.0, 1e-3, "what is beyond the last ring"));
  rows.push_back(near("the rings at Tabor's parameter 5", "pi Gamma R", "JKR: 3/2", soft, 1.5, 0.03,
                      "the limit is neared as the inverse of Tabor's parameter"));
  rows.push_back(near("the rings at Tabor's parameter 5, Maugis", "pi Gamma R",
                      "Maugis 1992 at 1.157 of Tabor's parameter", soft,
                      closed_form::maugisPullOff(1.1575 * 5.0), 0.02,
                      "near the limit the laws differ little"));
  const std::vector<Row> on_grids = onGrids(
      {limit("a sphere at Tabor's parameter 1: pull-off with the pitch", "pi Gamma R", kRings,
             axisymmetric::pullOff(1.0), 5e-3, "steps of the height",
             {1.0, "to the floor that steps leave"})},
      {"pixels per cohesive length", {0.5, 1, 2}, 3}, [](double pixels, const Phase& phase) {
        return std::vector<double>{spherePullOff(1.0, pixels, phase)};
      });
  rows.insert(rows.end(), on_grids.begin(), on_grids.end());
  return rows;
}

/// The alpha from which a wave closes by itself, by bisection.
double snapThreshold() {
  constexpr int kCols = 256;
  constexpr double kPixelsPerCohesiveLength = 4.0;
  const double pitch = kModulus * kRange * kRange / kWork / kPixelsPerCohesiveLength;
  double open = 0.4, closed = 0.8;
  for (int halvings = 0; halvings < 7; ++halvings) {
    const double alpha = 0.5 * (open + closed);
    const double amplitude = std::sqrt(2.0 * kCols * pitch * kWork / kModulus) / (kPi * alpha);
    const SolvedHalfSpace found =
        solve(onRigidPlane(analytic::sine(2, kCols, pitch, pitch, amplitude, 1), kModulus),
              elastic(kRange));
    if (found.status != HalfSpaceStatus::kSolved) return std::nan("");
    double widest = 0.0;
    cv::minMaxLoc(found.gap, nullptr, &widest);
    (widest < 2.0 * kRange ? closed : open) = alpha;
  }
  return 0.5 * (open + closed);
}

std::vector<Row> waveRows() {
  return {near("a wave that closes by itself: alpha from which on", "",
               "Johnson 1995: sqrt(2 l Gamma/(pi^2 h^2 E)) = largest sin^2(x)/sqrt(tan(x))",
               snapThreshold(), 0.5698754, 0.01,
               "bisection to 0.3 %; a cohesive length of a 64th of the wave, where JKR has none")};
}

/// Amplitude of a wave along x in a map.
double amplitudeOf(const cv::Mat& map) {
  double sum = 0.0;
  for (int col = 0; col < map.cols; ++col) {
    sum += 2.0 / map.cols * static_cast<double>(map.at<float>(0, col)) *
           std::sin(2.0 * kPi * col / map.cols);
  }
  return std::abs(sum);
}

/// A wave that is closed all over, in a body of which it is 1/s radians long: pressure over what is
/// gone of its amplitude.
Row closedWaveRow(const char* name, const char* source, Material body, double s, double expected,
                  double tolerance, const char* why) {
  const int cols = 32;
  const double amplitude = 0.5 * kRange;
  const double pitch = 2.0 * kPi * body.thickness / (s * cols);
  HalfSpaceProblem problem =
      onRigidPlane(analytic::sine(2, cols, pitch, pitch, amplitude, 1), kModulus);
  problem.lower_material = body;
  problem.interface.work_of_adhesion =
      12.5 * expected * kRange * kRange;  // contacts are 200 times as stiff
  HalfSpaceOptions options = elastic(kRange);
  options.tolerance = 1e-6;
  const SolvedHalfSpace found = solve(problem, options);
  const double stiffness = found.status == HalfSpaceStatus::kSolved
                               ? amplitudeOf(found.pressure) / (amplitude - amplitudeOf(found.gap))
                               : std::nan("");
  return near(std::string("a closed wave, ") + name, "Pa/m", source, stiffness, expected, tolerance,
              why);
}

std::vector<Row> layerRows() {
  Material body;
  body.youngs_modulus = 80e9;
  body.poisson_ratio = 0.3;
  body.thickness = 1e-6;
  const double plane = 80e9 / (1.0 - 0.3 * 0.3);
  const double confined = 80e9 * 0.7 / (1.3 * 0.4);
  const double t = body.thickness;
  const char* kResidual = "half_space/tolerance";
  Material film = body;
  film.backing = Backing::kBonded;
  Material coated = film;
  coated.substrate = {20e9, 0.3};
  const double thin = 0.03;
  return {closedWaveRow("plate of s = qt = 0.03", "a plate that bends: E' t^3 q^4/12", body, thin,
                        plane * std::pow(thin, 4) / (12.0 * t), 1e-3, "shear, of s^2"),
          closedWaveRow("plate of s = 30", "a half-space: (E'/2) q", body, 30.0,
                        0.5 * plane * 30.0 / t, 1e-3, kResidual),
          closedWaveRow("film on something rigid, s = 0.03",
                        "a confined film: E (1 - nu)/((1 + nu)(1 - 2 nu) t)", film, thin,
                        confined / t, 5e-3, "sideways strain, of s^2"),
          closedWaveRow("film on something rigid, s = 30", "a half-space: (E'/2) q", film, 30.0,
                        0.5 * plane * 30.0 / t, 1e-3, kResidual),
          closedWaveRow("film on a soft body, s = 30", "a half-space of the film: (E'/2) q", coated,
                        30.0, 0.5 * plane * 30.0 / t, 1e-3, kResidual)};
}

}  // namespace

Section halfSpaceSection() {
  Section section{"The half-space", {}};
  for (const std::vector<Row>& rows :
       {flatRows(), hertzRows(), westergaardRows(), sphereRows(), waveRows(), layerRows()}) {
    section.rows.insert(section.rows.end(), rows.begin(), rows.end());
  }
  return section;
}

}  // namespace verification
}  // namespace mems_stiction
