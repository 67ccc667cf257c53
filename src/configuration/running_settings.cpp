#include "configuration/running_settings.hpp"

#include <utility>

#include "contact/guidance_setting.hpp"
#include "prediction/contact_solvers.hpp"

namespace mems_stiction {
namespace {

SettingsOwner::Snapshot checked(Configuration configuration) {
  configuration.check();
  return std::make_shared<const Configuration>(std::move(configuration));
}

}  // namespace

RunningSettings::RunningSettings(const Configuration& configuration)
    : interface(configuration.model.interface),
      capillary(configuration.model.capillary),
      load(configuration.model.load),
      device(configuration.device),
      guidance(configuration.model.guidance),
      solver(configuration.model.solver) {}

void RunningSettings::describe(OptionVisitor& visitor) {
  interface.describe(visitor);
  capillary.describe(visitor);
  load.describe(visitor);
  device.describe(visitor);
  describeGuidance(visitor, guidance);
  describeOwnSettings(solver, visitor);
}

SettingsOwner::SettingsOwner(const Configuration& configuration)
    : configuration_(checked(configuration)) {}

SettingsOwner::Snapshot SettingsOwner::snapshot() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return configuration_;
}

void SettingsOwner::change(const RunningSettings& settings) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Configuration configuration = *configuration_;
  configuration.model.interface = settings.interface;
  configuration.model.capillary = settings.capillary;
  configuration.model.load = settings.load;
  configuration.device = settings.device;
  configuration.model.guidance = settings.guidance;
  configuration.model.solver = settings.solver;
  configuration_ = checked(std::move(configuration));
}

}  // namespace mems_stiction
