/// Slips of a unit are named, with the unit that was meant; real materials and devices are not.

#include "evaluation/plausibility.hpp"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "mems_stiction/configuration/configuration_yaml.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/paper/paper_options.hpp"

namespace mems_stiction {
namespace {

std::string onlyWarning(const Configuration& configuration) {
  const std::vector<std::string> lines = settingsWarnings(configuration);
  EXPECT_EQ(lines.size(), 1u);
  return lines.empty() ? "" : lines.front();
}

TEST(Plausibility, ASlipOfAUnitIsNamedWithTheUnitThatWasMeant) {
  Configuration configuration;
  configuration.model.interface.work_of_adhesion = 50.0;
  EXPECT_EQ(onlyWarning(configuration),
            "interface/work_of_adhesion 50 J/m^2 is implausible (1e-07 to 20 J/m^2 are taken): "
            "probably 50 mJ/m^2; "
            "write 0.05");
  configuration.model.interface.work_of_adhesion = 15.0;
  EXPECT_EQ(onlyWarning(configuration),
            "interface/work_of_adhesion 15 J/m^2 is outside the usual 1e-06 to 10 J/m^2: probably "
            "15 mJ/m^2; write 0.015");
  configuration = Configuration();
  configuration.model.lower.youngs_modulus = 169.0;
  EXPECT_NE(onlyWarning(configuration).find("probably 169 GPa; write 1.69e+11"), std::string::npos);
  configuration = Configuration();
  configuration.model.upper.hardness = 12.0;
  EXPECT_NE(onlyWarning(configuration).find("probably 12 GPa; write 1.2e+10"), std::string::npos);
  configuration = Configuration();
  configuration.model.interface.insulator_thickness = 100.0;
  EXPECT_NE(onlyWarning(configuration).find("probably 100 nm; write 1e-07"), std::string::npos);
  configuration = Configuration();
  configuration.model.formulation = "paper";
  configuration.model.solver.of<PaperOptions>().step = 0.1;
  EXPECT_NE(onlyWarning(configuration).find("paper/step 0.1 m is outside the usual"),
            std::string::npos);
  configuration = Configuration();
  configuration.model.capillary.relative_humidity = 0.4;
  configuration.model.capillary.temperature = 25.0;
  EXPECT_NE(onlyWarning(configuration).find("degrees Celsius; write 298.1"), std::string::npos);
  configuration = Configuration();
  configuration.counter_surface.type = CounterSurfaceType::kGaussian;
  configuration.counter_surface.gaussian.gaussian.rms_height = 3.0;
  EXPECT_NE(onlyWarning(configuration).find("probably 3 nm; write 3e-09"), std::string::npos);
  configuration = Configuration();
  configuration.counter_surface.type = CounterSurfaceType::kSelfAffine;
  configuration.counter_surface.self_affine.rolloff_wavelength = 2.0;
  EXPECT_NE(onlyWarning(configuration).find("probably 2 nm; write 2e-09"), std::string::npos);
}

TEST(Plausibility, AreasInSquareMicrometresAreNamed) {
  for (const double area : {40.0, 40e-6}) {
    Configuration configuration;
    configuration.device.contact_area = area;
    const std::string line = onlyWarning(configuration);
    EXPECT_NE(line.find("device/contact_area"), std::string::npos) << line;
    EXPECT_NE(line.find("probably 40 um^2; write 4e-11"), std::string::npos) << line;
  }
  Configuration configuration;
  configuration.device.contact_area = 1e-15;
  EXPECT_NE(onlyWarning(configuration).find("device/contact_area 1e-15 m^2 is outside the usual"),
            std::string::npos);
  configuration.device.contact_area = 40e-12;
  EXPECT_TRUE(settingsWarnings(configuration).empty());
  configuration.device.electrode_area = 40e-6;
  EXPECT_NE(onlyWarning(configuration).find("device/electrode_area"), std::string::npos);
}

TEST(Plausibility, ASettingThatTheSolverDoesNotUseIsNamed) {
  Configuration configuration;
  configuration.model.solver.of<PaperOptions>().step = 1e-9;
  EXPECT_EQ(onlyWarning(configuration), "paper/step 1e-09 has no effect: approach/formulation " +
                                            std::string(kDefaultFormulation) + " does not use it");
  configuration.model.formulation = "paper";
  EXPECT_TRUE(settingsWarnings(configuration).empty());
  configuration = Configuration();
  configuration.model.solver.of<PaperOptions>().cutoff_distance = 0.2e-9;
  configuration.model.output.energy_curve = true;
  configuration.uncertainty.hardness = 0.3;
  configuration.uncertainty.cutoff_distance = 0.3;
  configuration.model.capillary.contact_angle = 0.3;
  EXPECT_EQ(settingsWarnings(configuration).size(), 5u);
  configuration.model.capillary.relative_humidity = 0.4;
  EXPECT_EQ(settingsWarnings(configuration).size(), 4u);
}

TEST(Plausibility, FilmsThatBearOnNothingAreNamed) {
  Configuration configuration;
  configuration.model.lower.hamaker_constant = 261e-21;
  EXPECT_EQ(onlyWarning(configuration),
            "lower/hamaker_constant 2.61e-19 has no effect: lower/film_thickness is 0");
  configuration.model.lower.film_thickness = 2e-9;
  EXPECT_TRUE(settingsWarnings(configuration).empty());
  configuration.model.lower.hamaker_constant = 0.0;
  EXPECT_EQ(onlyWarning(configuration),
            "lower/film_thickness 2e-09 has no effect: lower/hamaker_constant is 0");
  configuration = Configuration();
  configuration.model.capillary.water_film = 0.8e-9;
  EXPECT_EQ(onlyWarning(configuration),
            "interface/water_film 8e-10 has no effect: interface/relative_humidity is 0");
  configuration = Configuration();
  configuration.model.formulation = "paper";
  configuration.model.interface.retardation_length = 20e-9;
  EXPECT_EQ(onlyWarning(configuration),
            "interface/retardation_length 2e-08 has no effect: the separation curve and the "
            "half-space alone retard the attraction");
}

TEST(Plausibility, WhatNoMaterialOrDeviceHasIsRefusedUnlessItIsMeant) {
  const auto refusal = [](const Configuration& configuration) {
    const std::vector<std::string> lines = configuration.validate();
    EXPECT_EQ(lines.size(), 1U);
    return lines.empty() ? "" : lines.front();
  };
  for (const double modulus : {169.0, 0.9e6, 2.1e12}) {
    Configuration configuration;
    configuration.model.lower.youngs_modulus = modulus;
    const std::string line = refusal(configuration);
    EXPECT_EQ(line.find("lower/youngs_modulus "), 0U) << line;
    EXPECT_NE(line.find("is implausible (1e+06 to 2e+12 Pa are taken)"), std::string::npos) << line;
    EXPECT_NE(line.find("limits/accept_implausible: true takes it"), std::string::npos) << line;
    EXPECT_THROW(configuration.check(), OptionsError);
    configuration.limits.accept_implausible = true;
    EXPECT_NO_THROW(configuration.check());
    EXPECT_EQ(settingsWarnings(configuration).size(), 1U) << "still said";
  }
  Configuration coated;
  coated.model.lower.film_thickness = 2.0;
  coated.model.lower.hamaker_constant = 261.0;
  coated.model.interface.retardation_length = 20.0;
  coated.model.capillary.relative_humidity = 0.3;
  coated.model.capillary.water_film = 0.8;
  std::string lines;
  for (const std::string& line : coated.validate()) lines += line + "\n";
  for (const char* meant :
       {"lower/film_thickness 2 m is implausible (1e-11 to 1e-05 m are taken): probably 2 nm",
        "lower/hamaker_constant 261 J is implausible (1e-24 to 1e-16 J are taken): probably 261 zJ",
        "interface/retardation_length 20 m is implausible (1e-10 to 1e-05 m are taken): probably "
        "20 nm",
        "interface/water_film 0.8 m is implausible (1e-11 to 2e-07 m are taken): probably 0.8 "
        "nm"}) {
    EXPECT_NE(lines.find(meant), std::string::npos) << lines;
  }
  Configuration blunt;  // 8 nm
  blunt.resolution.tip_radius = blunt.preprocessing.tip.radius = 8.0;
  EXPECT_EQ(blunt.validate().size(), 2U);
  for (const std::string& line : blunt.validate()) {
    EXPECT_NE(line.find(" 8 m is implausible (1e-11 to 0.001 m are taken): probably 8 nm"),
              std::string::npos)
        << line;
  }
  blunt.resolution.tip_radius = blunt.preprocessing.tip.radius = 1e-3;
  EXPECT_TRUE(blunt.validate().empty());
  Configuration rubber;
  rubber.model.upper.youngs_modulus = 1.5e6;
  EXPECT_TRUE(rubber.validate().empty());
  EXPECT_TRUE(settingsWarnings(rubber).empty());
  Configuration large;
  large.device.contact_area = 100.0;
  EXPECT_NE(refusal(large).find("device/contact_area 100 m^2 is implausible"), std::string::npos);
  large.device.contact_area = 0.9e-4;
  EXPECT_TRUE(large.validate().empty());
}

TEST(Plausibility, ALoadThatNoAreaCouldCarryIsNamed) {
  Options options;
  Prediction prediction;
  prediction.nominal_area = 36e-12;
  prediction.mechanical_load = 1e-6;
  EXPECT_TRUE(frameWarnings(prediction, options, {}).empty());
  prediction.mechanical_load = 1.0;  // 1 uN given as 1
  const std::vector<std::string> lines = frameWarnings(prediction, options, {});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].find("the mechanical load of 1 N is 2.778e+10 Pa on this frame"),
            std::string::npos)
      << lines[0];
  EXPECT_EQ(lines[0].find(','), std::string::npos);
}

