#include "bench/settings.hpp"

#include "approach/gap_order.hpp"
#include "mems_stiction/paper/paper_options.hpp"

namespace mems_stiction {
namespace bench {
namespace {

constexpr double kContactFraction = 0.3;
constexpr double kOverload = 1.0;  // [N]

}  // namespace

double fullApproach(const HeightMap& frame) {
  GapField field;
  field.compute(frame);
  GapOrder order;
  order.build(field, kContactFraction);
  return order.cells()[static_cast<std::size_t>(order.contactLimit() - 1)].gap;
}

Options optionsFor(const Case& setting, const std::string& formulation, Pressing pressing,
                   bool all_outputs) {
  Options options;
  options.formulation = formulation;
  if (pressing == Pressing::kOverload) {
    options.load.mechanical_load = kOverload;
    options.load.voltage = 5.0;
    options.interface.insulator_thickness = 100e-9;
  }
  options.approach.max_contact_fraction = kContactFraction;
  options.solver.of<PaperOptions>().step =
      fullApproach(frameOf(setting.frame, setting.size)) / setting.steps;
  options.output = {all_outputs, all_outputs, all_outputs, false, false};
  return options;
}

Options optionsUnder(const Case& setting, double pressure) {
  Options options = optionsFor(setting, kDefaultFormulation, Pressing::kAdhesion, false);
  const HeightMap& frame = frameOf(setting.frame, setting.size);
  options.load.mechanical_load =
      pressure * frame.cols() * frame.pitchX() * frame.rows() * frame.pitchY();
  return options;
}

std::vector<Recipe> cleaningRecipes() {
  Recipe offset{"offset", {}};
  offset.cleaning.offset.enabled = true;
  Recipe lines{"lines", {}};
  lines.cleaning.lines.method = LineAlignment::kMedian;
  Recipe spikes{"spikes", {}};
  spikes.cleaning.spikes.enabled = true;
  Recipe fill{"fill", {}};
  fill.cleaning.fill.enabled = true;
  Recipe level{"level", {}};
  level.cleaning.level.shape = LevelShape::kPlane;
  Recipe all{"afm_recipe", {}};
  all.cleaning.offset = offset.cleaning.offset;
  all.cleaning.lines = lines.cleaning.lines;
  all.cleaning.spikes = spikes.cleaning.spikes;
  all.cleaning.fill = fill.cleaning.fill;
  all.cleaning.level = level.cleaning.level;
  return {offset, lines, spikes, fill, level, all};
}

}  // namespace bench
}  // namespace mems_stiction
