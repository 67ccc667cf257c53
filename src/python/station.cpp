/// Load sweeps and contact cycles.

#include <pybind11/stl.h>

#include <memory>

#include "bindings.hpp"
#include "interruptible.hpp"
#include "memory.hpp"
#include "mems_stiction/scan/frame_load.hpp"
#include "mems_stiction/scan/prepared_scan.hpp"
#include "mems_stiction/station/contact_cycles.hpp"
#include "mems_stiction/station/load_sweep.hpp"

namespace mems_stiction {
namespace python {
namespace {

namespace py = pybind11;

using Sweep = std::shared_ptr<LoadSweepResult>;
using Cycles = std::shared_ptr<ContactCyclesResult>;

Sweep sweep(const PreparedScan& prepared, const Configuration& configuration, const std::vector<double>& voltages,
            const std::vector<double>& mechanical_loads) {
  return interruptible([&](const std::atomic<bool>& cancel) {
    RunControl control;
    control.cancel = &cancel;
    return std::make_shared<LoadSweepResult>(
        sweepLoads(onFrame(configuration.model, configuration.device, prepared.surfaces), prepared.model_surfaces,
                   {voltages, mechanical_loads}, configuration.device, configuration.uncertainty, control));
  });
}

Cycles cycle(const PreparedScan& prepared, const Configuration& configuration, int count) {
  return interruptible([&](const std::atomic<bool>& cancel) {
    RunControl control;
    control.cancel = &cancel;
    return std::make_shared<ContactCyclesResult>(
        cycleContacts(onFrame(configuration.model, configuration.device, prepared.surfaces), prepared.model_surfaces,
                      count, configuration.device, configuration.uncertainty, control));
  });
}

Records pointsOf(const Sweep& result) {
  Fields<LoadSweepRow> fields;
  const LoadSweepRow& row = fields.sample;
  fields("direction", row.direction);
  fields("voltage", row.voltage);
  fields("mechanical_load", row.mechanical_load);
  fields("status", row.status);
  fields("is_open", row.is_open);
  fields("pull_off_force", row.pull_off_force);
  fields("van_der_waals_force", row.van_der_waals_force);
  fields("electrostatic_force", row.electrostatic_force);
  fields("normal_load", row.normal_load);
  fields("contact_area", row.contact_area);
  fields("contact_area_jkr", row.contact_area_jkr);
  fields("contact_fraction", row.contact_fraction);
  fields("asperity_count", row.asperity_count);
  fields("approach", row.approach);
  fields("sticks", row.sticks);
  fields("margin", row.margin);
  fields("margin_lower", row.margin_lower);
  fields("holding_margin", row.holding_margin);
  fields("margin_upper", row.margin_upper);
  fields("pull_off_force_lower", row.pull_off_interval.lower);
  fields("pull_off_force_upper", row.pull_off_interval.upper);
  return recordsOf(result->rows, fields.fields, result);
}

Records summariesOf(const Sweep& result) {
  Fields<LoadSweepSummary> fields;
  const LoadSweepSummary& one = fields.sample;
  fields("mechanical_load", one.mechanical_load);
  fields("highest_releasing_voltage", one.highest_releasing_voltage);
  fields("highest_safe_voltage", one.highest_safe_voltage);
  fields("lowest_sticking_voltage", one.lowest_sticking_voltage);
  fields("lowest_safe_voltage", one.lowest_safe_voltage);
  fields("opening_voltage", one.opening_voltage);
  return recordsOf(result->summaries, fields.fields, result);
}

Records cyclesOf(const Cycles& result) {
  Fields<ContactCycle> fields;
  const ContactCycle& one = fields.sample;
  fields("cycle", one.cycle);
  fields("status", one.status);
  fields("pull_off_force", one.pull_off_force);
  fields("van_der_waals_force", one.van_der_waals_force);
  fields("contact_area", one.contact_area);
  fields("contact_area_jkr", one.contact_area_jkr);
  fields("contact_fraction", one.contact_fraction);
  fields("asperity_count", one.asperity_count);
  fields("plastic_count", one.plastic_count);
  fields("rms_height", one.rms_height);
  fields("largest_change", one.largest_change);
  fields("sticks", one.sticks);
  fields("margin", one.margin);
  fields("margin_lower", one.margin_lower);
  fields("margin_upper", one.margin_upper);
  fields("pull_off_force_lower", one.pull_off_interval.lower);
  fields("pull_off_force_upper", one.pull_off_interval.upper);
  return recordsOf(result->cycles, fields.fields, result);
}

}  // namespace

void bindStation(py::module& module) {
  py::class_<LoadSweepResult, Sweep>(module, "LoadSweepResult")
      .def_property_readonly("points", &pointsOf)
      .def_property_readonly("summaries", &summariesOf)
      .def_readonly("pull_in_voltage", &LoadSweepResult::pull_in_voltage);
  py::class_<ContactCyclesResult, Cycles>(module, "ContactCyclesResult")
      .def_property_readonly("cycles", &cyclesOf)
      .def_readonly("first_sticking_cycle", &ContactCyclesResult::first_sticking_cycle)
      .def_property_readonly("lower", [](const ContactCyclesResult& result) { return result.surfaces.lower; })
      .def_property_readonly("upper", [](const ContactCyclesResult& result) { return result.surfaces.upper; });
  module.def("sweep_loads", &sweep);
  module.def("cycle_contact", &cycle);
}

}  // namespace python
}  // namespace mems_stiction
