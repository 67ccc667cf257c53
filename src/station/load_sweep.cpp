#include "station/load_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"
#include "station/remaining_contact.hpp"
#include "verdict/electrode_hold.hpp"
#include "verdict/finding.hpp"

namespace mems_stiction {
namespace {

constexpr double kMostStates = 1e6;  // each is a prediction: days
/// Under so many loads a device's own force is found at most, and under so many presses of them.
constexpr std::size_t kMostOfDevice = 16;
constexpr std::size_t kMostPresses = 4;

/// Of an ascending list so many, evenly, with the first and the last.
std::vector<double> fewOf(const std::vector<double>& values, std::size_t most) {
  if (values.size() <= most) return values;
  std::vector<double> few;
  for (std::size_t i = 0; i < most; ++i)
    few.push_back(values[i * (values.size() - 1) / (most - 1)]);
  return few;
}

/// The first violation of its kind, and how many more there are: a list may have a million of them.
void addFirst(const std::string& first, std::size_t count, std::vector<std::string>& violations) {
  if (count == 0) return;
  violations.push_back(first +
                       (count > 1 ? " (and " + countText(count - 1, "more such value") + ")" : ""));
}

void addListViolations(const std::string& name, const std::vector<double>& values,
                       const std::string& unit, std::vector<std::string>& violations) {
  if (values.empty())
    violations.push_back(name + ": an empty list is not allowed, must hold one value at least");
  const auto is_wrong = [](double value) { return !std::isfinite(value) || value < 0.0; };
  const auto wrong = std::find_if(values.begin(), values.end(), is_wrong);
  if (wrong != values.end()) {
    addFirst(
        name + ": " + numberText(*wrong) + " " + unit + " is not allowed, must be >= 0 " + unit,
        static_cast<std::size_t>(std::count_if(wrong, values.end(), is_wrong)), violations);
  }
  std::string first;
  std::size_t count = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i] > values[i - 1] || ++count > 1) continue;
    first = name + ": " + numberText(values[i]) + " " + unit + " after " +
            numberText(values[i - 1]) + " " + unit + " is not allowed, must ascend";
  }
  addFirst(first, count, violations);
}

/// The force of the voltage's field that holds the closed device; what stays without the voltage is
/// in the pull-off force [N].
double holdingField(const DeviceOptions& device, const InterfaceOptions& interface,
                    const RemainingState& state, const Prediction& contact,
                    const LoadOptions& load) {
  const auto hold = voltageHold(device, interface, load, contact.mean_gap);
  return hold ? hold->force : state.voltageForce() * device.contact_area / contact.nominal_area;
}

/// What opens a beam that is held, over all that holds it [-]; NaN where a share is not known.
double holdingMarginOfBeam(const DeviceOptions& device, const InterfaceOptions& interface,
                           const RemainingState& state, const Prediction& contact,
                           const LoadOptions& load, const LoadSweepRow& row) {
  if (!(row.ratio() > 0.0))
    return row.ratio();  // it stays down without a load, too (compressed beams)
  const Beam beam = device.beam();
  const double area_ratio = device.contact_area / contact.nominal_area;
  const bool has_force = device.hasBeamContact();
  const auto shareOfForce = [&](double force) {
    if (force == 0.0) return 0.0;
    return has_force ? force * area_ratio / beamForce(beam) : Verdict::kNotStated;
  };
  double shares = 1.0 / row.ratio() + shareOfForce(state.mechanical_load);
  if (const auto hold = voltageHold(device, interface, load, contact.mean_gap)) {
    shares += row.is_peeled ? hold->work / peelNumber(beam, 1.0) : hold->force / beamForce(beam);
  } else {
    shares += shareOfForce(state.voltageForce());
  }
  return 1.0 / shares;
}

/// One loop of the voltage at one mechanical load.
class Loop {
 public:
  Loop(const Options& options, const SurfacePair& surfaces, const DeviceOptions& device,
       const UncertaintyOptions& uncertainty, const std::vector<LoadedScale>& scales,
       const MeasuredScan& scan, double pull_in)
      : options_(options),
        device_(device),
        uncertainty_(uncertainty),
        scales_(scales),
        contact_(options, surfaces, scan),
        cell_area_(scan.cell_area),
        pull_in_(pull_in) {}

  /// Of the last contact that was made.
  const Verdict& verdict() const { return verdict_; }

