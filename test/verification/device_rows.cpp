/// Water in the gap, beams, springs, and the digits of float32 heights.

#include <cmath>
#include <cstdio>

#include "height_map/scan_sanity.hpp"
#include "mechanics/traction_law.hpp"
#include "mems_stiction/loads/capillary.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "mems_stiction/verdict/beam_adhesion.hpp"
#include "mems_stiction/verdict/device_options.hpp"
#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/paper_options.hpp"
#include "verification/closed_forms.hpp"
#include "verification/grid_convergence.hpp"
#include "verification/sections.hpp"

namespace mems_stiction {
namespace verification {
namespace {

constexpr double kUm = 1e-6;

CapillaryOptions humid(double relative_humidity, double contact_angle) {
  CapillaryOptions options;
  options.relative_humidity = relative_humidity;
  options.contact_angle = contact_angle;
  return options;
}

/// Energy per width of one clamped-guided arm of length s [J/m], by Simpson's rule: bending alone,
/// over u = h (3 x^2/s^2 - 2 x^3/s^3), or with the stretching of an arm that is held at both ends
/// and under tension, over the shape of a beam-column, u' ~ 1 - cosh(k (x - s/2))/cosh(k s/2).
class ArmEnergy {
 public:
  ArmEnergy(double modulus, double thickness, double gap, double stress, double length)
      : modulus_(modulus), thickness_(thickness), gap_(gap), stress_(stress), length_(length) {}

  double bent() const {
    integrate([](double x) { return x - x * x; }, [](double x) { return 1.0 - 2.0 * x; });
    return bending_;
  }

  double stretched() const {
    const double unit = modulus_ * std::pow(thickness_, 3) / (12.0 * length_ * length_);
    double low = 1e-6;  // (k s)^2
    double high = 1e6;
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (low + high);
      solve(std::sqrt(middle));
      (middle * unit < thickness_ * (stress_ + modulus_ * strain_) ? low : high) = middle;
    }
    return bending_ + thickness_ * length_ * strain_ * (stress_ + 0.5 * modulus_ * strain_);
  }

 private:
  template <typename Slope, typename Curvature>
  void integrate(const Slope& slope, const Curvature& curvature) const {
    constexpr int kIntervals = 2000;
    double sum = 0.0, squares = 0.0, curved = 0.0;
    for (int i = 0; i <= kIntervals; ++i) {
      const double x = static_cast<double>(i) / kIntervals;
      const double weight = (i == 0 || i == kIntervals ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0)) / 3.0;
      sum += weight / kIntervals * slope(x);
      squares += weight / kIntervals * std::pow(slope(x), 2);
      curved += weight / kIntervals * std::pow(curvature(x), 2);
    }
    const double scale = std::pow(gap_ / (sum * length_), 2);
    strain_ = 0.5 * scale * squares;
    bending_ = modulus_ * std::pow(thickness_, 3) / 24.0 * scale * curved / length_;
  }

  void solve(double ks) const {
    integrate([ks](double x) { return 1.0 - std::cosh(ks * (x - 0.5)) / std::cosh(0.5 * ks); },
              [ks](double x) { return ks * std::sinh(ks * (x - 0.5)) / std::cosh(0.5 * ks); });
  }

  double modulus_, thickness_, gap_, stress_, length_;
  mutable double strain_ = 0.0;
  mutable double bending_ = 0.0;
};

double slopeOfArmEnergy(double stress, bool is_stretched, double length) {
  const double step = 1e-4 * length;
  const auto energyAt = [&](double s) {
    const ArmEnergy energy(169e9, 2 * kUm, 3 * kUm, stress, s);
    return is_stretched ? energy.stretched() : energy.bent();
  };
  return (energyAt(length - step) - energyAt(length + step)) / (2.0 * step);
}

/// What scanWarnings() says heights of this offset are spaced by.
double spacingSaid(double offset) {
  const double amplitude = 1e-7 * offset;
  const HeightMap scan = analytic::sum(analytic::sine(32, 48, 1e-6, 1e-6, amplitude, 3, 2),
                                       analytic::flat(32, 48, 1e-6, 1e-6, offset));
  const std::string key = "are spaced by ";
  for (const std::string& line : scanWarnings(analytic::asSingle(scan))) {
    const std::size_t at = line.find(key);
    if (at != std::string::npos) return std::stod(line.substr(at + key.size()));
  }
  return std::nan("");
}

}  // namespace

