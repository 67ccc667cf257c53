#include "paper/asperity_summary.hpp"

#include <cmath>

#include "mechanics/jkr.hpp"
#include "mechanics/transition.hpp"
#include "numeric/constants.hpp"

namespace mems_stiction {

Asperity asperityAt(const ContactPatch& patch, const CapCouple& caps,
                    const AsperityResponse& response, double load_share, const GapField& field,
                    const AsperityLaw& law, const InterfaceOptions& interface) {
  Asperity asperity;
  asperity.x = caps.centre.col * field.pitchX();
  asperity.y = caps.centre.row * field.pitchY();
  asperity.cap_radius = caps.cap_radius;
  asperity.composite_radius = caps.composite_radius;
  asperity.load = load_share * response.load_weight;
  const double apparent_load =
      jkr::apparentLoad(asperity.load * caps.cos_tilt, law.work_of_adhesion, caps.composite_radius);
  asperity.contact_radius =
      jkr::contactRadius(apparent_load, caps.composite_radius, law.contact_modulus);
  asperity.tilt = caps.tilt();
  asperity.plasticity_index = law.plasticityIndexOf(caps.composite_radius);
  asperity.tabor_parameter = taborParameter(caps.composite_radius, law.work_of_adhesion,
                                            law.contact_modulus, interface.equilibrium_distance);
  asperity.area = patch.area * field.cellArea();
  asperity.is_at_border = patch.min_col == 0 || patch.max_col == field.cols() - 1 ||
                          patch.min_row == 0 || patch.max_row == field.rows() - 1;
  asperity.regime = regimeOf(asperity.plasticity_index);
  return asperity;
}

void sumAsperities(const AsperityLaw& law, ContactSolution& solution) {
  const double sigma = law.composite_rms_height;
  double jkr_sum = 0.0;
  double transition_sum = 0.0;
  double area_sum = 0.0;
  double parameter_sum = 0.0;
  for (const Asperity& asperity : solution.asperities) {
    const double adhesion = kPi * law.work_of_adhesion * asperity.composite_radius;
    jkr_sum += 1.5 * adhesion;
    transition_sum += pullOffPrefactor(asperity.tabor_parameter) * adhesion;
    area_sum += kPi * asperity.contact_radius * asperity.contact_radius;
    parameter_sum += law.contact_modulus / law.work_of_adhesion *
                     std::sqrt(sigma * sigma * sigma / asperity.composite_radius);
  }
  solution.pull_off_force_jkr = jkr_sum;
  solution.pull_off_force_transition = transition_sum;
  solution.contact_area_jkr = area_sum;
  solution.adhesion_parameter = law.work_of_adhesion > 0.0
                                    ? parameter_sum / static_cast<int>(solution.asperities.size())
                                    : std::numeric_limits<double>::infinity();
}

}  // namespace mems_stiction
