#include "mems_stiction/mechanics/material.hpp"

#include <algorithm>

namespace mems_stiction {

void Material::describe(OptionVisitor& visitor, const std::string& prefix) {
  visitor.number(prefix + "/youngs_modulus", youngs_modulus, "Pa", Range::positive(), "Young's modulus of this body");
  visitor.number(prefix + "/poisson_ratio", poisson_ratio, "", Range{-1.0, 0.5, true, false},
                 "Poisson's ratio of this body");
  visitor.number(prefix + "/hardness", hardness, "Pa", Range::positive(), "indentation hardness of this body");
}

ContactPair::ContactPair(const Material& lower, const Material& upper)
    : contact_modulus(1.0 / ((1.0 - lower.poisson_ratio * lower.poisson_ratio) / lower.youngs_modulus +
                             (1.0 - upper.poisson_ratio * upper.poisson_ratio) / upper.youngs_modulus)),
      hardness(std::min(lower.hardness, upper.hardness)) {}

}  // namespace mems_stiction
