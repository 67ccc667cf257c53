#pragma once

/// Every row of the table, one file per physical idea.

#include <cstddef>
#include <functional>
#include <vector>

#include "verification/row.hpp"

namespace mems_stiction {
namespace verification {

Section jkrSection();
Section transitionSection();
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
/// - @p on_section is told the number of each, from 1, and of all, before it is computed
std::vector<Section> allSections(const std::function<void(std::size_t, std::size_t)>& on_section =
                                     [](std::size_t, std::size_t) {});

}  // namespace verification
}  // namespace mems_stiction
