#pragma once

/// @file
/// What do the electrodes of a device do when a contact potential lies between them, too?
///
/// Contact potential and trapped charge V_c have a sign of their own; they count as if they had
/// that of the voltage (LoadOptions). So the electrodes see |V| + |V_c| while the voltage is on:
///
///     voltage at which they close        V = max(0, V_close - |V_c|)
///     what V adds to what holds          F_e(|V| + |V_c|) - F_e(V_c)
///     what stays when V has gone         F_e(V_c)
///
/// V_close without a contact potential: device_options.hpp. F_e of a spring's plate is A_e times
/// the pressure of parallel plates (surface_forces.hpp) over the gap that is left when the device
/// is closed and the mean gap of the surfaces; of a beam that of beam_field.hpp. Where no gap is
/// left the plate lands on its electrode: there the field of the contact area is in the force of
/// the surfaces, and the rest of the electrode alone counts here.
///
///     const FieldHold hold = lastingHold(device, interface, contact_potential, mean_gap);

#include <optional>

#include "verdict/beam_field.hpp"

namespace mems_stiction {

/// closingVoltage() of electrodes with a contact potential of either sign [V]; 0: it closes them by
/// itself.
double closingVoltage(const DeviceOptions& device, const InterfaceOptions& interface,
                      double contact_potential);

/// What the voltage adds to what holds the closed device, by all of the electrode; nothing where no
/// electrode is stated.
/// - @p contact_gap mean gap of the surfaces where they do not touch [m], >= 0
std::optional<FieldHold> voltageHold(const DeviceOptions& device, const InterfaceOptions& interface,
                                     const LoadOptions& load, double contact_gap);

/// What of the electrodes' field holds the closed device when the voltage has gone. Nothing where
/// no electrode is stated.
/// - @p contact_gap as of voltageHold(); NaN of surfaces that touch everywhere
FieldHold lastingHold(const DeviceOptions& device, const InterfaceOptions& interface,
                      double contact_potential, double contact_gap);

/// Lengths of a beam that adhesion and the field together hold.
struct BeamLengths {
  double detachment = 0.0;  ///< longest beam that comes off by itself [m]
  double unstuck = 0.0;     ///< free arm of the beam while it is stuck [m]
};

/// detachmentLength() and unstuckLength() with the work of the field that stays. A longer or
/// shorter beam has an electrode of the same proportions.
/// - @p work of adhesion, >= 0 [J/m^2]; NaN gives NaN
BeamLengths stuckLengths(const DeviceOptions& device, const InterfaceOptions& interface,
                         double contact_potential, double contact_gap, double work);

}  // namespace mems_stiction
