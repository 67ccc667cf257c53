#pragma once

/// @file
/// How two surfaces part: by contacts that let go one by one (contact_curve.hpp), or as a whole
/// where they are bonded (conforming_contact.hpp). doc/separation_curve.md, "Which way the surfaces
/// part".

#include <vector>

#include "mems_stiction/contact/contact_solution.hpp"

namespace mems_stiction {

/// One unloading branch, from rest to apart: whole when it is made, and never changed.
struct Unloading {
  double force = 0.0;  ///< largest [N]
  double work = 0.0;   ///< per area [J/m^2]
  double lost =
      0.0;  ///< of the work: what jumps lose of the energy of the state at rest, per area [J/m^2]
  double contact_area = 0.0;  ///< at rest [m^2]
  Exponents force_exponents;
  Exponents work_exponents;
  const char* doubt =
      nullptr;  ///< why the force may be out by more than 1.3 (ModelStatement::doubt)
  std::vector<SeparationCurvePoint>
      curve;  ///< by descending displacement; empty where it is the loading branch
};

}  // namespace mems_stiction
