#include "verification/sections.hpp"

namespace mems_stiction {
namespace verification {

std::vector<Section> allSections() {
  return {hertzSection(),
          jkrSection(),
          dmtAndTransitionSection(),
          manyAsperitiesSection(),
          surfaceForcesSection(),
          loadSumsSection(),
          capsSection(),
          sphereOnFlatSection(),
          plasticitySection(),
          equilibriumSection(),
          deformedSurfacesSection(),
          roughSurfacesSection(),
          roughnessSection(),
          capillarySection(),
          halfSpaceSection(),
          devicesSection(),
          inputDigitsSection()};
}

}  // namespace verification
}  // namespace mems_stiction
