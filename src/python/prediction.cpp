/// Predictions: one predictor for scan after scan, and what each prediction holds.

#include <pybind11/stl.h>

#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "bindings.hpp"
#include "figures.hpp"
#include "memory.hpp"
#include "mems_stiction/height_map/scan_sanity.hpp"
#include "mems_stiction/prediction/force_curve.hpp"
#include "mems_stiction/scan/frame_load.hpp"
#include "mems_stiction/scan/plausibility.hpp"
#include "mems_stiction/scan/record.hpp"
#include "mems_stiction/scan/scan_predictor.hpp"
#include "mems_stiction/verdict/regime_flags.hpp"
#include "preprocess_steps.hpp"

namespace mems_stiction {
namespace python {
namespace {

namespace py = pybind11;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr ArealParameters kNoRoughness = {kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone};

/// A prediction with all that its record holds.
struct PredictedScan {
  HeightMap scan;        ///< as it came
  SurfacePair surfaces;  ///< cleaned and in place, on the scan's grid
  Prediction prediction;
  std::vector<std::string> scan_warnings;  ///< extras.warnings has those about the settings, too
  RecordExtras extras;
  std::vector<CurvePoint> curve;  ///< over the height
};

using Predicted = std::shared_ptr<PredictedScan>;

/// What predict_scan does with one scan. Any thread may ask; one is served at a time.
class Predictor {
 public:
  explicit Predictor(Configuration configuration)
      : configuration_(std::move(configuration)), predictor_(configuration_) {}

  /// - @p counter_surface that was measured beside the scan; null: the configured one
  Predicted predict(const HeightMap& scan, const HeightMap* counter_surface) {
    const py::gil_scoped_release unlocked;
    const std::lock_guard<std::mutex> lock(mutex_);
    predictor_.preparer().setMeasuredCounterSurface(counter_surface != nullptr ? *counter_surface : HeightMap());
    const PreparedScan prepared = predictor_.preparer().prepare(scan);
    auto predicted = std::make_shared<PredictedScan>();
    predicted->scan = scan;
    predicted->surfaces = prepared.surfaces;
    predicted->prediction = predictor_.predict(prepared);
    if (!configuration_.model.output.roughness) predicted->prediction.roughness = kNoRoughness;
    predicted->extras.formulation = predictor_.options().formulation;
    predicted->extras.preprocessing = prepared.record;
    predicted->extras.provenance = provenanceOf({}, configuration_);
    predicted->scan_warnings = scanWarnings(scan);
    predicted->extras.warnings = predicted->scan_warnings;
    for (std::string& warning : settingsWarnings(configuration_)) {
      predicted->extras.warnings.push_back(std::move(warning));
    }
    if (configuration_.device.isStated()) {
      const Options on_frame = onFrame(configuration_.model, configuration_.device, prepared.surfaces);
      predicted->extras.verdict = verdictOf(predicted->prediction, configuration_.device, configuration_.uncertainty,
                                            on_frame, scan.cellArea());
    }
    predicted->curve = curveOf(predicted->prediction, predictor_.options().interface);
    predictor_.preparer().setMeasuredCounterSurface({});
    return predicted;
  }

