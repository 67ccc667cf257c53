#pragma once

/// @file
/// How hard does water that condenses between the surfaces pull them together?
///
///     r_K = gamma V_m/(R T ln(1/RH))          Kelvin radius of the meniscus, hollow in one direction
///     d_K = 2 r_K cos(theta)                  Kelvin gap: water fills what is narrower
///     p   = gamma/r_K                         Laplace pressure in the water
///     F_c = p dA per cell apart by less than d_K, 0 beyond
///
/// p falls and d_K grows with humidity, p d_K = 2 gamma cos(theta) does not change: the energy that separation costs
/// per area of filled gap. A sphere on a flat gives F_c = 4 pi gamma R cos(theta), at every humidity. Assumptions:
/// equilibrium with the vapour, one contact angle on both surfaces, the gap varies slowly over d_K. Menisci take
/// milliseconds to hours to form: a fast contact feels less. Below some 10 % humidity d_K is a molecule or two and a
/// continuum's pressure an extrapolation; near saturation d_K diverges, so the humidity stays below 1. Off by default:
/// the interfacial energy of the model may already hold the water. With this term on, interface/work_of_adhesion must
/// be the dry one, or water counts twice. Sources: Israelachvili, Intermolecular and Surface Forces (3rd ed., 2011),
/// chapter 17; Fisher, Gamble and Middlehurst, Nature 290 (1981) 575, for how far the Kelvin equation holds for
/// water.
///
///     const CapillaryForce water(options);
///     const double pull = capillaryForce(order, approach, contact_count, water, field.cellArea());

#include "mems_stiction/base/option_visitor.hpp"

namespace mems_stiction {

class GapOrder;

/// Defaults other than the humidity: water at 25 degrees Celsius (CRC Handbook: 72.0 mN/m, 997.0 kg/m^3, 18.015 g/mol)
/// that wets the surfaces.
struct CapillaryOptions {
  double relative_humidity = 0.0;   ///< RH [-], in [0, 1); 0 switches the term off
  double surface_tension = 0.0720;  ///< gamma of liquid against vapour [N/m], > 0
  double contact_angle = 0.0;       ///< theta [rad], in [0, pi/2]
  double temperature = 298.15;      ///< T [K], > 0
  double molar_volume = 18.07e-6;   ///< V_m of the liquid [m^3/mol], > 0

  /// Keys interface/...
  void describe(OptionVisitor& visitor);
};

/// The pull of the condensed liquid on one cell.
class CapillaryForce {
 public:
  CapillaryForce() = default;  ///< switched off
  explicit CapillaryForce(const CapillaryOptions& options);

  bool isOn() const { return gap_limit_ > 0.0; }
  double kelvinRadius() const { return kelvin_radius_; }  ///< r_K [m]; 0 when switched off
  double gapLimit() const { return gap_limit_; }          ///< d_K [m]; 0 when switched off
  double pressure() const { return pressure_; }           ///< p [Pa]; 0 when switched off

  /// Of a filled cell [N]. @param cell_area [m^2]
  double forcePerCell(double cell_area) const { return pressure_ * cell_area; }

 private:
  double kelvin_radius_ = 0.0;
  double gap_limit_ = 0.0;
  double pressure_ = 0.0;
};

/// F_c [N] when the first `contact_count` ordered cells touch and the others are apart by gap - approach.
double capillaryForce(const GapOrder& order, double approach, int contact_count, const CapillaryForce& force,
                      double cell_area);

}  // namespace mems_stiction
