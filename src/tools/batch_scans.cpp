#include "batch_scans.hpp"

#include <exception>
#include <utility>

#include "configuration/named_files.hpp"
#include "errors/error_text.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

bool isBag(const std::string& path) {
  return endsWith(path, ".bag") || endsWith(path, ".bag.active");
}

}  // namespace

BatchScans::BatchScans(const BatchArguments& arguments, std::vector<std::string> inputs,
                       const Configuration& configuration)
    : arguments_(arguments),
      inputs_(std::move(inputs)),
      configuration_(configuration),
      settings_file_checksum_(settingsFilesChecksum(configuration)) {
  for (std::size_t input = 0; input < inputs_.size(); ++input) list(input);
}

ScanState BatchScans::state(std::size_t number) const {
  const std::size_t input = items_[number - 1].input;
  const auto bag = bag_states_.find(input);
  return bag != bag_states_.end() ? bag->second
                                  : scanState(inputs_[input], true, settings_file_checksum_);
}

std::vector<std::string> BatchScans::files(const std::vector<std::size_t>& numbers) const {
  std::vector<std::string> paths;
  for (const std::size_t number : numbers) {
    const Item& item = items_[number - 1];
    if (item.scan == 0 && item.reason.empty()) paths.push_back(inputs_[item.input]);
  }
  return paths;
}

std::string BatchScans::shardOfFile(std::size_t number) const {
  std::size_t index = 0;
  std::size_t count = 0;
  for (std::size_t item = 0; item < items_.size(); ++item) {
    if (items_[item].input != items_[number - 1].input) continue;
    ++count;
    if (item < number) ++index;
  }
  return std::to_string(index) + "/" + std::to_string(count);
}

BatchScan BatchScans::read(std::size_t number) {
  const Item& item = items_[number - 1];
  BatchScan scan;
  scan.number = number;
  scan.input = inputs_[item.input];
  scan.place = item.scan;
  scan.reason = item.reason;
  const auto bag = bag_states_.find(item.input);
  if (bag != bag_states_.end()) scan.state = bag->second;
  if (!item.reason.empty()) scan.state = state(number);
  if (item.scan == 0 || !item.reason.empty()) return scan;
  try {
    const bool wants_counter = configuration_.counter_surface.type == CounterSurfaceType::kTopic;
    scan.of_bag = open(item.input).read(item.scan - 1, wants_counter);
  } catch (const std::exception& error) {
    scan.reason = reasonOf(error);
  }
  return scan;
}

void BatchScans::list(std::size_t input) {
  if (!isBag(inputs_[input])) {
    items_.push_back({input, 0, ""});
    return;
  }
  bag_states_[input] = scanState(inputs_[input], false, settings_file_checksum_);
  try {
    const BagScans& bag = open(input);
    for (std::size_t scan = 1; scan <= bag.count(); ++scan) items_.push_back({input, scan, ""});
    if (bag.wasCutOff()) {
      items_.push_back({input, 0,
                        "the bag was cut off; the " + std::to_string(bag.count()) +
                            " scans before the cut have their rows, what came later is lost"});
    }
  } catch (const std::exception& error) {
    items_.push_back({input, 0, error.what()});
  }
}

const BagScans& BatchScans::open(std::size_t input) {
  if (!bag_ || bag_input_ != input) {
    bag_.reset();
    bag_ = openBag(inputs_[input], arguments_.topic, configuration_.scan);
    bag_input_ = input;
  }
  return *bag_;
}

}  // namespace mems_stiction
