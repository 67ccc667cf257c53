#pragma once

/// @file
/// What does it cost to press the gap between two surfaces flat, all of it?
///
///     U/A = (E/4) sum |q| |h_q|^2 = (E/4) integral from 0 to infinity of S(r)/(2 r^2) dr
///     S(r) = mean of (h(x + r) - h(x))^2
///
/// the elastic energy of two bodies whose composite surface h takes the other's shape (Persson, Tosatti, J. Chem. Phys.
/// 115 (2001) 5597, eq. 3; the second form is its Fourier transform for a surface without direction, and the mean over
/// rows and columns stands for others). S is measured at distances that grow by a quarter, along some of the rows and
/// columns; beyond a quarter of the frame it is taken as constant. Surfaces that give less than Gamma can lie against
/// each other everywhere.

#include "mems_stiction/approach/gap_field.hpp"

namespace mems_stiction {

/// U/A [J/m^2].
/// - @p contact_modulus E [Pa], > 0
double flatteningEnergy(const GapField& field, double contact_modulus);

}  // namespace mems_stiction
