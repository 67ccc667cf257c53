#include "evaluation/frame_load.hpp"

#include "height_map/validity.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {

double nominalArea(const SurfacePair& surfaces) {
  cv::Mat valid = validMask(surfaces.lower.heights());
  if (!surfaces.upperIsPlane() && surfaces.upper.heights().size() == valid.size()) {
    valid &= validMask(surfaces.upper.heights());
  }
  return cv::countNonZero(valid) * surfaces.lower.cellArea();
}

Options onFrame(const Options& options, const DeviceOptions& device, const SurfacePair& surfaces) {
  const LoadOptions& stated = options.load;
  if (!stated.isPerArea()) return options;
  const double pressure =
      stated.pressure > 0.0 ? stated.pressure : stated.device_force / device.contact_area;
  const double load = pressure * nominalArea(surfaces);
  if (load > stated.max_mechanical_load) {
    throw SurfaceError(
        (stated.pressure > 0.0 ? "load/pressure of " + numberText(stated.pressure) + " Pa"
                               : "load/device_force of " + numberText(stated.device_force) + " N") +
        " is " + numberText(load) + " N on this frame; more than load/max_mechanical_load of " +
        numberText(stated.max_mechanical_load) + " N");
  }
  Options scaled = options;
  scaled.load.setShareOfLoad(load);
  return scaled;
}

}  // namespace mems_stiction
