#include "mems_stiction/preprocess/pipeline.hpp"

#include <cmath>

#include <opencv2/imgproc.hpp>

#include "errors/plain_format.hpp"
#include "errors/short_number.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "preprocess/fill_holes.hpp"
#include "preprocess/level.hpp"
#include "preprocess/line_alignment.hpp"
#include "preprocess/low_pass.hpp"
#include "preprocess/refine.hpp"
#include "preprocess/region.hpp"
#include "preprocess/spike_removal.hpp"
#include "preprocess/stage_offset.hpp"
#include "preprocess/tilt.hpp"
#include "preprocess/tip_correction.hpp"
#include "preprocess/working_surface.hpp"
#include "settings/option_values.hpp"
#include "settings/time_limit.hpp"

namespace mems_stiction {
namespace {

/// The parameters of one step as "threshold=6 window=5", without the keys' common prefix.
template <typename StepOptions>
std::string parametersOf(const std::string& step, const StepOptions& options) {
  const std::string prefix = "preprocessing/" + step;
  std::string text;
  visitValues(options, [&](const std::string& key, const auto& value) {
    if (key == prefix + "/enabled") return;
    std::string name = key.substr(prefix.size());
    if (name.empty()) name = "shape";
    while (!name.empty() && (name.front() == '/' || name.front() == '_')) name.erase(name.begin());
    text += (text.empty() ? "" : " ") + name + "=" + valueText(value);
  });
  return text;
}

bool isWanted(const RegionOptions& options) { return options.isStated(); }
bool isWanted(const StageOffsetOptions& options) { return options.enabled; }
bool isWanted(const LineAlignmentOptions& options) {
  return options.method != LineAlignment::kNone;
}
bool isWanted(const SpikeOptions& options) { return options.enabled; }
bool isWanted(const FillOptions& options) { return options.enabled; }
bool isWanted(const TipOptions& options) { return options.radius > 0.0; }
bool isWanted(const LevelOptions& options) { return options.shape != LevelShape::kNone; }
bool isWanted(const LowPassOptions& options) { return options.cutoff_wavelength > 0.0; }
bool isWanted(const RefineOptions& options) { return options.factor > 1; }

template <typename StepOptions>
void addStep(const char* name, const StepOptions& options, std::vector<PreprocessStep>& steps) {
  if (!isWanted(options)) return;
  PreprocessStep step;
  step.name = name;
  step.parameters = parametersOf(name, options);
  steps.push_back(step);
}

/// A step has made a new surface, which takes the place of the one in work.
HeightChange replace(WorkingSurface& surface, const HeightMap& after) {
  cv::Mat before = surface.heights;
  const cv::Mat& heights = after.heights();
  if (before.size() != heights.size())
    cv::resize(before, before, heights.size(), 0.0, 0.0, cv::INTER_NEAREST);
  HeightChange change;
  ChangeSums changes;
  const auto cols = static_cast<std::size_t>(heights.cols);
  for (int row = 0; row < heights.rows; ++row) {
    addChanges(before.ptr<double>(row), heights.ptr<double>(row), cols, changes);
    change.invalid_pixels += countAbove(0.0, heights.ptr<double>(row), cols).invalid;
  }
  change.rms_change = changes.rms();
  change.changed_pixels = changes.changed;
  surface.heights = heights;
  surface.pitch_x = after.pitchX();
  surface.pitch_y = after.pitchY();
  return change;
}

}  // namespace

void PipelineOptions::describe(OptionVisitor& visitor) {
  region.describe(visitor);
  offset.describe(visitor);
  lines.describe(visitor);
  spikes.describe(visitor);
  fill.describe(visitor);
  tip.describe(visitor);
  level.describe(visitor);
  low_pass.describe(visitor);
  refine.describe(visitor);
}

std::vector<std::string> PipelineOptions::validate() const { return rangeViolations(*this); }

struct ScanCleaner::Work {
  Region region;
  WorkingSurface surface;
};

ScanCleaner::ScanCleaner() : work_(std::make_unique<Work>()) {}

ScanCleaner::~ScanCleaner() = default;
ScanCleaner::ScanCleaner(ScanCleaner&&) noexcept = default;
ScanCleaner& ScanCleaner::operator=(ScanCleaner&&) noexcept = default;

ScanCleaner::ScanCleaner(const PipelineOptions& options)
    : options_(options), work_(std::make_unique<Work>()) {
  std::vector<std::string> violations = options.validate();
  if (!violations.empty()) throw OptionsError(std::move(violations));
  work_->region = Region(options.region);
  std::vector<PreprocessStep>& steps = cleaned_.record.steps;
  addStep("region", options_.region, steps);
  addStep("offset", options_.offset, steps);
  addStep("lines", options_.lines, steps);
  addStep("spikes", options_.spikes, steps);
  addStep("fill", options_.fill, steps);
  addStep("tip", options_.tip, steps);
  addStep("level", options_.level, steps);
  addStep("low_pass", options_.low_pass, steps);
  addStep("refine", options_.refine, steps);
}

const CleanedScan& ScanCleaner::clean(const HeightMap& scan) {
  cleaned_.surface = HeightMap();  // lets go of the memory
  if (cleaned_.record.steps.empty()) {
    cleaned_.surface = scan;
    return cleaned_;
  }
  WorkingSurface& work = work_->surface;
  work.take(scan);
  auto step = cleaned_.record.steps.begin();
  const auto note = [&](const HeightChange& change) {
    static_cast<HeightChange&>(*step++) = change;
    TimeLimit::check();
  };
  if (isWanted(options_.region)) {
    cleaned_.outside = work_->region.outside(work.heights.size(), work.pitch_x, work.pitch_y);
    note(leaveOut(work, cleaned_.outside));
  }
  if (isWanted(options_.offset)) note(subtractStageOffset(work));
  if (isWanted(options_.lines)) note(alignLines(work, options_.lines));
  if (isWanted(options_.spikes)) note(removeSpikes(work, options_.spikes));
  if (isWanted(options_.fill)) note(fillHoles(work, options_.fill, cleaned_.outside));
  if (isWanted(options_.tip)) {
    const TipCorrection correction = tipCorrected(work.surface(), options_.tip);
    cleaned_.record.tip_unreached_fraction = correction.unreached_fraction;
    note(replace(work, correction.surface));
  }
  if (isWanted(options_.level)) {
    const HeightChange change = levelBy(work, options_.level);
    step->tilt_left = tiltLeft(work.surface(), 2).rms_height;
    note(change);
  }
  if (isWanted(options_.low_pass))
    note(replace(work, lowPassed(work.surface(), options_.low_pass)));
  if (isWanted(options_.refine)) note(replace(work, refined(work.surface(), options_.refine)));
  cleaned_.surface = work.surface();
  return cleaned_;
}

CleanedScan cleanScan(const HeightMap& scan, const PipelineOptions& options) {
  return ScanCleaner(options).clean(scan);
}

std::vector<std::string> recordLines(const PreprocessRecord& record) {
  std::vector<std::string> lines;
  for (const PreprocessStep& step : record.steps) {
    const std::string change = plainFormat("%.4g", step.rms_change);
    lines.push_back(step.name + (step.parameters.empty() ? "" : " (" + step.parameters + ")") +
                    ": rms change " + change + " m; " + std::to_string(step.changed_pixels) +
                    " pixels changed");
    if (!std::isnan(step.tilt_left))
      lines.back() += "; tilt and bow left " + shortNumber(step.tilt_left) + " m";
    if (step.name == "tip") {
      lines.back() += plainFormat("; fraction not reached %.4g", record.tip_unreached_fraction);
    }
  }
  return lines;
}

}  // namespace mems_stiction
