#pragma once

/// @file
/// The scans of a device as they come from Python.

#include <string>
#include <vector>

#include "evaluation/device_prediction.hpp"
#include "interruptible.hpp"
#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {
namespace python {

/// A scan as it came.
struct DeviceScan {
  std::string name;                ///< of its file; empty: its place stands for it
  HeightMap scan;                  ///< as it came
  std::vector<std::string> notes;  ///< on how it was read
  ScanIdentity identity;           ///< as its file states it
};

/// Cleans all of them for the predictor.
void addScans(const std::vector<DeviceScan>& scans, const std::vector<DeviceScan>& counter_surface,
              const Cancellation& check, DevicePredictor& predictor);

}  // namespace python
}  // namespace mems_stiction
