#include "preprocess/levelling.hpp"

#include "preprocess/level.hpp"
#include "preprocess/polynomial_level.hpp"

namespace mems_stiction {

void LevelOptions::describe(OptionVisitor& visitor, const std::string& prefix) {
  visitor.enumeration(prefix, shape,
                      {{"none", LevelShape::kNone},
                       {"plane", LevelShape::kPlane},
                       {"polynomial", LevelShape::kPolynomial}},
                      "what is subtracted from a scan: nothing, the plane or the polynomial of "
                      "degree 2 that fits its valid pixels");
  visitor.flag(prefix + "_robust", robust,
               "fit that plane or polynomial so that features and spikes have no say");
}

HeightChange levelBy(WorkingSurface& surface, const LevelOptions& options) {
  if (options.shape == LevelShape::kPlane && !options.robust) return level(surface);
  const int degree = options.shape == LevelShape::kPlane ? 1 : 2;
  const FitWeights weights = options.robust ? FitWeights::kRobust : FitWeights::kEqual;
  const PolynomialSurface fit = fitPolynomial(surface.heights, surface.pitch_x, surface.pitch_y,
                                              degree, weights, surface.memory);
  return subtract(fit, surface);
}

}  // namespace mems_stiction