Section capillarySection() {
  const WaterLaw dry_air = humid(0.3, 0.0).law(), slanted = humid(0.8, 1.2).law();
  Section section{"Condensed water", {}};
  section.rows = {
      near("Kelvin radius times ln(1/RH)", "m", "water at room temperature: 0.52 to 0.54 nm",
           dry_air.kelvinRadius() * std::log(1.0 / 0.3), 0.53e-9, 0.01 / 0.53,
           "the published range"),
      exact("pressure at 30 % humidity", "Pa", "Laplace: gamma/r_K, r_K = gamma V/(R T ln(1/RH))",
            dry_air.pressure(), 8.31446261815324 * 298.15 * std::log(1.0 / 0.3) / 18.07e-6),
      exact("energy of separation, wetting", "J/m^2", "2 gamma",
            dry_air.pressure() * dry_air.gapLimit(), 144e-3),
      exact("energy of separation, contact angle 1.2", "J/m^2", "2 gamma cos(theta)",
            slanted.pressure() * slanted.gapLimit(), 144e-3 * std::cos(1.2)),
  };
  std::vector<Row> rows = {limit("pull of water on a sphere of 2 um, 70 %", "N", "4 pi gamma R",
                                 4.0 * closed_form::kPi * 0.072 * 2e-6, 2e-3,
                                 "two rims of 240 pixels, known to a quarter of one",
                                 {1.2, "rims of pixels: between first and second order"})};
  rows = onGrids(rows, {"columns", {60, 120, 240, 480}},
                 [](double cols, const Phase& phase) -> std::vector<double> {
                   Options options = paperOptions();
                   options.interface.hamaker_constant = 0.0;
                   options.capillary = humid(0.7, 0.0);
                   const double pitch = 450e-9 / cols;
                   const auto count = static_cast<int>(cols);
                   return {AdhesionModel(options)
                               .predict(analytic::paraboloid(count, count, pitch, pitch, 2e-6,
                                                             phase.x * pitch, phase.y * pitch))
                               .capillary_force};
                 });
  section.rows.insert(section.rows.end(), rows.begin(), rows.end());
  return section;
}

Section devicesSection() {
  const char* kBeams = "de Boer and Michalske 1999";
  const char* kDigits = "the published digits are all that there are";
  const Beam published_beam{BeamType::kCantilever, 500 * kUm, 2 * kUm, 2 * kUm, 169e9, 0.0};
  Beam cantilever = published_beam;
  cantilever.length = 300 * kUm;
  cantilever.gap = 3 * kUm;
  Beam clamped = cantilever;
  clamped.type = BeamType::kDoublyClamped;
  clamped.residual_stress = 50e6;
  const double stiffness = 169e9 * std::pow(2 * kUm, 3) * std::pow(3 * kUm, 2);
  Section section{"Devices", {}};
  section.rows = {
      near("work of a cantilever stuck in S-shape, 500 um", "J/m^2", kBeams,
           sShapeWork(published_beam, 500 * kUm), 129.792e-6, 1e-8, kDigits),
      near("work of one that touches with its tip, 500 um", "J/m^2", kBeams,
           arcWork(published_beam, 500 * kUm), 32.448e-6, 1e-8, kDigits),
      near("work of the S-shape, 170 um", "J/m^2", "slope of the energy of bending, by quadrature",
           sShapeWork(cantilever, 170 * kUm), slopeOfArmEnergy(0.0, false, 170 * kUm), 1e-6,
           "central difference, a step of 1e-4"),
      near("work of a stretched arm, 50 MPa, 170 um", "J/m^2",
           "slope of the energy of bending and stretching", sShapeWork(clamped, 170 * kUm),
           slopeOfArmEnergy(50e6, true, 170 * kUm), 1e-6, "central difference, a step of 1e-4"),
      exact("peel number of a cantilever, 0.1 mJ/m^2", "",
            "3 E t^3 h^2/(8 w l^4), Mastrangelo and Hsu 1993", peelNumber(cantilever, 1e-4),
            3.0 * stiffness / (8.0 * 1e-4 * std::pow(300 * kUm, 4))),
      exact("longest cantilever that comes off", "m", "peel number 1",
            detachmentLength(cantilever, 1e-4), std::pow(3.0 * stiffness / (8.0 * 1e-4), 0.25)),
      near("peel number of a doubly clamped beam, 1 mJ/m^2", "",
           "slope of the energy of one arm of half the length", peelNumber(clamped, 1e-3),
           slopeOfArmEnergy(50e6, true, 150 * kUm) / 1e-3, 1e-6,
           "central difference, a step of 1e-4"),
      exact("arm of a stuck cantilever, 0.1 mJ/m^2", "m", "(3 E t^3 h^2/(2 w))^(1/4)",
            unstuckLength(cantilever, 1e-4), std::pow(1.5 * stiffness / 1e-4, 0.25)),
  };
  // travel of a quarter of the gap: the plate lands before it gives way
  DeviceOptions device;
  device.spring_stiffness = 1.0;
  device.travel = 0.5 * kUm;
  device.electrode_gap = 2 * kUm;
  device.electrode_area = 1e-8;
  section.rows.push_back(exact("closing voltage of a travel of a quarter of the gap", "V",
                               "k x = eps0 A U^2/(2 (g - x)^2)",
                               closingVoltage(device, InterfaceOptions()),
                               std::sqrt(2.0 * 0.5 * kUm * std::pow(1.5 * kUm, 2) /
                                         (closed_form::kVacuumPermittivity * 1e-8))));
  return section;
}

Section inputDigitsSection() {
  Section section{"Digits of float32 heights", {}};
  const struct {
    const char* name;
    double offset;
    const char* printed;
  } spacings[] = {{"spacing near 10 mm", 10e-3, "0.93e-9"},
                  {"spacing near 1 mm", 1e-3, "0.116e-9"},
                  {"spacing near 0.1 mm", 0.1e-3, "7.3e-12"},
                  {"spacing near 1 um", 1e-6, "0.11e-12"}};
  for (const auto& spacing : spacings) {
    section.rows.push_back(published(spacing.name, "m", "IEEE 754, 24 bits",
                                     spacingSaid(spacing.offset), spacing.printed));
  }
  return section;
}

}  // namespace verification
}  // namespace mems_stiction
