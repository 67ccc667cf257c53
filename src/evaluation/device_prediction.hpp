#pragma once

/// @file
/// From scans as they were read to the record of a device's force: what predict_device and Python's
/// predict_device share.
///
///     DevicePredictor predictor(configuration);
///     for (const ScanFile& file : files) predictor.add(file.name, file.surface, file.notes);
///     DevicePrediction prediction = predictor.predict();
///     predictor.judge(prediction, [](const auto& solve) { return solve({}); });
///     std::cout << deviceYamlRecord(prediction);

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/device_scans.hpp"
#include "evaluation/scan_judgement.hpp"
#include "mems_stiction/configuration/configuration.hpp"
#include "mems_stiction/configuration/provenance.hpp"
#include "mems_stiction/device/device_force.hpp"
#include "mems_stiction/evaluation/scan_predictor.hpp"
#include "mems_stiction/half_space/half_space_solver.hpp"
#include "mems_stiction/verdict/verdict.hpp"

namespace mems_stiction {

/// A device's force, and where it comes from.
struct DevicePrediction {
  DeviceForce force;
  std::vector<std::string> scans;            ///< names of what was scanned of the lower surface
  std::vector<ScanIdentity> identities;      ///< of these
  std::vector<std::string> counter_surface;  ///< the same of the upper one
  std::string formulation;                   ///< that the made surfaces were brought to contact by
  std::optional<Verdict> verdict;            ///< on the device, where it states what is to open it
  std::optional<Provenance>
      provenance;  ///< version, hash of the settings, what all scans state alike
  std::vector<std::string> scan_warnings;  ///< what looks wrong in a scan, with its name
  std::vector<std::string> settings_warnings;

  /// Both, and those of the force.
  std::vector<std::string> warnings() const;
};

/// One device with device/contact_area. One object serves one thread.
class DevicePredictor {
 public:
  /// Reads the counter-surface's file, if it has one.
  /// @throw OptionsError if the configuration is out of range or states no contact area
  explicit DevicePredictor(const Configuration& configuration);

  /// - @p notes on how it was read
  /// @return what looks wrong in the scan, each with its name
  /// @throw SurfaceError with the name, if it cannot be used
  std::vector<std::string> add(const std::string& name, const HeightMap& scan,
                               const std::vector<std::string>& notes,
                               const ScanIdentity& identity = {});
  /// Of the surface that meets it, in place of the configured one. @return, @throw as add(), and
  /// OptionsError if counter_surface/facing does not say how it lies
  std::vector<std::string> addCounterSurface(const std::string& name, const HeightMap& measured,
                                             const std::vector<std::string>& notes);

  /// One of the surfaces that are made for the prediction, the whole of it.
  /// - @p number, @p depth as of DeviceScans::surface()
  DividedSurface surface(int number, std::optional<double> depth) const {
    return scans_.surface(number, depth);
  }
  /// What looks wrong in the scans, each with its name.
  const std::vector<std::string>& scanWarnings() const { return prediction_.scan_warnings; }

  /// Without a verdict.
  /// @throw as deviceForce()
  DevicePrediction predict(const std::function<void(double)>& on_progress = {});
  /// The verdict, where the device states what is to open it. Where the flags of the finest scan
  /// ask for the half-space, that judges, as for a prediction of the scan alone, and moves the
  /// device's figures.
  void judge(DevicePrediction& prediction, const HalfSpaceRun& run);

  /// The forces alone, by each of several models: the surfaces are made once.
  /// @throw as deviceForces()
  std::vector<DeviceForce> forces(const std::vector<Options>& models,
                                  const std::function<void(double)>& on_progress = {}) const;

 private:
  std::vector<std::string> noted(const std::string& name, std::vector<std::string> lines);

  Configuration stated_;
  Configuration configuration_;
  ScanPredictor predictor_;
  DeviceScans scans_;
  std::vector<PreparedScan> prepared_;
  DevicePrediction prediction_;
};

/// One YAML document, from its "---" to the end of its last line: figures, verdict, then the lists
/// `realisations`, `parts_of_scans`, `spectrum` and `warnings`, which are there when empty, too. A
/// comment at the end says force and interval for people.
std::string deviceYamlRecord(const DevicePrediction& prediction);

/// The same as one JSON object on one line, without a line end. Numbers that are not finite are
/// null.
std::string deviceJsonRecord(const DevicePrediction& prediction);

}  // namespace mems_stiction
