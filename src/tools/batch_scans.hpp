#pragma once

/// The scans of all inputs of a batch, and the row of each.

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "batch_arguments.hpp"
#include "batch_rows.hpp"
#include "half_space_row.hpp"
#include "mems_stiction/half_space/half_space_solver.hpp"
#include "mems_stiction/scan/scan_predictor.hpp"
#include "row_states.hpp"
#include "scan_bag_reader.hpp"
#include "scan_row.hpp"
#include "scans_ahead.hpp"

namespace mems_stiction {

/// One row, and what it lacks.
struct BatchRow {
  RowFields fields;
  std::string reason;  ///< why it is not predicted; empty if it is
  bool is_predicted = false;
  bool is_solved = false;  ///< by the half-space
};

/// Numbers the scans from 1, in the order of the inputs.
class BatchScans {
 public:
  /// Looks into every bag. @param arguments, configuration must outlive this
  BatchScans(const BatchArguments& arguments, std::vector<std::string> inputs, const Configuration& configuration);

  std::size_t size() const { return items_.size(); }
  std::vector<std::string> columns() const;
  std::map<std::string, std::string> units() const;

  /// What has changed in the files of a scan since this row of it was written, in words; empty if nothing has.
  /// @throw FileError without a file name for a row that does not say what it is of
  std::string changeSince(const RowTexts& row, std::size_t number) const;

  /// Which rows will be asked for, in this order: their files are read ahead.
  void expect(const std::vector<std::size_t>& numbers);

  /// Of a number, as the user wrote it.
  const std::string& file(std::size_t number) const { return inputs_[items_[number - 1].input]; }

  /// Predicts a scan; what is wrong with it is in its row. Writes its folder if arguments.dump says so.
  /// @param number from 1 to size()
  /// @param tell what the half-space is at, again and again while it is solved
  /// @throw FileError if the folder cannot be written
  BatchRow row(std::size_t number, const std::function<void(const std::string&)>& tell);

 private:
  /// One row to come.
  struct Item {
    std::size_t input = 0;  ///< place in the list of inputs
    std::size_t scan = 0;   ///< of the bag, from 1; 0: a file, or a bag as a whole
    std::string reason;     ///< why there is nothing to predict; else empty
  };

  /// What a row says of a scan beside its figures.
  struct Subject {
    std::vector<std::string> warnings;
    ScanIdentity identity;
  };

  bool hasDevice() const { return configuration_.device.isStated(); }
  void list(std::size_t input);
  const ScanBagReader& open(std::size_t input);
  Subject predict(const Item& item, ScanOrigin& origin, ScanState& state);
  HalfSpaceAnswer solve(const std::function<void(const std::string&)>& tell) const;
  /// On the device, if it is stated; by the half-space, if it was asked and can.
  std::optional<Verdict> judge(const HalfSpaceAnswer& half_space) const;
  void dump(std::size_t number, RowFields fields, const std::optional<SolvedHalfSpace>& half_space) const;

  const BatchArguments& arguments_;
  std::vector<std::string> inputs_;
  const Configuration& configuration_;
  std::string settings_file_checksum_;           ///< before the files are read
  std::map<std::size_t, ScanState> bag_states_;  ///< by the places of the inputs, before the bags are read
  ScanPredictor predictor_;
  HalfSpaceSolver half_space_;
  ScansAhead ahead_;
  std::vector<Item> items_;
  std::unique_ptr<ScanBagReader> bag_;  ///< the one that was opened last
  std::size_t bag_input_ = 0;
  HeightMap surface_;      ///< as it was read
  PreparedScan prepared_;  ///< and what belongs to it, for the full result
  Prediction prediction_;
};

}  // namespace mems_stiction
