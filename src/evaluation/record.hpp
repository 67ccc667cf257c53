#pragma once

/// @file
/// A prediction as text for scripts: field names of StictionPrediction, SI units, words for the
/// enumerations.

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/cleaning_spread.hpp"
#include "mems_stiction/configuration/provenance.hpp"
#include "mems_stiction/device/device_force.hpp"
#include "mems_stiction/evaluation/convergence.hpp"
#include "mems_stiction/half_space/half_space_solution.hpp"
#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/prediction/prediction.hpp"
#include "mems_stiction/preprocess/pipeline.hpp"
#include "mems_stiction/settings/figure.hpp"
#include "mems_stiction/verdict/verdict.hpp"
#include "station/load_sweep.hpp"
#include "verdict/margin_uncertainty.hpp"

namespace mems_stiction {

/// The figures of one step of the cleaning.
template <typename Visitor>
void visitStepFields(const PreprocessStep& step, Visitor&& visit) {
  visit({"step"}, step.name);
  visit({"parameters"}, step.parameters);
  visit({"rms_change", "m"}, step.rms_change);
  visit({"changed_pixels"}, step.changed_pixels);
  visit({"invalid_pixels"}, step.invalid_pixels);
  if (!std::isnan(step.tilt_left)) visit({"tilt_left", "m"}, step.tilt_left);
}

/// What a record may have beside the prediction; each is left out when empty.
struct RecordExtras {
  std::string channel;                      ///< which channel of the file
  std::string formulation;                  ///< that the prediction is of
  std::optional<Verdict> verdict;           ///< on the device
  std::optional<Provenance> provenance;     ///< version, hash of the settings, what was scanned
  std::optional<DeviceForce> device_force;  ///< a map of its figures; the verdict rests on it
  std::vector<std::string> warnings;        ///< about scan and settings: a list of texts
  std::optional<ForceInterval> pull_off_interval;  ///< a sentence in YAML's comments, for people
  bool has_curve = false;                          ///< the prediction's curve, as a list of maps
  PreprocessRecord
      preprocessing;  ///< a list of maps: step, parameters, rms_change, changed_pixels, ...
  std::vector<ConvergenceRow> convergence;  ///< a list of maps, one per resolution
  std::vector<CleaningRow>
      cleanings;  ///< a list of maps, one per cleaning, and a map of their spread
  std::optional<SolvedHalfSpace>
      half_space;  ///< a map of its figures, with the list of maps `curve`; beside a verdict
                   ///< also verdict_by: who judged
  std::optional<LoadSweepResult> sweep;  ///< a map: pull_in_voltage, pull_in_reason, lists of maps
                                         ///< `summaries` and `points`
};

/// One YAML document, from its "---" to the end of its last line. Numbers that are not finite are
/// .nan, .inf, -.inf. The energy curve is a list of maps, left out when the prediction has none;
/// spatial roughness is a part of `roughness`, left out when it was not computed. Flags of the
/// model's range are there with and without a device. All fields have all digits. For people,
/// comments at the end repeat the pull-off force and the margin, rounded to what is known, and
/// convergence, cleanings and the sweep as tables.
/// - @p file the scan's name, as the user wrote it
std::string yamlRecord(const std::string& file, const HeightMap& scan, const Prediction& prediction,
                       const RecordExtras& extras = {});

/// The same as one JSON object on one line, without a line end. Numbers that are not finite are
/// null: JSON has no others.
std::string jsonRecord(const std::string& file, const HeightMap& scan, const Prediction& prediction,
                       const RecordExtras& extras = {});

}  // namespace mems_stiction
