#pragma once

/// @file
/// The total normal load on the contacts, as a sum with named parts (section 2.1 of the paper):
///
///     F = F_w + F_e + F_m + F_c          van der Waals, field, mechanical, condensed water (capillary.hpp)

namespace mems_stiction {

/// The normal load and its parts [N].
struct NormalLoad {
  double van_der_waals = 0.0;  ///< F_w [N]
  double electrostatic = 0.0;  ///< F_e [N]
  double mechanical = 0.0;     ///< F_m [N]
  double capillary = 0.0;      ///< F_c, of condensed water; 0 unless interface/relative_humidity is set [N]

  double total() const { return van_der_waals + electrostatic + mechanical + capillary; }
};

}  // namespace mems_stiction
