#pragma once

/// What is done to a scan before it is brought into contact.

#include "mems_stiction/base/option_visitor.hpp"

namespace mems_stiction {

enum class Levelling { kNone, kPlane };

struct PreprocessOptions {
  Levelling level = Levelling::kNone;  ///< kPlane subtracts the least-squares plane of the valid pixels

  void describe(OptionVisitor& visitor);
};

}  // namespace mems_stiction
