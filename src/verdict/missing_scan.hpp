#pragma once

/// @file
/// Does a scan show what holds at the pull-off, and which scan would?
///
/// Waves that are shorter than two pixels, or drawn by the tip, keep the surfaces apart all the
/// same. Adhesion bridges them while their rms height h stays below
///
///     b = max(z0, d_K, sqrt(Gamma/(E' q)))        q = 2 pi/l, l the shortest wave that is shown
///
/// z0 is the range of the attraction, d_K the gap that condensed water fills, and at the third,
/// flattening a wave of the wave number q costs a quarter of the work of adhesion: a half-space
/// stores E' q h^2/4 per area. h is continued from the waves that are shown (unresolved_waves.hpp).
/// On 24 surfaces whose short waves are known, forces by coarse pixels were too large by 1.03 in
/// the median where h was below b/4, by 1.3 up to b, by 2.4 up to 2 b, 5.9 up to 4 b, and 37 above
/// (doc/validity.md). So where h exceeds b the force is not known, neither is the verdict. A scan
/// of smaller pixels p' is needed, of which h (p'/p)^H is below b.
///
/// Assumptions: isotropic roughness that goes on beyond the pixels as it falls towards them; the
/// scan's noise is below what it shows there. Noise makes h too large, an instrument that blurs
/// (white light) makes it too small.
///
///     prediction.short_waves = shortWaves(unresolvedWaves(scan, {}, tip_limit), options);
///     if (prediction.short_waves.areUnresolved()) say(whatIsMissing(prediction.short_waves,
///         "the scan does not show"));

#include <string>

#include "mems_stiction/prediction/options.hpp"
#include "mems_stiction/prediction/prediction.hpp"
#include "mems_stiction/roughness/unresolved_waves.hpp"

namespace mems_stiction {

ShortWaves shortWaves(const UnresolvedWaves& waves, const Options& options);

inline constexpr char kTheScan[] = "the scan does not show";
inline constexpr char kNoScan[] = "no scan shows";

/// "the scan does not show what holds: waves shorter than two pixels of 197 nm have an rms height
/// of 0.76 nm, ...; missing is AFM, 2 um to 10 um wide, pixels of 20 nm or less"; empty if they are
/// resolved. No scan is named where the pixels are as small as those of any tip.
/// - @p who begins the sentence
std::string whatIsMissing(const ShortWaves& found, const std::string& who);

}  // namespace mems_stiction
