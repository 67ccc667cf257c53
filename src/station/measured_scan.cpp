#include "station/measured_scan.hpp"

#include "verdict/missing_scan.hpp"

namespace mems_stiction {

MeasuredScan asMeasured(const Options& options, const SurfacePair& surfaces) {
  const ShortWaves waves =
      shortWaves(unresolvedWaves(surfaces.lower, surfaces.upper, 0.0), options);
  return {surfaces.lower.cellArea(),
          [waves](Prediction& prediction) { prediction.short_waves = waves; }};
}

}  // namespace mems_stiction
