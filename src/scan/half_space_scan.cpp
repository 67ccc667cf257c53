#include "mems_stiction/scan/half_space_scan.hpp"

namespace mems_stiction {

HalfSpaceProblem halfSpaceProblem(const PreparedScan& prepared, const Options& options) {
  HalfSpaceProblem problem;
  problem.surfaces = prepared.model_surfaces;
  problem.lower_material = options.lower;
  problem.upper_material = options.upper;
  problem.interface = options.interface;
  problem.capillary = options.capillary;
  problem.load = options.load;
  return problem;
}

}  // namespace mems_stiction
