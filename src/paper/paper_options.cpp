#include "mems_stiction/paper/paper_options.hpp"

namespace mems_stiction {

void PaperOptions::describe(OptionVisitor& visitor) {
  visitor.formerName("approach/step", "paper/step");
  visitor.number("paper/step", step, "m", Range::nonNegative(),
                 "approach per step; 0 = a fiftieth of the composite rms height");
  visitor.formerName("interface/cutoff_distance", "paper/cutoff_distance");
  visitor.number("paper/cutoff_distance", cutoff_distance, "m", Range::positive(),
                 "interatomic cut-off: smaller gaps count as this in van der Waals sums");
}

}  // namespace mems_stiction
