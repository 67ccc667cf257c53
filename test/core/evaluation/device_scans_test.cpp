/// Scans of one device as its settings have them: what their order must not change.

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "evaluation/device_scans.hpp"
#include "support/holed_surfaces.hpp"
#include "support/sample_frames.hpp"

namespace mems_stiction {
namespace {

constexpr int kSide = 96;

HeightMap scanned(double pitch, int seed) {
  return samples::gaussian(kSide, kSide, pitch, pitch, 4e-9, 6.0 * pitch, seed);
}

Configuration device() {
  Configuration configuration;
  configuration.device.contact_area = 4e-12;
  configuration.device_force.realisations = 3;
  return configuration;
}

/// A pressure acts on the pixels that were measured: of whichever scan the load comes from.
TEST(DeviceScans, theirOrderChangesNothing) {
  const std::vector<HeightMap> scans = {withScatteredHoles(scanned(10e-9, 1), 0.05, 1),
                                        scanned(10e-9, 2), scanned(40e-9, 3)};
  Configuration loaded = device();
  loaded.model.load.mechanical_load = 1e-6;
  Configuration pressed = device();
  pressed.model.load.pressure = 1e6;
  for (const Configuration& configuration : {loaded, pressed}) {
    ScanPreparer preparer(configuration);
    std::vector<int> order = {0, 1, 2};
    std::optional<DeviceForce> first;
    do {
      DeviceScans together(configuration);
      for (const int place : order) {
        together.add("scan " + std::to_string(place),
                     preparer.prepare(scans[static_cast<std::size_t>(place)]));
      }
      const DeviceForce found = together.force();
      if (!first) first = found;
      EXPECT_EQ(found.pull_off_force, first->pull_off_force);
      EXPECT_EQ(found.pull_off_force_lower, first->pull_off_force_lower);
      EXPECT_EQ(found.pull_off_force_upper, first->pull_off_force_upper);
      EXPECT_EQ(found.separation_at_rest, first->separation_at_rest);
      EXPECT_EQ(found.warnings, first->warnings);
      EXPECT_NE(order[together.finest()], 2) << "the wide one";
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

}  // namespace
}  // namespace mems_stiction
