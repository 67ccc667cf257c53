#pragma once

/// @file
/// The settings that may change while a node runs, and the one place where they are.
///
/// Whoever needs a setting asks the owner, and works with that snapshot until one piece of work is
/// done. So what is predicted, judged and published belongs together, whatever changes meanwhile.
/// What prepares a scan (prepared_scan.hpp) is not among these settings: a change never makes a
/// prepared scan stale.

#include <memory>
#include <mutex>

#include "mems_stiction/configuration/configuration.hpp"

namespace mems_stiction {

/// Five sections of the configuration.
struct RunningSettings {
  InterfaceOptions interface;
  CapillaryOptions capillary;
  LoadOptions load;
  DeviceOptions device;
  Guidance guidance;      ///< of the section device, too
  SolverSettings solver;  ///< what single solvers ask for beside

  explicit RunningSettings(const Configuration& configuration);

  void describe(OptionVisitor& visitor);
};

/// Holds a configuration that is always valid. Every thread may ask and change.
class SettingsOwner {
 public:
  using Snapshot = std::shared_ptr<const Configuration>;

  /// @throw OptionsError if the configuration is out of range.
  explicit SettingsOwner(const Configuration& configuration);

  /// The whole configuration of now; it stays as it is.
  Snapshot snapshot() const;
  /// The part of it that may change.
  RunningSettings current() const { return RunningSettings(*snapshot()); }

  /// All of them at once. @throw OptionsError naming each refused value and combination; then
  /// nothing changes.
  void change(const RunningSettings& settings);

 private:
  mutable std::mutex mutex_;
  Snapshot configuration_;
};

}  // namespace mems_stiction
