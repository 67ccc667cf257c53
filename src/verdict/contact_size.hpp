#pragma once

/// @file
/// Has a contact of the device the size of the scan, so that the scan's own force may be taken for
/// it?
///
///     ratio = (device/contact_area/device/contacts)/scanned area
///
/// Forces do not go with area. A larger contact rests on higher summits, so its surfaces stand
/// further apart and a handful of places hold it whatever its area; a smaller one has lower
/// summits. Large generated surfaces (4096 x 4096 pixels of 10 nm, self-affine and Gaussian)
/// against parts of them, scaled by area: parts of a quarter of the area come out 1.6 to 2.5 times
/// too strong, of a 16th 2.6 to 10 times, of a 64th 8 to 41 times (medians of 12 places). So where
/// nobody has found the force of such an area (device_force.hpp), the scan's stands for contacts of
/// half to twice its area alone.

#include <string>

#include "mems_stiction/prediction/prediction.hpp"
#include "mems_stiction/verdict/device_options.hpp"

namespace mems_stiction {

/// Larger and smaller ratios are doubted [-].
constexpr double kTrustedAreaRatio = 2.0;

/// Whether each contact has the scan's size; so it is taken where the device states no area.
bool hasSizeOfScan(const Prediction& prediction, const DeviceOptions& device);

/// Why the device cannot be judged by the scan's force.
/// - @p why the device's own force is missing, and what to do; empty: nobody asked for it
std::string whatSizeLacks(const Prediction& prediction, const DeviceOptions& device,
                          const std::string& why);

}  // namespace mems_stiction