TEST(Plausibility, DegreesAndOtherSlipsOfLengthAndStressAreNamed) {
  Configuration configuration;
  configuration.counter_surface.pose.tilt_x = -1.0;
  EXPECT_NE(onlyWarning(configuration).find("probably -1 degrees; write -0.01745"),
            std::string::npos);
  configuration = Configuration();
  configuration.counter_surface.pose.rotation = 45.0;
  EXPECT_NE(onlyWarning(configuration).find("probably 45 degrees; write 0.7854"),
            std::string::npos);
  configuration = Configuration();
  configuration.preprocessing.region.width = 2.0;
  EXPECT_NE(onlyWarning(configuration).find("probably 2 um; write 2e-06"), std::string::npos);
  configuration = Configuration();
  configuration.device.spring_stiffness = 5e5;
  EXPECT_NE(onlyWarning(configuration).find("probably 5e+05 mN/m; write 500"), std::string::npos);
  configuration = Configuration();
  configuration.model.interface.insulator_thickness = 0.1;  // um
  EXPECT_NE(onlyWarning(configuration).find("probably 0.1 um; write 1e-07"), std::string::npos);
}

TEST(Plausibility, WhatSettingsSayOfEachOtherIsNamed) {
  Configuration configuration;
  configuration.model.lower.hardness = 12e6;  // kPa for MPa
  EXPECT_NE(onlyWarning(configuration)
                .find("lower/hardness 1.2e+07 Pa beside lower/youngs_modulus 1.69e+11 Pa"),
            std::string::npos);
  configuration = Configuration();
  configuration.model.interface.work_of_adhesion = 5.0;
  EXPECT_NE(onlyWarning(configuration).find("z0 = 1.608e-11 m"), std::string::npos)
      << onlyWarning(configuration);
  configuration.model.interface.work_of_adhesion = 1e-4;
  EXPECT_NE(onlyWarning(configuration).find("is an attraction of the range"), std::string::npos);
  configuration = Configuration();
  configuration.model.capillary.relative_humidity = 0.5;
  configuration.model.capillary.water_film = 0.8e-9;
  EXPECT_TRUE(settingsWarnings(configuration).empty());
  configuration.model.capillary.contact_angle = 1.5;
  EXPECT_NE(onlyWarning(configuration).find("hardly wets"), std::string::npos);
  configuration = Configuration();
  DeviceOptions& device = configuration.device;
  device.beam_type = BeamType::kDoublyClamped;
  device.beam_length = 200e-6;
  device.beam_thickness = 2e-6;
  device.beam_gap = 2e-6;
  device.beam_modulus = 169e9;
  device.beam_residual_stress = -30e6;
  EXPECT_TRUE(settingsWarnings(configuration).empty());
  device.beam_residual_stress = -30.0;
  EXPECT_NE(onlyWarning(configuration).find("probably -30 MPa; write -3e+07"), std::string::npos);
  device.beam_residual_stress = 0.0;
  std::swap(device.beam_length, device.beam_thickness);
  EXPECT_NE(onlyWarning(configuration).find("is no beam"), std::string::npos);
}

