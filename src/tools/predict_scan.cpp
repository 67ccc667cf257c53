/// predict_scan: will the surface in this file stick? No ROS master needed; the prediction is the
/// node's to the last line.

#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "busy_line.hpp"
#include "command_line.hpp"
#include "configuration/named_files.hpp"
#include "curve_file.hpp"
#include "device/device_evidence.hpp"
#include "evaluation/device_scans.hpp"
#include "evaluation/frame_load.hpp"
#include "evaluation/plausibility.hpp"
#include "evaluation/scan_flags.hpp"
#include "evaluation/scan_judgement.hpp"
#include "half_space/half_space_fields.hpp"
#include "half_space_run.hpp"
#include "import/scan_writer.hpp"
#include "mems_stiction/configuration/configuration_yaml.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/evaluation/scan_predictor.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "numeric/words.hpp"
#include "prediction/asked_output.hpp"
#include "prediction/force_curve.hpp"
#include "scan_answer.hpp"
#include "scan_sweep.hpp"
#include "settings/option_values.hpp"
#include "verdict/margin_uncertainty.hpp"

namespace {

using namespace mems_stiction;

struct Arguments {
  std::string configuration;
  std::string pitch;  ///< "M" or "MX,MY"
  std::optional<double> voltage;
  std::optional<double> load;
  std::optional<double> step;
  std::string channel;
  std::string deformed;
  std::string curve;              ///< of the half-space, or of the formulation without it
  std::string formulation_curve;  ///< with the half-space and without
  HalfSpaceMapFiles half_space_maps;
  bool all = false;
  bool json = false;
  bool ignore_mask = false;
  bool accept_implausible = false;
  bool strict = false;
  bool record_curve = false;
  bool half_space = false;
  bool convergence = false;
  bool cleanings = false;
  SweepArguments sweep;
  std::vector<std::string> scans;
};

void describe(CLI::App& app, Arguments& arguments) {
  app.description(
      "Predicts whether the scanned surface sticks to its counter-surface: pull-off force, contact "
      "area, regimes.\n"
      "Prints the answer for people: status, force, verdict, flags in words, warnings. --all and "
      "--json print every figure in SI units, with the field names of "
      "mems_stiction/StictionPrediction.");
  app.add_option("SCAN", arguments.scans,
                 "TIFF, PNG or EXR image of heights, .npy, text (.txt, .asc, .csv, .xyz), .gwy, or "
                 "an instrument maker's file "
                 "(most of those need Gwyddion's libraries). Settings beside a scan: SCAN.yaml, "
                 "with pitch_x, pitch_y, "
                 "height_scale, ...")
      ->required()
      ->type_name("");
  app.add_option("-c,--config", arguments.configuration,
                 "materials, interface, loads, ...; every key is explained in config/stiction.yaml")
      ->type_name("FILE.yaml");
  app.add_option("-p,--pitch", arguments.pitch,
                 "distance of neighbouring pixels [m]; MX,MY where columns and rows differ. Goes "
                 "before what files say")
      ->type_name("M");
  addLoadOptions(app, arguments);
  app.add_option("-s,--step", arguments.step,
                 "approach per step of paper and printed [m], paper/step; 0 = automatic")
      ->type_name("M");
  addChannelOption(app, arguments.channel);
  addMaskOption(app, arguments.ignore_mask);
  addPlausibilityOptions(app, arguments);
  app.add_flag("-a,--all", arguments.all, "the whole record of each scan, as a YAML document");
  app.add_flag("-j,--json", arguments.json, "the whole record as one JSON object per line");
  app.add_option("--curve", arguments.curve,
                 "write force over height, both ways, as CSV: that of the formulation, its height "
                 "z0 - displacement, "
                 "or with --half-space that of the half-space over the same height; for one scan. "
                 "plot_curve draws it")
      ->type_name("OUT.csv");
  app.add_option("--formulation-curve", arguments.formulation_curve,
                 "write the formulation's with --half-space too, to be drawn over the "
                 "half-space's; for one scan")
      ->type_name("OUT.csv");
  app.add_flag("--record-curve", arguments.record_curve,
               "the record (--all, which this implies, or --json) holds the formulation's curve: "
               "displacement, force, is_separation of each point");
  app.add_flag("--convergence", arguments.convergence,
               "predict at full, half and quarter resolution too, and print how pull-off force and "
               "contact area move");
  app.add_flag(
      "--cleanings", arguments.cleanings,
      "predict under each reasonable cleaning too (not levelled, plane, parabola, row medians; "
      "with and without "
      "spikes), print how pull-off force and margin move, and widen the margin's interval by that");
  addSweepOptions(app, arguments.sweep);
  app.add_option("-d,--deformed", arguments.deformed,
                 "write the surface after contact as a float TIFF in metres; for one scan")
      ->type_name("OUT.tiff");
  app.add_flag("--half-space", arguments.half_space,
               "solve the whole surface of each scan as one elastic half-space too, as "
               "half_space/enabled true does, to "
               "see how far the asperity model is from it, and to judge the device by it; takes "
               "seconds to minutes, "
               "doc/half_space.md. Without it those are solved whose flags ask for it, where a "
               "device is stated");
  HalfSpaceMapFiles& files = arguments.half_space_maps;
  app.add_option("--half-space-pressure", files.pressure,
                 "write the pressure between the surfaces at rest in pascals, positive in contact; "
                 "for one scan")
      ->type_name("OUT.tiff");
  app.add_option("--half-space-gap", files.gap, "write the gap at rest in metres; for one scan")
      ->type_name("OUT.tiff");
  app.add_option("--half-space-deformed", files.deformed,
                 "as --deformed, by the half-space: what flowed is missing; for one scan")
      ->type_name("OUT.tiff");
  app.footer(
      "Exit status: 0 all scans predicted, 1 so they are, with --strict and a warning, 2 bad input "
      "(one line on "
      "stderr\n"
      "names the file and the cause; the other scans of the call are still predicted).\n\n"
      "Example: predict_scan --pitch 20e-9 --load 1e-6 surface.tiff");
}

void requireOneScan(const Arguments& arguments, const std::string& option,
                    const std::string& path) {
  if (arguments.scans.size() == 1) return;
  throw OptionsError({option + ": " + path + " cannot hold what belongs to " +
                      std::to_string(arguments.scans.size()) + " scans; give one scan"});
}

/// What the half-space's and the formulation's curves are written to; empty: not asked for.
struct CurveFiles {
  std::string half_space;
  std::string formulation;
};

/// @throw OptionsError if both are one file
CurveFiles curveFilesOf(const Arguments& arguments) {
  if (arguments.half_space) return {arguments.curve, arguments.formulation_curve};
  if (!arguments.curve.empty() && !arguments.formulation_curve.empty()) {
    throw OptionsError(
        {"--formulation-curve: without --half-space --curve is that curve already; give one of "
         "both"});
  }
  return {"", arguments.curve + arguments.formulation_curve};
}

/// Under another name nobody could open it. Devices and pipes have none.
void requireTiff(const std::string& option, const std::string& path) {
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
    return;
  const std::string kind = std::filesystem::path(path).extension().string();
  if (path.empty() || kind == ".tiff" || kind == ".tif") return;
  throw OptionsError({option + ": '" + path + "' is not allowed, must end in .tiff or .tif"});
}

/// @throw OptionsError for an output that cannot be written, or that is one of the inputs
void requireOutputs(const Arguments& arguments) {
  std::vector<std::string> inputs = arguments.scans;
  for (const std::string& scan : arguments.scans) inputs.push_back(scan + ".yaml");
  if (!arguments.configuration.empty()) inputs.push_back(arguments.configuration);
  std::vector<std::pair<std::string, std::string>> outputs = arguments.half_space_maps.wanted();
  outputs.insert(outputs.end(), {{"--deformed", arguments.deformed},
                                 {"--curve", arguments.curve},
                                 {"--formulation-curve", arguments.formulation_curve}});
  for (const auto& [option, path] : outputs) requireOutput(option, path, inputs);
  requireTiff("--deformed", arguments.deformed);
  for (const auto& [option, path] : arguments.half_space_maps.wanted()) requireTiff(option, path);
}

/// One of the settings, by its key.
void setNumber(Options& options, const std::string& key, double number) {
  ValueVisitor visitor([&](const std::string& name, auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>) {
      if (name == key) value = number;
    }
  });
  options.describe(visitor);
}

