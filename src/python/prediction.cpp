/// Predictions: one predictor for scan after scan, and what each prediction has.

#include <pybind11/stl.h>

#include <atomic>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "configuration/named_files.hpp"
#include "device/device_evidence.hpp"
#include "device/device_force_fields.hpp"
#include "evaluation/device_scans.hpp"
#include "evaluation/frame_load.hpp"
#include "evaluation/plausibility.hpp"
#include "evaluation/record.hpp"
#include "evaluation/scan_judgement.hpp"
#include "figures.hpp"
#include "half_space/half_space_fields.hpp"
#include "interruptible.hpp"
#include "memory.hpp"
#include "mems_stiction/configuration/configuration_yaml.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/evaluation/half_space_scan.hpp"
#include "mems_stiction/evaluation/scan_predictor.hpp"
#include "numeric/words.hpp"
#include "prediction/force_curve.hpp"
#include "verdict/margin_uncertainty.hpp"
#include "verdict/regime_flags.hpp"
#include "without_lock.hpp"

namespace mems_stiction {
namespace python {
namespace {

namespace py = pybind11;
using py::literals::operator""_a;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr ArealParameters kNoRoughness = {kNone, kNone, kNone, kNone, kNone,
                                          kNone, kNone, kNone, kNone};

/// A prediction with all that its record has.
struct PredictedScan {
  HeightMap scan;        ///< as it came
  SurfacePair surfaces;  ///< cleaned and in place, on the scan's grid
  Prediction prediction;
  std::vector<std::string> scan_warnings;  ///< extras.warnings has those about the settings, too
  RecordExtras extras;
  std::vector<CurvePoint> curve;  ///< over the height
};

using Predicted = std::shared_ptr<PredictedScan>;

/// Runs work(cancel), where the user's Ctrl-C sets `cancel`. Predictions alone are too short for
/// that.
template <typename Work>
Predicted predicting(const Configuration& configuration, const Work& work) {
  if (wantsDeviceForce(configuration.device, configuration.device_force) ||
      mayCallHalfSpace(configuration)) {
    return interruptible(work);
  }
  const WithoutLock unlocked;
  return work(std::atomic<bool>(false));
}

/// The record of a prediction.
/// - @p cancel ends what takes long
Predicted predictedScan(const HeightMap& scan, const PreparedScan& prepared,
                        Prediction&& prediction, const ScanIdentity& identity,
                        const Configuration& configuration, const std::atomic<bool>& cancel) {
  auto predicted = std::make_shared<PredictedScan>();
  predicted->scan = scan;
  predicted->surfaces = prepared.surfaces;
  predicted->prediction = std::move(prediction);
  if (!configuration.model.output.roughness) predicted->prediction.roughness = kNoRoughness;
  predicted->extras.formulation = configuration.model.formulation;
  predicted->extras.preprocessing = prepared.record;
  predicted->extras.provenance = provenanceOf(identity, configuration);
  predicted->scan_warnings = warningsOf(prepared);
  predicted->extras.warnings =
      predictionWarnings(prepared, configuration, predicted->prediction, configuration.model);
  if (configuration.device.isStated() || mayCallHalfSpace(configuration)) {
    const Options on_frame = onFrame(configuration.model, configuration.device, prepared.surfaces);
    Evidence evidence;
    if (wantsDeviceForce(configuration.device, configuration.device_force)) {
      DeviceForce& force = predicted->extras.device_force.emplace();
      evidence = evidenceOfScan(prepared, configuration, Cancellation(cancel), &force);
      addMissing(force.warnings, predicted->extras.warnings);
    }
    const ScanJudgement judged = judgedScan(
        predicted->prediction, prepared, on_frame, configuration, evidence,
        evidence.device ? &*predicted->extras.device_force : nullptr, [&](const auto& solve) {
          HalfSpaceControl control;
          control.cancel = &cancel;
          return solve(control);
        });
    predicted->extras.half_space = judged.begun();
    predicted->extras.verdict = judged.verdict;
  }
  predicted->curve = curveOf(predicted->prediction, configuration.model);
  return predicted;
}

/// What predict_scan does with one scan. Any thread may ask; one is served at a time.
class Predictor {
 public:
  explicit Predictor(Configuration configuration)
      : configuration_(withFilesOfNow(std::move(configuration))), predictor_(configuration_) {}

