#include "mems_stiction/mechanics/material.hpp"

#include <algorithm>

namespace mems_stiction {

void Material::describe(OptionVisitor& visitor, const std::string& prefix) {
  visitor.number(prefix + "/youngs_modulus", youngs_modulus, "Pa", Range::positive(),
                 "Young's modulus of this body");
  visitor.number(prefix + "/poisson_ratio", poisson_ratio, "", Range{-1.0, 0.5, true, false},
                 "Poisson's ratio of this body");
  visitor.number(prefix + "/hardness", hardness, "Pa", Range::positive(),
                 "indentation hardness of this body");
  visitor.number(
      prefix + "/thickness", thickness, "m", Range::nonNegative(),
      "thickness of this body, which long waves bend or a substrate stiffens; 0 = thick");
  visitor.enumeration(
      prefix + "/backing", backing, {{"free", Backing::kFree}, {"bonded", Backing::kBonded}},
      "what holds a body with a thickness: nothing (a beam or plate), or a substrate (a film)");
  visitor.number(prefix + "/substrate/youngs_modulus", substrate.youngs_modulus, "Pa",
                 Range::nonNegative(), "Young's modulus of what a film is bonded to; 0 = rigid");
  visitor.number(prefix + "/substrate/poisson_ratio", substrate.poisson_ratio, "",
                 Range{-1.0, 0.5, true, false}, "Poisson's ratio of what a film is bonded to");
  visitor.number(prefix + "/film_thickness", film_thickness, "m", Range::nonNegative(),
                 "thickness of this body's native film, which attracts by "
                 "interface/hamaker_constant; 0 = none");
  visitor.number(prefix + "/hamaker_constant", hamaker_constant, "J", Range::nonNegative(),
                 "Hamaker constant of what is under the film, across the same medium; 0 = as the "
                 "film");
}

std::vector<std::string> Material::contradictions(const std::string& prefix) const {
  if (backing == Backing::kBonded || !(substrate.youngs_modulus > 0.0)) return {};
  return {prefix + "/substrate/youngs_modulus: " + numberText(substrate.youngs_modulus) +
          " Pa with " + prefix +
          "/backing free is not allowed: a free body has no substrate; must be 0 Pa, or the "
          "backing bonded"};
}

ContactPair::ContactPair(const Material& lower, const Material& upper)
    : contact_modulus(1.0 /
                      ((1.0 - lower.poisson_ratio * lower.poisson_ratio) / lower.youngs_modulus +
                       (1.0 - upper.poisson_ratio * upper.poisson_ratio) / upper.youngs_modulus)),
      hardness(std::min(lower.hardness, upper.hardness)) {}

}  // namespace mems_stiction
