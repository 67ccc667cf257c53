/// The force of a whole device, from all scans of its surfaces.

#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "device/device_force_fields.hpp"
#include "device/device_force_lists.hpp"
#include "device_scan.hpp"
#include "evaluation/device_prediction.hpp"
#include "figures.hpp"
#include "interruptible.hpp"
#include "memory.hpp"

namespace mems_stiction {
namespace python {
namespace {

namespace py = pybind11;
using py::literals::operator""_a;

using SharedDevice = std::shared_ptr<DevicePrediction>;

/// Its file, or "scan 2".
std::string nameOf(const std::vector<DeviceScan>& scans, std::size_t place,
                   const std::string& kind) {
  return scans[place].name.empty() ? kind + " " + std::to_string(place + 1) : scans[place].name;
}

SharedDevice predictDevice(const std::vector<DeviceScan>& scans,
                           const std::vector<DeviceScan>& counter_surface,
                           const Configuration& configuration) {
  return interruptible([&](const std::atomic<bool>& cancel) {
    const Cancellation check(cancel);
    DevicePredictor predictor(configuration);
    addScans(scans, counter_surface, check, predictor);
    auto predicted = std::make_shared<DevicePrediction>(predictor.predict(check));
    predictor.judge(*predicted, [&](const auto& solve) {
      HalfSpaceControl control;
      control.cancel = &cancel;
      return solve(control);
    });
    return predicted;
  });
}

/// Figures and realisations alone, one for each model.
std::vector<SharedDevice> predictDeviceUnder(const std::vector<DeviceScan>& scans,
                                             const std::vector<DeviceScan>& counter_surface,
                                             const Configuration& configuration,
                                             const std::vector<Configuration>& models) {
  return interruptible([&](const std::atomic<bool>& cancel) {
    const Cancellation check(cancel);
    DevicePredictor predictor(configuration);
    addScans(scans, counter_surface, check, predictor);
    std::vector<Options> options;
    options.reserve(models.size());
    for (const Configuration& model : models) options.push_back(model.model);
    std::vector<SharedDevice> predicted;
    for (DeviceForce& force : predictor.forces(options, check)) {
      predicted.push_back(std::make_shared<DevicePrediction>());
      predicted.back()->force = std::move(force);
      predicted.back()->scan_warnings = predictor.scanWarnings();
    }
    return predicted;
  });
}

py::dict figuresOfDevice(const DevicePrediction& predicted) {
  return dictionaryOf([&](auto& fields) { visitDeviceForceFields(predicted.force, fields); });
}

std::optional<py::dict> verdictOfDevice(const DevicePrediction& predicted) {
  if (!predicted.verdict) return std::nullopt;
  return verdictFigures(*predicted.verdict);
}

Records realisationsOf(const SharedDevice& predicted) {
  return recordsOf(predicted->force.realisations, predicted,
                   [](const auto& item, auto& fields) { visitRealisationFields(item, fields); });
}

Records partsOf(const SharedDevice& predicted) {
  return recordsOf(predicted->force.parts_of_scans, predicted,
                   [](const auto& item, auto& fields) { visitPartOfScanFields(item, fields); });
}

Records spectrumOf(const SharedDevice& predicted) {
  return recordsOf(predicted->force.spectrum, predicted,
                   [](const auto& item, auto& fields) { visitBandFields(item, fields); });
}

}  // namespace

void addScans(const std::vector<DeviceScan>& scans, const std::vector<DeviceScan>& counter_surface,
              const Cancellation& check, DevicePredictor& predictor) {
  for (std::size_t i = 0; i < scans.size(); ++i) {
    check(0.0);
    predictor.add(nameOf(scans, i, "scan"), scans[i].scan, scans[i].notes, scans[i].identity);
  }
  for (std::size_t i = 0; i < counter_surface.size(); ++i) {
    check(0.0);
    predictor.addCounterSurface(nameOf(counter_surface, i, "counter-surface"),
                                counter_surface[i].scan, counter_surface[i].notes);
  }
}

void bindDevice(py::module& module) {
  DeclaredFields declared;
  const DeviceForce none;
  visitDeviceForceFields(none, declared);
  declared.addTo(module, "DeviceForceFigures");

  py::class_<DeviceScan>(module, "DeviceScan")
      .def(py::init([](const std::string& name, const HeightMap& scan,
                       const std::vector<std::string>& notes, const ScanIdentity& identity) {
             return DeviceScan{name, scan, notes, identity};
           }),
           "name"_a, "scan"_a, "notes"_a, "identity"_a);
  py::class_<DevicePrediction, SharedDevice>(module, "DevicePrediction")
      .def_property_readonly("figures", &figuresOfDevice)
      .def_property_readonly("verdict", &verdictOfDevice)
      .def_property_readonly("scans", [](const DevicePrediction& one) { return one.scans; })
      .def_property_readonly("scan_warnings",
                             [](const DevicePrediction& one) { return one.scan_warnings; })
      .def_property_readonly("force_warnings",
                             [](const DevicePrediction& one) { return one.force.warnings; })
      .def_property_readonly("warnings", &DevicePrediction::warnings)
      .def_property_readonly("realisations", &realisationsOf)
      .def_property_readonly("parts_of_scans", &partsOf)
      .def_property_readonly("spectrum", &spectrumOf)
      .def_property_readonly("work_deviation",
                             [](const DevicePrediction& one) { return one.force.work_deviation; })
      .def_property_readonly("made_surface",
                             [](const DevicePrediction& one) { return one.force.made_surface; })
      .def("json", &deviceJsonRecord);
  module.def("predict_device", &predictDevice, "scans"_a, "counter_surface"_a, "configuration"_a);
  module.def("predict_device_under", &predictDeviceUnder, "scans"_a, "counter_surface"_a,
             "configuration"_a, "models"_a);
}

}  // namespace python
}  // namespace mems_stiction
