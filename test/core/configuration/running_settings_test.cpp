#include "configuration/running_settings.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>

#include "mems_stiction/configuration/configuration_yaml.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/paper/paper_options.hpp"

namespace mems_stiction {
namespace {

Configuration insulated() {
  Configuration configuration;
  configuration.model.interface.insulator_thickness = 1e-7;
  return configuration;
}

TEST(SettingsOwner, ChangesTheRunningSettingsAndNoOthers) {
  Configuration configuration = insulated();
  configuration.preprocessing.offset.enabled = true;
  SettingsOwner owner(configuration);
  RunningSettings settings = owner.current();
  settings.load.voltage = 3.0;
  settings.interface.work_of_adhesion = 0.1;
  settings.capillary.relative_humidity = 0.4;
  settings.device.spring_stiffness = 2.0;
  settings.solver.of<PaperOptions>().cutoff_distance = 0.2e-9;
  owner.change(settings);
  configuration.model.load.voltage = 3.0;
  configuration.model.interface.work_of_adhesion = 0.1;
  configuration.model.capillary.relative_humidity = 0.4;
  configuration.device.spring_stiffness = 2.0;
  configuration.model.solver.of<PaperOptions>().cutoff_distance = 0.2e-9;
  EXPECT_EQ(toYaml(*owner.snapshot()), toYaml(configuration));
}

TEST(SettingsOwner, ARefusalNamesEachValueAndChangesNothing) {
  SettingsOwner owner(insulated());
  const std::string before = toYaml(*owner.snapshot());
  RunningSettings settings = owner.current();
  settings.interface.work_of_adhesion = 0.1;
  settings.load.voltage = 2000.0;
  settings.load.mechanical_load = -1.0;
  settings.device.spring_stiffness = std::nan("");
  try {
    owner.change(settings);
    FAIL() << "was accepted";
  } catch (const OptionsError& error) {
    EXPECT_EQ(error.violations().size(), 3U) << error.what();
  }
  settings = owner.current();
  settings.load.voltage = 1.0;
  settings.interface.insulator_thickness = 0.0;  // each is allowed, not both
  EXPECT_THROW(owner.change(settings), OptionsError);
  EXPECT_EQ(toYaml(*owner.snapshot()), before);
  EXPECT_THROW(SettingsOwner{[] {
                 Configuration bad;
                 bad.model.lower.hardness = -1.0;
                 return bad;
               }()},
               OptionsError);
}

TEST(SettingsOwner, ASnapshotStaysAsItIs) {
  SettingsOwner owner(insulated());
  const SettingsOwner::Snapshot before = owner.snapshot();
  RunningSettings settings = owner.current();
  settings.load.voltage = 5.0;
  owner.change(settings);
  EXPECT_EQ(before->model.load.voltage, 0.0);
  EXPECT_EQ(owner.snapshot()->model.load.voltage, 5.0);
}

TEST(SettingsOwner, WhoeverAsksMeanwhileSeesAChangeAsAWhole) {
  SettingsOwner owner(insulated());
  std::atomic<bool> is_over{false};
  std::thread changing([&] {
    for (int i = 0; i < 300; ++i) {
      RunningSettings settings = owner.current();
      settings.load.voltage = i % 2;
      settings.load.mechanical_load = 1e-6 * (i % 2);
      owner.change(settings);
    }
    is_over = true;
  });
  int torn = 0;
  while (!is_over) {
    const LoadOptions load = owner.current().load;
    if (load.mechanical_load != 1e-6 * load.voltage) ++torn;
  }
  changing.join();
  EXPECT_EQ(torn, 0);
}

}  // namespace
}  // namespace mems_stiction
