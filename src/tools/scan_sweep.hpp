#pragma once

/// The options of predict_scan that sweep loads, and what they ask for.

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

#include "mems_stiction/prediction/options.hpp"
#include "station/load_sweep.hpp"

namespace mems_stiction {

/// As they were written: "V,V,..." or "FIRST:LAST:STEP".
struct SweepArguments {
  std::optional<std::string> voltages;
  std::optional<std::string> loads;
};

void addSweepOptions(CLI::App& app, SweepArguments& arguments);

/// "0,5,1e1", or a range with its end, as "0:30:2.5": the numbers that scripts/sweep_load takes, to
/// the bit.
/// - @p option that is named by what is thrown
/// @throw OptionsError
std::vector<double> numbersOf(const std::string& option, const std::string& text);

/// The grid; without --sweep-voltage the voltage that is set. Without --sweep-load it has no load
/// yet: that of the frame.
/// @throw OptionsError for numbers that cannot be swept, naming the option
std::optional<LoadSweepRequest> sweepRequest(const SweepArguments& arguments, const Options& model);

}  // namespace mems_stiction
