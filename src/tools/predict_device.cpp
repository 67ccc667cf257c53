/// predict_device: which force holds a whole device, by all scans of its surfaces? No ROS master
/// needed.

#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "busy_line.hpp"
#include "command_line.hpp"
#include "configuration/named_files.hpp"
#include "device_picture.hpp"
#include "evaluation/device_prediction.hpp"
#include "evaluation/plausibility.hpp"
#include "half_space_run.hpp"
#include "mems_stiction/configuration/configuration_yaml.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "numeric/words.hpp"

namespace {

using namespace mems_stiction;

struct Arguments {
  std::string configuration;
  std::vector<std::string> pitches;  ///< "M" or "MX,MY" of all scans, or one for each
  std::optional<double> area;
  std::optional<int> contacts;
  std::optional<int> realisations;
  std::optional<double> max_cells;
  std::optional<double> voltage;
  std::optional<double> load;
  std::string channel;
  std::string picture;
  bool json = false;
  bool ignore_mask = false;
  bool accept_implausible = false;
  bool strict = false;
  std::vector<std::string> counter_surface;
  std::vector<std::string> scans;
};

void describe(CLI::App& app, Arguments& arguments) {
  app.description(
      "Predicts the force that holds a whole device, from all scans of its surfaces: of any pitch, "
      "size and "
      "instrument.\n"
      "Surfaces of the device's size are made with what the scans say together, and brought to "
      "contact. Prints one "
      "record\nin SI units: median and 95 % interval, work of adhesion, the verdict where a spring "
      "or beam is stated.");
  app.add_option("SCAN", arguments.scans,
                 "scans of the surface, of any kind that predict_scan reads. Settings beside a "
                 "scan: SCAN.yaml, with "
                 "pitch_x, pitch_y, height_scale, ...")
      ->required()
      ->type_name("");
  app.add_option(
         "-c,--config", arguments.configuration,
         "materials, interface, loads, device, ...; every key is explained in config/stiction.yaml")
      ->type_name("FILE.yaml");
  app.add_option("-a,--area", arguments.area,
                 "nominal area of all contacts of the device together [m^2]; goes before "
                 "device/contact_area")
      ->type_name("M2");
  app.add_option("--contacts", arguments.contacts,
                 "separate contacts that share the area; goes before device/contacts")
      ->type_name("N");
  app.add_option(
         "--realisations", arguments.realisations,
         "surfaces of the device's size that are made; goes before device_force/realisations")
      ->type_name("N");
  app.add_option("--max-cells", arguments.max_cells,
                 "pixels of one made surface at most; goes before device_force/max_cells")
      ->type_name("N");
  app.add_option("-p,--pitch", arguments.pitches,
                 "distance of neighbouring pixels [m]; MX,MY where columns and rows differ. Given "
                 "once it counts for all scans; else give the option again for each, in their "
                 "order. Goes before what files say")
      ->type_name("M")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
  app.add_option("--counter-surface", arguments.counter_surface,
                 "scan of the surface that meets it, in place of what counter_surface/type says; "
                 "counter_surface/facing "
                 "must say which way it faces. Several by as many options")
      ->type_name("SCAN")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
  addLoadOptions(app, arguments);
  addChannelOption(app, arguments.channel);
  addMaskOption(app, arguments.ignore_mask);
  addPlausibilityOptions(app, arguments);
  app.add_flag("-j,--json", arguments.json,
               "one JSON object on one line instead of a YAML document");
  app.add_option("--picture", arguments.picture,
                 "draw spectrum, roughness against scale, a made surface and force against area, "
                 ".png, .pdf or .svg; "
                 "by plot_device")
      ->type_name("OUT.png");
  app.footer(
      "Exit status: 0, 1 with --strict and a warning, or 2 for bad input (one line on stderr names "
      "the file and the\n"
      "cause; a scan that cannot be used is not left out silently).\n\n"
      "Example: predict_device --config part.yaml --area 1e-8 afm_1.gwy afm_2.gwy wide.gwy");
}

/// A file that is read.
struct InputScan {
  std::string path;
  ScanFileOptions options;
};

/// @throw OptionsError if the number of pitches is neither one nor that of the scans
std::vector<InputScan> inputsOf(const Arguments& arguments, const std::vector<std::string>& paths,
                                bool is_counter) {
  const std::size_t count = arguments.pitches.size();
  if (!is_counter && count > 1 && count != paths.size()) {
    throw OptionsError({"--pitch: " + std::to_string(count) + " are given for " +
                        countText(paths.size(), "scan") + "; give it once, or once for each"});
  }
  std::vector<InputScan> inputs;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    InputScan input{paths[i], {}};
    input.options.import.channel = arguments.channel;
    input.options.import.ignore_mask = arguments.ignore_mask;
    std::string pitch;
    if (count == 1) pitch = arguments.pitches.front();
    if (count > 1 && !is_counter) pitch = arguments.pitches[i];
    applyPitch(pitch, input.options);
    inputs.push_back(input);
  }
  return inputs;
}

