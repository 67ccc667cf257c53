/// The half-space on the surfaces and settings of a prediction.

#include <memory>
#include <optional>
#include <string>

#include "bindings.hpp"
#include "figures.hpp"
#include "interruptible.hpp"
#include "memory.hpp"
#include "mems_stiction/half_space/half_space_solver.hpp"
#include "mems_stiction/scan/frame_load.hpp"
#include "mems_stiction/scan/half_space_scan.hpp"
#include "mems_stiction/scan/prepared_scan.hpp"

namespace mems_stiction {
namespace python {
namespace {

namespace py = pybind11;

/// A solution with its curve and its contacts, and the verdict on the device if one is stated.
struct SolvedScan {
  SolvedHalfSpace solution;
  std::optional<Verdict> verdict;
  std::vector<CurvePoint> curve;
  cv::Mat contact_map;
};

using Solved = std::shared_ptr<SolvedScan>;

Solved solve(const PreparedScan& prepared, const Configuration& configuration) {
  return interruptible([&](const std::atomic<bool>& cancel) {
    const Options options = onFrame(configuration.model, configuration.device, prepared.surfaces);
    const HalfSpaceProblem problem = halfSpaceProblem(prepared, options);
    HalfSpaceControl control;
    control.cancel = &cancel;
    auto solved = std::make_shared<SolvedScan>();
    solved->solution = HalfSpaceSolver(configuration.half_space).solve(problem, control);
    solved->curve = curveOf(solved->solution);
    solved->contact_map = halfSpaceContactMap(solved->solution, problem, configuration.half_space, prepared.refinement);
    if (configuration.device.isStated()) {
      solved->verdict = halfSpaceVerdict(solved->solution, prepared, options, configuration);
    }
    return solved;
  });
}

/// Those of the record, and those that only the solution has.
template <typename Visitor>
void visitFields(const SolvedHalfSpace& solution, Visitor&& visit) {
  visitHalfSpaceFields(solution, visit);
  visit("message", solution.message, "");
  visit("pull_off_uncertainty", solution.pull_off_uncertainty, "N");
  visit("pull_off_height", solution.pull_off_height, "m");
  visit("rest_height", solution.rest_height, "m");
  visit("rest_force", solution.rest_force, "N");
  visit("contact_count", solution.contact_count, "");
  visit("flowed_volume", solution.flowed_volume, "m^3");
  visit("range", solution.range, "m");
  visit("cohesive_length", solution.cohesive_length, "m");
  visit("is_step_converged", solution.is_step_converged, "");
  visit("residual", solution.residual, "");
  visit("state_count", solution.state_count, "");
  visit("jumps", solution.jumps, "");
}

py::dict figuresOf(const SolvedScan& solved) {
  DictionaryFields fields;
  visitFields(solved.solution, fields);
  return fields.dictionary;
}

py::dict halfSpaceUnits() {
  UnitFields fields;
  visitFields(SolvedHalfSpace(), fields);
  return fields.units;
}

Records curveOfScan(const Solved& solved) {
  Fields<CurvePoint> fields;
  visitCurvePointFields(fields.sample, fields);
  return recordsOf(solved->curve, fields.fields, solved);
}

}  // namespace

void bindHalfSpace(py::module& module) {
  py::class_<SolvedScan, Solved>(module, "SolvedScan")
      .def_property_readonly("figures", &figuresOf)
      .def_property_readonly("verdict",
                             [](const SolvedScan& solved) {
                               return solved.verdict ? py::object(verdictFigures(*solved.verdict)) : py::none();
                             })
      .def_property_readonly("curve", &curveOfScan)
      .def_property_readonly("pressure", [](const SolvedScan& solved) { return memoryOf(solved.solution.pressure); })
      .def_property_readonly("gap", [](const SolvedScan& solved) { return memoryOf(solved.solution.gap); })
      .def_property_readonly("contact_map", [](const SolvedScan& solved) { return memoryOf(solved.contact_map); })
      .def_property_readonly("deformed_lower", [](const SolvedScan& solved) { return solved.solution.deformed_lower; })
      .def_property_readonly("deformed_upper", [](const SolvedScan& solved) { return solved.solution.deformed_upper; });
  module.def("half_space", &solve);
  module.def("half_space_units", &halfSpaceUnits);
}

}  // namespace python
}  // namespace mems_stiction
