#pragma once

/// @file
/// A prediction by the separation curve whose contacts are all alike, for tests of verdicts.

#include "mems_stiction/prediction/prediction.hpp"

namespace mems_stiction {
namespace predicted_contacts {

constexpr double kCell = 25e-18;   ///< area of a pixel [m^2]
constexpr double kArea = 1e-12;    ///< of the scan [m^2]
constexpr double kPullOff = 1e-7;  ///< of the scan [N]

/// - @p contacts of 100 pixels each
inline Prediction predicted(int contacts = 25) {
  Prediction prediction;
  prediction.status = Status::kEquilibrium;
  prediction.nominal_area = kArea;
  prediction.pull_off_force = prediction.pull_off_force_jkr = prediction.pull_off_force_transition =
      kPullOff;
  prediction.apparent_work_of_adhesion = 0.01;
  prediction.pull_off_exponents = prediction.work_exponents = {1.0, 0.0, 0.0};
  prediction.model.assumes_jkr = false;
  prediction.asperity_count = prediction.pull_off_contact_count = contacts;
  Asperity asperity;
  asperity.composite_radius = 1e-6;
  asperity.area = 100 * kCell;
  prediction.asperities.assign(static_cast<std::size_t>(contacts), asperity);
  return prediction;
}

}  // namespace predicted_contacts
}  // namespace mems_stiction