  /// - @p counter_surface that was measured beside the scan; none: the configured one
  /// - @p notes on how the scan was read
  Predicted predict(const HeightMap& scan, const std::optional<HeightMap>& counter_surface,
                    const std::vector<std::string>& notes, const ScanIdentity& identity) {
    return predicting(configuration_, [&](const std::atomic<bool>& cancel) {
      const std::lock_guard<std::mutex> lock(mutex_);
      predictor_.preparer().setMeasuredCounterSurface(counter_surface.value_or(HeightMap()));
      PreparedScan prepared = predictor_.preparer().prepare(scan);
      prepared.warnings.insert(prepared.warnings.begin(), notes.begin(), notes.end());
      Predicted predicted = predictedScan(scan, prepared, predictor_.predict(prepared), identity,
                                          configuration_, cancel);
      predictor_.preparer().setMeasuredCounterSurface({});
      return predicted;
    });
  }

 private:
  Configuration configuration_;
  ScanPredictor predictor_;
  std::mutex mutex_;
};

/// One scan, prepared once, for settings after settings. Any thread may ask; one is served at a
/// time.
class OneScan {
 public:
  /// - @p notes on how the scan was read
  OneScan(const HeightMap& scan, const std::optional<HeightMap>& counter_surface,
          const Configuration& configuration, const std::vector<std::string>& notes,
          const ScanIdentity& identity)
      : scan_(scan), identity_(identity), configuration_(configuration), predictor_(configuration) {
    const WithoutLock unlocked;
    if (counter_surface) predictor_.preparer().setMeasuredCounterSurface(*counter_surface);
    prepared_ = predictor_.preparer().prepare(scan_);
    prepared_.warnings.insert(prepared_.warnings.begin(), notes.begin(), notes.end());
  }

  /// @throw OptionsError for settings with another preparation than the first.
  Predicted predict(const Configuration& configuration) {
    return predicting(configuration, [&](const std::atomic<bool>& cancel) {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (preparation(configuration) != preparation(configuration_)) {
        throw OptionsError(
            {"the settings of one scan may differ in materials, interface, loads, approach, "
             "output, device, "
             "device_force, uncertainty alone; output/roughness and all that bears on the scan and "
             "its counter-surface "
             "must be the same"});
      }
      predictor_.setOptions(configuration.model);
      predictor_.setDevice(configuration.device);
      Prediction prediction =
          is_seen_ ? predictor_.predictAgain(prepared_) : predictor_.predict(prepared_);
      is_seen_ = true;
      return predictedScan(scan_, prepared_, std::move(prediction), identity_, configuration,
                           cancel);
    });
  }

  std::vector<std::string> warnings() const { return warningsOf(prepared_); }

 private:
  /// What bears on the preparation, as text.
  static std::string preparation(const Configuration& configuration) {
    Configuration alone = configuration;
    alone.model = Options();
    alone.model.output.roughness = configuration.model.output.roughness;
    alone.device = DeviceOptions();
    alone.device_force = DeviceForceOptions();
    alone.uncertainty = UncertaintyOptions();
    alone.half_space = HalfSpaceOptions();
    return toYaml(alone);
  }