/// The configuration file with the command line's values in it. @throw OptionsError, FileError
Configuration configurationOf(const Arguments& arguments) {
  Configuration configuration =
      configurationFile(arguments.configuration, arguments.accept_implausible);
  applyLoads(arguments, configuration.model.load);
  if (arguments.area) configuration.device.contact_area = *arguments.area;
  if (arguments.contacts) configuration.device.contacts = *arguments.contacts;
  if (arguments.realisations) configuration.device_force.realisations = *arguments.realisations;
  if (arguments.max_cells) configuration.device_force.max_cells = *arguments.max_cells;
  if (!arguments.counter_surface.empty())
    configuration.counter_surface.type = CounterSurfaceType::kFlat;
  configuration.device_force.enabled = true;
  configuration.check();
  if (configuration.device.contact_area == 0.0) {
    throw OptionsError(
        {"device/contact_area: is not stated; give --area, the nominal area of all contacts of the "
         "device in m^2"});
  }
  return configuration;
}

/// @throw OptionsError for a picture that cannot be written, or that is one of the inputs
void requirePicture(const Arguments& arguments) {
  if (arguments.picture.empty()) return;
  const std::string kind = std::filesystem::path(arguments.picture).extension().string();
  if (kind != ".png" && kind != ".pdf" && kind != ".svg") {
    throw OptionsError(
        {"--picture: '" + arguments.picture + "' is not allowed, must end in .png, .pdf or .svg"});
  }
  std::vector<std::string> inputs = arguments.scans;
  inputs.insert(inputs.end(), arguments.counter_surface.begin(), arguments.counter_surface.end());
  inputs.push_back(arguments.configuration);
  requireOutput("--picture", arguments.picture, inputs);
}

/// @throw Error in one line, with the file's name
void predictDevice(const Arguments& arguments, const Configuration& configuration,
                   const std::vector<InputScan>& inputs,
                   const std::vector<InputScan>& counter_inputs) {
  DevicePredictor predictor(configuration);
  const auto take = [&](const InputScan& input, const auto& add) {
    const ScanFile file = whileSaying(input.path + ": reading", [&] {
      return openScanFile(input.path, configuration.scan, input.options);
    });
    for (const std::string& line :
         whileSaying(input.path + ": cleaning", [&] { return add(file); })) {
      warn("predict_device", line);
    }
  };
  for (const InputScan& input : inputs) {
    take(input, [&](const ScanFile& file) {
      return predictor.add(input.path, file.surface, file.notes, file.identity);
    });
  }
  for (const InputScan& input : counter_inputs) {
    take(input, [&](const ScanFile& file) {
      return predictor.addCounterSurface(input.path, file.surface, file.notes);
    });
  }
  const std::string what = countText(inputs.size(), "scan");
  DevicePrediction prediction = whileSayingShare(
      what, [&](const auto& on_progress) { return predictor.predict(on_progress); });
  predictor.judge(prediction, &withHalfSpaceProgress);
  for (const std::string& line : prediction.force.warnings) warn("predict_device", line);
  const std::string json = deviceJsonRecord(prediction);
  if (arguments.json) {
    std::cout << json << std::endl;
  } else {
    std::cout << deviceYamlRecord(prediction) << std::flush;
  }
  if (!arguments.picture.empty()) {
    whileSaying(arguments.picture + ": drawing",
                [&] { drawDevice(json, prediction.force.made_surface, arguments.picture); });
  }
}

/// @throw OptionsError for a number in the place of a scan, as behind "--pitch 1e-8 2e-8"
void requireNoNumbers(const std::vector<std::string>& scans) {
  for (const std::string& scan : scans) {
    const bool is_number = scan.find_first_not_of("0123456789.,eE+-") == std::string::npos;
    if (is_number && !std::filesystem::exists(scan)) {
      throw OptionsError({"--pitch: '" + scan +
                          "' stands in the place of a scan; give the option again for each value"});
    }
  }
}

int run(const Arguments& arguments) {
  if (!arguments.pitches.empty()) requireNoNumbers(arguments.scans);
  const std::vector<std::string> paths = scansOf(arguments.scans);
  const std::vector<InputScan> inputs = inputsOf(arguments, paths, false);
  const std::vector<InputScan> counter_inputs =
      inputsOf(arguments, scansOf(arguments.counter_surface), true);
  const Configuration configuration = withFilesOfNow(configurationOf(arguments));
  requirePicture(arguments);
  for (const std::string& warning : settingsWarnings(configuration))
    warn("predict_device", warning);
  predictDevice(arguments, configuration, inputs, counter_inputs);
  return strictStatus("predict_device", arguments.strict, 0);
}

}  // namespace

int main(int argc, char** argv) {
  return runProgram<Arguments>("predict_device", argc, argv, describe, run);
}