  LoadSweepRow next(double voltage, double mechanical_load, SweepDirection direction) {
    LoadSweepRow row;
    row.voltage = voltage;
    row.mechanical_load = mechanical_load;
    row.direction = direction;
    if (!is_open_) fill(contact_.advance(voltage, mechanical_load), row);
    const bool closes_again = row.voltage >= pull_in_;
    if (!is_open_ && direction == SweepDirection::kDown && row.holding_margin >= 1.0 &&
        !closes_again) {
      is_open_ = true;
      word_at_opening_ = row.sticks;  // the median opens it: its interval may leave that open
    }
    if (!is_open_) {
      row.lands = landsAt(row);
      return row;
    }

    LoadSweepRow open;
    open.voltage = voltage;
    open.mechanical_load = mechanical_load;
    open.direction = direction;
    open.status = contact_.contact().status;
    open.is_open = true;
    open.sticks = word_at_opening_;
    open.lands = Lands::kNo;
    return open;
  }

 private:
  Lands landsAt(const LoadSweepRow& row) {
    if (std::isnan(pull_in_)) return Lands::kUnknown;
    has_landed_ = has_landed_ || row.voltage >= pull_in_;
    if (!has_landed_) return Lands::kNo;
    return row.voltage >= pull_in_ || !std::isnan(row.holding_margin) ? Lands::kYes
                                                                      : Lands::kUnknown;
  }

  /// The least that presses no less; the last one where there is none.
  const LoadedScale* scaleAt(const LoadSweepRow& row) const {
    const auto found = std::find_if(scales_.begin(), scales_.end(), [&](const LoadedScale& beside) {
      return beside.voltage >= row.voltage && beside.mechanical_load >= row.mechanical_load;
    });
    if (found != scales_.end()) return &*found;
    return scales_.empty() ? nullptr : &scales_.back();
  }

  void fill(const RemainingState& state, LoadSweepRow& row) {
    const Prediction& contact = contact_.contact();
    if (state.is_searched) {
      Evidence evidence;
      if (const LoadedScale* beside = scaleAt(row)) evidence.device = beside->scale.under(contact);
      verdict_ = verdictOf(contact, device_, uncertainty_, options_, cell_area_, evidence);
      pull_off_interval_ = pullOffInterval(contact, options_, uncertainty_);
    }
    row.status = contact.status;
    row.is_lower_bound = contact.isLowerBound();
    row.pull_off_force = contact.pull_off_force;
    row.van_der_waals_force = contact.van_der_waals_force;
    row.electrostatic_force = state.electrostatic_force;
    row.normal_load = state.normal_load;
    row.contact_area = state.contact_area;
    row.contact_area_jkr = state.contact_area_jkr;
    row.contact_fraction = state.contact_fraction;
    row.asperity_count = contact.asperity_count;
    row.approach = contact.approach;
    row.sticks = verdict_.sticks;
    row.margin = verdict_.margin;
    row.margin_lower = verdict_.margin_lower;
    row.margin_upper = verdict_.margin_upper;
    row.pull_off_interval = pull_off_interval_;
    row.peel_number = verdict_.peel_number;
    row.peel_number_lower = verdict_.peel_number_lower;
    row.peel_number_upper = verdict_.peel_number_upper;
    row.is_peeled = isPeeled(verdict_);
    const bool is_known = contact.status == Status::kEquilibrium || contact.model.knows_every_load;
    if (!is_known) return;
    LoadOptions load = options_.load;
    load.voltage = state.voltage;
    if (device_.hasBeam() && !device_.hasSpring()) {
      row.holding_margin =
          holdingMarginOfBeam(device_, options_.interface, state, contact, load, row);
      return;
    }
    if (std::isnan(verdict_.margin)) return;
    const double pressing = state.mechanical_load * device_.contact_area / contact.nominal_area;
    row.holding_margin = device_.spring_stiffness * device_.travel /
                         (verdict_.device_pull_off_force + pressing +
                          holdingField(device_, options_.interface, state, contact, load));
    // a beam beside the spring is held by what it holds without a load, at least
    if (device_.hasBeam()) row.holding_margin = std::min(row.holding_margin, row.ratio());
  }

  const Options& options_;
  const DeviceOptions& device_;
  const UncertaintyOptions& uncertainty_;
  const std::vector<LoadedScale>& scales_;
  RemainingContact contact_;
  double cell_area_;
  double pull_in_;  ///< [V]; NaN: not known
  Verdict verdict_;
  ForceInterval pull_off_interval_;
  bool is_open_ = false;
  Sticks word_at_opening_ = Sticks::kNo;  ///< of the contact that opens
  bool has_landed_ = false;               ///< by the field alone
};

}  // namespace

const char* word(SweepDirection direction) {
  return direction == SweepDirection::kUp ? "up" : "down";
}