  HeightMap scan_;
  ScanIdentity identity_;
  Configuration configuration_;
  ScanPredictor predictor_;
  PreparedScan prepared_;
  bool is_seen_ = false;
  std::mutex mutex_;
};

template <typename Visitor>
void visitPredictionFigures(const PredictedScan& predicted, Visitor&& visit) {
  visitPredictionFields(predicted.prediction, visit);
  visit({"formulation", "", "whose answer it is"}, predicted.extras.formulation);
  visit({"regime_flags", "",
         "where the model leaves its range: bits, of which flags has the names (doc/validity.md)"},
        regimeFlags(predicted.prediction, predicted.scan.cellArea()));
  const Provenance provenance = predicted.extras.provenance.value_or(Provenance());
  visitScanIdentityFields(provenance, visit);
}

py::dict figuresOfPrediction(const PredictedScan& predicted) {
  return dictionaryOf([&](auto& fields) { visitPredictionFigures(predicted, fields); });
}

std::optional<py::dict> verdictOfScan(const PredictedScan& predicted) {
  if (!predicted.extras.verdict) return std::nullopt;
  return verdictFigures(*predicted.extras.verdict);
}

std::optional<py::dict> deviceForceOfScan(const PredictedScan& predicted) {
  if (!predicted.extras.device_force) return std::nullopt;
  return dictionaryOf(
      [&](auto& fields) { visitDeviceForceFields(*predicted.extras.device_force, fields); });
}

std::optional<py::dict> halfSpaceOfScan(const PredictedScan& predicted) {
  if (!predicted.extras.half_space) return std::nullopt;
  return dictionaryOf([&](auto& fields) {
    visitHalfSpaceFields(*predicted.extras.half_space, fields);
    visitHalfSpaceStiffness(*predicted.extras.half_space, fields);
  });
}

py::dict roughnessOfScan(const PredictedScan& predicted) {
  return dictionaryOf([&](auto& fields) {
    visitRoughnessFields(predicted.prediction.roughness, fields);
    visitSpatialRoughnessFields(predicted.prediction.spatial_roughness, fields);
  });
}

Records asperitiesOf(const Predicted& predicted) {
  return recordsOf(predicted->prediction.asperities, predicted,
                   [](const Asperity& one, auto& fields) { visitAsperityFields(one, fields); });
}

Records energyCurveOf(const Predicted& predicted) {
  return recordsOf(
      predicted->prediction.energy_curve, predicted,
      [](const EnergyPoint& point, auto& fields) { visitEnergyPointFields(point, fields); });
}

Records displacementCurveOf(const Predicted& predicted) {
  return recordsOf(predicted->prediction.curve, predicted,
                   [](const SeparationCurvePoint& point, auto& fields) {
                     visitSeparationPointFields(point, fields);
                   });
}

Records heightCurveOf(const Predicted& predicted) {
  return recordsOf(predicted->curve, predicted, [](const CurvePoint& point, auto& fields) {
    visitCurvePointFields(point, fields);
  });
}

/// Pull-off force over the prediction's, of samples of the uncertain constants, ascending; empty
/// without a list of contacts.
std::vector<double> spreadOf(const PredictedScan& predicted, const Configuration& configuration) {
  const WithoutLock unlocked;
  return adhesionSpread(predicted.prediction, configuration.model, configuration.uncertainty)
      .pull_off;
}

}  // namespace

void bindPrediction(py::module& module) {
  DeclaredFields of_prediction, of_verdict;
  visitPredictionFigures({}, of_prediction);
  visitJudgedFields({}, of_verdict);
  of_prediction.addTo(module, "PredictionFigures");
  of_verdict.addTo(module, "VerdictFigures");

  py::class_<PredictedScan, Predicted>(module, "PredictedScan")
      .def_property_readonly("figures", &figuresOfPrediction)
      .def_property_readonly("verdict", &verdictOfScan)
      .def_property_readonly("device_force", &deviceForceOfScan)
      .def_property_readonly("half_space", &halfSpaceOfScan)
      .def_property_readonly("roughness", &roughnessOfScan)
      .def_property_readonly(
          "flag_names",
          [](const PredictedScan& one) {
            return regimeFlagNames(regimeFlags(one.prediction, one.scan.cellArea()));
          })
      .def_property_readonly("model_doubt",
                             [](const PredictedScan& one) { return modelDoubt(one.prediction); })
      .def_property_readonly(
          "preprocessing",
          [](const PredictedScan& one) { return stepsOf(one.extras.preprocessing); })
      .def_readonly("scan_warnings", &PredictedScan::scan_warnings)
      .def_property_readonly("warnings",
                             [](const PredictedScan& one) { return one.extras.warnings; })
      .def_property_readonly("scan", [](const PredictedScan& one) { return one.scan; })
      .def_property_readonly("lower", [](const PredictedScan& one) { return one.surfaces.lower; })
      .def_property_readonly("upper", [](const PredictedScan& one) { return one.surfaces.upper; })
      .def_property_readonly(
          "contact_map",
          [](const PredictedScan& one) { return memoryOf(one.prediction.contact_map); })
      .def_property_readonly(
          "deformed_lower",
          [](const PredictedScan& one) { return memoryOf(one.prediction.deformed_lower); })
      .def_property_readonly(
          "deformed_upper",
          [](const PredictedScan& one) { return memoryOf(one.prediction.deformed_upper); })
      .def_property_readonly(
          "pressure", [](const PredictedScan& one) { return memoryOf(one.prediction.pressure); })
      .def_property_readonly("asperities", &asperitiesOf)
      .def_property_readonly("energy_curve", &energyCurveOf)
      .def_property_readonly("curve", &displacementCurveOf)
      .def_property_readonly("curve_over_height", &heightCurveOf)
      .def("spread", &spreadOf, "configuration"_a)
      .def(
          "json",
          [](const PredictedScan& one, const std::string& file) {
            return jsonRecord(file, one.scan, one.prediction, one.extras);
          },
          "file"_a);

  py::class_<Predictor>(module, "Predictor")
      .def(py::init<Configuration>(), "configuration"_a)
      .def("predict", &Predictor::predict, "scan"_a, "counter_surface"_a, "notes"_a, "identity"_a);
  py::class_<OneScan>(module, "OneScan")
      .def(py::init<const HeightMap&, const std::optional<HeightMap>&, const Configuration&,
                    const std::vector<std::string>&, const ScanIdentity&>(),
           "scan"_a, "counter_surface"_a, "configuration"_a, "notes"_a, "identity"_a)
      .def_property_readonly("scan_warnings", &OneScan::warnings)
      .def("predict", &OneScan::predict, "configuration"_a);
  module.def("regime_flag_sentences", &regimeFlagSentences, "flags"_a, "doubt"_a);
}

}  // namespace python
}  // namespace mems_stiction
