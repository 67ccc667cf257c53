#pragma once

/// @file
/// How many cells of a patch of overlap touch: (S13) of doc/separation_curve.md.
///
///     const double area = realCells(at_rest) * cell_area;

#include "separation/patch_forces.hpp"

namespace mems_stiction {

/// A patch where the surfaces rest.
struct PatchAtRest {
  PatchLoad load;
  double cells = 1.0;      ///< that overlap, one or more
  double rim_force = 0.0;  ///< DMT's 2 pi Gamma R [N]; infinite of a plateau without depth
  double prefactor = 2.0;  ///< c of (S8), from DMT (2) to JKR (1.5) [-]
  double capacity = 0.0;   ///< what flow lets it carry at most, Ha A; infinite if nothing flows [N]
};

/// Share of its overlap on which an elastic top touches without adhesion [-]: Sneddon's, a half of
/// a paraboloid, all of a punch.
/// - @p flatness 1 - m, A ~ delta^m, from 0 to 1
double touchingShare(double flatness);

/// Share of a random surface that touches under a pressure [-]: erf(sqrt(pi) p/(E h')), Persson's
/// law with the slope that solved surfaces have while little touches, 2 p/(E h') (Prodanov, Dapp,
/// Mueser, Tribol. Lett. 53 (2014) 433).
/// - @p pressure p on the whole [Pa], @p contact_modulus E [Pa], @p rms_slope h' [-]; all of a
/// surface without slope touches
double touchingShare(double pressure, double contact_modulus, double rms_slope);

/// Cells that repel each other, one at least: a half-space knows no smaller contact.
double realCells(const PatchAtRest& patch);

}  // namespace mems_stiction
