#pragma once

/// @file
/// Which reading of the paper's equations a contact is computed with.

namespace mems_stiction {

/// Which reading of the paper's equations (6), (9), (12) and (13) is used: what the authors
/// compute, with the roots and exponents that the print lost, or the print to the letter.
/// doc/theory.md has the table.
enum class Formulation { kPaper, kPrinted };

}  // namespace mems_stiction
