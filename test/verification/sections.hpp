#pragma once

/// Every row of the table, one file per physical idea.

#include "verification/row.hpp"

namespace mems_stiction {
namespace verification {

Section hertzSection();
Section jkrSection();
Section dmtAndTransitionSection();
Section manyAsperitiesSection();
Section surfaceForcesSection();
Section loadSumsSection();
Section capsSection();
Section sphereOnFlatSection();
Section plasticitySection();
Section equilibriumSection();
Section deformedSurfacesSection();
Section roughSurfacesSection();
Section roughnessSection();
Section capillarySection();
Section halfSpaceSection();
Section devicesSection();
Section inputDigitsSection();

/// All of them, in the order of the table.
std::vector<Section> allSections();

}  // namespace verification
}  // namespace mems_stiction
