#include "verdict/missing_scan.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "loads/force_range.hpp"
#include "mechanics/traction_law.hpp"
#include "verdict/part_verdict.hpp"
#include "verdict/regime_flags.hpp"

namespace mems_stiction {
namespace {

UnresolvedWaves wavesOf(double rms_height, double pitch = 10e-9, double hurst = 0.8) {
  UnresolvedWaves waves;
  waves.pitch = pitch;
  waves.shortest_shown = 2.0 * pitch;
  waves.rms_height = rms_height;
  waves.hurst = hurst;
  return waves;
}

TEST(MissingScan, isOneThatShowsWavesWhichAdhesionDoesNotBridge) {
  const Options options;
  const double range = forceRange(options.interface, options.lower, options.upper);
  EXPECT_DOUBLE_EQ(shortWaves(wavesOf(0.1e-9), options).limit,
                   range);  // at 20 nm flattening costs too much
  EXPECT_FALSE(shortWaves(wavesOf(0.99 * range), options).areUnresolved());
  EXPECT_TRUE(shortWaves(wavesOf(1.01 * range), options).areUnresolved());
  EXPECT_FALSE(shortWaves(UnresolvedWaves(), options).areUnresolved());  // nobody has looked
}

TEST(MissingScan, isNoneWhereWaterFillsOrAdhesionFlattensTheWaves) {
  const UnresolvedWaves waves = wavesOf(1e-9);
  Options options;
  EXPECT_TRUE(shortWaves(waves, options).areUnresolved());
  options.capillary.relative_humidity = 0.5;
  EXPECT_FALSE(shortWaves(waves, options).areUnresolved());
  EXPECT_DOUBLE_EQ(shortWaves(waves, options).limit, options.capillary.law().gapLimit());

  Options soft;
  soft.lower.youngs_modulus = soft.upper.youngs_modulus = 10e6;
  const double limit = shortWaves(waves, soft).limit;
  EXPECT_GT(limit, 1e-9);
  // a half-space with a wave of this rms height: E' q h^2/4 per area
  const double modulus = ContactPair(soft.lower, soft.upper).contact_modulus;
  const double wave_number = 2.0 * M_PI / waves.shortest_shown;
  EXPECT_NEAR(0.25 * modulus * wave_number * limit * limit, 0.25 * soft.interface.work_of_adhesion,
              1e-12);

  Options none;
  none.interface.work_of_adhesion = 0.0;
  EXPECT_FALSE(shortWaves(waves, none).areUnresolved());
}

TEST(MissingScan, hasPixelsThatLeaveOutNoMoreThanAdhesionBridges) {
  const Options options;
  for (const double hurst : {0.5, 0.8, 0.99}) {
    for (const double pitch : {20e-9, 200e-9}) {
      for (const double height : {0.3e-9, 0.7e-9, 3e-9}) {
        const ShortWaves found = shortWaves(wavesOf(height, pitch, hurst), options);
        if (!found.areUnresolved()) continue;
        EXPECT_LT(found.needed_pitch, pitch);
        if (found.needed_pitch == 1e-9) continue;  // no tip draws less
        const double left = height * std::pow(found.needed_pitch / pitch, hurst);
        EXPECT_FALSE(shortWaves(wavesOf(left, found.needed_pitch, hurst), options).areUnresolved())
            << hurst << " " << pitch << " " << height;
        const double digit = found.needed_pitch /
                             std::pow(10.0, std::floor(std::log10(1.0001 * found.needed_pitch)));
        EXPECT_TRUE(std::abs(digit - 1.0) < 1e-9 || std::abs(digit - 2.0) < 1e-9 ||
                    std::abs(digit - 5.0) < 1e-9);
      }
    }
  }
}

TEST(MissingScan, isNamedWithItsWidthAndPixels) {
  const Options options;
  const std::string white_light =
      whatIsMissing(shortWaves(wavesOf(0.75e-9, 197e-9), options), kTheScan);
  EXPECT_EQ(
      white_light.find(
          "the scan does not show what holds: waves shorter than two pixels of 197 nm have an "
          "rms height of some 0.75 nm"),
      0U)
      << white_light;
  EXPECT_NE(white_light.find("missing is AFM, 2 um to 10 um wide, pixels of 20 nm or less"),
            std::string::npos)
      << white_light;
  UnresolvedWaves blunt = wavesOf(0.5e-9);
  blunt.shortest_shown = 80e-9;
  const std::string by_tip = whatIsMissing(shortWaves(blunt, options), kNoScan);
  EXPECT_EQ(by_tip.find("no scan shows what holds: waves shorter than 80 nm, which are the tip's,"),
            0U)
      << by_tip;
  EXPECT_NE(by_tip.find("AFM with a sharper tip"), std::string::npos) << by_tip;
  EXPECT_EQ(whatIsMissing(shortWaves(wavesOf(0.01e-9), options), kTheScan), "");
}

TEST(MissingScan, isNoneWhereThePixelsAreAsSmallAsThoseOfAnyTip) {
  const Options options;
  for (const double pitch : {0.5e-9, 1e-9}) {
    const std::string noise = whatIsMissing(shortWaves(wavesOf(5e-9, pitch), options), kTheScan);
    EXPECT_NE(noise.find("no scan resolves them: they need pixels below 1 nm"), std::string::npos)
        << noise;
    EXPECT_EQ(noise.find("missing is"), std::string::npos) << noise;
  }
  EXPECT_NE(whatIsMissing(shortWaves(wavesOf(5e-9, 2e-9), options), kTheScan)
                .find("missing is AFM, 100 nm to 500 nm wide, pixels of 1 nm or less"),
            std::string::npos);
  UnresolvedWaves blunt = wavesOf(5e-9, 1e-9);
  blunt.shortest_shown = 80e-9;
  EXPECT_NE(whatIsMissing(shortWaves(blunt, options), kTheScan).find("AFM with a sharper tip"),
            std::string::npos);
}

/// A contact with a spring that holds it open, by far.
struct StatedDevice {
  Prediction prediction;
  DeviceOptions device;

