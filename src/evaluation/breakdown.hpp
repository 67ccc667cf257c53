#pragma once

/// @file
/// Do voltage and contact potential lie over more than insulator and gap can stand?
///
///     closed  E_i = U/t                     in the insulator where the surfaces touch
///             E_g = U/(mean gap + t/eps_r)  in the gap beside the contacts
///     open    E_e = U/(d_e + t/eps_r)     between the electrodes of the device, at rest and closed
///
/// U is the size of both together (LoadOptions::fieldVoltage()). These are the fields of the
/// electrostatic pressure (surface_forces.hpp), so the forces go with their squares. A warning
/// comes above
///
///     1 GV/m     in the insulator: what thermal SiO2 stands, the best of the usual ones (8 to 11
///                MV/cm; films of a few nanometres up to 1.5 GV/m). Deposited oxides and nitrides,
///                polymers and monolayers stand less.
///     3 GV/m     in a gap below half a micrometre: clean metals emit electrons from 3 to 7 GV/m on
///                (Fowler and Nordheim 1928)
///     0.11 GV/m  in a wider gap: between metals at 0.5 to 4 um, where Paschen's law has ended, it
///                breaks down at 65 to 110 MV/m in air (Dhariwal, Torres and Desmulliez, IEE Proc.
///                Sci. Meas. Technol. 147 (2000) 261)
///
/// No warning does not mean that the device stands it: rims, charges and repeated voltages lower
/// all three. The figures are recalled, standard values; of Dhariwal et al. the abstract was read.

#include <string>
#include <vector>

#include "mems_stiction/prediction/options.hpp"
#include "mems_stiction/verdict/device_options.hpp"

namespace mems_stiction {

/// "load/voltage 20 V and load/contact_potential 0.3 V": what of them is on.
std::string fieldSources(const LoadOptions& load);

/// One sentence for each field that nothing stands, without commas; none without a
/// voltage or contact potential.
/// - @p mean_gap of the surfaces out of contact [m]; NaN if it is not known
std::vector<std::string> breakdownWarnings(const Options& options, const DeviceOptions& device,
                                           double mean_gap);

}  // namespace mems_stiction
