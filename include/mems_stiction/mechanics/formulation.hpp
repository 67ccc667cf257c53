#pragma once

/// @file
/// Which reading of the paper's equations a contact is computed with.

namespace mems_stiction {

/// Which reading of the paper's equations (6), (9), (12) and (13) is used: what the authors compute, with the roots and
/// exponents that the print lost, or the print to the letter. doc/theory.md has the table.
enum class Formulation { kPaper, kPrinted };

/// Whether hardness plays a part. kElastic keeps every asperity in the elastic regime (chi = 1), as the theories that
/// the paper compares with do.
enum class Deformation { kThreeRegimes, kElastic };

}  // namespace mems_stiction
