#pragma once

/// @file
/// The surfaces after contact as a reading of the paper has them (modified_topography.hpp): with
/// (12) as printed,
///
///     s = P/w = 1/2 +- 1/(4 (1 + |ln(H2/H1)/ln a|)),    + if the upper body is the harder one
///
/// and with (13), where the softer body takes all, in every regime.

#include "deformation/modified_topography.hpp"
#include "mems_stiction/mechanics/plasticity.hpp"
#include "paper/formulation.hpp"

namespace mems_stiction {

/// How the interference of a cell is divided between the bodies.
class FormulationShare {
 public:
  /// - @p hardness_ratio_limit a of (12), in (0, 1)
  FormulationShare(const Material& lower, const Material& upper, double hardness_ratio_limit,
                   Formulation formulation, Deformation deformation);

  /// Share of w that the lower surface loses, c s [-].
  double lower(double plasticity_index) const { return flow(plasticity_index) * lower_share_; }
  /// Share of w that the upper surface loses, c (1 - s) [-].
  double upper(double plasticity_index) const {
    return flow(plasticity_index) * (1.0 - lower_share_);
  }

 private:
  /// c [-]
  double flow(double plasticity_index) const;

  double lower_share_;  ///< s [-], in [0, 1]
  bool flows_in_every_regime_ = false;
};

}  // namespace mems_stiction
