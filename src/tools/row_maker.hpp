#pragma once

/// From the scan of a batch to its row.

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "batch_arguments.hpp"
#include "batch_rows.hpp"
#include "batch_scans.hpp"
#include "half_space_row.hpp"
#include "mems_stiction/evaluation/scan_predictor.hpp"
#include "mems_stiction/half_space/half_space_solver.hpp"
#include "mems_stiction/verdict/evidence.hpp"
#include "row_states.hpp"
#include "scan_row.hpp"
#include "scans_ahead.hpp"

namespace mems_stiction {

/// One row, and what it lacks.
struct BatchRow {
  RowFields fields;
  std::string message;  ///< why it is not predicted; empty if it is
  bool is_predicted = false;
  bool is_unsolved = false;  ///< the half-space was asked and has no solution
  bool is_warned = false;
};

/// A row with every column that the formulation has, in order, as it is without a value: names and
/// types. @param with_verdict whether a device is stated
RowFields batchSample(const std::string& formulation, bool with_verdict, bool with_half_space);

/// The unit of every such column that has one.
std::map<std::string, std::string> batchUnits(const std::string& formulation, bool with_verdict,
                                              bool with_half_space);

/// Predicts scans. One object serves one thread at a time.
class RowMaker {
 public:
  /// @param arguments, configuration, ahead must outlive this; several objects may share them
  RowMaker(const BatchArguments& arguments, const Configuration& configuration, ScansAhead& ahead);

  /// What is wrong with the scan is in its row. Writes its folder if arguments.dump says so.
  /// @param tell what the half-space is at, again and again while it is solved
  /// @throw FileError if the folder cannot be written
  BatchRow row(const BatchScan& scan, const std::function<void(const std::string&)>& tell);

 private:
  /// What a row says of a scan beside its figures.
  struct Subject {
    std::vector<std::string> warnings;
    ScanIdentity identity;
  };

  bool hasDevice() const { return configuration_.device.isStated(); }
  Subject predict(const BatchScan& scan, ScanOrigin& origin, ScanState& state);
  /// The row of a scan that is predicted. Adds warnings to @p subject.
  BatchRow predictedRow(const ScanOrigin& origin, const ScanState& state, Subject& subject,
                        const std::function<void(const std::string&)>& tell);
  HalfSpaceAnswer solve(const std::function<void(const std::string&)>& tell);
  /// On the device, if it is stated; by the half-space, if it was asked and can.
  std::optional<Verdict> judge(const HalfSpaceAnswer& half_space) const;
  void dump(std::size_t number, RowFields fields,
            const std::optional<SolvedHalfSpace>& half_space) const;

  const BatchArguments& arguments_;
  const Configuration& configuration_;
  ScanPredictor predictor_;
  HalfSpaceSolver half_space_;
  ScansAhead& ahead_;
  HeightMap surface_;      ///< as it was read
  PreparedScan prepared_;  ///< and what belongs to it, for the full result
  Prediction prediction_;
  Evidence beside_;  ///< on the device, but for the half-space's
};

}  // namespace mems_stiction
