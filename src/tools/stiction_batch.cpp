/// stiction_batch: one row per scan over many bags and scan files; goes on where it was
/// interrupted, in shards that join to what one run gives. No ROS master needed.

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/utils/logger.hpp>

#include "batch_arguments.hpp"
#include "batch_rows.hpp"
#include "batch_scans.hpp"
#include "batch_settings.hpp"
#include "busy_line.hpp"
#include "command_line.hpp"
#include "evaluation/half_space_call.hpp"
#include "evaluation/plausibility.hpp"
#include "files/output_file.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"
#include "part_devices.hpp"
#include "part_rows.hpp"
#include "prediction/contact_solvers.hpp"
#include "progress_bar.hpp"
#include "row_queue.hpp"
#include "row_states.hpp"
#include "rows_in_hand.hpp"

namespace {

using namespace mems_stiction;

/// Exit status when no scan of the call could be predicted.
constexpr int kNonePredicted = 1;
/// Changed files that are named one by one.
constexpr std::size_t kMostNamed = 10;

/// Refuses before the work what could not be written after it. @throw OptionsError, FileError
void checkOutputs(const BatchArguments& arguments) {
  for (const std::string& path :
       {arguments.output, settingsPathOf(arguments.output), arguments.table, arguments.parts}) {
    if (isLonelyPipe(path)) throw FileError(path + ": " + kLonelyPipe);
  }
  if (arguments.parts.empty()) return;
  rowFormatOf(arguments.parts, "--parts");
  if (arguments.parts == arguments.output || arguments.parts == arguments.table)
    throw OptionsError({"--parts: must be another file than --output"});
}

/// Whether the solver at work leaves a setting alone: it would be warned of.
bool isIgnored(const std::string& key, const Options& options) {
  const std::vector<IgnoredSetting> ignored = ignoredSettings(options.formulation, options);
  return std::any_of(ignored.begin(), ignored.end(),
                     [&](const IgnoredSetting& setting) { return setting.key == key; });
}

/// Says of scans that may be of one device, and do not say so, how they are judged together.
void askForPart(const BatchArguments& arguments, const Configuration& configuration) {
  if (!configuration.device.isStated()) return;
  const std::size_t count = scansWithoutPart(arguments.output);
  if (count < 2) return;
  complain(
      "stiction_batch",
      std::to_string(count) +
          " scans state no part_id, and each is judged alone: if they are of one device, --part "
          "NAME with --parts judges them together; of several, state part_id beside each scan "
          "(SCAN.yaml)");
}

/// If they are asked for, by the rows that are there.
/// - @p inputs, configuration that the rows were made of and with
void pool(const BatchArguments& arguments, const std::vector<std::string>& inputs,
          const Configuration& configuration) {
  if (arguments.parts.empty()) return;
  PartDevices devices(arguments, inputs, configuration);
  const auto device = [&](const std::vector<RowOfPart>& rows) {
    return whileSayingShare(
        "a part of " + countText(rows.size(), "scan"),
        [&](const auto& on_progress) { return devices.device(rows, on_progress); });
  };
  const std::size_t count = writeParts(arguments.output, arguments.parts, device);
  std::cout << oneLine(arguments.parts) << ": " << countText(count, "part") << "\n";
}

/// If it is asked for, of the rows that are there. @param sample of the rows
void tabulate(const BatchArguments& arguments, const RowFields& sample) {
  if (arguments.table.empty()) return;
  const std::size_t count = writeTable(arguments.table, arguments.form, sample);
  std::cout << oneLine(arguments.table) << ": " << countText(count, "column") << " of these rows\n";
}

constexpr const char* kGone = "rows are of files that are no longer there";

/// Complains of the first of many things in full, and of how many more there are: "more " + rest.
void complainOfMany(const std::vector<std::string>& things, const std::string& rest) {
  for (std::size_t i = 0; i < std::min(things.size(), kMostNamed); ++i)
    complain("stiction_batch", things[i]);
  if (things.size() <= kMostNamed) return;
  complain("stiction_batch", std::to_string(things.size() - kMostNamed) + " more " + rest);
}

/// Places of the rows whose files have changed since; says which, and which files are gone.
std::vector<std::size_t> changedRows(const RowFile& rows, RowFormat format,
                                     const BatchArguments& arguments,
                                     const std::vector<std::string>& columns,
                                     const BatchScans& scans,
                                     const std::vector<std::size_t>& numbers) {
  std::vector<std::size_t> changed;
  std::vector<std::string> changes;
  std::vector<std::string> gone;
  for (std::size_t place = 0; place < rows.earlier().size(); ++place) {
    const std::size_t number = numbers[place];
    std::string change;
    try {
      const RowTexts row = rowTextsOf(rows.earlier()[place], format, columns);
      const ScanState now = scans.state(number);
      change = changeSince(row, now);
      if (isGone(row, now)) {
        gone.push_back(scans.file(number) + ": is no longer there; its row " +
                       std::to_string(number) + " stays as it was");
      }
    } catch (const FileError& error) {
      throw FileError(arguments.output + ": " + error.what());
    } catch (const nlohmann::json::exception&) {
      change = "its row cannot be read";
    }
    if (change.empty()) continue;
    changed.push_back(place);
    changes.push_back(scans.file(number) + ": has changed since its row " + std::to_string(number) +
                      " was written, predicted again: " + change);
  }
  complainOfMany(changes, "rows are of files that have changed");
  complainOfMany(gone, kGone);
  return changed;
}

int run(const BatchArguments& arguments) {
  cv::utils::logging::setLogLevel(
      cv::utils::logging::LOG_LEVEL_SILENT);  // we name what is wrong ourselves
  const Shard shard = shardOf(arguments.shard);
  const RowFormat format = rowFormatOf(arguments.output);
  checkOutputs(arguments);
  const std::vector<std::string> inputs = inputsOf(arguments);
  Configuration configuration = configurationOf(arguments);
  for (const std::string& doubt : settingsWarnings(configuration)) warn("stiction_batch", doubt);
  OutputOptions& output = configuration.model.output;
  output = OutputOptions{};  // figures do not depend on it
  output.deformed_surfaces = output.contact_map = !arguments.dump.empty();
  output.energy_curve =
      !arguments.dump.empty() && !isIgnored("output/energy_curve", configuration.model);
  const OutputOptions wanted = output;
  output.energy_curve = output.deformed_surfaces = output.contact_map = false;
  const Configuration stated = configuration;  // the same settings with and without --dump
  output = wanted;

  BatchScans scans(arguments, inputs, configuration);
  RowQueue queue(arguments, configuration, scans);
  const bool has_device = configuration.device.isStated();
  const bool has_half_space = mayCallHalfSpace(configuration);
  const std::string& formulation = configuration.model.formulation;
  const RowFields sample = batchSample(formulation, has_device, has_half_space);
  const std::vector<std::string> columns = columnsOf(sample);
  if (!arguments.table.empty()) checkTable(arguments.table, arguments.form, columns);
  checkSettings(arguments.output,
                settingsText(scans.size(), inputs, arguments,
                             batchUnits(formulation, has_device, has_half_space), stated));
  std::vector<std::size_t> numbers;
  for (std::size_t number = shard.index; number <= scans.size(); number += shard.count)
    numbers.push_back(number);

  RowFile rows(arguments.output, format, headingText(format, columns), numbers);
  const std::vector<std::size_t> changed =
      changedRows(rows, format, arguments, columns, scans, numbers);
  const std::size_t before = rows.done() - changed.size();
  std::vector<std::size_t> wanted_numbers;
  wanted_numbers.reserve(numbers.size());
  for (const std::size_t place : changed) wanted_numbers.push_back(numbers[place]);
  wanted_numbers.insert(wanted_numbers.end(),
                        numbers.begin() + static_cast<std::ptrdiff_t>(rows.done()), numbers.end());
  const RowsInHand in_hand(arguments.output, queue.inHand());
  for (std::size_t i = 0; i < std::min(in_hand.left(), wanted_numbers.size()); ++i) {
    const std::size_t number = wanted_numbers[i];
    const std::string cause = whileSaying(
        scans.file(number) + ": an earlier call was killed here; trying it alone",
        [&] { return causeOfDeath(arguments, scans.file(number), scans.shardOfFile(number)); });
    if (!cause.empty()) scans.passOver(number, cause);
  }
  queue.expect(wanted_numbers);
  std::size_t failed_count = 0;
  std::size_t unsolved_count = 0;
  std::string first_message;
  {
    ProgressBar progress(numbers.size(), before);
    std::size_t made = 0;
    const auto show = [&](const std::string& doing) {
      progress.show(before + made, failed_count, doing);
    };
    for (; made < wanted_numbers.size(); ++made) {
      show("");
      const BatchRow row = queue.next(show);
      const std::string line = rowText(row.fields, format, columns);
      if (made == changed.size()) rows.settle();
      if (made < changed.size()) {
        rows.replace(changed[made], line);
      } else {
        rows.append(line);
      }
      if (!row.is_predicted && ++failed_count == 1) {
        const std::string& file = scans.file(wanted_numbers[made]);
        const bool names_it = row.message.find(file) != std::string::npos;
        first_message = (names_it ? "" : file + ": ") + row.message;
      }
      if (row.is_unsolved) ++unsolved_count;
      if (row.is_warned) ++warningCount();
    }
  }
  rows.settle();
  std::cout << oneLine(arguments.output) << ": " << countText(rows.done(), "row") << ", " << before
            << " of them from before, " << countText(failed_count, "scan") << " failed in this run";
  if (unsolved_count > 0) {
    std::cout << ", half-space not solved for " << countText(unsolved_count, "other");
  }
  std::cout << "\n";
  if (failed_count > 0) {
    complain("stiction_batch",
             (failed_count > 1 ? "the first of " + std::to_string(failed_count) + ": " : "") +
                 first_message);
  }
  tabulate(arguments, sample);
  askForPart(arguments, stated);
  pool(arguments, scans.inputs(), stated);
  return failed_count > 0 && failed_count == wanted_numbers.size()
             ? kNonePredicted
             : strictStatus("stiction_batch", arguments.strict, 0);
}

int merge(const BatchArguments& arguments) {
  std::vector<std::string> shards = inputsOf(arguments);
  for (std::string& shard : shards) shard = rowsBehind(shard);
  rowFormatOf(arguments.output);
  checkOutputs(arguments);
  for (const std::string& shard : shards) {
    std::error_code ignored;
    const bool is_there = std::filesystem::exists(shard, ignored);
    if (is_there && std::filesystem::exists(settingsPathOf(shard), ignored)) continue;
    throw FileError(shard + (is_there ? ": no rows of stiction_batch: there is no " +
                                            settingsPathOf(shard) + " beside it"
                                      : ": there is no such file"));
  }
  const std::string settings = readSettings(shards.front());
  for (const std::string& shard : shards) {
    if (comparableSettings(readSettings(shard)) != comparableSettings(settings)) {
      throw FileError(shard + ": made with other inputs or settings than " + shards.front());
    }
  }
  const std::size_t total = totalOf(shards.front(), settings);
  BatchArguments of_rows = arguments;
  std::optional<Configuration> made;  // what the rows were, where that is asked for
  const auto rowsMade = [&]() -> const Configuration& {
    if (!made) made = madeOf(shards.front(), settings, of_rows);
    return *made;
  };
  RowFields sample;
  if (!arguments.table.empty()) {
    const Configuration& configuration = rowsMade();
    sample = batchSample(configuration.model.formulation, configuration.device.isStated(),
                         mayCallHalfSpace(configuration));
    checkTable(arguments.table, arguments.form, columnsOf(sample));
  }
  complainOfMany(requireOneState(shards), kGone);
  mergeRows(shards, arguments.output, total);
  writeFile(settingsPathOf(arguments.output), settings);
  std::cout << oneLine(arguments.output) << ": " << countText(total, "row") << " of "
            << countText(shards.size(), "shard") << "\n";
  tabulate(arguments, sample);
  if (!arguments.parts.empty()) {
    const Configuration& configuration = rowsMade();
    askForPart(arguments, configuration);
    pool(of_rows, of_rows.inputs, configuration);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return runProgram<BatchArguments>("stiction_batch", argc, argv, describe,
                                    [](BatchArguments arguments) {
                                      if (arguments.form.isAsked()) {
                                        arguments.table = arguments.output;
                                        arguments.output = rowsPathOf(arguments.table);
                                      }
                                      return arguments.merge ? merge(arguments) : run(arguments);
                                    });
}
