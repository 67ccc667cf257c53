#pragma once

/// @file
/// How hard do the cells that are apart attract each other, and what does it cost to take them apart for good?

#include "mems_stiction/approach/gap_pyramid.hpp"
#include "mems_stiction/loads/interface.hpp"
#include "mems_stiction/separation/contact_traction.hpp"

namespace mems_stiction {

/// Of a frame at one approach.
struct Attraction {
  double adhesion = 0.0;       ///< sum of t(d) dA over the cells apart [N]
  double electrostatic = 0.0;  ///< sum of eps0 U^2/(2 (d + h/eps_r)^2) dA over all, d = 0 in contact [N]
};

/// Sums over the frame without a pass over it.
class AttractionSum {
 public:
  AttractionSum(const InterfaceOptions& interface, double voltage, double cell_area);

  const ContactTraction& law() const { return law_; }
  /// The forces when the first `contact_count` ordered cells are in contact and the others apart by gap - approach.
  Attraction forces(const GapPyramid& gaps, double approach, int contact_count) const;
  /// Sum of w(d) dA over all cells, Gamma in contact [J]: takes longer.
  double energy(const GapPyramid& gaps, double approach, int contact_count) const;

 private:
  void addForces(const OrderedCell* cells, std::size_t count, double approach, Attraction& sum) const;
  void addForces(const GapMoments& gaps, double approach, Attraction& sum) const;
  PyramidRule rule() const { return {0.0, law_.range()}; }

  ContactTraction law_;
  double cell_area_;
  FieldLaw field_;
};

}  // namespace mems_stiction