TEST(Plausibility, WhatAVoltageBendsOfAPartIsSaid) {
  Configuration configuration;
  configuration.model.interface.insulator_thickness = 100e-9;
  configuration.model.load.voltage = 20.0;
  EXPECT_TRUE(settingsWarnings(configuration).empty());
  configuration.model.upper.thickness = 2e-6;
  EXPECT_EQ(onlyWarning(configuration).find("load/voltage 20 V beside upper/thickness 2e-06 m: "),
            0U);
  EXPECT_EQ(onlyWarning(configuration).find(','), std::string::npos);
  configuration.model.upper.backing =
      Backing::kBonded;  // a film lies on something that no field bends
  EXPECT_TRUE(settingsWarnings(configuration).empty());
  configuration.model.upper.backing = Backing::kFree;
  configuration.model.load.voltage = 0.0;
  EXPECT_TRUE(settingsWarnings(configuration).empty());
  configuration.model.load.contact_potential = -0.3;
  EXPECT_EQ(onlyWarning(configuration)
                .find("load/contact_potential 0.3 V beside upper/thickness 2e-06 m: "),
            0U);
}

TEST(Plausibility, ASettingOfWhatIsOffIsNamed) {
  Configuration configuration;
  configuration.preprocessing.spikes.threshold = 4.0;
  EXPECT_EQ(
      onlyWarning(configuration),
      "preprocessing/spikes/threshold 4 has no effect: preprocessing/spikes/enabled is false");
  configuration.preprocessing.spikes.enabled = true;
  EXPECT_TRUE(settingsWarnings(configuration).empty());
  configuration.counter_surface.gaussian.gaussian.rms_height = 9e-9;
  EXPECT_EQ(onlyWarning(configuration),
            "counter_surface/gaussian/rms_height 9e-09 has no effect: counter_surface/type is not "
            "gaussian");
  configuration = Configuration();
  configuration.device.beam_length = 200e-6;
  EXPECT_EQ(onlyWarning(configuration),
            "device/beam_length 0.0002 has no effect: device/beam_type is none");
}

