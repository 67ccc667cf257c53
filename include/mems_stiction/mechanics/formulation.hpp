#pragma once

/// @file
/// Which reading of the paper's equations a contact is computed with.

namespace mems_stiction {

/// Which reading of the paper's equations (6), (9), (10), (12) and (13) is used; doc/theory.md has the table.
enum class Formulation { kCorrected, kPrinted };

/// Whether hardness plays a part. kElastic keeps every asperity in the elastic regime (chi = 1), as the theories that
/// the paper compares with do.
enum class Deformation { kThreeRegimes, kElastic };

}  // namespace mems_stiction
