#include "mems_stiction/preprocess/level_options.hpp"

#include "mems_stiction/height_map/validity.hpp"
#include "mems_stiction/preprocess/level.hpp"
#include "mems_stiction/preprocess/polynomial_level.hpp"

namespace mems_stiction {

void LevelOptions::describe(OptionVisitor& visitor, const std::string& prefix) {
  visitor.enumeration(
      prefix, shape,
      {{"none", LevelShape::kNone}, {"plane", LevelShape::kPlane}, {"polynomial", LevelShape::kPolynomial}},
      "what is subtracted from a scan: nothing, the plane or the polynomial of degree 2 that fits its valid pixels");
  visitor.flag(prefix + "_robust", robust, "fit that plane or polynomial so that features and spikes have no say");
}

HeightMap levelledBy(const HeightMap& surface, const LevelOptions& options) {
  const FitWeights weights = options.robust ? FitWeights::kRobust : FitWeights::kEqual;
  switch (options.shape) {
    case LevelShape::kNone:
      break;
    case LevelShape::kPlane:
      return options.robust ? without(fitPolynomial(surface, 1, weights), surface) : levelled(surface);
    case LevelShape::kPolynomial:
      return without(fitPolynomial(surface, 2, weights), surface);
  }
  return {ownedHeights(surface), surface.pitchX(), surface.pitchY()};
}

}  // namespace mems_stiction
