#include "mems_stiction/preprocess/pipeline.hpp"

#include <cmath>
#include <cstdio>

#include <opencv2/imgproc.hpp>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/height_map/validity.hpp"

namespace mems_stiction {
namespace {

/// Writes the described parameters of one step as "threshold=6 window=5", without the keys' common prefix.
class ParameterText : public OptionVisitor {
 public:
  explicit ParameterText(const std::string& step) : prefix_("preprocessing/" + step) {}

  void number(const std::string& key, double& value, const std::string&, const Range&, const std::string&) override {
    add(key, numberText(value));
  }
  void integer(const std::string& key, int& value, const Range&, const std::string&) override {
    add(key, std::to_string(value));
  }
  void flag(const std::string& key, bool& value, const std::string&) override {
    if (key != prefix_ + "/enabled") add(key, value ? "true" : "false");
  }
  void text(const std::string& key, std::string& value, const std::string&) override { add(key, value); }
  void choice(const std::string& key, std::string& value, const std::vector<std::string>&,
              const std::string&) override {
    add(key, value);
  }

  const std::string& text() const { return text_; }

 private:
  void add(const std::string& key, const std::string& value) {
    std::string name = key.substr(prefix_.size());
    if (name.empty()) name = "shape";
    while (!name.empty() && (name.front() == '/' || name.front() == '_')) name.erase(name.begin());
    text_ += (text_.empty() ? "" : " ") + name + "=" + value;
  }

  std::string prefix_;
  std::string text_;
};

void measureChange(const HeightMap& before, const HeightMap& after, PreprocessStep& step) {
  cv::Mat old_heights;
  before.heights().convertTo(old_heights, CV_64F);
  if (old_heights.size() != after.heights().size()) {
    cv::resize(old_heights, old_heights, after.heights().size(), 0.0, 0.0, cv::INTER_NEAREST);
  }
  const cv::Mat& heights = after.heights();
  double squares = 0.0;
  long long common = 0;
  for (int row = 0; row < heights.rows; ++row) {
    const double* old_line = old_heights.ptr<double>(row);
    const double* line = heights.ptr<double>(row);
    for (int col = 0; col < heights.cols; ++col) {
      const bool was_valid = std::isfinite(old_line[col]);
      const bool is_valid = std::isfinite(line[col]);
      if (!is_valid) ++step.invalid_pixels;
      if (was_valid && is_valid) {
        const double change = line[col] - old_line[col];
        squares += change * change;
        ++common;
        if (change != 0.0) ++step.changed_pixels;
      } else if (was_valid != is_valid) {
        ++step.changed_pixels;
      }
    }
  }
  if (common > 0) step.rms_change = std::sqrt(squares / static_cast<double>(common));
}

/// Runs steps one after the other on one surface and keeps the record.
class Pipeline {
 public:
  explicit Pipeline(const HeightMap& scan) { prepared_.surface = scan; }

  template <typename StepOptions, typename Apply>
  void run(bool wanted, const std::string& name, const StepOptions& options, Apply apply) {
    if (!wanted) return;
    PreprocessStep step;
    step.name = name;
    ParameterText parameters(name);
    describeConst(options, parameters);
    step.parameters = parameters.text();
    const HeightMap after = apply(prepared_.surface);
    measureChange(prepared_.surface, after, step);
    prepared_.surface = after;
    prepared_.record.steps.push_back(step);
  }

  CleanedScan& prepared() { return prepared_; }

 private:
  CleanedScan prepared_;
};

}  // namespace

void PipelineOptions::describe(OptionVisitor& visitor) {
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

CleanedScan cleanScan(const HeightMap& scan, const PipelineOptions& options) {
  std::vector<std::string> violations = options.validate();
  if (!violations.empty()) throw OptionsError(std::move(violations));

  Pipeline pipeline(scan);
  pipeline.run(options.offset.enabled, "offset", options.offset,
               [](const HeightMap& surface) { return withoutStageOffset(surface); });
  pipeline.run(options.lines.method != LineAlignment::kNone, "lines", options.lines,
               [&](const HeightMap& surface) { return withAlignedLines(surface, options.lines); });
  pipeline.run(options.spikes.enabled, "spikes", options.spikes,
               [&](const HeightMap& surface) { return withoutSpikes(surface, options.spikes); });
  pipeline.run(options.fill.enabled, "fill", options.fill,
               [&](const HeightMap& surface) { return withFilledHoles(surface, options.fill); });
  pipeline.run(options.tip.radius > 0.0, "tip", options.tip, [&](const HeightMap& surface) {
    const TipCorrection correction = tipCorrected(surface, options.tip);
    pipeline.prepared().record.tip_unreached_fraction = correction.unreached_fraction;
    return correction.surface;
  });
  pipeline.run(options.level.shape != LevelShape::kNone, "level", options.level,
               [&](const HeightMap& surface) { return levelledBy(surface, options.level); });
  pipeline.run(options.low_pass.cutoff_wavelength > 0.0, "low_pass", options.low_pass,
               [&](const HeightMap& surface) { return lowPassed(surface, options.low_pass); });
  pipeline.run(options.refine.factor > 1, "refine", options.refine,
               [&](const HeightMap& surface) { return refined(surface, options.refine); });
  return pipeline.prepared();
}

std::vector<std::string> recordLines(const PreprocessRecord& record) {
  std::vector<std::string> lines;
  for (const PreprocessStep& step : record.steps) {
    char change[32];
    std::snprintf(change, sizeof change, "%.4g", step.rms_change);
    lines.push_back(step.name + (step.parameters.empty() ? "" : " (" + step.parameters + ")") + ": rms change " +
                    change + " m, " + std::to_string(step.changed_pixels) + " pixels changed");
    if (step.name == "tip") {
      char fraction[32];
      std::snprintf(fraction, sizeof fraction, "%.4g", record.tip_unreached_fraction);
      lines.back() += std::string(", fraction not reached ") + fraction;
    }
  }
  return lines;
}

}  // namespace mems_stiction
