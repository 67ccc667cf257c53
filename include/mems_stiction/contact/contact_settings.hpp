#pragma once

/// @file
/// What a contact of two surfaces depends on beside the surfaces.
///
///     ContactSettings settings;
///     settings.upper.youngs_modulus = 70e9;     // [Pa]
///     settings.interface.work_of_adhesion = 0.1;  // [J/m^2]
///     settings.output.asperities = false;

#include <any>
#include <vector>

#include "mems_stiction/loads/capillary.hpp"
#include "mems_stiction/loads/interface.hpp"
#include "mems_stiction/mechanics/material.hpp"
#include "mems_stiction/mechanics/plasticity.hpp"
#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

enum class Connectivity { kFour, kEight };

/// Settings of the approach; keys approach/...
struct ApproachOptions {
  int max_steps = 100000;             ///< the search range ends after so many steps
  double max_contact_fraction = 0.5;  ///< beyond it the surfaces count as bonded, in (0, 1]
  Connectivity connectivity = Connectivity::kFour;

  void describe(OptionVisitor& visitor);
};

/// What predict() returns beside the figures; each costs time.
struct OutputOptions {
  bool deformed_surfaces = true;  ///< both surfaces after contact
  bool contact_map = true;        ///< 0 apart, 1 elastic, 2 elasto-plastic, 3 fully plastic
  bool asperities = true;         ///< one record per contact
  bool roughness = true;          ///< ISO 25178 figures of the lower surface
  bool energy_curve = false;      ///< one record per step of the approach

  void describe(OptionVisitor& visitor);
};

/// Settings that single solvers ask for beside those of all: a struct of each such solver, by its
/// type.
class SolverSettings {
 public:
  /// As set, or as by default.
  template <typename Own>
  const Own& of() const {
    static const Own as_by_default;
    for (const std::any& one : all_) {
      if (const auto* const own = std::any_cast<Own>(&one)) return *own;
    }
    return as_by_default;
  }
  /// To be changed.
  template <typename Own>
  Own& of() {
    for (std::any& one : all_) {
      if (auto* const own = std::any_cast<Own>(&one)) return *own;
    }
    return all_.emplace_back().emplace<Own>();
  }

 private:
  std::vector<std::any> all_;
};

/// How the part is led while it touches.
enum class Guidance {
  kGuided,  ///< it stays as the frame shows it
  kFree,    ///< it tilts until it rests on three contacts around its middle
};

/// What every solver is given. A solver leaves alone what has no meaning for it.
struct ContactSettings {
  Material lower;
  Material upper;
  InterfaceOptions interface;
  CapillaryOptions capillary;
  LoadOptions load;
  ApproachOptions approach;
  Deformation deformation = Deformation::kThreeRegimes;
  Guidance guidance = Guidance::kGuided;
  SolverSettings solver;
  OutputOptions output;

  /// Gamma and the energy of condensed water, which flat surfaces gain in full contact [J/m^2].
  double gainedWork() const;
};

}  // namespace mems_stiction
