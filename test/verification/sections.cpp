#include "verification/sections.hpp"

namespace mems_stiction {
namespace verification {

std::vector<Section> allSections(const std::function<void(std::size_t, std::size_t)>& on_section) {
  const std::vector<Section (*)()> all = {
      jkrSection,           transitionSection,  surfaceForcesSection,
      loadSumsSection,      capsSection,        sphereOnFlatSection,
      plasticitySection,    equilibriumSection, deformedSurfacesSection,
      roughSurfacesSection, roughnessSection,   capillarySection,
      halfSpaceSection,     devicesSection,     inputDigitsSection};
  std::vector<Section> sections;
  for (Section (*const section)() : all) {
    on_section(sections.size() + 1, all.size());
    sections.push_back(section());
  }
  return sections;
}

}  // namespace verification
}  // namespace mems_stiction
