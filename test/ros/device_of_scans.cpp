/// The force of a device from scans in files, by the core alone: what the node's answer is compared with.
///
/// usage: device_of_scans CONFIG.yaml SCAN...
/// Prints a line per figure, and one per made surface, with all digits.

#include <cstdio>
#include <exception>
#include <iostream>
#include <string>

#include "device/device_force_fields.hpp"
#include "evaluation/frame_load.hpp"
#include "mems_stiction/configuration/configuration_yaml.hpp"
#include "mems_stiction/device/device_force.hpp"
#include "mems_stiction/evaluation/prepared_scan.hpp"
#include "mems_stiction/import/scan_file.hpp"

namespace mems_stiction {
namespace {

void print(const std::string& name, double value) { std::printf("%s %.17g\n", name.c_str(), value); }

int run(int count, char** arguments) {
  const Configuration configuration = loadConfiguration(arguments[1]);
  ScanPreparer preparer(configuration);
  DeviceSurfaces surfaces;
  Options model = configuration.model;
  for (int i = 2; i < count; ++i) {
    const PreparedScan scan = preparer.prepare(readScanFile(arguments[i], configuration.scan));
    surfaces.scans.push_back({arguments[i], scan.surfaces.lower});
    model = onFrame(configuration.model, configuration.device, scan.surfaces);
  }
  const DeviceForce force = deviceForce(surfaces, {configuration.device.contact_area, configuration.device.contacts},
                                        model, configuration.uncertainty, configuration.device_force);
  visitDeviceForceFields(
      force, [](const Figure& figure, const auto& value) { print(figure.name, static_cast<double>(value)); });
  for (const Realisation& made : force.realisations) print("realisation", made.pull_off_force);
  return 0;
}

}  // namespace
}  // namespace mems_stiction

int main(int count, char** arguments) {
  try {
    return mems_stiction::run(count, arguments);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