/// The configuration file with the command line's values in it.
/// @throw OptionsError, FileError
Configuration configurationOf(const Arguments& arguments) {
  Configuration configuration =
      configurationFile(arguments.configuration, arguments.accept_implausible);
  applyLoads(arguments, configuration.model.load);
  if (arguments.step) setNumber(configuration.model, "paper/step", *arguments.step);
  if (arguments.half_space) configuration.half_space.enabled = HalfSpaceUse::kAlways;
  configuration.check();
  sweepRequest(arguments.sweep, configuration.model);
  for (const auto& [option, path] :
       {std::make_pair("--deformed", arguments.deformed),
        std::make_pair("--curve", arguments.curve),
        std::make_pair("--formulation-curve", arguments.formulation_curve)}) {
    if (!path.empty()) requireOneScan(arguments, option, path);
  }
  for (const auto& [option, path] : arguments.half_space_maps.wanted()) {
    if (configuration.half_space.enabled != HalfSpaceUse::kAlways) {
      throw OptionsError({option + ": only the half-space has it; give --half-space too"});
    }
    requireOneScan(arguments, option, path);
  }
  return configuration;
}

/// @throw SurfaceError if the formulation does not follow the force
void requireCurve(const Prediction& prediction, const std::string& formulation) {
  if (!prediction.curve.empty()) return;
  throw SurfaceError("formulation " + formulation +
                     " does not follow the force, so that there is no curve of it");
}

