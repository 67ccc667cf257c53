#pragma once

/// @file
/// The force that a formulation has followed, over the same height as that of the half-space, so
/// that both can be laid over each other.

#include <vector>

#include "contact/curve_point.hpp"
#include "mems_stiction/contact/contact_settings.hpp"
#include "mems_stiction/prediction/prediction.hpp"

namespace mems_stiction {

/// Both ways: to rest and apart again. The height is z0 - displacement: surfaces that touch without
/// force are z0 apart, and the half-space counts from where they would meet. Where nothing flows
/// and nothing conforms, the unloading branch is the loading branch, backwards. Empty if the
/// formulation does not follow the force.
/// - @p settings that the prediction was made with
std::vector<CurvePoint> curveOf(const Prediction& prediction, const ContactSettings& settings);

}  // namespace mems_stiction