 private:
  Configuration configuration_;
  ScanPredictor predictor_;
  std::mutex mutex_;
};

py::dict figuresOf(const PredictedScan& predicted) {
  DictionaryFields fields;
  visitPredictionFields(predicted.prediction, fields);
  fields("formulation", predicted.extras.formulation, "");
  fields("regime_flags", regimeFlags(predicted.prediction, predicted.scan.cellArea()), "");
  return fields.dictionary;
}

py::object verdictOfScan(const PredictedScan& predicted) {
  if (!predicted.extras.verdict) return py::none();
  return verdictFigures(*predicted.extras.verdict);
}

py::dict roughnessOfScan(const PredictedScan& predicted) {
  DictionaryFields fields;
  visitRoughnessFields(predicted.prediction.roughness, fields);
  visitSpatialRoughnessFields(predicted.prediction.spatial_roughness, fields);
  return fields.dictionary;
}

std::vector<Field> asperityFields() {
  Fields<Asperity> fields;
  const Asperity& one = fields.sample;
  fields("x", one.x);
  fields("y", one.y);
  fields("z", one.z);
  fields("cap_radius", one.cap_radius);
  fields("composite_radius", one.composite_radius);
  fields("load", one.load);
  fields("contact_radius", one.contact_radius);
  fields("tilt", one.tilt);
  fields("plasticity_index", one.plasticity_index);
  fields("tabor_parameter", one.tabor_parameter);
  fields("area", one.area);
  fields("is_at_border", one.is_at_border);
  fields("regime", one.regime);
  return fields.fields;
}

template <typename Record, typename Visit>
std::vector<Field> fieldsOf(const Visit& visit) {
  Fields<Record> fields;
  visit(fields.sample, fields);
  return fields.fields;
}

Records asperitiesOf(const Predicted& predicted) {
  return recordsOf(predicted->prediction.asperities, asperityFields(), predicted);
}

Records energyCurveOf(const Predicted& predicted) {
  return recordsOf(
      predicted->prediction.energy_curve,
      fieldsOf<EnergyPoint>([](const auto& point, auto& fields) { visitEnergyPointFields(point, fields); }), predicted);
}

Records displacementCurveOf(const Predicted& predicted) {
  return recordsOf(predicted->prediction.curve, fieldsOf<SeparationCurvePoint>([](const auto& point, auto& fields) {
                     visitSeparationPointFields(point, fields);
                   }),
                   predicted);
}

Records heightCurveOf(const Predicted& predicted) {
  return recordsOf(predicted->curve,
                   fieldsOf<CurvePoint>([](const auto& point, auto& fields) { visitCurvePointFields(point, fields); }),
                   predicted);
}

/// Pull-off force over the prediction's, of samples of the uncertain constants, ascending; empty without a list of contacts.
std::vector<double> spreadOf(const PredictedScan& predicted, const Configuration& configuration) {
  const py::gil_scoped_release unlocked;
  return adhesionSpread(predicted.prediction, configuration.model, configuration.uncertainty).pull_off;
}

/// {"prediction": {name: unit}, "verdict": ...}
py::dict predictionUnits() {
  UnitFields of_prediction, of_verdict;
  const Prediction prediction;
  const Verdict verdict;
  visitPredictionFields(prediction, of_prediction);
  visitVerdictFields(verdict, of_verdict);
  of_verdict("verdict_by", "", "");
  py::dict units;
  units["prediction"] = of_prediction.units;
  units["verdict"] = of_verdict.units;
  return units;
}

}  // namespace

void bindPrediction(py::module& module) {
  py::class_<PredictedScan, Predicted>(module, "PredictedScan")
      .def_property_readonly("figures", &figuresOf)
      .def_property_readonly("verdict", &verdictOfScan)
      .def_property_readonly("roughness", &roughnessOfScan)
      .def_property_readonly(
          "flag_names",
          [](const PredictedScan& one) { return regimeFlagNames(regimeFlags(one.prediction, one.scan.cellArea())); })
      .def_property_readonly("preprocessing",
                             [](const PredictedScan& one) { return stepsOf(one.extras.preprocessing); })
      .def_readonly("scan_warnings", &PredictedScan::scan_warnings)
      .def_property_readonly("warnings", [](const PredictedScan& one) { return one.extras.warnings; })
      .def_property_readonly("scan", [](const PredictedScan& one) { return one.scan; })
      .def_property_readonly("lower", [](const PredictedScan& one) { return one.surfaces.lower; })
      .def_property_readonly("upper", [](const PredictedScan& one) { return one.surfaces.upper; })
      .def_property_readonly("contact_map",
                             [](const PredictedScan& one) { return memoryOf(one.prediction.contact_map); })
      .def_property_readonly("deformed_lower",
                             [](const PredictedScan& one) { return memoryOf(one.prediction.deformed_lower); })
      .def_property_readonly("deformed_upper",
                             [](const PredictedScan& one) { return memoryOf(one.prediction.deformed_upper); })
      .def_property_readonly("pressure", [](const PredictedScan& one) { return memoryOf(one.prediction.pressure); })
      .def_property_readonly("asperities", &asperitiesOf)
      .def_property_readonly("energy_curve", &energyCurveOf)
      .def_property_readonly("curve", &displacementCurveOf)
      .def_property_readonly("curve_over_height", &heightCurveOf)
      .def("spread", &spreadOf)
      .def("json", [](const PredictedScan& one, const std::string& file) {
        return jsonRecord(file, one.scan, one.prediction, one.extras);
      });

  py::class_<Predictor>(module, "Predictor").def(py::init<Configuration>()).def("predict", &Predictor::predict);
  module.def("prediction_units", &predictionUnits);
}

}  // namespace python
}  // namespace mems_stiction
