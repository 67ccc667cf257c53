#include "mems_stiction/equilibrium/asperity_response.hpp"

#include <algorithm>

#include "mems_stiction/base/constants.hpp"
#include "mems_stiction/mechanics/plasticity.hpp"

namespace mems_stiction {
namespace {

/// V_i of (6). The volume of a spherical cap has the first power of the height as last factor; (6) prints the second.
MEMS_STICTION_INLINE void findSharingWeights(const CapLanes& caps, Formulation formulation, Lanes& weights) {
  weights = (3.0 * caps.base_radius * caps.base_radius + caps.height * caps.height) * caps.height;
  if (formulation == Formulation::kPrinted) weights *= caps.height;
}

/// AsperityLaw::plasticityIndexOf() of four asperities.
MEMS_STICTION_INLINE void findPlasticityIndices(const AsperityLaw& law, const Lanes& radii, Lanes& indices) {
  if (law.deformation == Deformation::kElastic) {
    indices = Lanes{};
  } else if (law.formulation == Formulation::kPrinted) {
    indices = law.contact_modulus / law.hardness * (law.composite_rms_height / radii);
  } else {
    mems_stiction::findPlasticityIndices(law.contact_modulus, law.hardness, law.composite_rms_height, radii, indices);
  }
}

}  // namespace

AsperityLaw::AsperityLaw(const ContactPair& pair, double work_of_adhesion_in, double composite_rms_height_in,
                         Formulation formulation_in, Deformation deformation_in)
    : contact_modulus(pair.contact_modulus),
      stiffness(4.0 / 3.0 * pair.contact_modulus),
      hardness(pair.hardness),
      work_of_adhesion(work_of_adhesion_in),
      composite_rms_height(composite_rms_height_in),
      formulation(formulation_in),
      deformation(deformation_in) {}

double AsperityLaw::plasticityIndexOf(double radius) const {
  Lanes indices;
  findPlasticityIndices(*this, Lanes{} + radius, indices);
  return indices[0];
}

MEMS_STICTION_VECTORIZED void findResponses(const CapLanes& caps, const AsperityLaw& law,
                                            AsperityResponse* const (&responses)[kLanes]) {
  const Lanes& rc = caps.base_radius;
  Lanes volume, plasticity_index, elastic_share;
  findSharingWeights(caps, law.formulation, volume);
  findPlasticityIndices(law, caps.composite_radius, plasticity_index);
  findRegimeFactors(plasticity_index, elastic_share);
  const Lanes imposed_load = law.stiffness * rc * rc * rc / caps.composite_radius;
  const Lanes yield_load = law.hardness * kPi * rc * rc;
  for (std::size_t i = 0; i < kLanes; ++i) {
    AsperityResponse& response = *responses[i];
    response.radius = caps.composite_radius[i];
    response.base_radius = rc[i];
    response.volume = volume[i];
    response.cos_tilt = caps.cos_tilt[i];
    response.imposed_load = imposed_load[i];
    response.yield_load = yield_load[i];
    response.elastic_share = elastic_share[i];
  }
}

AsperityResponse::AsperityResponse(const CapCouple& caps, const AsperityLaw& law) {
  const Lanes zero{};
  const CapLanes lanes{zero + caps.base_radius, zero + caps.height, zero + caps.composite_radius,
                       zero + caps.squared_slope, zero + caps.cos_tilt};
  findResponses(lanes, law, {this, this, this, this});
}

double AsperityResponse::carriedLoad() const {
  return elastic_share * imposed_load + (1.0 - elastic_share) * std::min(imposed_load, yield_load);
}

double AsperityResponse::generalizedForce(double axial_load, const AsperityLaw& law) const {
  const double adhesion = 2.0 * kPi * law.work_of_adhesion * radius;
  if (law.formulation == Formulation::kPrinted) {
    const double squared = axial_load * axial_load / imposed_load;
    return (2.0 * axial_load - 2.0 * squared - elastic_share * (imposed_load - squared)) / 3.0 + adhesion;
  }
  const double excess = imposed_load - axial_load;
  const double elastic = adhesion - excess * excess / imposed_load / 3.0;
  if (elastic_share == 1.0) return elastic;
  const double plastic = axial_load + adhesion - yield_load;
  return elastic_share * elastic + (1.0 - elastic_share) * std::max(elastic, plastic);
}

}  // namespace mems_stiction
