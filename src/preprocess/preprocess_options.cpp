#include "mems_stiction/preprocess/preprocess_options.hpp"

namespace mems_stiction {

void PreprocessOptions::describe(OptionVisitor& visitor) {
  visitor.enumeration("preprocessing/level", level, {{"none", Levelling::kNone}, {"plane", Levelling::kPlane}},
                      "what is subtracted from a scan: nothing, or the least-squares plane of its valid pixels");
}

}  // namespace mems_stiction
