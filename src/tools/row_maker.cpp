#include "row_maker.hpp"

#include <exception>
#include <iomanip>
#include <utility>

#include "busy_line.hpp"
#include "device/device_evidence.hpp"
#include "errors/error_text.hpp"
#include "errors/plain_format.hpp"
#include "evaluation/device_scans.hpp"
#include "evaluation/frame_load.hpp"
#include "evaluation/half_space_call.hpp"
#include "evaluation/plausibility.hpp"
#include "half_space_run.hpp"
#include "mems_stiction/evaluation/half_space_scan.hpp"
#include "numeric/words.hpp"
#include "prediction/force_curve.hpp"

namespace mems_stiction {
namespace {

constexpr const char* kRowsOfScans =
    "rows are of scans; --parts finds it for each part and --device-force for each scan";
constexpr const char* kPartsAreAsked =
    "rows are of scans; the part's row in the file of --parts has the device's verdict";

constexpr const char* kNotFlagged = "no flag asks for it";

void append(const RowFields& more, RowFields& fields) {
  fields.insert(fields.end(), more.begin(), more.end());
}

/// What is wrong with a scan, with its name where memory ends: that says nothing of the file.
std::string reasonFor(const std::string& input, const std::exception& error) {
  return (hasNoMemory(error) ? input + ": " : "") + reasonOf(error);
}

}  // namespace

RowFields batchSample(const std::string& formulation, bool with_verdict, bool with_half_space) {
  RowFields fields = sampleFields(formulation, with_verdict);
  if (with_half_space) append(halfSpaceSample(with_verdict), fields);
  append(stateFields({}), fields);
  return fields;
}

std::map<std::string, std::string> batchUnits(const std::string& formulation, bool with_verdict,
                                              bool with_half_space) {
  std::map<std::string, std::string> units = columnUnits(formulation, with_verdict);
  if (with_half_space) units.merge(halfSpaceColumnUnits());
  units.merge(stateUnits());
  return units;
}

RowMaker::RowMaker(const BatchArguments& arguments, const Configuration& configuration,
                   ScansAhead& ahead)
    : arguments_(arguments),
      configuration_(configuration),
      predictor_(configuration),
      half_space_(configuration.half_space),
      ahead_(ahead) {}

BatchRow RowMaker::row(const BatchScan& scan, const std::function<void(const std::string&)>& tell) {
  ScanOrigin origin;
  origin.number = scan.number;
  origin.file = scan.input;
  origin.scan = scan.place;
  ScanState state = scan.state;
  std::string reason = scan.reason;
  if (reason.empty()) {
    Subject subject;
    try {
      subject = predict(scan, origin, state);
    } catch (const std::exception& error) {
      reason = reasonFor(scan.input, error);
    }
    try {
      if (reason.empty()) return predictedRow(origin, state, subject, tell);
    } catch (const std::exception& error) {
      if (!hasNoMemory(error)) throw;  // other scans may be smaller
      reason = reasonFor(scan.input, error);
    }
  }
  BatchRow row;
  row.message = reason;
  row.fields = originFields(origin, reason);
  append(stateFields(state), row.fields);
  return row;
}

BatchRow RowMaker::predictedRow(const ScanOrigin& origin, const ScanState& state, Subject& subject,
                                const std::function<void(const std::string&)>& tell) {
  BatchRow row;
  row.is_predicted = true;
  row.fields = originFields(origin, "");
  beside_ = Evidence();
  if (arguments_.rowsHaveDeviceForce()) {
    DeviceForce force;
    beside_ = evidenceOfScan(
        prepared_, configuration_, [&](double share) { tell(deviceText(share)); }, &force);
    addMissing(force.warnings, subject.warnings);
  } else if (wantsDeviceForce(configuration_.device, configuration_.device_force)) {
    beside_.why_no_device = arguments_.parts.empty() ? kRowsOfScans : kPartsAreAsked;
  }
  row.is_warned = !subject.warnings.empty();
  HalfSpaceAnswer half_space;
  const bool has_half_space = mayCallHalfSpace(configuration_);
  if (has_half_space) {
    half_space = solve(tell);
    row.is_unsolved = half_space.is_called && !half_space.message.empty();
  }
  const std::optional<Verdict> verdict = judge(half_space);
  append(figureFields(surface_, subject.warnings, prediction_, verdict,
                      configuration_.model.formulation,
                      provenanceOf(subject.identity, configuration_)),
         row.fields);
  if (has_half_space) append(halfSpaceFields(half_space, verdict), row.fields);
  append(stateFields(state), row.fields);
  if (!arguments_.dump.empty()) dump(origin.number, row.fields, half_space.solution);
  return row;
}

RowMaker::Subject RowMaker::predict(const BatchScan& scan, ScanOrigin& origin, ScanState& state) {
  Subject subject;
  if (scan.place == 0) {
    const ScanAhead ahead = ahead_.take(scan.input);
    state = ahead.state;
    if (ahead.failure) std::rethrow_exception(ahead.failure);
    surface_ = ahead.scan.surface;
    subject.identity = ahead.scan.identity;
    subject.warnings = ahead.scan.notes;
    origin.channel = ahead.scan.channel;
  } else {
    surface_ = scan.of_bag.surface;
    origin.name = scan.of_bag.frame_id;
    origin.stamp = scan.of_bag.stamp;
    subject.identity = scan.of_bag.identity;
  }
  predictor_.preparer().setMeasuredCounterSurface(scan.of_bag.counter_surface);
  prepared_ = predictor_.preparer().prepare(surface_);
  prediction_ = predictor_.predict(prepared_);
  for (std::string& line :
       predictionWarnings(prepared_, configuration_, prediction_, configuration_.model)) {
    subject.warnings.push_back(std::move(line));
  }
  return subject;
}

std::optional<Verdict> RowMaker::judge(const HalfSpaceAnswer& half_space) const {
  if (!hasDevice()) return std::nullopt;
  const SolvedHalfSpace unsolved = unsolvedHalfSpace(half_space.message);
  Evidence evidence = beside_;
  if (half_space.is_called)
    evidence.half_space = half_space.solution ? &*half_space.solution : &unsolved;
  return verdictOf(prediction_, configuration_.device, configuration_.uncertainty,
                   configuration_.model, surface_.cellArea(), evidence);
}

HalfSpaceAnswer RowMaker::solve(const std::function<void(const std::string&)>& tell) {
  HalfSpaceAnswer answer;
  try {
    const Options options =
        onFrame(configuration_.model, configuration_.device, prepared_.surfaces);
    const HalfSpaceCall call = halfSpaceCall(prediction_, prepared_, options, configuration_);
    answer.is_called = call.is_made;
    beside_.why_half_space = call.why;
    if (!call.is_made || !call.objection.empty()) {
      answer.message = call.is_made ? call.objection : kNotFlagged;
      return answer;
    }
    HalfSpaceText text;
    HalfSpaceControl control;
    control.on_state = [&](const ForcePoint& point) { tell(text.next(point)); };
    answer.solution = answerOf(call, half_space_, halfSpaceProblem(prepared_, options), control);
    if (answer.solution->status != HalfSpaceStatus::kSolved)
      answer.message = answer.solution->message;
  } catch (const std::exception& error) {
    answer.message = reasonOf(error);
  }
  return answer;
}

void RowMaker::dump(std::size_t number, RowFields fields,
                    const std::optional<SolvedHalfSpace>& half_space) const {
  PlainStream folder;
  folder << arguments_.dump << "/" << std::setw(6) << std::setfill('0') << number;
  NamedMaps maps;
  if (half_space) {
    append(halfSpaceExtras(*half_space), fields);
    maps = halfSpaceMaps(*half_space);
  }
  writeFullResult(folder.str(), fields, prepared_.surfaces.lower, prediction_,
                  curveOf(prediction_, configuration_.model), maps);
}

}  // namespace mems_stiction
