#include "batch_scans.hpp"

#include <exception>
#include <filesystem>
#include <iomanip>
#include <sstream>
#include <utility>

#include "half_space_run.hpp"
#include "mems_stiction/base/error_text.hpp"
#include "mems_stiction/import/waiting_gwyddion.hpp"
#include "mems_stiction/prediction/force_curve.hpp"
#include "mems_stiction/scan/frame_load.hpp"
#include "mems_stiction/scan/half_space_scan.hpp"
#include "mems_stiction/scan/plausibility.hpp"

namespace mems_stiction {
namespace {

bool isBag(const std::string& path) {
  for (const char* end : {".bag", ".bag.active"}) {
    const std::string suffix = end;
    if (path.size() > suffix.size() && path.compare(path.size() - suffix.size(), suffix.size(), suffix) == 0)
      return true;
  }
  return false;
}

ScanFileOptions fileOptions(const BatchArguments& arguments) {
  ScanFileOptions options;
  options.import.use_cache = !arguments.no_cache;
  options.import.ignore_mask = arguments.ignore_mask;
  options.import.waiting = std::make_shared<WaitingGwyddions>(options.import.program);
  return options;
}

void append(const RowFields& more, RowFields& fields) { fields.insert(fields.end(), more.begin(), more.end()); }

}  // namespace

BatchScans::BatchScans(const BatchArguments& arguments, std::vector<std::string> inputs,
                       const Configuration& configuration)
    : arguments_(arguments),
      inputs_(std::move(inputs)),
      configuration_(configuration),
      settings_file_checksum_(settingsFilesChecksum(configuration)),
      predictor_(configuration),
      half_space_(configuration.half_space),
      ahead_(configuration.scan, fileOptions(arguments), settings_file_checksum_) {
  for (std::size_t input = 0; input < inputs_.size(); ++input) list(input);
}

std::string BatchScans::changeSince(const RowTexts& row, std::size_t number) const {
  const std::size_t input = items_[number - 1].input;
  const auto bag = bag_states_.find(input);
  return mems_stiction::changeSince(
      row, bag != bag_states_.end() ? bag->second : scanState(inputs_[input], true, settings_file_checksum_));
}

void BatchScans::expect(const std::vector<std::size_t>& numbers) {
  std::vector<std::string> paths;
  for (const std::size_t number : numbers) {
    const Item& item = items_[number - 1];
    if (item.scan == 0 && item.reason.empty()) paths.push_back(inputs_[item.input]);
  }
  ahead_.expect(std::move(paths));
}

std::vector<std::string> BatchScans::columns() const {
  std::vector<std::string> names = columnNames(hasDevice());
  if (arguments_.half_space) {
    for (std::string& name : halfSpaceColumnNames(hasDevice())) names.push_back(std::move(name));
  }
  for (auto& field : stateFields({})) names.push_back(std::move(field.first));
  return names;
}

std::map<std::string, std::string> BatchScans::units() const {
  std::map<std::string, std::string> units = columnUnits(hasDevice());
  if (arguments_.half_space) units.merge(halfSpaceColumnUnits());
  units.merge(stateUnits());
  return units;
}

BatchRow BatchScans::row(std::size_t number, const std::function<void(const std::string&)>& tell) {
  const Item& item = items_[number - 1];
  ScanOrigin origin;
  origin.number = number;
  origin.file = inputs_[item.input];
  origin.scan = item.scan;
  std::string reason = item.reason;
  Subject subject;
  ScanState state;
  const auto bag = bag_states_.find(item.input);
  if (bag != bag_states_.end()) state = bag->second;
  if (reason.empty()) {
    try {
      subject = predict(item, origin, state);
    } catch (const std::exception& error) {
      reason = reasonOf(error);
    }
  }
  BatchRow row;
  row.is_predicted = reason.empty();
  row.reason = reason;
  row.fields = originFields(origin, reason);
  if (!row.is_predicted) {
    append(stateFields(state), row.fields);
    return row;
  }
  HalfSpaceAnswer half_space;
  if (arguments_.half_space) {
    half_space = solve(tell);
    row.is_solved = half_space.reason.empty();
  }
  const std::optional<Verdict> verdict = judge(half_space);
  append(figureFields(surface_, subject.warnings, prediction_, verdict, configuration_.model.formulation,
                      provenanceOf(subject.identity, configuration_)),
         row.fields);
  if (arguments_.half_space) append(halfSpaceFields(half_space, verdict), row.fields);
  append(stateFields(state), row.fields);
  if (!arguments_.dump.empty()) dump(number, row.fields, half_space.solution);
  return row;
}

void BatchScans::list(std::size_t input) {
  if (!isBag(inputs_[input])) {
    items_.push_back({input, 0, ""});
    return;
  }
  bag_states_[input] = scanState(inputs_[input], false, settings_file_checksum_);
  try {
    const ScanBagReader& bag = open(input);
    for (std::size_t scan = 1; scan <= bag.count(); ++scan) items_.push_back({input, scan, ""});
    if (bag.wasCutOff()) {
      items_.push_back({input, 0,
                        "the bag was cut off; the " + std::to_string(bag.count()) +
                            " scans before the cut have their rows, what came later is lost"});
    }
  } catch (const std::exception& error) {
    items_.push_back({input, 0, error.what()});
  }
}

const ScanBagReader& BatchScans::open(std::size_t input) {
  if (!bag_ || bag_input_ != input) {
    bag_.reset();
    bag_ = std::make_unique<ScanBagReader>(inputs_[input], arguments_.topic, configuration_.scan);
    bag_input_ = input;
  }
  return *bag_;
}

BatchScans::Subject BatchScans::predict(const Item& item, ScanOrigin& origin, ScanState& state) {
  HeightMap counter_surface;
  Subject subject;
  subject.identity.scan_name = std::filesystem::path(inputs_[item.input]).stem().string();
  if (item.scan == 0) {
    const ScanAhead ahead = ahead_.take(inputs_[item.input]);
    state = ahead.state;
    if (ahead.failure) std::rethrow_exception(ahead.failure);
    surface_ = ahead.scan.surface;
    subject.warnings = ahead.scan.notes;
    origin.channel = ahead.scan.channel;
  } else {
    const bool wants_counter = configuration_.counter_surface.type == CounterSurfaceType::kTopic;
    const BagScan of_bag = open(item.input).read(item.scan - 1, wants_counter);
    surface_ = of_bag.scan.surface;
    if (of_bag.counter_surface) counter_surface = of_bag.counter_surface->surface;
    origin.name = of_bag.scan.header.frame_id;
    subject.identity = of_bag.scan.identity;
    std::ostringstream stamp;
    stamp << of_bag.scan.header.stamp;
    origin.stamp = stamp.str();
  }
  predictor_.preparer().setMeasuredCounterSurface(counter_surface);
  prepared_ = predictor_.preparer().prepare(surface_);
  prediction_ = predictor_.predict(prepared_);
  for (std::string& line : predictionWarnings(prepared_, configuration_, prediction_, configuration_.model)) {
    subject.warnings.push_back(std::move(line));
  }
  return subject;
}

std::optional<Verdict> BatchScans::judge(const HalfSpaceAnswer& half_space) const {
  if (!hasDevice()) return std::nullopt;
  const SolvedHalfSpace unsolved = unsolvedHalfSpace(half_space.reason);
  Evidence evidence;
  if (arguments_.half_space) evidence.half_space = half_space.solution ? &*half_space.solution : &unsolved;
  return verdictOf(prediction_, configuration_.device, configuration_.uncertainty, configuration_.model,
                   surface_.cellArea(), evidence);
}

HalfSpaceAnswer BatchScans::solve(const std::function<void(const std::string&)>& tell) const {
  HalfSpaceAnswer answer;
  try {
    HalfSpaceText text;
    HalfSpaceControl control;
    control.on_state = [&](const ForcePoint& point) { tell(text.next(point)); };
    answer.solution = half_space_.solve(
        halfSpaceProblem(prepared_, onFrame(configuration_.model, configuration_.device, prepared_.surfaces)), control);
    if (answer.solution->status != HalfSpaceStatus::kSolved) answer.reason = answer.solution->message;
  } catch (const std::exception& error) {
    answer.reason = reasonOf(error);
  }
  return answer;
}

void BatchScans::dump(std::size_t number, RowFields fields, const std::optional<SolvedHalfSpace>& half_space) const {
  std::ostringstream folder;
  folder << arguments_.dump << "/" << std::setw(6) << std::setfill('0') << number;
  NamedMaps maps;
  if (half_space) {
    append(halfSpaceExtras(*half_space), fields);
    maps = halfSpaceMaps(*half_space);
  }
  writeFullResult(folder.str(), fields, prepared_.surfaces.lower, prediction_,
                  curveOf(prediction_, configuration_.model.interface), maps);
}

}  // namespace mems_stiction
