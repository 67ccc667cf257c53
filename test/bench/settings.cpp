#include "bench/settings.hpp"

#include "mems_stiction/approach/gap_order.hpp"

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

Options optionsFor(const Case& setting, bool all_outputs) {
  Options options;
  options.load.mechanical_load = kOverload;
  options.load.voltage = 5.0;
  options.interface.insulator_thickness = 100e-9;
  options.approach.max_contact_fraction = kContactFraction;
  options.approach.step = fullApproach(frameOf(setting.frame, setting.size)) / setting.steps;
  options.output = {all_outputs, all_outputs, all_outputs, false, false};
  return options;
}

}  // namespace bench
}  // namespace mems_stiction
