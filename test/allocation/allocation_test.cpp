#include <gtest/gtest.h>

#include <memory>

#include "mems_stiction/prediction/adhesion_model.hpp"
#include "mems_stiction/preprocess/pipeline.hpp"
#include "support/allocation_count.hpp"
#include "support/analytic_surfaces.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

constexpr int kSize = 512;

HeightMap frame(int seed) {
  GaussianSurfaceOptions options;
  options.rows = options.cols = kSize;
  options.seed = seed;
  return analytic::asSingle(gaussianSurface(options));
}

Options optionsWith(bool all_outputs) {
  Options options;
  options.load.voltage = 5.0;
  options.interface.insulator_thickness = 100e-9;
  options.output = {all_outputs, all_outputs, all_outputs, all_outputs, all_outputs};
  options.lower.hardness = options.upper.hardness = 1e12;  // nothing flows
  return options;
}

TEST(Allocation, IsSeenByTheCount) {
  startCountingAllocations();
  const auto memory = std::make_unique<std::vector<double>>(1000);
  const cv::Mat map = cv::Mat::zeros(100, 100, CV_64FC1);
  const AllocationCount count = stopCountingAllocations();
  EXPECT_GE(count.calls, 3);
  EXPECT_GE(count.peak,
            static_cast<std::ptrdiff_t>(1000 * sizeof(double) + 100 * 100 * sizeof(double)));
}

class RepeatedFrame : public testing::TestWithParam<bool> {};

TEST_P(RepeatedFrame, AllocatesNothing) {
  const HeightMap scan = frame(1);
  AdhesionModel model(optionsWith(GetParam()));
  Prediction prediction;
  model.predict(scan, prediction);
  startCountingAllocations();
  model.predict(scan, prediction);
  const AllocationCount count = stopCountingAllocations();
  EXPECT_EQ(count.calls, 0);
}

/// Places that flow are found by transforms, which may allocate, and listed; nothing is allocated
/// for each cell.
TEST_P(RepeatedFrame, ThatFlowsAllocatesForItsTransforms) {
  const HeightMap scan = frame(1);
  Options options = optionsWith(GetParam());
  options.lower.hardness = options.upper.hardness = 1e9;
  AdhesionModel model(options);
  Prediction prediction;
  model.predict(scan, prediction);
  EXPECT_GT(prediction.elasto_plastic_count + prediction.plastic_count, 0);
  startCountingAllocations();
  model.predict(scan, prediction);
  EXPECT_LT(stopCountingAllocations().calls, 1000);
}

TEST_P(RepeatedFrame, AgainstARoughCounterSurfaceAllocatesNothing) {
  const HeightMap scan = frame(1);
  const HeightMap counter_surface = frame(2);
  AdhesionModel model(optionsWith(GetParam()));
  Prediction prediction;
  model.predict({scan, counter_surface}, prediction);
  startCountingAllocations();
  model.predict({scan, counter_surface}, prediction);
  const AllocationCount count = stopCountingAllocations();
  EXPECT_EQ(count.calls, 0);
}

INSTANTIATE_TEST_SUITE_P(Outputs, RepeatedFrame, testing::Values(false, true));

/// What levelling left is measured on a sample of 64 x 64 pixels, whatever the size of the scan.
TEST(RepeatedScan, IsCleanedWithoutAllocationButForTheSampleOfItsTilt) {
  const HeightMap scan = frame(1);
  PipelineOptions options;
  options.offset.enabled = true;
  options.lines.method = LineAlignment::kMedian;
  options.spikes.enabled = true;
  options.spikes.threshold = 20.0;  // finds none: filling holes allocates
  options.fill.enabled = true;
  options.level.shape = LevelShape::kPlane;
  ScanCleaner cleaner(options);
  ASSERT_EQ(cleaner.clean(scan).record.steps[2].changed_pixels, 0);
  startCountingAllocations();
  cleaner.clean(scan);
  const AllocationCount with_tilt = stopCountingAllocations();
  EXPECT_LT(with_tilt.peak, static_cast<std::ptrdiff_t>(8 * 64 * 64 * sizeof(double)));

  options.level.shape = LevelShape::kNone;
  ScanCleaner without_level(options);
  without_level.clean(scan);
  startCountingAllocations();
  without_level.clean(scan);
  const AllocationCount count = stopCountingAllocations();
  EXPECT_EQ(count.calls, 0);
}

TEST(Memory, OfAPredictionStaysBelow64BytesAPixelBeyondTheInput) {
  const HeightMap scan = frame(1);
  for (const double max_contact_fraction : {0.3, 1.0}) {
    Options options = optionsWith(true);
    options.approach.max_contact_fraction = max_contact_fraction;
    options.load.mechanical_load = 1.0;  // nothing carries it: the approach goes on to the limit
    startCountingAllocations();
    {
      AdhesionModel model(options);
      Prediction prediction;
      model.predict(scan, prediction);
    }
    const AllocationCount count = stopCountingAllocations();
    EXPECT_LE(count.peak, 64 * kSize * kSize) << "contact fraction " << max_contact_fraction;
    EXPECT_GE(count.peak, 8 * kSize * kSize)
        << "the gap alone takes 8 bytes a pixel: the count must see it";
  }
}

}  // namespace
}  // namespace mems_stiction
