#include "paper/asperity_response.hpp"

#include <algorithm>

#include "mems_stiction/mechanics/plasticity.hpp"
#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

/// V_i of (6). The volume of a spherical cap has the first power of the height as last factor; (6)
/// prints the second.
double loadWeight(const CapCouple& caps, Formulation formulation) {
  const double volume =
      (3.0 * caps.cap_radius * caps.cap_radius + caps.height * caps.height) * caps.height;
  return formulation == Formulation::kPrinted ? volume * caps.height : volume;
}

}  // namespace

AsperityLaw::AsperityLaw(const ContactPair& pair, double work_of_adhesion_in,
                         double composite_rms_height_in, Formulation formulation_in,
                         Deformation deformation_in)
    : contact_modulus(pair.contact_modulus),
      stiffness(4.0 / 3.0 * pair.contact_modulus),
      hardness(pair.hardness),
      work_of_adhesion(work_of_adhesion_in),
      composite_rms_height(composite_rms_height_in),
      formulation(formulation_in),
      deformation(deformation_in) {}

double AsperityLaw::plasticityIndexOf(double radius) const {
  if (deformation == Deformation::kElastic) return 0.0;
  if (formulation == Formulation::kPrinted)
    return contact_modulus / hardness * (composite_rms_height / radius);
  return plasticityIndex(contact_modulus, hardness, composite_rms_height, radius);
}

AsperityResponse::AsperityResponse(const CapCouple& caps, const AsperityLaw& law)
    : radius(caps.composite_radius),
      cap_radius(caps.cap_radius),
      load_weight(loadWeight(caps, law.formulation)),
      cos_tilt(caps.cos_tilt),
      imposed_load(law.stiffness * cap_radius * cap_radius * cap_radius / radius),
      yield_load(law.hardness * kPi * cap_radius * cap_radius),
      elastic_share(regimeFactor(law.plasticityIndexOf(radius))) {}

double AsperityResponse::carriedLoad() const {
  return elastic_share * imposed_load + (1.0 - elastic_share) * std::min(imposed_load, yield_load);
}

double AsperityResponse::generalizedForce(double axial_load, const AsperityLaw& law) const {
  const double adhesion = 2.0 * kPi * law.work_of_adhesion * radius;
  const double excess = imposed_load - axial_load;
  const double elastic = adhesion - excess * excess / imposed_load / 3.0;
  const double plastic = adhesion + 2.0 * axial_load * excess / imposed_load / 3.0;
  return elastic_share * elastic + (1.0 - elastic_share) * plastic;
}

}  // namespace mems_stiction
