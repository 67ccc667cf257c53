#include "mechanics/layered_attraction.hpp"

#include <cmath>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

/// b of a body [J^(1/2)]
double rootBelow(const CoatedBody& body, double root_of_film) {
  const bool is_coated = body.film_thickness > 0.0 && body.hamaker_constant > 0.0;
  return is_coated ? std::sqrt(body.hamaker_constant) - root_of_film : 0.0;
}

}  // namespace

LayeredAttraction::LayeredAttraction(double hamaker_constant, const CoatedBody& lower,
                                     const CoatedBody& upper, double retardation_length)
    : film_constant_(hamaker_constant),
      shifts_{lower.film_thickness, upper.film_thickness,
              lower.film_thickness + upper.film_thickness},
      inverse_length_(retardation_length > 0.0 ? 1.0 / retardation_length : 0.0) {
  const double film = std::sqrt(hamaker_constant);
  const double below_lower = rootBelow(lower, film);
  const double below_upper = rootBelow(upper, film);
  const double unit = 1.0 / (12.0 * kPi);
  weights_[0] = unit * hamaker_constant;
  weights_[1] = unit * film * below_lower;
  weights_[2] = unit * film * below_upper;
  weights_[3] = unit * below_lower * below_upper;
}

bool LayeredAttraction::isPlain() const {
  return inverse_length_ == 0.0 && weights_[1] == 0.0 && weights_[2] == 0.0;
}

double LayeredAttraction::steepness() const {
  const int faster = (inverse_length_ > 0.0) + (weights_[1] < 0.0) + (weights_[2] < 0.0);
  return 1.0 + faster / 3.0;
}

double LayeredAttraction::hamakerConstant(double gap) const {
  return 12.0 * kPi * gap * gap * at(gap).energy;
}

LayeredAttraction LayeredAttraction::times(double factor) const {
  LayeredAttraction other(*this);
  other.film_constant_ *= factor;
  for (double& weight : other.weights_) weight *= factor;
  other.plain_ *= factor;
  return other;
}

LayeredAttraction LayeredAttraction::less(double traction) const {
  LayeredAttraction other(*this);
  other.plain_ += 0.5 * traction;
  return other;
}

}  // namespace mems_stiction