  StatedDevice() {
    prediction.status = Status::kEquilibrium;
    prediction.nominal_area = device.contact_area = 1e-12;
    prediction.pull_off_force = prediction.pull_off_force_jkr =
        prediction.pull_off_force_transition = 1e-7;
    prediction.apparent_work_of_adhesion = 0.01;
    prediction.pull_off_exponents = prediction.work_exponents = {1.0, 0.0, 0.0};
    prediction.model.assumes_jkr = false;
    prediction.asperity_count = prediction.pull_off_contact_count = 25;
    Asperity asperity;
    asperity.composite_radius = 1e-6;
    asperity.area = 2500e-18;
    prediction.asperities.assign(25, asperity);
    device.spring_stiffness = 100.0;
    device.travel = 1e-6;
  }
  Verdict verdict(const Evidence& evidence = {}) const {
    return verdictOf(prediction, device, {}, Options(), 25e-18, evidence);
  }
};

TEST(MissingScan, makesTheVerdictUnknownWhateverItWouldBe) {
  StatedDevice stated;
  for (const double stiffness : {100.0, 0.1, 1e-4}) {  // no, marginal, yes
    stated.device.spring_stiffness = stiffness;
    stated.prediction.short_waves = {};
    EXPECT_NE(stated.verdict().sticks, Sticks::kUnknown);
    stated.prediction.short_waves = shortWaves(wavesOf(1e-9), Options());
    const Verdict verdict = stated.verdict();
    EXPECT_EQ(verdict.sticks, Sticks::kUnknown);
    EXPECT_EQ(verdict.reason, whatIsMissing(stated.prediction.short_waves, kTheScan));
    EXPECT_TRUE(std::isnan(verdict.margin));
    EXPECT_NE(verdict.regime_flags & kUnresolvedFlag, 0U);
    EXPECT_EQ(flagsForHalfSpace(verdict.regime_flags | kNearBondingFlag),
              0U);  // its pixels are the same
  }
}

TEST(MissingScan, isNoMatterForABeamWhoseWorkOfAdhesionWasMeasured) {
  StatedDevice stated;
  stated.device = {};
  stated.device.beam_type = BeamType::kCantilever;
  stated.device.beam_length = 100e-6;
  stated.device.beam_thickness = stated.device.beam_gap = 2e-6;
  stated.device.beam_modulus = 160e9;
  stated.device.apparent_work_of_adhesion = 1e-3;
  const Sticks before = stated.verdict().sticks;
  stated.prediction.short_waves = shortWaves(wavesOf(1e-9), Options());
  EXPECT_EQ(stated.verdict().sticks, before);
  stated.device.apparent_work_of_adhesion = 0.0;
  EXPECT_EQ(stated.verdict().sticks, Sticks::kUnknown);
}

TEST(MissingScan, isForAllScansOfAPartTogether) {
  StatedDevice stated;
  Evidence evidence;
  DeviceEvidence& of_device = evidence.device.emplace();
  of_device.pull_off_force = 1e-7;
  of_device.apparent_work_of_adhesion = 0.01;
  of_device.force_factors = of_device.work_factors = {0.9, 1.0, 1.1};
  stated.prediction.short_waves = shortWaves(wavesOf(1e-9), Options());
  EXPECT_EQ(stated.verdict(evidence).sticks, Sticks::kNo);  // another scan shows it
  of_device.missing_scan = whatIsMissing(stated.prediction.short_waves, kNoScan);
  of_device.warnings = {of_device.missing_scan};
  EXPECT_EQ(stated.verdict(evidence).sticks, Sticks::kUnknown);
  EXPECT_EQ(stated.verdict(evidence).reason, of_device.missing_scan);
}

/// As stiction_batch and the node pool scans without the device's own force.
TEST(MissingScan, leavesAPartToTheScansThatShowWhatHolds) {
  StatedDevice stated;
  const auto statement = [&](const std::string& name, double height, Status status) {
    Prediction prediction = stated.prediction;
    prediction.status = status;
    prediction.short_waves = shortWaves(wavesOf(height), Options());
    return statementOf(name, prediction,
                       verdictOf(prediction, stated.device, {}, Options(), 25e-18));
  };
  const ScanStatement fine = statement("fine", 0.05e-9, Status::kEquilibrium);
  const ScanStatement wide = statement("wide", 1e-9, Status::kBonded);
  const PooledVerdict alone = pooledVerdictOf({fine, fine});
  const PooledVerdict part = pooledVerdictOf({fine, fine, wide, wide, wide, wide, wide});
  EXPECT_EQ(part.sticks, Sticks::kNo) << part.reason;
  EXPECT_EQ(part.margin.value, alone.margin.value);
  EXPECT_EQ(part.margin.lower, alone.margin.lower);
  EXPECT_EQ(part.counted_scans, 2);
  ASSERT_FALSE(part.warnings.empty());
  EXPECT_NE(part.warnings[0].find("AFM"), std::string::npos) << part.warnings[0];
  const PooledVerdict none = pooledVerdictOf({wide, wide});
  EXPECT_EQ(none.sticks, Sticks::kUnknown);
  EXPECT_NE(none.reason.find("missing is AFM"), std::string::npos) << none.reason;
}

}  // namespace
}  // namespace mems_stiction
