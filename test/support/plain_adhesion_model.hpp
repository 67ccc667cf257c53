#pragma once

/// The adhesion model the slow and obvious way: at every step of the approach the whole frame is
/// thresholded and relabelled with OpenCV's connectedComponentsWithStats, patches are measured from
/// their labels, and loads are summed cell by cell. The yardstick for PatchSweep, GapLoads and
/// AdhesionModel; it shares with them only the formulas for one patch.

#include <vector>

#include <opencv2/core.hpp>

#include "approach/gap_field.hpp"
#include "mems_stiction/prediction/options.hpp"
#include "mems_stiction/prediction/prediction.hpp"
#include "paper/cell_forces.hpp"
#include "paper/contact_patch.hpp"

namespace mems_stiction {
namespace plain {

/// Which cells touch at an approach D: g < D on the way, g <= D when D is the gap of the last cell
/// that was added.
enum class Touch { kBelow, kUpTo };

/// The contact patches of one state, measured from a labelling of the frame.
struct Labelling {
  cv::Mat labels;  ///< rows x cols CV_32SC1: 0 apart, i + 1 for patches[i]
  std::vector<ContactPatch> patches;
  int contact_count = 0;
};

Labelling labelPatches(const GapField& field, double approach, Touch touch,
                       Connectivity connectivity);

/// (2) and (3) summed cell by cell.
NormalLoad sumLoads(const GapField& field, double approach, Touch touch, const CellForces& forces,
                    double mechanical_load);

/// The whole prediction but the maps, the roughness and the energy curve.
Prediction predict(const Options& options, const SurfacePair& surfaces);

}  // namespace plain
}  // namespace mems_stiction
