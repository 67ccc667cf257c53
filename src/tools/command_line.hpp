#pragma once

/// What the command-line tools have in common: parsing, exit statuses, and one line on stderr for
/// what is wrong.

#include <CLI/CLI.hpp>

#include <cerrno>
#include <cstring>
#include <exception>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "errors/error_text.hpp"
#include "errors/one_line.hpp"
#include "files/interruption.hpp"
#include "files/open_files.hpp"
#include "mems_stiction/configuration/configuration.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "mems_stiction/loads/interface.hpp"
#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

/// Exit status when the command line or a scan cannot be used.
constexpr int kBadInput = 2;
/// Exit status of --strict where something was warned of.
constexpr int kStrict = 1;

inline void complain(const std::string& program, const std::string& what) {
  std::cerr << program << ": " << oneLine(what) << "\n";
}

/// How much has been warned of, for --strict.
inline int& warningCount() {
  static int count = 0;
  return count;
}

inline void printWarning(const std::string& path, const std::string& what) {
  std::cerr << oneLine(path) << ": warning: " << oneLine(what) << "\n";
}

/// One line about a scan that goes on.
inline void warn(const std::string& path, const std::string& what) {
  ++warningCount();
  printWarning(path, what);
}

/// "M" or "MX,MY" into both pitches. @throw OptionsError
inline void applyPitch(const std::string& text, ScanFileOptions& options) {
  options.pitch_option = "--pitch";
  if (text.empty()) return;
  std::istringstream stream(text);
  char comma = ',';
  bool good = static_cast<bool>(stream >> options.pitch_x);
  options.pitch_y = options.pitch_x;
  if (good && !(stream >> std::ws).eof())
    good = stream >> comma >> options.pitch_y && comma == ',' && stream.eof();
  if (!good || !Range::positive().contains(options.pitch_x) ||
      !Range::positive().contains(options.pitch_y)) {
    throw OptionsError({"--pitch: '" + text +
                        "' is not allowed, must be one or two numbers > 0 m, as in 20e-9,25e-9"});
  }
}

/// What is wrong with the command line, in one line.
std::string parseFailure(const CLI::App& app, const CLI::Error& error);

/// Before any work: @p path can be written to, and is none of the files that are read.
/// - @p option that names it; nothing is asked of an empty path
/// @throw OptionsError
void requireOutput(const std::string& option, const std::string& path,
                   const std::vector<std::string>& inputs);

/// The scan files that the arguments of a program name: those of a folder, by name, in its place;
/// sidecars aside. A folder's hidden files, folders and files that hold no scan by their ending
/// (.yaml, .md, .py, ...) are left out.
/// @throw FileError for a folder without any
std::vector<std::string> scansOf(const std::vector<std::string>& paths);

/// "--version" is among the arguments. Then it is all that is asked for.
bool asksVersion(int argc, char** argv);
void addVersion(CLI::App& app);
void printVersion(const std::string& program);

/// Numbers above 0, as an option's check.
std::string positive(const std::string& text);

/// Numbers that are not read as 0 without being 0, as an option's check.
std::string notLost(const std::string& text);

/// Calls handle(path) for each scan, sidecars aside. One that throws is named with the reason; the
/// others go on.
/// @return the exit status
template <typename Handler>
int forEachScan(const std::string& program, const std::vector<std::string>& scans,
                Handler&& handle) {
  int status = 0;
  for (const std::string& path : scansOf(scans)) {
    try {
      handle(path);
    } catch (const std::exception& error) {
      const std::string what = reasonOf(error);
      complain(program, what.find(path) == std::string::npos ? path + ": " + what : what);
      status = kBadInput;
    }
  }
  return status;
}

/// The whole of main(): describe(app, arguments), parse, run(arguments). @return the exit status
template <typename Arguments, typename Describe, typename Run>
int runProgram(const std::string& program, int argc, char** argv, Describe&& describe, Run&& run) {
  holdStandardDescriptors();
  cleanUpWhenInterrupted();
  try {
    if (asksVersion(argc, argv)) {
      printVersion(program);
      return 0;
    }
    CLI::App app;
    Arguments arguments;
    describe(app, arguments);
    addVersion(app);
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      if (error.get_exit_code() == 0) return app.exit(error);  // --help
      complain(program, parseFailure(app, error));
      return kBadInput;
    }
    const int status = run(arguments);
    if (std::cout.flush()) return status;
    complain(program,
             "the standard output cannot be written: " + std::string(std::strerror(errno)));
    return kBadInput;
  } catch (const std::exception& error) {
    complain(program, reasonOf(error));
    return kBadInput;
  }
}

/// -u and -l, into `voltage` and `load` of the arguments: std::optional<double>.
template <typename Arguments>
void addLoadOptions(CLI::App& app, Arguments& arguments) {
  app.add_option("-u,--voltage", arguments.voltage, "voltage between the surfaces [V]")
      ->type_name("V")
      ->check(notLost);
  app.add_option("-l,--load", arguments.load,
                 "external force pressing the scanned area together [N]; goes before load/pressure "
                 "and load/device_force")
      ->type_name("N")
      ->check(notLost);
}

/// What was given by them.
template <typename Arguments>
void applyLoads(const Arguments& arguments, LoadOptions& load) {
  if (arguments.voltage) load.voltage = *arguments.voltage;
  if (arguments.load) load.setMechanicalLoad(*arguments.load);
}

/// --accept-implausible and --strict, into members of these names.
template <typename Arguments>
void addPlausibilityOptions(CLI::App& app, Arguments& arguments) {
  app.add_flag("--accept-implausible", arguments.accept_implausible,
               "take scans and constants that no instrument, material or device has "
               "(limits/accept_implausible)");
  app.add_flag("--strict", arguments.strict,
               "exit with 1 where there is a warning and nothing worse");
}

/// The configuration file of a program; empty: the defaults.
/// @throw OptionsError, FileError
Configuration configurationFile(const std::string& path, bool accept_implausible);

/// The exit status of a program that has ended with @p status. @return kStrict with --strict and a
/// warning in place of 0
int strictStatus(const std::string& program, bool is_strict, int status);

/// --channel of an instrument maker's file.
void addChannelOption(CLI::App& app, std::string& channel);

/// --ignore-mask of a .gwy file.
void addMaskOption(CLI::App& app, bool& ignore_mask);

}  // namespace mems_stiction
