#pragma once

/// @file
/// The device that must come off again: what its designer knows of spring, contact and beam. 0
/// means "not stated".
///
///     DeviceOptions device;
///     device.spring_stiffness = 10.0;  // [N/m]
///     device.travel = 1e-6;            // [m]
///     device.contact_area = 1e-10;     // [m^2], of four dimples
///     device.contacts = 4;

#include <string>
#include <vector>

#include "mems_stiction/loads/interface.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "mems_stiction/verdict/beam_adhesion.hpp"

namespace mems_stiction {

/// Spring, contact area, electrodes and beam; keys device/...
struct DeviceOptions {
  double spring_stiffness = 0.0;  ///< k of the suspension along z [N/m], >= 0
  double travel = 0.0;            ///< from rest to contact [m], >= 0
  double contact_area = 0.0;  ///< nominal area of dimples or landing pads, all together [m^2], >= 0
  int contacts = 1;           ///< separate ones that share the contact area, >= 1
  double electrode_area = 0.0;  ///< that the voltage acts on [m^2], >= 0
  double electrode_gap = 0.0;   ///< at rest [m], >= 0; 0 = the travel, of a beam its gap

  BeamType beam_type = BeamType::kNone;
  double beam_length = 0.0;           ///< [m], >= 0
  double beam_width = 0.0;            ///< [m], >= 0; 0 = not stated
  double beam_thickness = 0.0;        ///< [m], >= 0
  double beam_gap = 0.0;              ///< height of the beam above the substrate [m], >= 0
  double beam_modulus = 0.0;          ///< Young's modulus of the beam [Pa], >= 0
  double beam_residual_stress = 0.0;  ///< tensile positive; of doubly clamped beams [Pa]
  double electrode_start = 0.0;  ///< of the electrode below a beam, from the (left) clamp [m], >= 0
  double electrode_length = 0.0;  ///< of it along the beam [m], >= 0; 0 = not stated

  /// Of the rough interface, measured on beams [J/m^2], >= 0; 0 = from the contacts of the
  /// prediction.
  double apparent_work_of_adhesion = 0.0;

  bool hasSpring() const { return spring_stiffness > 0.0 && travel > 0.0; }
  bool hasBeam() const { return beam_type != BeamType::kNone; }
  /// A beam alone, whose contact is known in newtons, too.
  bool hasBeamContact() const {
    return hasBeam() && !hasSpring() && beam_width > 0.0 && contact_area > 0.0;
  }
  bool isStated() const {
    return hasBeam() || spring_stiffness > 0.0 || travel > 0.0 || contact_area > 0.0;
  }

  /// What pulls the closed device open [N]: k times travel, or of a beam alone its force
  /// (beam_adhesion.hpp).
  double restoringForce() const {
    return hasBeamContact() ? beamForce(beam()) : spring_stiffness * travel;
  }
  Beam beam() const;
  /// The beam alone, where spring and beam are both stated.
  DeviceOptions withoutSpring() const;
  /// How far the contact reaches along the beam [m]: over the whole width, or, where that is less,
  /// a square.
  double beamContactLength() const;

  void describe(OptionVisitor& visitor);
  /// One line per violated constraint; empty when all is well. A beam must be stated as a whole.
  std::vector<std::string> validate() const;
};

/// Voltage at which the electrodes close [V]: pull-in, or, when the travel ends before that (a
/// third of the electrical gap), the voltage that holds the spring at the end of its travel. Of a
/// beam alone by beam_electrode.hpp. NaN when spring, travel or electrode area are not stated, or
/// the beam's width and its electrode; the field has no fringes.
double closingVoltage(const DeviceOptions& device, const InterfaceOptions& interface);
/// The settings that it lacks: "device/travel", "device/travel and device/electrode_area", ...;
/// empty when it is known.
std::string whatPullInLacks(const DeviceOptions& device);
/// The same for a margin; empty where none of what it needs is stated.
std::string whatSpringLacks(const DeviceOptions& device);

}  // namespace mems_stiction
