/// Sweeps and cycles of a part of a scan have the word of its prediction.

#include <gtest/gtest.h>

#include "evaluation/scan_flags.hpp"
#include "mems_stiction/evaluation/scan_predictor.hpp"
#include "mems_stiction/verdict/verdict.hpp"
#include "station/contact_cycles.hpp"
#include "station/load_sweep.hpp"
#include "support/analytic_surfaces.hpp"
#include "verdict/regime_flags.hpp"

namespace mems_stiction {
namespace {

constexpr int kSide = 125;
constexpr double kPitch = 10e-9;

TEST(ScanFlags, contactsAtTheBorderOfTheRegionAreThoseOfSweepsAndCycles) {
  Configuration configuration;
  // five summits along the middle, where the region ends
  configuration.preprocessing.region.width = 0.5 * kSide * kPitch;
  configuration.device.contact_area = 0.5 * kSide * kSide * kPitch * kPitch;
  configuration.device.travel = 1e-6;
  configuration.device.spring_stiffness = 1e4;
  configuration.device_force.enabled = false;
  const HeightMap scan = analytic::sphereArray(kSide, kSide, kPitch, kPitch, {1e-6}, 1, 5);
  ScanPredictor predictor(configuration);
  const PreparedScan prepared = predictor.preparer().prepare(scan);
  const Prediction prediction = predictor.predict(prepared);
  const Verdict verdict = verdictOf(prediction, configuration.device, configuration.uncertainty,
                                    configuration.model, scan.cellArea());
  ASSERT_NE(verdict.regime_flags & kBorderFlag, 0U);
  ASSERT_EQ(verdict.sticks, Sticks::kUnknown) << verdict.reason;
  const MeasuredScan measured = measuredScan(prepared, configuration.model);
  EXPECT_EQ(sweepLoads(configuration.model, prepared.model_surfaces, {{0.0}, {0.0}},
                       configuration.device, configuration.uncertainty, {}, {}, measured)
                .rows.front()
                .sticks,
            Sticks::kUnknown);
  EXPECT_EQ(cycleContacts(configuration.model, prepared.model_surfaces, 1, configuration.device,
                          configuration.uncertainty, {}, {}, measured)
                .cycles.front()
                .sticks,
            Sticks::kUnknown);
}

}  // namespace
}  // namespace mems_stiction
