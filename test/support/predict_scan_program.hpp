#pragma once

/// The real predict_scan, and what it reads and writes.

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "import/scan_writer.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/program_run.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {

class PredictScan : public ::testing::Test {
 protected:
  Outcome run(const std::string& arguments) const {
    return runProgram(folder_, std::string(MEMS_STICTION_PREDICT_SCAN) + " " + arguments);
  }

  /// A sphere of 2 um in a frame of 2 um, float32 metres.
  std::string sphere(const std::string& name = "sphere.tiff") const {
    writeHeightTiff(folder_.file(name),
                    analytic::paraboloid(101, 101, 20e-9, 20e-9, 2e-6).heights());
    return folder_.file(name);
  }

  ScratchFolder folder_;
};

/// What --curve begins with.
constexpr const char* kCurveColumns =
    "height,force,direction,version,settings_hash,scan_name,part_id,serial_id,lot_id,wafer_id,site_"
    "x,site_y,"
    "acquisition_time,instrument,operator_name,checksum";

/// Height [m] and force [N] of the points of one direction, in the order of the file.
inline std::vector<std::pair<double, double>> pointsOf(const std::string& csv,
                                                       const std::string& direction) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, kCurveColumns);
  std::vector<std::pair<double, double>> points;
  while (std::getline(lines, line)) {
    const std::size_t first = line.find(',');
    const std::size_t second = line.find(',', first + 1);
    if (line.compare(second + 1, direction.size() + 1, direction + ",") == 0) {
      points.emplace_back(std::stod(line), std::stod(line.substr(first + 1, second - first - 1)));
    }
  }
  return points;
}

}  // namespace mems_stiction
