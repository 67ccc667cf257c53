#pragma once

/// Curves of force over height in files, whichever model they are of.

#include <string>
#include <vector>

#include "contact/curve_point.hpp"
#include "mems_stiction/configuration/provenance.hpp"

namespace mems_stiction {

/// CSV that plot_curve reads: a line of names, then height [m], force [N] and direction of each
/// point, and where the curve comes from.
/// @throw FileError if it cannot be written
void writeCurve(const std::string& path, const std::vector<CurvePoint>& curve,
                const Provenance& provenance);

}  // namespace mems_stiction