AnswerForm formOf(const Arguments& arguments) {
  if (arguments.json) return AnswerForm::kJson;
  return arguments.all || arguments.record_curve ? AnswerForm::kYaml : AnswerForm::kShort;
}

/// @throw Error in one line, with the file's name
void predictScan(const std::string& path, const Arguments& arguments,
                 const ScanFileOptions& file_options, const Configuration& configuration,
                 ScanPredictor& predictor) {
  if (std::filesystem::path(path).extension() == ".bag") {
    throw FileError(
        path +
        ": is a bag; stiction_batch predicts the scans of bags (stiction_report shows them)");
  }
  if (std::filesystem::path(path).extension() == ".yaml" ||
      std::filesystem::path(path).extension() == ".yml") {
    throw FileError(path + ": is a file of settings, not a scan; give it with --config");
  }
  const CurveFiles curve_files = curveFilesOf(arguments);
  const ScanFile scan = whileSaying(
      path + ": reading", [&] { return openScanFile(path, configuration.scan, file_options); });
  const AnswerForm form = formOf(arguments);
  ScanWarnings warnings(path, answerShowsWarnings(form));
  warnings.addCounted(settingsWarnings(configuration));
  warnings.add(scan.notes);

  Prediction prediction;
  RecordExtras extras;
  extras.channel = scan.channel;
  extras.formulation = configuration.model.formulation;
  extras.provenance = provenanceOf(scan.identity, configuration);
  extras.has_curve = arguments.record_curve;
  extras.warnings = scan.notes;
  Options options = configuration.model;
  Evidence evidence;
  try {
    const PreparedScan prepared = whileSaying(
        path + ": cleaning", [&] { return predictor.preparer().prepare(scan.surface); });
    warnings.add(warningsOf(prepared));
    options = onFrame(configuration.model, configuration.device, prepared.surfaces);
    prediction = whileSaying(path + ": predicting", [&] { return predictor.predict(prepared); });
    warnings.add(frameWarnings(prediction, options, configuration.device));
    for (std::string& line : predictionWarnings(prepared, configuration, prediction, options)) {
      extras.warnings.push_back(std::move(line));
    }
    if (!arguments.deformed.empty()) requireDeformedSurfaces(prediction);
    if (!curve_files.formulation.empty() || extras.has_curve)
      requireCurve(prediction, options.formulation);
    extras.preprocessing = prepared.record;
    extras.pull_off_interval = pullOffInterval(prediction, options, configuration.uncertainty);
    if (arguments.convergence) {
      extras.convergence = whileSaying(path + ": predicting at coarser pixels",
                                       [&] { return predictor.convergence(prepared); });
    }
    std::optional<DeviceScale> scale;
    if (wantsDeviceForce(configuration.device, configuration.device_force)) {
      DeviceForce& force = extras.device_force.emplace();
      evidence = whileSayingShare(path, [&](const auto& tell) {
        return evidenceOfScan(prepared, configuration, tell, &force);
      });
      warnings.add(force.warnings);
      addMissing(force.warnings, extras.warnings);
      if (evidence.device) {
        scale = DeviceScale{*evidence.device, prediction.pull_off_force,
                            prediction.apparent_work_of_adhesion};
      }
    }
    if (std::optional<LoadSweepRequest> request =
            sweepRequest(arguments.sweep, configuration.model)) {
      if (request->mechanical_loads.empty())
        request->mechanical_loads = {options.load.mechanical_load};
      std::vector<LoadedScale> scales;
      if (scale) {
        scales = whileSayingShare(path + ": loading the device", [&](const auto& tell) {
          return scalesUnder(request->loadsOfDevice(options), prepared, configuration, tell);
        });
      }
      extras.sweep = whileSaying(path + ": sweeping the load", [&] {
        return sweepLoads(options, prepared.model_surfaces, *request, configuration.device,
                          configuration.uncertainty, RunControl(), scales,
                          measuredScan(prepared, options));
      });
    }
    if (arguments.cleanings) {
      extras.cleanings = whileSaying(path + ": predicting under each cleaning", [&] {
        return cleaningSpread(scan.surface, configuration, scale);
      });
    }
    if (arguments.cleanings) evidence.cleaning = reachOf(extras.cleanings);
    const ScanJudgement judged =
        judgedScan(prediction, prepared, options, configuration, evidence,
                   evidence.device ? &*extras.device_force : nullptr, &withHalfSpaceProgress);
    extras.half_space = judged.begun();
    extras.verdict = judged.verdict;
    if (judged.call.is_made && judged.half_space.status != HalfSpaceStatus::kSolved) {
      const std::string asked = judged.call.why.empty() ? "" : judged.call.why + " asks for it: ";
      warn(path, "half-space: " + asked + judged.half_space.message);
    }
  } catch (const SurfaceError& error) {
    throw SurfaceError(path + ": " + error.what());
  }
  if (!arguments.deformed.empty()) writeHeightTiff(arguments.deformed, prediction.deformed_lower);
  if (!curve_files.formulation.empty()) {
    writeCurve(curve_files.formulation, curveOf(prediction, options), *extras.provenance);
  }
  if (!curve_files.half_space.empty()) {
    writeCurve(curve_files.half_space, curveOf(*extras.half_space), *extras.provenance);
  }
  if (extras.half_space) writeMaps(arguments.half_space_maps, *extras.half_space);
  printAnswer(form, path, scan.surface, prediction, extras);
  warnings.answered();
}

