#pragma once

/// @file
/// Does a contact of the device have the size of the scan, so that the scan's force may be scaled to it?
///
///     ratio = (device/contact_area/device/contacts)/scanned area
///
/// The verdict takes the scan's force times device/contact_area over the scanned area. That is right for as many
/// separate contacts as lie in that ratio, each of the scan's size. One larger contact rests on higher summits, so its
/// surfaces stand further apart and a handful of places hold it whatever its area; a smaller one has lower summits.
/// Large generated surfaces (4096 x 4096 pixels of 10 nm, self-affine and Gaussian) against parts of them, scaled by
/// area: parts of a quarter of the area come out 1.6 to 2.5 times too strong, of a 16th 2.6 to 10 times, of a 64th 8 to
/// 41 times (medians of 12 places). So a ratio of 1/2 to 2 is let pass, and beyond it the verdict makes no statement.

#include <string>

#include "mems_stiction/prediction/prediction.hpp"
#include "mems_stiction/verdict/device_options.hpp"

namespace mems_stiction {

/// Larger and smaller ratios are doubted [-].
constexpr double kTrustedAreaRatio = 2.0;

/// What is wrong with the sizes, and what to do, without commas; empty if they agree, or the device states no area.
std::string contactSizeObjection(const Prediction& prediction, const DeviceOptions& device);

}  // namespace mems_stiction
