#pragma once

/// @file
/// The scan behind the surfaces of a contact. The model may have them on finer pixels than were
/// measured, and more of them than is to be judged (preprocessing/refine, preprocessing/region). A
/// verdict on each contact asks what was measured.

#include <functional>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/prediction/options.hpp"
#include "mems_stiction/prediction/prediction.hpp"

namespace mems_stiction {

/// What verdicts on contacts of one scan need of it.
struct MeasuredScan {
  double cell_area = 0.0;  ///< of its pixels [m^2]
  /// Sets in a prediction of the model's surfaces what is the scan's own: waves that it does not
  /// show, and contacts at the border of what is judged.
  std::function<void(Prediction&)> flag;
};

/// Surfaces on the pixels that they were measured with.
MeasuredScan asMeasured(const Options& options, const SurfacePair& surfaces);

}  // namespace mems_stiction
