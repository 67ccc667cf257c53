#include "evaluation/scan_judgement.hpp"

#include <utility>

#include "device/device_evidence.hpp"
#include "mems_stiction/evaluation/half_space_scan.hpp"

namespace mems_stiction {

std::optional<SolvedHalfSpace> ScanJudgement::begun() const {
  if (!call.is_made || !call.objection.empty()) return std::nullopt;
  return half_space;
}

ScanJudgement judgedScan(const Prediction& prediction, const PreparedScan& prepared,
                         const Options& options, const Configuration& configuration,
                         Evidence evidence, DeviceForce* force, const HalfSpaceRun& run) {
  ScanJudgement found;
  found.call = halfSpaceCall(prediction, prepared, options, configuration);
  if (found.call.is_made) {
    found.half_space = run([&](const HalfSpaceControl& control) {
      return answerOf(found.call, HalfSpaceSolver(configuration.half_space),
                      halfSpaceProblem(prepared, options), control);
    });
    evidence.half_space = &found.half_space;
    evidence.why_half_space = found.call.why;
  }
  if (!configuration.device.isStated()) return found;
  found.verdict = verdictOf(prediction, configuration.device, configuration.uncertainty, options,
                            prepared.surfaces.lower.cellArea(), evidence);
  if (force != nullptr && found.verdict->judge == Judge::kHalfSpace) {
    *force = judgedByHalfSpace(std::move(*force), prediction, options, configuration.uncertainty,
                               evidence);
  }
  return found;
}

}  // namespace mems_stiction
