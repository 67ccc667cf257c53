/// Load sweeps and contact cycles.

#include <pybind11/stl.h>

#include <memory>

#include "bindings.hpp"
#include "evaluation/device_scans.hpp"
#include "evaluation/frame_load.hpp"
#include "evaluation/scan_flags.hpp"
#include "interruptible.hpp"
#include "memory.hpp"
#include "mems_stiction/evaluation/prepared_scan.hpp"
#include "station/station_fields.hpp"

namespace mems_stiction {
namespace python {
namespace {

namespace py = pybind11;
using py::literals::operator""_a;

using Sweep = std::shared_ptr<LoadSweepResult>;
using Cycles = std::shared_ptr<ContactCyclesResult>;

Sweep sweep(const PreparedScan& prepared, const Configuration& configuration,
            const std::vector<double>& voltages, const std::vector<double>& mechanical_loads) {
  return interruptible([&](const std::atomic<bool>& cancel) {
    RunControl control;
    control.cancel = &cancel;
    const Options options = onFrame(configuration.model, configuration.device, prepared.surfaces);
    const LoadSweepRequest request{voltages, mechanical_loads};
    const std::vector<LoadedScale> scales =
        scalesUnder(request.loadsOfDevice(options), prepared, configuration, Cancellation(cancel));
    return std::make_shared<LoadSweepResult>(sweepLoads(
        options, prepared.model_surfaces, request, configuration.device, configuration.uncertainty,
        control, scales, measuredScan(prepared, configuration.model)));
  });
}

Cycles cycle(const PreparedScan& prepared, const Configuration& configuration, int count) {
  return interruptible([&](const std::atomic<bool>& cancel) {
    RunControl control;
    control.cancel = &cancel;
    const Options options = onFrame(configuration.model, configuration.device, prepared.surfaces);
    const std::vector<LoadedScale> scales =
        scalesUnder({options.load}, prepared, configuration, Cancellation(cancel));
    return std::make_shared<ContactCyclesResult>(cycleContacts(
        options, prepared.model_surfaces, count, configuration.device, configuration.uncertainty,
        control, scales, measuredScan(prepared, configuration.model)));
  });
}

Records pointsOf(const Sweep& result) {
  return recordsOf(result->rows, result,
                   [](const auto& row, auto& fields) { visitSweepFields(row, fields); });
}

Records summariesOf(const Sweep& result) {
  return recordsOf(result->summaries, result,
                   [](const auto& one, auto& fields) { visitSummaryFields(one, fields); });
}

Records cyclesOf(const Cycles& result) {
  return recordsOf(result->cycles, result,
                   [](const auto& cycle, auto& fields) { visitCycleFields(cycle, fields); });
}

}  // namespace

void bindStation(py::module& module) {
  py::class_<LoadSweepResult, Sweep>(module, "LoadSweepResult")
      .def_property_readonly("points", &pointsOf)
      .def_property_readonly("summaries", &summariesOf)
      .def_readonly("pull_in_voltage", &LoadSweepResult::pull_in_voltage)
      .def_readonly("pull_in_reason", &LoadSweepResult::pull_in_reason)
      .def_readonly("why_no_margin", &LoadSweepResult::why_no_margin);
  py::class_<ContactCyclesResult, Cycles>(module, "ContactCyclesResult")
      .def_property_readonly("cycles", &cyclesOf)
      .def_readonly("first_sticking_cycle", &ContactCyclesResult::first_sticking_cycle)
      .def_readonly("why_no_margin", &ContactCyclesResult::why_no_margin)
      .def_property_readonly(
          "lower", [](const ContactCyclesResult& result) { return result.surfaces.lower; })
      .def_property_readonly(
          "upper", [](const ContactCyclesResult& result) { return result.surfaces.upper; });
  module.def("sweep_loads", &sweep, "prepared"_a, "configuration"_a, "voltages"_a,
             "mechanical_loads"_a);
  module.def("cycle_contact", &cycle, "prepared"_a, "configuration"_a, "count"_a);
}

}  // namespace python
}  // namespace mems_stiction
