#include "evaluation/cleaning_spread.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>

#include "errors/short_number.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/evaluation/scan_predictor.hpp"
#include "prediction/asked_output.hpp"
#include "prediction/prediction_fields.hpp"
#include "preprocess/tilt.hpp"
#include "verdict/margin_uncertainty.hpp"

namespace mems_stiction {
namespace {

struct Levelling {
  const char* name;
  LineAlignment lines;
  LevelShape shape;
};

constexpr Levelling kLevellings[] = {
    {"not levelled", LineAlignment::kNone, LevelShape::kNone},
    {"plane", LineAlignment::kNone, LevelShape::kPlane},
    {"parabola", LineAlignment::kNone, LevelShape::kPolynomial},
    {"row medians and plane", LineAlignment::kMedian, LevelShape::kPlane}};
constexpr std::size_t kNotLevelled = 0;
constexpr std::size_t kPlane = 1;

PipelineOptions cleaned(PipelineOptions options, const Levelling& levelling, bool without_spikes) {
  options.lines.method = levelling.lines;
  options.level.shape = levelling.shape;
  options.spikes.enabled = without_spikes;
  options.fill.enabled = options.fill.enabled || without_spikes;
  return options;
}

CleaningRow rowOf(const std::string& cleaning, const HeightMap& scan,
                  const Configuration& configuration, const std::optional<DeviceScale>& scale) {
  CleaningRow row;
  row.cleaning = cleaning;
  try {
    ScanPredictor predictor(configuration);
    const Prediction prediction = predictor.predict(scan);
    row.is_reasonable = true;
    row.status = prediction.status;
    row.rms_height = prediction.rms_height;
    row.pull_off_force = prediction.pull_off_force;
    row.contact_area = prediction.contact_area;
    row.apparent_work_of_adhesion = apparentWorkOfAdhesion(prediction, predictor.options());
    row.asperity_count = prediction.asperity_count;
    Evidence evidence;
    if (scale) evidence.device = scale->under(prediction);
    const Verdict verdict = verdictOf(prediction, configuration.device, configuration.uncertainty,
                                      predictor.options(), scan.cellArea(), evidence);
    row.margin = verdict.margin;
    row.margin_lower = verdict.margin_lower;
    row.margin_upper = verdict.margin_upper;
    row.sticks = verdict.sticks;
  } catch (const SurfaceError& error) {
    row.message = error.what();
  }
  return row;
}

/// Largest over smallest; NaN if there is none.
double factorOf(const std::vector<double>& values) {
  if (values.empty()) return CleaningRow::kUnknown;
  const auto [smallest, largest] = std::minmax_element(values.begin(), values.end());
  return *largest / *smallest;
}

/// Lets a range of factors reach to a figure, if there is such a factor.
void include(double value, double configured, FactorRange& range) {
  const double factor = value / configured;
  if (!std::isfinite(factor) || !(factor > 0.0)) return;
  range.lowest = std::min(range.lowest, factor);
  range.highest = std::max(range.highest, factor);
}

}  // namespace

std::vector<CleaningRow> cleaningSpread(const HeightMap& scan, const Configuration& configuration,
                                        const std::optional<DeviceScale>& scale) {
  Configuration changed = configuration;
  changed.model.output = figuresAlone();
  changed.model.output.roughness = true;
  changed.check();
  std::vector<CleaningRow> rows = {rowOf("as configured", scan, changed, scale)};
  for (const bool without_spikes : {false, true}) {
    const std::size_t first = rows.size();
    for (const Levelling& levelling : kLevellings) {
      changed.preprocessing = cleaned(configuration.preprocessing, levelling, without_spikes);
      rows.push_back(rowOf(std::string(levelling.name) + (without_spikes ? ", spikes filled" : ""),
                           scan, changed, scale));
    }
    CleaningRow& not_levelled = rows[first + kNotLevelled];
    const Tilt tilt = {not_levelled.rms_height, rows[first + kPlane].rms_height};
    if (tilt.isLarge()) not_levelled.is_reasonable = false;
  }
  return rows;
}

CleaningSpread spreadOf(const std::vector<CleaningRow>& rows) {
  CleaningSpread spread;
  std::vector<double> forces;
  std::vector<double> margins;
  for (const CleaningRow& row : rows) {
    if (!row.is_reasonable) continue;
    ++spread.count;
    forces.push_back(row.pull_off_force);
    if (std::isnan(row.margin)) continue;
    margins.push_back(row.margin);
    spread.margin_lower = std::fmin(spread.margin_lower, row.margin_lower);
    spread.margin_upper = std::fmax(spread.margin_upper, row.margin_upper);
  }
  spread.pull_off_factor = factorOf(forces);
  spread.margin_factor = factorOf(margins);
  return spread;
}

CleaningReach reachOf(const std::vector<CleaningRow>& rows) {
  CleaningReach reach;
  for (const CleaningRow& row : rows) {
    if (!row.is_reasonable) continue;
    include(row.pull_off_force, rows.front().pull_off_force, reach.pull_off);
    include(row.apparent_work_of_adhesion, rows.front().apparent_work_of_adhesion,
            reach.apparent_work);
  }
  return reach;
}

std::string cleaningTable(const std::vector<CleaningRow>& rows, const std::string& indent) {
  std::string text = indent +
                     "cleaning                                 rms [m]  pull-off [N]  contacts    "
                     "margin     from       to  sticks\n";
  for (const CleaningRow& row : rows) {
    char line[240];
    if (row.message.empty()) {
      const std::string note = row.is_reasonable ? "" : "  tilted: does not count";
      const std::string status =
          row.status == Status::kEquilibrium ? "" : std::string("  ") + word(row.status);
      const int digits = knownDigits(row.margin, row.margin_lower, row.margin_upper);
      std::snprintf(line, sizeof line, "%-36s  %10s  %12s  %8d  %8s %8s %8s  %s%s%s\n",
                    row.cleaning.c_str(), shortNumber(row.rms_height).c_str(),
                    shortNumber(row.pull_off_force, digits).c_str(), row.asperity_count,
                    shortNumber(row.margin, digits).c_str(),
                    shortNumber(row.margin_lower, digits).c_str(),
                    shortNumber(row.margin_upper, digits).c_str(), sticksText(row.sticks),
                    status.c_str(), note.c_str());
      text += indent + line;
    } else {
      text += indent + row.cleaning + ": " + row.message + "\n";
    }
  }
  const CleaningSpread spread = spreadOf(rows);
  if (spread.count == 0) return text;
  text += indent + "Over " + std::to_string(spread.count) +
          " cleanings the pull-off force changes by a factor " +
          shortNumber(spread.pull_off_factor) + ".\n";
  if (std::isnan(spread.margin_factor)) return text;
  text += indent + "The margin changes by a factor " + shortNumber(spread.margin_factor) +
          "; whichever was right, it lies within " + shortNumber(spread.margin_lower, 2) + " to " +
          shortNumber(spread.margin_upper, 2) + " (95 %).\n";
  return text;
}

}  // namespace mems_stiction
