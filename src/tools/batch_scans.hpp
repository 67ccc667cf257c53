#pragma once

/// The scans of all inputs of a batch.

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bag_scans.hpp"
#include "batch_arguments.hpp"
#include "evaluation/scan_state.hpp"
#include "mems_stiction/configuration/configuration.hpp"

namespace mems_stiction {

/// A scan on its way to its row. Of a file it is the path alone: whoever makes the row reads it.
struct BatchScan {
  std::size_t number = 0;
  std::string input;      ///< as the user wrote it
  std::size_t place = 0;  ///< in its bag, from 1; 0: a file, or a bag as a whole
  std::string reason;     ///< why there is nothing to predict; else empty
  BagScan of_bag;
  ScanState state;  ///< of a bag
};

/// Numbers the scans from 1, in the order of the inputs.
class BatchScans {
 public:
  /// Looks into every bag. @param arguments, configuration must outlive this
  BatchScans(const BatchArguments& arguments, std::vector<std::string> inputs,
             const Configuration& configuration);

  std::size_t size() const { return items_.size(); }
  const std::vector<std::string>& inputs() const { return inputs_; }
  /// Of a number, as the user wrote it.
  const std::string& file(std::size_t number) const { return inputs_[items_[number - 1].input]; }
  /// settingsFilesChecksum() before the files are read.
  const std::string& settingsFileChecksum() const { return settings_file_checksum_; }

  /// The state of the files of a scan now; of a bag, when it was looked into.
  ScanState state(std::size_t number) const;
  /// Which of these are files, in this order.
  std::vector<std::string> files(const std::vector<std::size_t>& numbers) const;
  /// Which scan it is among those of its file, as --shard takes it: "3/5".
  std::string shardOfFile(std::size_t number) const;
  /// It gets a row with this reason in place of a prediction.
  void passOver(std::size_t number, const std::string& reason) {
    items_[number - 1].reason = reason;
  }
  /// Takes a scan out of its bag; what is wrong with it is its reason.
  BatchScan read(std::size_t number);

 private:
  /// One row to come.
  struct Item {
    std::size_t input = 0;  ///< place in the list of inputs
    std::size_t scan = 0;   ///< as BatchScan::place
    std::string reason;
  };

  void list(std::size_t input);
  const BagScans& open(std::size_t input);

  const BatchArguments& arguments_;
  std::vector<std::string> inputs_;
  const Configuration& configuration_;
  std::string settings_file_checksum_;
  std::map<std::size_t, ScanState>
      bag_states_;  ///< by the places of the inputs, before the bags are read
  std::vector<Item> items_;
  std::unique_ptr<BagScans> bag_;  ///< the one that was opened last
  std::size_t bag_input_ = 0;
};

}  // namespace mems_stiction