const char* word(Lands lands) {
  constexpr const char* kWords[] = {"no", "yes", "unknown"};
  return kWords[static_cast<int>(lands)];
}

LoadSweepSummary summaryOf(double mechanical_load, const std::vector<LoadSweepRow>& rows) {
  LoadSweepSummary summary;
  summary.mechanical_load = mechanical_load;
  bool releases = true;
  bool is_safe = true;
  for (const LoadSweepRow& row : rows) {
    if (row.mechanical_load != mechanical_load) continue;
    if (row.direction == SweepDirection::kDown) {
      if (row.is_open && std::isnan(summary.opening_voltage)) summary.opening_voltage = row.voltage;
      continue;
    }
    const bool is_safe_here = row.sticks == Sticks::kNo;
    is_safe = is_safe && is_safe_here;
    if (is_safe) summary.highest_safe_voltage = row.voltage;
    if (is_safe_here && std::isnan(summary.lowest_safe_voltage))
      summary.lowest_safe_voltage = row.voltage;
    releases = releases && row.ratio() >= 1.0 && row.status != Status::kNoEquilibrium &&
               !row.is_lower_bound;
    if (releases) summary.highest_releasing_voltage = row.voltage;
    if (row.ratio() < 1.0 && std::isnan(summary.lowest_sticking_voltage))
      summary.lowest_sticking_voltage = row.voltage;
  }
  return summary;
}

std::vector<std::string> LoadSweepRequest::validate(const Options& options) const {
  std::vector<std::string> violations;
  addListViolations("voltages", voltages, "V", violations);
  addListViolations("mechanical_loads", mechanical_loads, "N", violations);
  const double states =
      static_cast<double>(voltages.size()) * static_cast<double>(mechanical_loads.size());
  if (states > kMostStates) {
    violations.push_back("voltages x mechanical_loads: " + numberText(states) +
                         " pairs are not allowed, must be <= " + numberText(kMostStates));
  }
  if (!violations.empty()) return violations;
  Options largest = options;
  largest.load.voltage = voltages.back();
  largest.load.mechanical_load = mechanical_loads.back();
  return largest.validate();
}

std::vector<LoadOptions> LoadSweepRequest::loadsOfDevice(const Options& options) const {
  if (!validate(options).empty()) return {};
  const std::vector<double> presses = fewOf(mechanical_loads, kMostPresses);
  const std::vector<double> fields = fewOf(voltages, kMostOfDevice / presses.size());
  std::vector<LoadOptions> loads;
  for (const double press : presses) {
    for (const double field : fields) {
      loads.push_back(options.load);
      loads.back().voltage = field;
      loads.back().setMechanicalLoad(press);
    }
  }
  return loads;
}

LoadSweepResult sweepLoads(const Options& options, const SurfacePair& surfaces,
                           const LoadSweepRequest& request, const DeviceOptions& device,
                           const UncertaintyOptions& uncertainty, const RunControl& control,
                           const std::vector<LoadedScale>& scales,
                           const std::optional<MeasuredScan>& scan) {
  std::vector<std::string> violations = request.validate(options);
  if (!violations.empty()) throw OptionsError(std::move(violations));

  const std::vector<double>& voltages = request.voltages;
  const auto step_count = static_cast<int>(2 * voltages.size() - 1);
  const int total = step_count * static_cast<int>(request.mechanical_loads.size());
  const MeasuredScan measured = scan ? *scan : asMeasured(options, surfaces);
  LoadSweepResult result;
  result.pull_in_voltage =
      closingVoltage(device, options.interface, options.load.contact_potential);
  if (std::isnan(result.pull_in_voltage)) result.pull_in_reason = whatPullInLacks(device);
  for (const double mechanical_load : request.mechanical_loads) {
    Loop loop(options, surfaces, device, uncertainty, scales, measured, result.pull_in_voltage);
    for (int step = 0; step < step_count; ++step) {
      if (control.isCancelled()) return result;
      const auto up_count = static_cast<int>(voltages.size());
      const bool is_up = step < up_count;
      const int place = is_up ? step : 2 * (up_count - 1) - step;
      result.rows.push_back(loop.next(voltages[static_cast<std::size_t>(place)], mechanical_load,
                                      is_up ? SweepDirection::kUp : SweepDirection::kDown));
      if (result.rows.size() == 1 && std::isnan(result.rows.front().ratio()))
        result.why_no_margin = loop.verdict().reason;
      control.report(static_cast<int>(result.rows.size()), total);
    }
    result.summaries.push_back(summaryOf(mechanical_load, result.rows));
  }
  result.is_complete = true;
  return result;
}

}  // namespace mems_stiction