TEST(Plausibility, HalfASpringBesideABeamIsNamed) {
  Configuration configuration;
  DeviceOptions& device = configuration.device;
  device.beam_type = BeamType::kCantilever;
  device.beam_length = 200e-6;
  device.beam_thickness = device.beam_gap = 2e-6;
  device.beam_modulus = 169e9;
  EXPECT_TRUE(settingsWarnings(configuration).empty());
  device.travel = 1e-6;
  EXPECT_EQ(onlyWarning(configuration),
            "device/travel 1e-06 has no effect: device/spring_stiffness is 0 and the gap of a beam "
            "is device/beam_gap");
  device.spring_stiffness = 1.0;
  EXPECT_TRUE(settingsWarnings(configuration).empty());
  device.travel = 0.0;
  EXPECT_EQ(onlyWarning(configuration),
            "device/spring_stiffness 1 has no effect: device/travel is 0");
  device.spring_stiffness = 0.0;
  device.electrode_start = 20e-6;
  EXPECT_EQ(onlyWarning(configuration),
            "device/electrode_start 2e-05 has no effect: device/electrode_length is 0");
}

TEST(Plausibility, ABeamBentBeyondSmallSlopesIsNamed) {
  Configuration configuration;
  DeviceOptions& device = configuration.device;
  device.beam_type = BeamType::kCantilever;
  device.beam_length = 200e-6;
  device.beam_thickness = 2e-6;
  device.beam_modulus = 169e9;
  device.beam_gap = 0.2 * device.beam_length;
  EXPECT_TRUE(settingsWarnings(configuration).empty());
  device.beam_gap *= 1.01;
  EXPECT_NE(onlyWarning(configuration)
                .find("device/beam_gap 4.04e-05 m beside device/beam_length 0.0002 m "),
            std::string::npos)
      << onlyWarning(configuration);
  device.beam_type = BeamType::kDoublyClamped;  // each half bends down
  EXPECT_FALSE(settingsWarnings(configuration).empty());
  device.beam_gap = 0.1 * device.beam_length;
  EXPECT_TRUE(settingsWarnings(configuration).empty());
}

TEST(Plausibility, NoCommaStandsInAWarning) {  // `rostopic echo -p` puts commas between fields
  Configuration configuration;
  configuration.model.interface.work_of_adhesion = 1e9;
  EXPECT_EQ(onlyWarning(configuration).find(','), std::string::npos);
}

TEST(Plausibility, ShippedMaterialsAndWhatIsNotStatedAreUsual) {
  EXPECT_TRUE(settingsWarnings(Configuration()).empty());
  for (const auto& entry : std::filesystem::directory_iterator(MEMS_STICTION_CONFIG_DIR)) {
    // node.yaml and source_*.yaml are for node and scan_source.
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".yaml" || name == "node.yaml") continue;
    if (name.rfind("source_", 0) == 0) continue;
    EXPECT_TRUE(settingsWarnings(loadConfiguration(entry.path().string())).empty()) << entry.path();
  }
}

}  // namespace
}  // namespace mems_stiction
