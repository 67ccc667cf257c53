#pragma once

/// @file
/// How the figures of the paper's formulations move with the constants, to first order: the
/// contacts are not searched again.
///
/// With factors w of the work of adhesion, h of the hardness, e of the modulus, x of the pitch, c
/// of the cut-off, a of the Hamaker constant, the contacts of the solution are moved:
///
///     R_i -> x^2 R_i     P1_i -> e x P1_i     yield load Y_i = Ha pi rc_i^2 -> h x^2 Y_i
///     phi_i -> (e/h) phi_i/x, and with it the elastic share chi_i
///     carried load  C = sum [chi_i P1_i + (1 - chi_i) min(P1_i, Y_i)]
///     demand        B = F_m + F_e + F_w + F_c + 2 pi Gamma sum R_i
///     growth        n = (B'/C')/(B/C), with F_w' and F_c' in B' for n = 1
///     F_w -> x^2 a (n c^-2 near + far),
///             far = H A/(6 pi (mean gap)^3), which the cut-off does not touch
///     F_c -> x^2 n F_c
///     F_V -> x^2 v^2 F_V, with a factor v of the contact potential, on the way out alone
///     pull-off per nominal area -> P'/(x^2 A0),
///             P' = n (3/2) pi (w Gamma) sum x^2 R_i + F_w' + F_c' + F_V'
///
/// The growth says that a surface that must carry more, or carries less per contact, brings
/// proportionally more contacts of the same kind into play (Archard; Greenwood and Williamson's
/// exponential summits). Left out: the feedback of new contacts on the demand (it makes sticky
/// surfaces near bonding more sensitive than said here), the change of the shares of large and
/// small contacts, and steps of the contact count when there are few. F_w ~ c^-2 is the edge of a
/// contact, a gap that grows evenly from 0. Condensed water goes with the contacts that it
/// surrounds. Judged by searching again with each constant changed (tested): on Gaussian surfaces
/// with 30 elastic contacts and more, the powers with which the pull-off force goes with the
/// constants agree within 0.3. The field of another contact potential is left out of B': with it
/// the power was 1.8 times that of the search, in the median of 30 surfaces at 0.3 to 2 V, without
/// it 1.0 times. Contacts that flow resist less than the load that they carry
/// (asperity_response.hpp): there the search moves by several times more, with powers of 4 of pitch
/// and cut-off. With a few contacts the search goes in steps, and this is the smooth mean at best.
/// A single contact that carries more than it must does not react at all: this is then wider than
/// what the search would say.

#include "mems_stiction/contact/contact_solution.hpp"

namespace mems_stiction {

/// Needs the list of all contacts.
std::unique_ptr<ContactResponse> contactGrowth(const SolvedContact& contact);

}  // namespace mems_stiction
