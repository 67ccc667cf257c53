/// The half-space on the surfaces and settings of a prediction.

#include <pybind11/stl.h>

#include <memory>
#include <optional>

#include "bindings.hpp"
#include "evaluation/device_scans.hpp"
#include "evaluation/frame_load.hpp"
#include "evaluation/half_space_call.hpp"
#include "figures.hpp"
#include "interruptible.hpp"
#include "memory.hpp"
#include "mems_stiction/configuration/provenance.hpp"
#include "mems_stiction/evaluation/half_space_scan.hpp"
#include "mems_stiction/evaluation/prepared_scan.hpp"
#include "mems_stiction/half_space/half_space_solver.hpp"

namespace mems_stiction {
namespace python {
namespace {

namespace py = pybind11;
using py::literals::operator""_a;

/// A solution with its curve and its contacts, and the verdict on the device if one is stated.
struct SolvedScan {
  SolvedHalfSpace solution;
  std::optional<Verdict> verdict;
  std::vector<CurvePoint> curve;
  cv::Mat contact_map;
  Provenance provenance;
};

using Solved = std::shared_ptr<SolvedScan>;

Solved solve(const PreparedScan& prepared, const ScanIdentity& identity,
             const Configuration& configuration) {
  return interruptible([&](const std::atomic<bool>& cancel) {
    const Options options = onFrame(configuration.model, configuration.device, prepared.surfaces);
    const HalfSpaceProblem problem = halfSpaceProblem(prepared, options);
    HalfSpaceControl control;
    control.cancel = &cancel;
    auto solved = std::make_shared<SolvedScan>();
    solved->provenance = provenanceOf(identity, configuration);
    solved->solution = HalfSpaceSolver(configuration.half_space).solve(problem, control);
    solved->curve = curveOf(solved->solution);
    solved->contact_map = halfSpaceContactMap(solved->solution, problem, configuration.half_space,
                                              prepared.refinement);
    if (configuration.device.isStated()) {
      const Evidence beside = evidenceOfScan(prepared, configuration, Cancellation(cancel));
      solved->verdict =
          halfSpaceVerdict(solved->solution, prepared, options, configuration, beside);
    }
    return solved;
  });
}

template <typename Visitor>
void visitSolutionFigures(const SolvedHalfSpace& solution, Visitor&& visit) {
  visitHalfSpaceFields(solution, visit);
  visitHalfSpaceStiffness(solution, visit);
  visitHalfSpaceDetails(solution, visit);
}

py::dict figuresOfSolution(const SolvedScan& solved) {
  return dictionaryOf([&](auto& fields) { visitSolutionFigures(solved.solution, fields); });
}

std::optional<py::dict> verdictOfSolution(const SolvedScan& solved) {
  if (!solved.verdict) return std::nullopt;
  return verdictFigures(*solved.verdict);
}

py::dict originOf(const SolvedScan& solved) {
  DictionaryFields fields;
  visitStatedProvenance(solved.provenance, fields);
  return fields.dictionary;
}

Records curveOfScan(const Solved& solved) {
  return recordsOf(solved->curve, solved,
                   [](const auto& point, auto& fields) { visitCurvePointFields(point, fields); });
}

}  // namespace

void bindHalfSpace(py::module& module) {
  DeclaredFields declared;
  visitSolutionFigures({}, declared);
  declared.addTo(module, "HalfSpaceFigures");

  py::class_<SolvedScan, Solved>(module, "SolvedScan")
      .def_property_readonly("figures", &figuresOfSolution)
      .def_property_readonly("verdict", &verdictOfSolution)
      .def_property_readonly("origin", &originOf)
      .def_property_readonly("curve", &curveOfScan)
      .def_property_readonly(
          "pressure", [](const SolvedScan& solved) { return memoryOf(solved.solution.pressure); })
      .def_property_readonly("gap",
                             [](const SolvedScan& solved) { return memoryOf(solved.solution.gap); })
      .def_property_readonly("contact_map",
                             [](const SolvedScan& solved) { return memoryOf(solved.contact_map); })
      .def_property_readonly(
          "deformed_lower", [](const SolvedScan& solved) { return solved.solution.deformed_lower; })
      .def_property_readonly("deformed_upper", [](const SolvedScan& solved) {
        return solved.solution.deformed_upper;
      });
  module.def(
      "half_space_warnings",
      [](const PreparedScan& prepared, const Configuration& configuration) {
        const std::string coarse =
            coarsePixelsWarning(prepared, configuration.model, configuration.half_space);
        return coarse.empty() ? std::vector<std::string>() : std::vector<std::string>{coarse};
      },
      "prepared"_a, "configuration"_a);
  module.def("half_space", &solve, "prepared"_a, "identity"_a, "configuration"_a);
}

}  // namespace python
}  // namespace mems_stiction
