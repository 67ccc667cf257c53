#include "preprocess/recipe.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "errors/short_number.hpp"
#include "mems_stiction/preprocess/pipeline.hpp"
#include "numeric/median.hpp"
#include "preprocess/tilt.hpp"

namespace mems_stiction {
namespace {

constexpr double kLargeJumps = 0.1;  ///< of the levelled rms height
constexpr int kFewestRows = 8;
constexpr double kFarOut = 5.0;  ///< in robust standard deviations: where a feature begins

/// Medians of what each row's part of columns has more than the row before, less their own median.
std::vector<double> stepsOf(const cv::Mat& heights, int first, int last) {
  std::vector<double> steps;
  std::vector<double> differences;
  for (int row = 1; row < heights.rows; ++row) {
    differences.clear();
    for (int col = first; col < last; ++col) {
      const double difference = heights.at<double>(row, col) - heights.at<double>(row - 1, col);
      if (std::isfinite(difference)) differences.push_back(difference);
    }
    steps.push_back(differences.empty() ? 0.0 : medianOf(differences));
  }
  std::vector<double> sorted = steps;
  const double middle = medianOf(sorted);
  for (double& step : steps) step -= middle;
  return steps;
}

/// Beyond this, a step is that of a feature.
double limitOf(const std::vector<double>& steps) {
  std::vector<double> distances;
  distances.reserve(steps.size());
  for (const double step : steps) distances.push_back(std::abs(step));
  return kFarOut * 1.4826 * medianOf(distances);
}

double lineJumps(const HeightMap& levelled) {
  const cv::Mat heights = levelled.asDouble().heights();
  if (heights.rows < kFewestRows || heights.cols < 2) return 0.0;
  const std::vector<double> left = stepsOf(heights, 0, heights.cols / 2);
  const std::vector<double> right = stepsOf(heights, heights.cols / 2, heights.cols);
  const double left_limit = limitOf(left);
  const double right_limit = limitOf(right);
  double products = 0.0;
  int count = 0;
  for (std::size_t row = 0; row < left.size(); ++row) {
    if (std::abs(left[row]) > left_limit || std::abs(right[row]) > right_limit) continue;
    products += left[row] * right[row];
    ++count;
  }
  return count > 0 ? std::sqrt(std::max(0.0, products / count)) : 0.0;
}

std::string pixels(long long count) {
  return std::to_string(count) + (count == 1 ? " pixel" : " pixels");
}

}  // namespace

CleaningRecipe cleaningRecipe(const HeightMap& scan) {
  CleaningRecipe recipe;
  const HeightStatistics measured = heightStatistics(scan);
  recipe.rms_height = measured.rms_height;
  PipelineOptions plane;
  plane.level.shape = LevelShape::kPlane;
  HeightMap levelled = cleanScan(scan, plane).surface;
  plane.level.robust = tiltLeft(levelled, 1).isLarge();
  if (plane.level.robust) levelled = cleanScan(scan, plane).surface;
  recipe.steps.level = plane.level;
  recipe.line_jumps = lineJumps(levelled);
  if (recipe.line_jumps > kLargeJumps * heightStatistics(levelled).rms_height) {
    recipe.steps.lines.method = LineAlignment::kMedianDifference;
  }
  recipe.missing = static_cast<long long>(scan.heights().total()) - measured.valid_count;
  PipelineOptions trial = recipe.steps;
  trial.spikes.enabled = true;
  CleanedScan cleaned = cleanScan(scan, trial);
  const auto spikes =
      std::find_if(cleaned.record.steps.begin(), cleaned.record.steps.end(),
                   [](const PreprocessStep& step) { return step.name == "spikes"; });
  recipe.spikes = spikes->changed_pixels;
  recipe.steps.spikes.enabled = recipe.spikes > 0;
  const double holes = static_cast<double>(recipe.spikes + recipe.missing);
  recipe.steps.fill.enabled =
      holes > 0.0 &&
      holes <= recipe.steps.fill.max_fraction * static_cast<double>(scan.heights().total());
  recipe.cleaned_rms_height = heightStatistics(cleanScan(scan, recipe.steps).surface).rms_height;
  return recipe;
}

bool CleaningRecipe::needsMoreThanAPlane() const {
  return steps.level.robust || steps.lines.method != LineAlignment::kNone || steps.spikes.enabled ||
         steps.fill.enabled;
}

std::string CleaningRecipe::sentence() const {
  std::string settings = "preprocessing/level: plane";
  std::string effects;
  if (steps.level.robust) {
    settings += " and preprocessing/level_robust: true";
    effects += "; tall features would pull the plane aslant";
  }
  if (steps.lines.method != LineAlignment::kNone) {
    settings += " and preprocessing/lines/method: median_difference";
    effects += "; rows jump by " + shortNumber(line_jumps) + " m rms";
  }
  if (steps.spikes.enabled) {
    settings += " and preprocessing/spikes/enabled: true";
    effects +=
        "; " + pixels(spikes) + (spikes == 1 ? " jumps" : " jump") + " out of the surroundings";
  }
  if (steps.fill.enabled) {
    settings += " and preprocessing/fill/enabled: true";
    if (missing > 0)
      effects += "; " + pixels(missing) + (missing == 1 ? " is" : " are") + " missing";
  }
  return "write " + settings + ": the rms height goes from " + shortNumber(rms_height) + " m to " +
         shortNumber(cleaned_rms_height) + " m" + effects;
}

}  // namespace mems_stiction