int run(const Arguments& arguments) {
  std::optional<ScanPredictor> predictor;
  Configuration configuration;
  ScanFileOptions file_options;
  file_options.import.channel = arguments.channel;
  file_options.import.ignore_mask = arguments.ignore_mask;
  try {
    applyPitch(arguments.pitch, file_options);
    configuration = configurationOf(arguments);
    configuration.model.output.deformed_surfaces = !arguments.deformed.empty();
    configuration.model.output.contact_map = false;
    configuration.model.output.roughness = true;
    configuration = withFilesOfNow(std::move(configuration));
    predictor.emplace(configuration);
    curveFilesOf(arguments);
    requireOutputs(arguments);
    const bool answer_shows_them = answerShowsWarnings(formOf(arguments));
    for (const std::string& warning : settingsWarnings(configuration)) {
      ++warningCount();
      if (!answer_shows_them) printWarning("predict_scan", warning);
    }
  } catch (const Error& error) {
    complain("predict_scan", error.what());
    return kBadInput;
  }
  return forEachScan("predict_scan", arguments.scans, [&](const std::string& path) {
    predictScan(path, arguments, file_options, configuration, *predictor);
  });
}

}  // namespace

int main(int argc, char** argv) {
  return runProgram<Arguments>("predict_scan", argc, argv, describe, [](Arguments arguments) {
    arguments.scans = scansOf(arguments.scans);
    return strictStatus("predict_scan", arguments.strict, run(arguments));
  });
}
