#include "surface/height_translation.hpp"

#include <string>
#include <utility>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {
namespace {

constexpr double kEnd = 8.0;
constexpr std::size_t kHeights = 4097;

std::vector<double> sampled(const std::function<double(double)>& height) {
  std::vector<double> heights;
  for (std::size_t i = 0; i < kHeights; ++i) {
    heights.push_back(height(kEnd * (2.0 * static_cast<double>(i) / (kHeights - 1) - 1.0)));
  }
  return heights;
}

}  // namespace

HeightTranslation::HeightTranslation(const std::function<double(double)>& height)
    : HeightTranslation(-kEnd, kEnd, sampled(height)) {}

HeightTranslation::HeightTranslation(double lowest, double highest,
                                     const std::vector<double>& heights)
    : lowest_(lowest),
      steps_((static_cast<double>(heights.size()) - 1.0) / (highest - lowest)),
      last_(static_cast<double>(heights.size()) - 2.0) {
  std::vector<std::string> violations;
  if (!Range::any().contains(lowest) || !Range::any().contains(highest) || !(lowest < highest)) {
    violations.push_back("translation/highest: " + numberText(highest) +
                         " is not allowed; must be above lowest, " + numberText(lowest));
  }
  if (heights.size() < 2) {
    violations.push_back("translation/heights: has " + std::to_string(heights.size()) +
                         " values; must have at least 2");
  }
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (Range::any().contains(heights[i]) && (i == 0 || !(heights[i] < heights[i - 1]))) continue;
    const std::string name =
        "translation/heights[" + std::to_string(i) + "]: " + numberText(heights[i]);
    if (!Range::any().contains(heights[i])) {
      violations.push_back(name + " is not allowed; must be " + Range::any().text());
    } else {
      violations.push_back(name + " is not allowed; must be at least the one before it, " +
                           numberText(heights[i - 1]));
    }
  }
  if (!violations.empty()) throw OptionsError(std::move(violations));
  for (std::size_t i = 1; i < heights.size(); ++i)
    segments_.push_back({heights[i - 1], heights[i] - heights[i - 1]});
}

}  // namespace mems_stiction
