#include "evaluation/device_prediction.hpp"

#include <utility>

#include "device/device_evidence.hpp"
#include "evaluation/frame_load.hpp"
#include "evaluation/plausibility.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "prediction/asked_output.hpp"

namespace mems_stiction {
namespace {

/// What the verdict needs of the prediction of a scan.
Configuration forVerdict(Configuration configuration) {
  configuration.model.output = figuresAlone();
  configuration.spatial_roughness.enabled = false;
  configuration.device_force.enabled = true;  // who asks for it wants it
  configuration.check();
  if (configuration.device.contact_area == 0.0) {
    throw OptionsError(
        {"device/contact_area: is not stated; must be the nominal area of all contacts of the "
         "device "
         "together, > 0 m^2"});
  }
  return configuration;
}

/// What goes wrong in the work is named by the scan.
template <typename Work>
auto named(const std::string& name, Work&& work) {
  try {
    return work();
  } catch (const SurfaceError& error) {
    throw SurfaceError(name + ": " + error.what());
  }
}

/// What all scans state alike, each with the settings' part where it names none.
Provenance provenanceOfAll(const std::vector<ScanIdentity>& identities,
                           const Configuration& stated) {
  Provenance all = provenanceOf(identities.empty() ? ScanIdentity() : identities.front(), stated);
  for (std::size_t i = 1; i < identities.size(); ++i) {
    static_cast<ScanIdentity&>(all) = commonIdentity(all, provenanceOf(identities[i], stated));
  }
  return all;
}

}  // namespace

std::vector<std::string> DevicePrediction::warnings() const {
  std::vector<std::string> all = scan_warnings;
  all.insert(all.end(), settings_warnings.begin(), settings_warnings.end());
  all.insert(all.end(), force.warnings.begin(), force.warnings.end());
  return all;
}

DevicePredictor::DevicePredictor(const Configuration& configuration)
    : stated_(configuration),
      configuration_(forVerdict(configuration)),
      predictor_(configuration_),
      scans_(configuration_) {
  prediction_.formulation = configuration_.model.formulation;
}

std::vector<std::string> DevicePredictor::noted(const std::string& name,
                                                std::vector<std::string> lines) {
  for (std::string& line : lines) line.insert(0, name + ": ");
  prediction_.scan_warnings.insert(prediction_.scan_warnings.end(), lines.begin(), lines.end());
  return lines;
}

std::vector<std::string> DevicePredictor::add(const std::string& name, const HeightMap& scan,
                                              const std::vector<std::string>& notes,
                                              const ScanIdentity& identity) {
  prepared_.push_back(named(name, [&] { return predictor_.preparer().prepare(scan); }));
  scans_.add(name, prepared_.back());
  prediction_.scans.push_back(name);
  prediction_.identities.push_back(identity);
  std::vector<std::string> lines = notes;
  for (std::string& line : warningsOf(prepared_.back())) lines.push_back(std::move(line));
  return noted(name, std::move(lines));
}

std::vector<std::string> DevicePredictor::addCounterSurface(const std::string& name,
                                                            const HeightMap& measured,
                                                            const std::vector<std::string>& notes) {
  std::vector<std::string> lines = notes;
  for (std::string& line : named(name, [&] { return scans_.addCounterSurface(name, measured); })) {
    lines.push_back(std::move(line));
  }
  prediction_.counter_surface.push_back(name);
  return noted(name, std::move(lines));
}

DevicePrediction DevicePredictor::predict(const std::function<void(double)>& on_progress) {
  DevicePrediction prediction = prediction_;
  prediction.provenance = provenanceOfAll(prediction.identities, stated_);
  prediction.settings_warnings = settingsWarnings(configuration_);
  prediction.force = scans_.force(on_progress);
  return prediction;
}

void DevicePredictor::judge(DevicePrediction& prediction, const HalfSpaceRun& run) {
  const DeviceOptions& device = configuration_.device;
  if (!device.hasSpring() && !device.hasBeam()) return;
  const std::size_t place = scans_.finest();
  const PreparedScan& finest = prepared_[place];
  const Prediction of_scan =
      named(prediction.scans[place], [&] { return predictor_.predict(finest); });
  Evidence evidence;
  evidence.device = deviceEvidence(prediction.force);
  prediction.verdict =
      judgedScan(of_scan, finest, onFrame(configuration_.model, device, finest.surfaces),
                 configuration_, evidence, &prediction.force, run)
          .verdict;
}

std::vector<DeviceForce> DevicePredictor::forces(
    const std::vector<Options>& models, const std::function<void(double)>& on_progress) const {
  std::vector<Options> plain = models;
  for (Options& model : plain) model.output = figuresAlone();
  return scans_.forces(plain, on_progress);
}

}  // namespace mems_stiction
