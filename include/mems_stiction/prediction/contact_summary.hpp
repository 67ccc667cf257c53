#pragma once

/// @file
/// From the state at equilibrium to the figures that are published (section 2.3 of the paper): pull-off force, contact
/// areas, energies, adhesion parameter, one record per asperity.

#include "mems_stiction/equilibrium/approach_search.hpp"
#include "mems_stiction/prediction/options.hpp"
#include "mems_stiction/prediction/prediction.hpp"

namespace mems_stiction {

/// One contact at equilibrium: what the sums and the asperity records are made from. z is left to the caller.
Asperity asperityAt(const ContactPatch& patch, const CapCouple& caps, const AsperityResponse& response,
                    double load_share, const GapField& field, const AsperityLaw& law,
                    const InterfaceOptions& interface);

/// Adds one contact to the sums, counts and extremes of a prediction.
void addContact(const Asperity& asperity, const AsperityLaw& law, Prediction& prediction);

/// Fills everything in `prediction` that follows from the contacts.
/// - @p tabor_parameters working memory
void summarizeContact(const HeightMap& lower, const EquilibriumState& state, ApproachSearch& search,
                      const GapField& field, const GapOrder& order, const AsperityLaw& law, const Options& options,
                      std::vector<double>& tabor_parameters, Prediction& prediction);

}  // namespace mems_stiction
