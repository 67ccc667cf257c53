#include "mems_stiction/evaluation/half_space_scan.hpp"

#include <algorithm>

#include "evaluation/block_maxima.hpp"
#include "mems_stiction/evaluation/scan_predictor.hpp"
#include "mems_stiction/mechanics/plasticity.hpp"
#include "prediction/asked_output.hpp"

namespace mems_stiction {
namespace {

/// Share of the hardness from which on a pressure is the hardness: balance of tractions and single
/// precision.
constexpr double kAtHardness = 0.999;

}  // namespace

HalfSpaceProblem halfSpaceProblem(const PreparedScan& prepared, const Options& options) {
  HalfSpaceProblem problem;
  problem.surfaces = prepared.model_surfaces;
  problem.lower_material = options.lower;
  problem.upper_material = options.upper;
  problem.interface = options.interface;
  problem.capillary = options.capillary;
  problem.load = options.load;
  problem.may_tilt = options.guidance != Guidance::kGuided;
  return problem;
}

Verdict halfSpaceVerdict(const SolvedHalfSpace& solved, const PreparedScan& prepared,
                         const Options& options, const Configuration& configuration,
                         const Evidence& beside) {
  Configuration asked = configuration;
  asked.model = options;
  asked.counter_surface = {};  // the prepared scan has it
  asked.model.output = figuresAlone();
  ScanPredictor predictor(asked);
  const Prediction prediction = predictor.predict(prepared);
  Evidence evidence = beside;
  evidence.half_space = &solved;
  return verdictOf(prediction, asked.device, asked.uncertainty, asked.model,
                   prepared.surfaces.lower.cellArea(), evidence);
}

cv::Mat halfSpaceContactMap(const SolvedHalfSpace& solved, const HalfSpaceProblem& problem,
                            const HalfSpaceOptions& options, int refinement) {
  if (solved.pressure.empty()) return cv::Mat();
  cv::Mat map = cv::Mat::zeros(solved.pressure.size(), CV_8UC1);
  map.setTo(static_cast<int>(Regime::kElastic), solved.pressure > 0.0);  // NaN is not
  const double hardness =
      std::min(problem.lower_material.hardness, problem.upper_material.hardness);
  if (options.flow)
    map.setTo(static_cast<int>(Regime::kPlastic), solved.pressure > kAtHardness * hardness);
  return refinement > 1 ? blockMaxima(map, refinement) : map;
}

}  // namespace mems_stiction
