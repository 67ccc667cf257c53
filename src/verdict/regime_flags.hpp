#pragma once

/// @file
/// Where does a prediction leave the range of the model that made it? Flags speak of the contacts
/// that hold at the pull-off: a load that presses more of them together at rest changes no flag.

#include <cstdint>
#include <string>
#include <vector>

#include "mems_stiction/prediction/prediction.hpp"

namespace mems_stiction {

/// Bits of a set of flags; the values are those of the message.
enum RegimeFlag : std::uint32_t {
  kBondedFlag = 1,  ///< bonded, also without the loads; paper, printed: the force is a lower bound
  kNoEquilibriumFlag = 2,  ///< the search ended first: the figures are those of its last step
  kTaborFlag =
      4,  ///< JKR's pull-off is too low: the median Tabor parameter asks for the transition or DMT
  kPlasticityFlag =
      8,  ///< more than half of the adhesion is of contacts that flow: their radii have changed
  kResolutionFlag = 16,   ///< more than half of the adhesion is of contacts of few pixels: a finer
                          ///< pitch may change it
  kFewContactsFlag = 32,  ///< so few contacts that another place of the surface may differ much
  kNearBondingFlag =
      64,               ///< the pull-off force may be out by more than 1.3 (ModelStatement::doubt)
  kBorderFlag = 128,    ///< more than half of the adhesion is of contacts at the frame's border
  kOnePixelFlag = 256,  ///< more than half of the adhesion is of contacts of one pixel
  kUnresolvedFlag = 512,  ///< pixels or tip are coarser than what holds (missing_scan.hpp): the
                          ///< force is not known
};

/// Contacts of fewer cells (five across) do not show their curvature.
inline constexpr double kFewestCellsPerContact = 20.0;
/// Fewer contacts than this say nothing of another place.
inline constexpr int kFewestContactsForStatement = 3;
/// Fewer contacts than this scatter by a third and more from place to place.
inline constexpr int kFewestContacts = 10;

/// Shares are of the sum of composite radii, which the adhesion is proportional to; without a list
/// of contacts (output/asperities off, or a formulation that lists none) they are of the number of
/// contacts, and the mean contact stands for all.
/// - @p cell_area of the scan [m^2], > 0
std::uint32_t regimeFlags(const Prediction& prediction, double cell_area);

/// Of a set of flags those that say that the pull-off force may be out by more than 1.3 against the
/// half-space: with half_space/enabled flagged they ask for it. The others speak of the scan, which
/// a half-space sees no better, or of the place.
std::uint32_t flagsForHalfSpace(std::uint32_t flags);

/// Why they say so, as a sentence without its full stop; empty if they do not.
std::string modelDoubt(const Prediction& prediction);

/// "bonded, tabor": the names of the flags set, in the order above; empty when none is.
std::string regimeFlagNames(std::uint32_t flags);
/// The same one by one.
std::vector<std::string> regimeFlagList(std::uint32_t flags);
/// What they mean, in words for people; near_bonding with its @p doubt (modelDoubt()) behind it.
std::vector<std::string> regimeFlagSentences(std::uint32_t flags, const std::string& doubt = "");

}  // namespace mems_stiction
