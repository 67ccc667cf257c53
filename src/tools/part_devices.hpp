#pragma once

/// The force of a part's device, by all of its scans together: what stiction_batch --parts judges
/// by.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "batch_arguments.hpp"
#include "batch_scans.hpp"
#include "mems_stiction/configuration/configuration.hpp"
#include "mems_stiction/evaluation/scan_predictor.hpp"
#include "mems_stiction/half_space/half_space_solution.hpp"
#include "mems_stiction/verdict/verdict.hpp"

namespace mems_stiction {

/// More scans of one part do not make its force better known; the first ones are taken.
constexpr std::size_t kMostScansOfDevice = 100;

/// A row of a scan that was predicted.
struct RowOfPart {
  std::size_t number = 0;
  std::optional<SolvedHalfSpace> half_space;  ///< that judged it: force and work alone
  std::uint32_t flags = 0;                    ///< bits of RegimeFlag
};

/// What all scans of a part say of its device.
struct PartDevice {
  std::optional<Verdict> verdict;  ///< nothing if the device's force was not asked for or not found
  std::vector<std::string> warnings;  ///< why not; and about the scans
};

/// Reads the scans of parts once more.
class PartDevices {
 public:
  /// - @p inputs of the rows, in their order
  PartDevices(const BatchArguments& arguments, std::vector<std::string> inputs,
              const Configuration& configuration);
  PartDevices(const PartDevices&) = delete;
  PartDevices& operator=(const PartDevices&) = delete;

  /// The half-space of the finest scan, where it judged, moves the device's force as that of its
  /// scan.
  /// - @p rows of one part
  /// - @p on_progress share of the device's force
  PartDevice device(const std::vector<RowOfPart>& rows,
                    const std::function<void(double)>& on_progress);

 private:
  HeightMap surface(std::size_t number);

  BatchArguments arguments_;
  std::vector<std::string> inputs_;
  Configuration configuration_;
  std::optional<BatchScans> scans_;  ///< once they are needed
  std::optional<ScanPredictor> predictor_;
};

}  // namespace mems_stiction
