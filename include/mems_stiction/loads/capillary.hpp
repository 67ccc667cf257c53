#pragma once

/// @file
/// Water between the surfaces (WaterLaw) as a term of its own. Off by default: the interfacial
/// energy of the model may already hold the water. With this term on, interface/work_of_adhesion
/// must be the dry one, or water counts twice.
///
///     Options options;
///     options.capillary.relative_humidity = 0.4;

#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

class GapOrder;
class WaterLaw;

/// Defaults other than the humidity: water at 25 degrees Celsius (CRC Handbook: 72.0 mN/m, 997.0
/// kg/m^3, 18.015 g/mol) that wets the surfaces.
struct CapillaryOptions {
  double relative_humidity = 0.0;   ///< RH [-], in [0, 1); 0 switches the term off
  double surface_tension = 0.0720;  ///< gamma of liquid against vapour [N/m], > 0
  double contact_angle = 0.0;       ///< theta [rad], in [0, pi/2]
  double temperature = 298.15;      ///< T [K], > 0
  double molar_volume = 18.07e-6;   ///< V_m of the liquid [m^3/mol], > 0
  double water_film = 0.0;          ///< t_w that is adsorbed on each face [m], >= 0

  WaterLaw law() const;

  /// Keys interface/...
  void describe(OptionVisitor& visitor);
};

/// F_c [N] when the first `contact_count` ordered cells touch and the others are apart by gap -
/// approach.
double capillaryForce(const GapOrder& order, double approach, int contact_count,
                      const WaterLaw& water, double cell_area);

}  // namespace mems_stiction
