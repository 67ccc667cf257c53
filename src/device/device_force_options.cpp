#include "mems_stiction/device/device_force_options.hpp"

namespace mems_stiction {

void DeviceForceOptions::describe(OptionVisitor& visitor) {
  visitor.flag("device_force/enabled", enabled,
               "whether a device that states its contact area is judged by the force of such an "
               "area; the node finds it "
               "beside its predictions");
  visitor.integer("device_force/realisations", realisations, Range::within(3, 1000),
                  "surfaces of the device's size that are made and brought to contact");
  visitor.number(
      "device_force/pitch", pitch, "m", Range::nonNegative(),
      "distance of neighbouring pixels of the made surfaces; 0 = that of the finest scan");
  visitor.number("device_force/max_cells", max_cells, "", Range::within(1e4, 1e11),
                 "pixels of one made surface; the force of a larger area is continued from those");
  visitor.flag("device_force/own_long_waves", own_long_waves,
               "whether a scan as wide as the device gives its own long waves, so that the force "
               "is that of its place; "
               "no = of any place of "
               "such a surface");
  visitor.integer("device_force/seed", seed, Range::nonNegative(),
                  "the same seed gives the same surfaces");
}

}  // namespace mems_stiction
